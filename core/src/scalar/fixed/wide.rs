//! 64-bit fixed point, the reference beside the 32-bit formats: exact integer square root and
//! division, slow and plain.

use crate::array::map3;
use crate::scalar::operators::operators;
use crate::scalar::{Exponent, Intensity, Ratio, SaturationCounter, Scalar, Tolerance};
use core::cmp::Ordering;
use core::fmt::{self, Debug, Formatter};
use core::marker::PhantomData;

const F: u32 = 32;

/// A signed 64-bit number with 32 bits behind the point. Sums and products saturate whatever the
/// counter, and `C` counts each saturation.
#[repr(transparent)]
pub struct Fixed64<C = ()>(i64, PhantomData<fn() -> C>);

impl<C> Fixed64<C> {
    /// The number with this bit pattern: `raw` · 2⁻³².
    #[inline(always)]
    pub const fn from_bits(raw: i64) -> Self {
        Self(raw, PhantomData)
    }

    /// The number nearest to `x`, in a constant, too. Beyond the largest numbers it is the largest; NaN gives 0.
    pub const fn nearest(x: f64) -> Self {
        let raw = super::floor(x * (1u64 << F) as f64 + 0.5);
        // The most negative value has no opposite.
        Self::from_bits(if raw == i64::MIN { -i64::MAX } else { raw })
    }

    /// The bit pattern: the number times 2³².
    #[inline(always)]
    pub const fn to_bits(self) -> i64 {
        self.0
    }
}

// Not derived: nothing of this depends on the counter.
impl<C> Copy for Fixed64<C> {}

impl<C> Clone for Fixed64<C> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<C> Default for Fixed64<C> {
    #[inline(always)]
    fn default() -> Self {
        Self::from_bits(0)
    }
}

impl<C> PartialEq for Fixed64<C> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<C> Eq for Fixed64<C> {}

impl<C> PartialOrd for Fixed64<C> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl<C> Debug for Fixed64<C> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Fixed64").field(&self.0).finish()
    }
}

impl<C: SaturationCounter> Fixed64<C> {
    #[inline(always)]
    fn fit(raw: i128) -> Self {
        if raw != i128::from(raw as i64) {
            C::saturated();
            return saturate(raw);
        }
        Self::from_bits(raw as i64)
    }
}

fn saturate<C>(raw: i128) -> Fixed64<C> {
    Fixed64::from_bits(raw.clamp(-i128::from(i64::MAX), i128::from(i64::MAX)) as i64)
}

/// 64 bits behind the point.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
pub struct Product(i128);

operators! { [] Product,
    Add::add = |a, b| Self(a.0.wrapping_add(b.0));
    Sub::sub = |a, b| Self(a.0.wrapping_sub(b.0));
}

operators! { [C: SaturationCounter] Fixed64<C>,
    Add::add = |a, b| Self::fit(i128::from(a.0) + i128::from(b.0));
    Sub::sub = |a, b| Self::fit(i128::from(a.0) - i128::from(b.0));
    Mul::mul = |a, b| Self::narrow(Self::product(a, b));
    Neg::neg = |a| Self::from_bits(a.0.wrapping_neg());
}

impl<C: SaturationCounter> Scalar for Fixed64<C> {
    const ZERO: Self = Self::from_bits(0);
    const ONE: Self = Self::from_bits(1 << F);
    const MAX: Self = Self::from_bits(i64::MAX);

    type Wide = Product;

    #[inline(always)]
    fn product(a: Self, b: Self) -> Product {
        Product(i128::from(a.0) * i128::from(b.0))
    }

    #[inline(always)]
    fn narrow(wide: Product) -> Self {
        Self::fit(wide.0.wrapping_add(1 << (F - 1)) >> F)
    }

    #[inline(always)]
    fn sqrt_wide(wide: Product) -> Self {
        Self::from_bits(wide.0.max(0).unsigned_abs().isqrt() as i64)
    }

    type Reciprocal = Self;

    #[inline(always)]
    fn reciprocal(self) -> Self {
        self
    }

    #[inline(always)]
    fn times_reciprocal(self, divisor: Self) -> Self {
        if divisor.0 == 0 {
            return if self.0 < 0 { -Self::MAX } else { Self::MAX };
        }
        saturate((i128::from(self.0) << F) / i128::from(divisor.0))
    }

    #[inline(always)]
    fn quotient_exceeds(_: Self, _: Self, _: Self) -> bool {
        false
    }

    fn scale_to_index(self, n: u32) -> u32 {
        ((i128::from(self.0.max(0)) * i128::from(n)) >> F) as u32
    }

    fn unit(v: [Self; 3]) -> ([Self; 3], Self) {
        let size = v.iter().fold(0, |size, c| size | c.0.unsigned_abs());
        if size == 0 {
            return (v, Self::from_bits(0));
        }
        // The largest component comes to lie in [2⁶⁰, 2⁶¹) or keeps its place above.
        let up = size.leading_zeros().saturating_sub(3);
        let scaled = map3(v, |c| i128::from(c.0) << up);
        let square = scaled.iter().fold(0u128, |sum, c| {
            sum.wrapping_add(c.unsigned_abs().wrapping_mul(c.unsigned_abs()))
        });
        let length = square.isqrt().max(1) as i128;
        let unit = map3(scaled, |c| saturate((c << F) / length));
        (unit, saturate(length >> up))
    }

    #[inline(always)]
    fn to_local(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self::from_bits(self.0 << (exponent & 63))
        } else {
            Self::from_bits(self.0 >> (exponent.unsigned_abs() & 63))
        }
    }

    #[inline(always)]
    fn to_global(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self::from_bits(self.0 >> (exponent & 63))
        } else {
            saturate(i128::from(self.0) << (exponent.unsigned_abs() & 63))
        }
    }
}

impl<C: SaturationCounter> Tolerance for Fixed64<C> {
    const EXACT_ROOTS: bool = true;

    const HITS_WITHIN_SLACK: bool = true;

    #[inline(always)]
    fn surface_error(_: Self, curvature_extent: Self) -> Self {
        Self::from_bits((curvature_extent.0 >> 28).wrapping_add(16))
    }

    #[inline(always)]
    fn coordinate_error(reach: Self) -> Self {
        Self::from_bits(2 * (reach.0 >> F) + 4)
    }

    #[inline(always)]
    fn plane_error(reach: Self) -> Self {
        Self::from_bits(3 * (reach.0 >> F) + 4)
    }
}

impl<C: SaturationCounter> Ratio for Fixed64<C> {
    #[inline(always)]
    fn whole_reciprocal(n: u32) -> Self {
        Self::from_bits(i64::from(n))
    }

    #[inline(always)]
    fn ratio(numerator: i32, n: Self) -> Self {
        Self::from_bits(i64::from(numerator)).times_reciprocal(n)
    }
}

impl<C: SaturationCounter> Intensity for Fixed64<C> {
    #[inline(always)]
    fn level(self) -> u8 {
        ((self.0.clamp(0, 1 << F) * 255 + (1 << (F - 1))) >> F) as u8
    }

    #[inline(always)]
    fn accumulate(self, light: Self) -> Self {
        (self + light).min(Self::ONE)
    }

    fn power(self, exponent: Exponent<Self>) -> Self {
        // 31 bits are enough for a colour.
        let x = (self.0.clamp(0, 1 << F) >> 4) as i32;
        let fraction = (exponent.fraction.0 >> 4) as i32;
        Self::from_bits(i64::from(super::power::power(x, 28, exponent.whole, fraction)) << 4)
    }
}
