//! `f32` without division or square root: micromath's bit trick for 1/√x, sharpened by Newton
//! steps.
//!
//! Worst relative error of 1/√x: 3.4 % as it is, 0.18 % after one Newton step, 5e-6 after two.
//! Roots are x · 1/√x, and reciprocals (1/√x)², with twice that error: micromath's own trick for
//! 1/x starts from 12.5 % and would be at 2.4e-4 after two steps.

use super::float::power_f32;
use super::operators::operators;
use super::{Exponent, Intensity, Ratio, Scalar, Tolerance};
use crate::array::map3;
use core::cmp::Ordering;
use micromath::F32Ext;

/// An `f32` whose reciprocal and reciprocal root are approximate, with `NEWTON` refining steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(transparent)]
pub struct Approx<const NEWTON: u32>(pub f32);

impl<const N: u32> Approx<N> {
    #[inline(always)]
    fn rsqrt(x: f32) -> f32 {
        let mut y = x.invsqrt();
        for _ in 0..N {
            y = y * (1.5 - 0.5 * x * y * y);
        }
        y
    }

    #[inline(always)]
    fn inverse(x: f32) -> f32 {
        let root = Self::rsqrt(x.abs());
        (root * root).copysign(x)
    }
}

impl<const N: u32> PartialOrd for Approx<N> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

operators! { [const N: u32] Approx<N>,
    Add::add = |a, b| Self(a.0 + b.0);
    Sub::sub = |a, b| Self(a.0 - b.0);
    Mul::mul = |a, b| Self(a.0 * b.0);
    Neg::neg = |a| Self(-a.0);
}

impl<const N: u32> Scalar for Approx<N> {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);
    const MAX: Self = Self(f32::MAX);

    type Wide = Self;

    #[inline(always)]
    fn product(a: Self, b: Self) -> Self {
        a * b
    }

    #[inline(always)]
    fn narrow(wide: Self) -> Self {
        wide
    }

    #[inline(always)]
    fn sqrt_wide(wide: Self) -> Self {
        // Below the smallest normal number the bit trick is meaningless.
        if wide.0 >= f32::MIN_POSITIVE {
            Self(wide.0 * Self::rsqrt(wide.0))
        } else {
            Self(0.0)
        }
    }

    type Reciprocal = f32;

    #[inline(always)]
    fn reciprocal(self) -> f32 {
        // Outside this range the trick's exponent arithmetic wraps.
        let size = self.0.abs();
        if size < 1e-37 {
            return f32::MAX.copysign(self.0);
        }
        if size > 1e37 {
            return 0.0;
        }
        Self::inverse(self.0)
    }

    #[inline(always)]
    fn times_reciprocal(self, reciprocal: f32) -> Self {
        Self((self.0 * reciprocal).clamp(f32::MIN, f32::MAX))
    }

    #[inline(always)]
    fn quotient_exceeds(_: Self, _: Self, _: Self) -> bool {
        false
    }

    #[inline(always)]
    fn scale_to_index(self, n: u32) -> u32 {
        (self.0 * n as f32) as u32
    }

    #[inline(always)]
    fn unit(v: [Self; 3]) -> ([Self; 3], Self) {
        let square = v[0].0 * v[0].0 + v[1].0 * v[1].0 + v[2].0 * v[2].0;
        if square >= f32::MIN_POSITIVE {
            let inverse = Self(Self::rsqrt(square));
            (map3(v, |c| c * inverse), Self(square) * inverse)
        } else {
            (v, Self(0.0))
        }
    }

    #[inline(always)]
    fn to_local(self, _: i8) -> Self {
        self
    }

    #[inline(always)]
    fn to_global(self, _: i8) -> Self {
        self
    }
}

impl<const N: u32> Tolerance for Approx<N> {
    const EXACT_ROOTS: bool = false;

    const HITS_WITHIN_SLACK: bool = N >= 2;

    #[inline(always)]
    fn surface_error(position: Self, curvature_extent: Self) -> Self {
        let curved = match N {
            0 => 1.0 / 16.0,
            1 => 1.0 / 256.0,
            _ => 1.0 / 65_536.0,
        };
        Self(position.0 * (1.0 / 524_288.0) + curvature_extent.0 * curved)
    }

    #[inline(always)]
    fn coordinate_error(reach: Self) -> Self {
        Self(f32::coordinate_error(reach.0))
    }

    #[inline(always)]
    fn plane_error(reach: Self) -> Self {
        Self(f32::plane_error(reach.0))
    }

    #[inline(always)]
    fn rounded_quotient(self, divisor: Self) -> Self {
        Self(self.0.quotient(divisor.0))
    }

    #[inline(always)]
    fn slack_near(reach: Self, slack: Self) -> Self {
        // Twice the error of an approximate reciprocal.
        let error = match N {
            0 => 1.0 / 4.0,
            1 => 1.0 / 64.0,
            _ => 1.0 / 8192.0,
        };
        Self(reach.0 * error).min(slack)
    }

    #[inline(always)]
    fn with_rounding_margin(self) -> Self {
        Self(self.0.with_rounding_margin())
    }
}

impl<const N: u32> Ratio for Approx<N> {
    #[inline(always)]
    fn whole_reciprocal(n: u32) -> f32 {
        1.0 / n as f32
    }

    #[inline(always)]
    fn ratio(numerator: i32, n: f32) -> Self {
        Self(numerator as f32 * n)
    }
}

impl<const N: u32> Intensity for Approx<N> {
    #[inline(always)]
    fn level(self) -> u8 {
        self.0.level()
    }

    #[inline(always)]
    fn accumulate(self, light: Self) -> Self {
        self + light
    }

    #[inline(always)]
    fn power(self, exponent: Exponent<Self>) -> Self {
        let exponent = Exponent {
            whole: exponent.whole,
            fraction: exponent.fraction.0,
        };
        Self(power_f32(self.0, exponent))
    }
}
