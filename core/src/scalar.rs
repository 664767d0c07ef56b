//! The numbers a picture is computed with: only the operations the tracer uses, and the laws that
//! every implementation obeys.
//!
//! Laws, on which the octree's proof of exactness (see [`crate::accel`]) and the absence of
//! panics rest:
//!
//! 1. No operation panics, whatever its operands.
//! 2. `+`, `-` and `*` by a fixed factor are monotone: a larger operand never gives a smaller
//!    result (within the format's range).
//! 3. [`Scalar::quotient`] and [`Scalar::times_reciprocal`] saturate where the quotient leaves the range.
//! 4. The same operands give the same bits on every target.

mod approx;
mod fixed;
mod float;
pub(crate) mod multiply;
mod root;
mod whole;
mod zeros;

pub use approx::Approx;
pub(crate) use fixed::reciprocal_q15;
pub use fixed::{Fixed, Fixed64, Reciprocal, reset_saturations, saturations};
pub(crate) use zeros::leading_zeros;

use crate::accel::{BoundScalar, InvDirection};
use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

/// A number format with the operations of Whitted ray tracing.
pub trait Scalar:
    Copy
    + Default
    + Debug
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The largest finite value.
    const MAX: Self;
    /// Whether roots and reciprocals, and with them the lengths of unit vectors, are exact but for
    /// rounding.
    const EXACT_ROOTS: bool;

    /// A product or a sum of products, twice as wide, that has not been rounded yet (floats: as
    /// wide as the number itself).
    type Wide: Copy + PartialOrd + Add<Output = Self::Wide> + Sub<Output = Self::Wide>;

    /// The product of two numbers, not rounded.
    fn product(a: Self, b: Self) -> Self::Wide;

    /// The product of a number with itself, not rounded.
    #[inline(always)]
    fn square(self) -> Self::Wide {
        Self::product(self, self)
    }

    /// Rounds a sum of products once, to nearest.
    fn narrow(wide: Self::Wide) -> Self;

    /// The square root of a sum of products; 0 if it is negative.
    fn sqrt_wide(wide: Self::Wide) -> Self;

    /// The square root; 0 if negative.
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt_wide(Self::product(self, Self::ONE))
    }

    /// 1/x in whatever form divides cheapest afterwards.
    type Reciprocal: Copy + Debug + Send + Sync + 'static;

    /// The reciprocal; that of 0 is the largest there is.
    fn reciprocal(self) -> Self::Reciprocal;

    /// `self` divided by the number whose reciprocal is given, saturating.
    fn times_reciprocal(self, reciprocal: Self::Reciprocal) -> Self;

    /// `self / divisor`, saturating.
    #[inline(always)]
    fn quotient(self, divisor: Self) -> Self {
        self.times_reciprocal(divisor.reciprocal())
    }

    /// Whether `numerator / divisor`, both ≥ 0, is certain to come out above `limit`: an answer
    /// without the division. Never true where [`Scalar::quotient`] gives `limit` or less, or what
    /// is found would depend on the order of the search.
    fn quotient_exceeds(numerator: Self, divisor: Self, limit: Self) -> bool;

    /// The reciprocal of a whole number, 1 ≤ `n` < 2³¹, for [`Scalar::ratio`].
    fn whole_reciprocal(n: u32) -> Self::Reciprocal;

    /// `numerator / n` for |numerator| ≤ 8 n, given `n`'s [`Scalar::whole_reciprocal`].
    fn ratio(numerator: i32, n: Self::Reciprocal) -> Self;

    /// ⌊`self` · n⌋ for 0 ≤ `self` ≤ 1; monotone.
    fn scale_to_index(self, n: u32) -> u32;

    /// The unit vector along `v`, and the length of `v`. The null vector gives itself and 0.
    fn unit(v: [Self; 3]) -> ([Self; 3], Self);

    /// `self` raised to `exponent`, for 0 ≤ `self` ≤ 1; 0⁰ is 1.
    fn power(self, exponent: Exponent<Self>) -> Self;

    /// Brings a length into a shape's own scale, where its size is about 1: times 2^`exponent`
    /// in formats whose precision is absolute, unchanged where it is relative.
    fn to_local(self, exponent: i8) -> Self;

    /// The inverse of [`Scalar::to_local`], saturating.
    fn to_global(self, exponent: i8) -> Self;

    /// A bound on how far a computed surface point, refined onto its shape, can lie from that
    /// shape, with a margin for the next ray's own rounding. `position` is the largest coordinate
    /// of the point, `curvature_extent` the size of a curved shape (0 for flat ones); both ≥ 0.
    fn surface_error(position: Self, curvature_extent: Self) -> Self;

    /// The grey level of an intensity: ⌊255 · clamp(self, 0, 1) + ½⌋.
    fn level(self) -> u8;

    /// A distance ≥ 0 with what rounding may have taken from it, where rounding is relative: which
    /// of two planes is met first does not hang on a last bit then. In fixed point quotients are
    /// rounded to absolute steps, and two that differ by less are equal already.
    #[inline(always)]
    fn with_rounding_margin(self) -> Self {
        self
    }

    /// The sum of a pixel's light so far and one more contribution. Fixed point stops at 1, where
    /// the result is clamped anyway, so that any number of contributions ≥ 0 has room.
    fn accumulate(self, light: Self) -> Self;

    /// The absolute value.
    #[inline(always)]
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// The smaller of two.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// A coordinate or a length on the packed tree's grid: an integer, with `GRID_SLACK` at most
    /// between what a ray's computed point rounds to and where the ray truly is. Coordinates of a
    /// scene, and their differences, stay below 2³¹.
    fn to_grid(self) -> i32;

    /// See [`Scalar::to_grid`].
    const GRID_SLACK: i32;

    /// Whether hits always lie within [`Quantize::SLACK`] of the true surface. Where they do not,
    /// a hit's point has to be looked for in its object's box, and an octree that links objects by
    /// exact shape would miss hits that brute force finds.
    const HITS_WITHIN_SLACK: bool;

    /// A direction's component with 30 bits behind the point.
    fn direction_q30(self) -> i32;

    /// The number that the octree's planes and ray parameters are held in.
    type Bound: BoundScalar;

    /// The same value as a plane coordinate, exactly.
    fn to_bound(self) -> Self::Bound;

    /// The nearest value to a plane coordinate.
    fn from_bound(bound: Self::Bound) -> Self;

    /// The reciprocal of a direction component as the octree's walk wants it.
    fn inv_direction(self) -> InvDirection<Self::Bound>;
}

/// An exponent ≥ 0, split so that the whole part is done by repeated squaring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exponent<S> {
    /// ⌊exponent⌋.
    pub whole: u32,
    /// What is left, in [0, 1).
    pub fraction: S,
}

/// The border between `f64` and a format. Only code that prepares a scene or looks at a result
/// uses it; nothing in the tracer does.
pub trait Quantize: Scalar {
    /// The name that the command line uses.
    const NAME: &'static str;
    /// Bits behind the point, for fixed-point formats.
    const FRACTION_BITS: Option<u32>;
    /// How far a computed hit point, not refined, can lie from its shape, as a share of the
    /// largest distance in the scene. Bounding boxes are this much larger than their shapes.
    const SLACK: f64;
    /// The nearest value; saturates, NaN gives 0.
    fn from_f64(x: f64) -> Self;
    /// The exact value (the 64-bit fixed format: rounded to nearest).
    fn to_f64(self) -> f64;
}
