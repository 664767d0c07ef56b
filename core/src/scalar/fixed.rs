//! 32-bit fixed point with 64-bit products, in integer arithmetic alone, without division.
//!
//! Names carry the scaling: `x_q31` is an integer that stands for x · 2³¹.

mod power;
mod root;
mod wide;

pub use wide::Fixed64;

use super::zeros::{leading_zeros, leading_zeros_64};
use super::{Exponent, Quantize, Scalar, multiply};
use crate::accel::InvDirection;
use core::ops::{Add, Mul, Neg, Sub};
pub(crate) use root::reciprocal_q15;
use root::{reciprocal_q30, rsqrt_q30};

/// A signed 32-bit number with `F` bits behind the point, 4 ≤ `F` ≤ 28.
///
/// `+`, `-` and `*` need no saturation where the scene's bounds prove that nothing overflows, as
/// they do for every scene that a planner accepted. With `CHECKED` they saturate all the same, and
/// each saturation is counted in [`saturations`]; without, they wrap, in fewer instructions. Both
/// give the same bits as long as the count stays 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd)]
#[repr(transparent)]
pub struct Fixed<const F: u32, const CHECKED: bool>(i32);

/// The saturations of all checked fixed-point operations of this process since the last
/// [`reset_saturations`].
pub fn saturations() -> u32 {
    count::COUNT.load(core::sync::atomic::Ordering::Relaxed)
}

/// Starts counting saturations anew.
pub fn reset_saturations() {
    count::COUNT.store(0, core::sync::atomic::Ordering::Relaxed);
}

mod count {
    use core::sync::atomic::{AtomicU32, Ordering};

    pub(super) static COUNT: AtomicU32 = AtomicU32::new(0);

    /// Counts one saturation; on cores without atomic addition two threads may count one less.
    #[cold]
    pub(super) fn saturated() {
        #[cfg(target_has_atomic = "32")]
        COUNT.fetch_add(1, Ordering::Relaxed);
        #[cfg(not(target_has_atomic = "32"))]
        COUNT.store(
            COUNT.load(Ordering::Relaxed).wrapping_add(1),
            Ordering::Relaxed,
        );
    }
}

impl<const F: u32, const CHECKED: bool> Fixed<F, CHECKED> {
    /// The number with this bit pattern: `raw` · 2⁻ᶠ.
    #[inline(always)]
    pub const fn from_bits(raw: i32) -> Self {
        Self(raw)
    }

    /// The bit pattern: the number times 2ᶠ.
    #[inline(always)]
    pub const fn to_bits(self) -> i32 {
        self.0
    }

    #[inline(always)]
    fn fit(raw: i64) -> Self {
        if CHECKED && raw != i64::from(raw as i32) {
            count::saturated();
            return Self(if raw < 0 { -i32::MAX } else { i32::MAX });
        }
        Self(raw as i32)
    }
}

/// Twice `F` bits behind the point; wraps beyond 64 bits.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
pub struct Product(i64);

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

/// 1/x as a signed mantissa of 31 bits and a right shift: a/x = a · mantissa / 2^shift.
#[derive(Clone, Copy, Debug)]
pub struct Reciprocal {
    /// In [2³⁰, 2³¹), with the sign of x.
    mantissa: i32,
    /// 1 to 62.
    shift: u8,
}

impl Reciprocal {
    /// A reciprocal from what [`Reciprocal::parts`] gave.
    #[inline(always)]
    pub const fn from_parts(mantissa: i32, shift: u8) -> Self {
        Self { mantissa, shift }
    }

    /// The mantissa and the shift, to be written down.
    #[inline(always)]
    pub const fn parts(self) -> (i32, u8) {
        (self.mantissa, self.shift)
    }

    /// Of `raw` · 2⁻ᶠ, such that a raw number times it is a raw number again.
    #[inline(always)]
    fn new(raw: i32, fraction_bits: u32) -> Self {
        let size = raw.unsigned_abs();
        if size == 0 {
            return Self {
                mantissa: i32::MAX,
                shift: 1,
            };
        }
        let zeros = leading_zeros(size);
        let mantissa = reciprocal_q30(size << zeros) as i32;
        Self {
            mantissa: if raw < 0 { -mantissa } else { mantissa },
            shift: (62 - fraction_bits - zeros) as u8,
        }
    }

    /// `a` / x, to nearest, saturating.
    #[inline(always)]
    fn divide(self, a: i32) -> i32 {
        let twice = multiply::signed(a, self.mantissa) >> (self.shift.wrapping_sub(1) & 63);
        saturate((twice + 1) >> 1)
    }
}

#[inline(always)]
fn saturate(raw: i64) -> i32 {
    if raw == i64::from(raw as i32) {
        raw as i32
    } else if raw < 0 {
        -i32::MAX
    } else {
        i32::MAX
    }
}

/// The upper word of `x` · 2^`left`, 0 ≤ `left` < 64: what is shifted out is lost. In words of 32
/// bits, since many cores have no other shifts.
#[inline(always)]
fn upper(x: u64, left: u32) -> u32 {
    let (high, low) = ((x >> 32) as u32, x as u32);
    if left >= 32 {
        low << (left & 31)
    } else {
        high << left | (low >> 1) >> (31 - left)
    }
}

/// `x_q30` / 2^`right` without its fraction, saturating; 0 ≤ `right` < 32.
#[inline(always)]
fn shortened(x_q30: u64, right: u32) -> i32 {
    if right >= 2 {
        // The upper word alone; less than 2³⁰ for two bits more, or the sign is not touched.
        saturate(i64::from((x_q30 >> 32) as u32 >> (right - 2)))
    } else {
        saturate((x_q30 >> (30 + right)) as i64)
    }
}

impl<const F: u32, const CHECKED: bool> Add for Fixed<F, CHECKED> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        if CHECKED {
            Self::fit(i64::from(self.0) + i64::from(other.0))
        } else {
            Self(self.0.wrapping_add(other.0))
        }
    }
}

impl<const F: u32, const CHECKED: bool> Sub for Fixed<F, CHECKED> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        if CHECKED {
            Self::fit(i64::from(self.0) - i64::from(other.0))
        } else {
            Self(self.0.wrapping_sub(other.0))
        }
    }
}

impl<const F: u32, const CHECKED: bool> Mul for Fixed<F, CHECKED> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::narrow(Self::product(self, other))
    }
}

impl<const F: u32, const CHECKED: bool> Neg for Fixed<F, CHECKED> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

impl<const F: u32, const CHECKED: bool> Scalar for Fixed<F, CHECKED> {
    const ZERO: Self = Self(0);
    const ONE: Self = Self(1 << F);
    const MAX: Self = Self(i32::MAX);
    const EXACT_ROOTS: bool = true;

    type Wide = Product;

    #[inline(always)]
    fn product(a: Self, b: Self) -> Product {
        Product(multiply::signed(a.0, b.0))
    }

    #[inline(always)]
    fn square(self) -> Product {
        Product(multiply::square(self.0) as i64)
    }

    #[inline(always)]
    fn narrow(wide: Product) -> Self {
        Self::fit(wide.0.wrapping_add(1 << (F - 1)) >> F)
    }

    #[inline(always)]
    fn sqrt_wide(wide: Product) -> Self {
        if wide.0 <= 0 {
            return Self(0);
        }
        let zeros = leading_zeros_64(wide.0 as u64) & !1;
        let x_q32 = upper(wide.0 as u64, zeros);
        let root_q62 = multiply::unsigned(x_q32, rsqrt_q30(x_q32)) + (1 << 29);
        Self(shortened(root_q62, zeros / 2))
    }

    type Reciprocal = Reciprocal;

    #[inline(always)]
    fn reciprocal(self) -> Reciprocal {
        Reciprocal::new(self.0, F)
    }

    #[inline(always)]
    fn times_reciprocal(self, reciprocal: Reciprocal) -> Self {
        Self(reciprocal.divide(self.0))
    }

    // The quotient's relative error is below 2⁻²⁷, its rounding below one step.
    #[inline(always)]
    fn quotient_exceeds(numerator: Self, divisor: Self, limit: Self) -> bool {
        let limit = i64::from(limit.0) + i64::from(limit.0 >> 24) + 4;
        i64::from(numerator.0) << F > i64::from(divisor.0) * limit
    }

    #[inline(always)]
    fn whole_reciprocal(n: u32) -> Reciprocal {
        // A quotient of two numbers of the same scaling does not depend on the scaling.
        Reciprocal::new(n as i32, F)
    }

    #[inline(always)]
    fn ratio(numerator: i32, n: Reciprocal) -> Self {
        Self(n.divide(numerator))
    }

    #[inline(always)]
    fn scale_to_index(self, n: u32) -> u32 {
        (multiply::unsigned(self.0.max(0) as u32, n) >> F) as u32
    }

    // Where a call costs little beside its products, one copy is enough.
    #[cfg_attr(octray_armv6m, inline(never))]
    #[cfg_attr(not(octray_armv6m), inline(always))]
    fn unit(v: [Self; 3]) -> ([Self; 3], Self) {
        let size = v[0].0.unsigned_abs() | v[1].0.unsigned_abs() | v[2].0.unsigned_abs();
        if size == 0 {
            return (v, Self(0));
        }
        // The largest component comes to lie in [2³⁰, 2³¹), whatever the length.
        let up = leading_zeros(size).saturating_sub(1);
        let [x, y, z] = v.map(|c| c.0 << up);
        // In [2⁶⁰, 2⁶⁴): an even number of leading zeros is 0 or 2.
        let square = multiply::square(x)
            .wrapping_add(multiply::square(y))
            .wrapping_add(multiply::square(z));
        let zeros = if square >> 62 == 0 { 2 } else { 0 };
        let x_q32 = ((square << zeros) >> 32) as u32;
        let inverse_q30 = rsqrt_q30(x_q32);
        // Below the upper word of the product, and at most 26.
        let shift = 30 - F - zeros / 2;
        let half = (1i32 << shift) >> 1;
        let unit = [x, y, z].map(|c| {
            let product = multiply::signed(c, inverse_q30 as i32);
            Self(((product >> 32) as i32).wrapping_add(half) >> shift)
        });
        let length_q62 = multiply::unsigned(x_q32, inverse_q30);
        (unit, Self(shortened(length_q62, up + zeros / 2)))
    }

    #[inline(always)]
    fn power(self, exponent: Exponent<Self>) -> Self {
        Self(power::power(self.0, F, exponent.whole, exponent.fraction.0))
    }

    #[inline(always)]
    fn to_local(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self(self.0 << (exponent & 31))
        } else {
            Self(self.0 >> (exponent.unsigned_abs() & 31))
        }
    }

    #[inline(always)]
    fn to_global(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self(self.0 >> (exponent & 31))
        } else {
            Self(saturate(
                i64::from(self.0) << (exponent.unsigned_abs() & 31),
            ))
        }
    }

    #[inline(always)]
    fn surface_error(_: Self, curvature_extent: Self) -> Self {
        // Rounding is absolute here, but for a curved shape's normal, which has F bits.
        Self((curvature_extent.0 >> (F - 2)).wrapping_add(8))
    }

    #[inline(always)]
    fn level(self) -> u8 {
        let c = i64::from(self.0.clamp(0, 1 << F));
        (((c << 8) - c + (1 << (F - 1))) >> F) as u8
    }

    #[inline(always)]
    fn accumulate(self, light: Self) -> Self {
        (self + light).min(Self::ONE)
    }

    #[inline(always)]
    fn to_grid(self) -> i32 {
        self.0
    }

    const GRID_SLACK: i32 = 4;

    const HITS_WITHIN_SLACK: bool = F >= 16;

    #[inline(always)]
    fn direction_q30(self) -> i32 {
        self.0 << (30 - F)
    }

    type Bound = i32;

    #[inline(always)]
    fn to_bound(self) -> i32 {
        self.0
    }

    #[inline(always)]
    fn from_bound(bound: i32) -> Self {
        Self(bound)
    }

    #[inline(always)]
    fn inv_direction(self) -> InvDirection<i32> {
        let Reciprocal { mantissa, shift } = Reciprocal::new(self.0, F);
        InvDirection::<i32>::new(self.0 < 0, mantissa, shift)
    }
}

impl<const F: u32, const CHECKED: bool> Quantize for Fixed<F, CHECKED> {
    const NAME: &'static str = match F {
        8 => "i24f8",
        10 => "i22f10",
        12 => "i20f12",
        14 => "i18f14",
        16 => "i16f16",
        18 => "i14f18",
        20 => "i12f20",
        22 => "i10f22",
        24 => "i8f24",
        26 => "i6f26",
        28 => "i4f28",
        _ => "fixed",
    };
    const FRACTION_BITS: Option<u32> = Some(F);
    // A direction is rounded to F bits: over the scene's diagonal that is this share of it.
    const SLACK: f64 = 4.0 / (1u64 << F) as f64;

    fn from_f64(x: f64) -> Self {
        // `as` saturates and makes NaN 0; the most negative value has no opposite.
        let scaled = x * (1u64 << F) as f64;
        Self((libm::floor(scaled + 0.5) as i32).max(-i32::MAX))
    }

    fn to_f64(self) -> f64 {
        f64::from(self.0) / (1u64 << F) as f64
    }
}
