//! 64-bit fixed point, the reference beside the 32-bit formats: exact integer square root and
//! division, slow and plain.

use super::count;
use crate::accel::InvDirection;
use crate::scalar::{Exponent, Quantize, Scalar};
use core::ops::{Add, Mul, Neg, Sub};

const F: u32 = 32;

/// A signed 64-bit number with 32 bits behind the point. Sums and products saturate and are
/// counted in [`crate::scalar::saturations`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd)]
#[repr(transparent)]
pub struct Fixed64(i64);

impl Fixed64 {
    /// The number with this bit pattern: `raw` · 2⁻³².
    #[inline(always)]
    pub const fn from_bits(raw: i64) -> Self {
        Self(raw)
    }

    /// The bit pattern: the number times 2³².
    #[inline(always)]
    pub const fn to_bits(self) -> i64 {
        self.0
    }

    #[inline(always)]
    fn fit(raw: i128) -> Self {
        if raw != i128::from(raw as i64) {
            count::saturated();
            return saturate(raw);
        }
        Self(raw as i64)
    }
}

fn saturate(raw: i128) -> Fixed64 {
    Fixed64(raw.clamp(-i128::from(i64::MAX), i128::from(i64::MAX)) as i64)
}

/// 64 bits behind the point.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
pub struct Product(i128);

impl Add for Product {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sub for Product {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl Add for Fixed64 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::fit(i128::from(self.0) + i128::from(other.0))
    }
}

impl Sub for Fixed64 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::fit(i128::from(self.0) - i128::from(other.0))
    }
}

impl Mul for Fixed64 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::narrow(Self::product(self, other))
    }
}

impl Neg for Fixed64 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

impl Scalar for Fixed64 {
    const ZERO: Self = Self(0);
    const ONE: Self = Self(1 << F);
    const MAX: Self = Self(i64::MAX);
    const EXACT_ROOTS: bool = true;

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
        Self(wide.0.max(0).unsigned_abs().isqrt() as i64)
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

    #[inline(always)]
    fn whole_reciprocal(n: u32) -> Self {
        Self(i64::from(n))
    }

    #[inline(always)]
    fn ratio(numerator: i32, n: Self) -> Self {
        Self(i64::from(numerator)).times_reciprocal(n)
    }

    fn scale_to_index(self, n: u32) -> u32 {
        ((i128::from(self.0.max(0)) * i128::from(n)) >> F) as u32
    }

    fn unit(v: [Self; 3]) -> ([Self; 3], Self) {
        let size = v.iter().fold(0, |size, c| size | c.0.unsigned_abs());
        if size == 0 {
            return (v, Self(0));
        }
        // The largest component comes to lie in [2⁶⁰, 2⁶¹) or keeps its place above.
        let up = size.leading_zeros().saturating_sub(3);
        let scaled = v.map(|c| i128::from(c.0) << up);
        let square = scaled.iter().fold(0u128, |sum, c| {
            sum.wrapping_add(c.unsigned_abs().wrapping_mul(c.unsigned_abs()))
        });
        let length = square.isqrt().max(1) as i128;
        let unit = scaled.map(|c| saturate((c << F) / length));
        (unit, saturate(length >> up))
    }

    fn power(self, exponent: Exponent<Self>) -> Self {
        // 31 bits are enough for a colour.
        let x = (self.0.clamp(0, 1 << F) >> 4) as i32;
        let fraction = (exponent.fraction.0 >> 4) as i32;
        Self(i64::from(super::power::power(x, 28, exponent.whole, fraction)) << 4)
    }

    #[inline(always)]
    fn to_local(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self(self.0 << (exponent & 63))
        } else {
            Self(self.0 >> (exponent.unsigned_abs() & 63))
        }
    }

    #[inline(always)]
    fn to_global(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self(self.0 >> (exponent & 63))
        } else {
            saturate(i128::from(self.0) << (exponent.unsigned_abs() & 63))
        }
    }

    #[inline(always)]
    fn surface_error(_: Self, curvature_extent: Self) -> Self {
        Self((curvature_extent.0 >> 28).wrapping_add(16))
    }

    #[inline(always)]
    fn level(self) -> u8 {
        ((self.0.clamp(0, 1 << F) * 255 + (1 << (F - 1))) >> F) as u8
    }

    #[inline(always)]
    fn accumulate(self, light: Self) -> Self {
        (self + light).min(Self::ONE)
    }

    #[inline(always)]
    fn to_grid(self) -> i32 {
        (self.0 >> 32) as i32
    }

    const GRID_SLACK: i32 = 4;

    const HITS_WITHIN_SLACK: bool = true;

    #[inline(always)]
    fn direction_q30(self) -> i32 {
        (self.0 >> (F - 30)) as i32
    }

    type Bound = i64;

    #[inline(always)]
    fn to_bound(self) -> i64 {
        self.0
    }

    #[inline(always)]
    fn from_bound(bound: i64) -> Self {
        Self(bound)
    }

    #[inline(always)]
    fn inv_direction(self) -> InvDirection<i64> {
        let size = self.0.unsigned_abs();
        let (mantissa, shift) = if size == 0 {
            (1i64 << 62, 0)
        } else {
            // 2¹²⁵ / x, for x normalised to [2⁶³, 2⁶⁴), in (2⁶¹, 2⁶²].
            let zeros = size.leading_zeros();
            let mantissa = ((1u128 << 125) / u128::from(size << zeros)) as i64;
            (mantissa, (125 - F - zeros) as u8)
        };
        let signed = if self.0 < 0 { -mantissa } else { mantissa };
        InvDirection::<i64>::new(self.0 < 0, signed, shift)
    }
}

impl Quantize for Fixed64 {
    const NAME: &'static str = "i32f32";
    const FRACTION_BITS: Option<u32> = Some(F);
    const SLACK: f64 = 1.0 / (1u64 << 28) as f64;

    fn from_f64(x: f64) -> Self {
        let scaled = x * (1u64 << F) as f64;
        Self((libm::floor(scaled + 0.5) as i64).max(-i64::MAX))
    }

    fn to_f64(self) -> f64 {
        self.0 as f64 / (1u64 << F) as f64
    }
}
