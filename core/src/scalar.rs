//! The numbers a picture is computed with: only the operations the tracer uses, in small traits, and
//! the laws that every implementation obeys.
//!
//! | trait | what it holds |
//! | --- | --- |
//! | [`Scalar`] | arithmetic: sums, products, roots, reciprocals, unit vectors |
//! | [`Tolerance`] | how far results can be off, and margins for it |
//! | [`Ratio`] | quotients of whole numbers, for places in a picture |
//! | [`Intensity`] | light: sums of it, powers of cosines, 8-bit levels |
//! | [`SaturationCounter`] | what fixed point does with a result that leaves its range |
//!
//! What the accelerators ask of a number is theirs: [`crate::accel::AccelScalar`]. Conversion from
//! and to `f64` is apart, too: [`crate::quantize`].
//!
//! Laws, on which the accelerators' proof of exactness (see [`crate::accel`]) and the absence of
//! panics rest:
//!
//! 1. No operation panics, whatever its operands.
//! 2. `+`, `-` and `*` by a fixed factor are monotone: a larger operand never gives a smaller
//!    result (within the format's range).
//! 3. [`Scalar::quotient`] and [`Scalar::times_reciprocal`] saturate where the quotient leaves the
//!    range.
//! 4. The same operands give the same bits on every target.

mod approx;
mod fixed;
mod float;
mod intensity;
pub(crate) mod multiply;
mod operators;
mod ratio;
mod root;
mod saturation;
mod tolerance;
mod whole;
mod zeros;

pub use approx::Approx;
pub(crate) use fixed::reciprocal_q15;
pub use fixed::{Fixed, Fixed64, Reciprocal};
pub use intensity::{Exponent, Intensity};
pub use ratio::Ratio;
pub use saturation::SaturationCounter;
pub use tolerance::Tolerance;
pub(crate) use whole::{whole_f32, whole_f64};
pub(crate) use zeros::leading_zeros;

use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

/// A number format with the arithmetic of ray tracing.
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

    /// Conservative test for `numerator / divisor > limit`, both operands ≥ 0, without dividing.
    /// Never true where [`Scalar::quotient`] gives `limit` or less, or what is found would depend on
    /// the order of the search.
    fn quotient_exceeds(numerator: Self, divisor: Self, limit: Self) -> bool;

    /// ⌊`self` · n⌋ for 0 ≤ `self` ≤ 1: 0 to `n`, monotone.
    fn scale_to_index(self, n: u32) -> u32;

    /// The unit vector along `v`, and the length of `v`. The null vector gives itself and 0.
    fn unit(v: [Self; 3]) -> ([Self; 3], Self);

    /// Brings a length into a shape's own scale, where its size is about 1: times 2^`exponent`
    /// in formats whose precision is absolute, unchanged where it is relative.
    fn to_local(self, exponent: i8) -> Self;

    /// The inverse of [`Scalar::to_local`], saturating.
    fn to_global(self, exponent: i8) -> Self;

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
}
