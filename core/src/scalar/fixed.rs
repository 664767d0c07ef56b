//! 32-bit fixed point with 64-bit products, in integer arithmetic alone, without division.
//!
//! Names carry the scaling: `x_q31` is an integer that stands for x · 2³¹.

#[cfg(feature = "fixed")]
mod interop;
mod power;
mod reciprocal;
mod root;
mod wide;

pub use reciprocal::Reciprocal;
pub(crate) use root::reciprocal_q15;
pub use wide::Fixed64;

use super::operators::operators;
use super::zeros::{leading_zeros, leading_zeros_64};
use super::{Exponent, Intensity, Ratio, SaturationCounter, Scalar, Tolerance, multiply};
use crate::array::map3;
use core::cmp::Ordering;
use core::fmt::{self, Debug, Formatter};
use core::marker::PhantomData;
use reciprocal::saturate;
use root::rsqrt_q30;

/// A signed 32-bit number with `F` bits behind the point, 4 ≤ `F` ≤ 28: steps of 2⁻ᶠ, values from
/// −2³¹⁻ᶠ to 2³¹⁻ᶠ.
///
/// Scenes are scaled so that nothing overflows. With a counter that is
/// [checked](SaturationCounter::CHECKED) `+`, `-` and `*` saturate all the same, and `C` counts each
/// saturation; with `()` they wrap, in fewer instructions. All give the same bits as long as nothing
/// saturates.
///
/// ```
/// use core::sync::atomic::{AtomicU32, Ordering};
/// use octray_core::quantize::Quantize;
/// use octray_core::scalar::{Fixed, SaturationCounter, Scalar};
///
/// // 16 bits behind the point, unchecked: what boards use.
/// let third = Fixed::<16>::from_f64(1.0 / 3.0);
/// assert_eq!(third.to_bits(), 21845);
/// assert_eq!((third * third).to_bits(), 7282);
/// assert_eq!(Fixed::<16>::ONE.quotient(third).to_bits(), 3 * 65536 + 3);
///
/// // Checked and counted, here in a static.
/// static COUNT: AtomicU32 = AtomicU32::new(0);
/// struct Counted;
/// impl SaturationCounter for Counted {
///     const CHECKED: bool = true;
///     fn saturated() {
///         COUNT.fetch_add(1, Ordering::Relaxed);
///     }
/// }
/// let large = Fixed::<16, Counted>::from_f64(30_000.0);
/// assert_eq!((large + large).to_bits(), i32::MAX);
/// assert_eq!(COUNT.load(Ordering::Relaxed), 1);
/// ```
///
/// With the feature `fixed` numbers are converted from and to those of [the crate of that name](https://docs.rs/fixed):
///
/// ```
/// # #[cfg(feature = "fixed")] {
/// use fixed::types::{I16F16, I20F12, I32F32, U8F8};
/// use octray_core::scalar::Fixed;
///
/// // What loses nothing is `From`.
/// let x: Fixed<16> = I16F16::from_num(1.5).into();
/// assert_eq!(I16F16::from(x), 1.5);
/// assert_eq!(I32F32::from(x), 1.5);
/// // All else goes to the nearest, halves up, and saturates.
/// assert_eq!(x.to_fixed_rounded::<U8F8>(), 1.5);
/// assert_eq!((-x).to_fixed_rounded::<U8F8>(), 0);
/// let third = Fixed::<16>::from_fixed_rounded(I20F12::from_num(1) / 3);
/// assert_eq!(third.to_bits(), 1365 * 16);
/// # }
/// ```
#[repr(transparent)]
pub struct Fixed<const F: u32, C = ()>(i32, PhantomData<fn() -> C>);

impl<const F: u32, C> Fixed<F, C> {
    /// The number with this bit pattern: `raw` · 2⁻ᶠ.
    #[inline(always)]
    pub const fn from_bits(raw: i32) -> Self {
        Self(raw, PhantomData)
    }

    /// The number nearest to `x`, in a constant, too. Beyond the largest numbers it is the largest; NaN gives 0.
    pub const fn nearest(x: f64) -> Self {
        let whole = floor(x * (1u64 << F) as f64 + 0.5);
        // The most negative value has no opposite.
        Self::from_bits(if whole > i32::MAX as i64 {
            i32::MAX
        } else if whole < -(i32::MAX as i64) {
            -i32::MAX
        } else {
            whole as i32
        })
    }

    /// The bit pattern: the number times 2ᶠ.
    #[inline(always)]
    pub const fn to_bits(self) -> i32 {
        self.0
    }
}

/// The largest integer not above `x`, saturated; 0 for NaN. In a constant, too.
const fn floor(x: f64) -> i64 {
    let whole = x as i64;
    if whole as f64 > x {
        whole.saturating_sub(1)
    } else {
        whole
    }
}

// Not derived: nothing of this depends on the counter.
impl<const F: u32, C> Copy for Fixed<F, C> {}

impl<const F: u32, C> Clone for Fixed<F, C> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<const F: u32, C> Default for Fixed<F, C> {
    #[inline(always)]
    fn default() -> Self {
        Self::from_bits(0)
    }
}

impl<const F: u32, C> PartialEq for Fixed<F, C> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<const F: u32, C> Eq for Fixed<F, C> {}

impl<const F: u32, C> PartialOrd for Fixed<F, C> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl<const F: u32, C> Debug for Fixed<F, C> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Fixed").field(&self.0).finish()
    }
}

impl<const F: u32, C: SaturationCounter> Fixed<F, C> {
    #[inline(always)]
    fn fit(raw: i64) -> Self {
        if C::CHECKED && raw != i64::from(raw as i32) {
            C::saturated();
            return Self::from_bits(if raw < 0 { -i32::MAX } else { i32::MAX });
        }
        Self::from_bits(raw as i32)
    }
}

/// Twice `F` bits behind the point; wraps beyond 64 bits.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
pub struct Product(i64);

operators! { [] Product,
    Add::add = |a, b| Self(a.0.wrapping_add(b.0));
    Sub::sub = |a, b| Self(a.0.wrapping_sub(b.0));
}

operators! { [const F: u32, C: SaturationCounter] Fixed<F, C>,
    Add::add = |a, b| if C::CHECKED {
        Self::fit(i64::from(a.0) + i64::from(b.0))
    } else {
        Self::from_bits(a.0.wrapping_add(b.0))
    };
    Sub::sub = |a, b| if C::CHECKED {
        Self::fit(i64::from(a.0) - i64::from(b.0))
    } else {
        Self::from_bits(a.0.wrapping_sub(b.0))
    };
    Mul::mul = |a, b| Self::narrow(Self::product(a, b));
    Neg::neg = |a| Self::from_bits(a.0.wrapping_neg());
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

impl<const F: u32, C: SaturationCounter> Scalar for Fixed<F, C> {
    const ZERO: Self = Self::from_bits(0);
    const ONE: Self = Self::from_bits(1 << F);
    const MAX: Self = Self::from_bits(i32::MAX);

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
            return Self::from_bits(0);
        }
        let zeros = leading_zeros_64(wide.0 as u64) & !1;
        let x_q32 = upper(wide.0 as u64, zeros);
        let root_q62 = multiply::unsigned(x_q32, rsqrt_q30(x_q32)) + (1 << 29);
        Self::from_bits(shortened(root_q62, zeros / 2))
    }

    type Reciprocal = Reciprocal;

    #[inline(always)]
    fn reciprocal(self) -> Reciprocal {
        Reciprocal::new(self.0, F)
    }

    #[inline(always)]
    fn times_reciprocal(self, reciprocal: Reciprocal) -> Self {
        Self::from_bits(reciprocal.divide(self.0))
    }

    // The quotient's relative error is below 2⁻²⁷, its rounding below one step.
    #[inline(always)]
    fn quotient_exceeds(numerator: Self, divisor: Self, limit: Self) -> bool {
        let limit = i64::from(limit.0) + i64::from(limit.0 >> 24) + 4;
        i64::from(numerator.0) << F > i64::from(divisor.0) * limit
    }

    #[inline(always)]
    fn scale_to_index(self, n: u32) -> u32 {
        (multiply::unsigned(self.0.max(0) as u32, n) >> F) as u32
    }

    // Not inlined where a call is cheap next to its products: one copy is smaller.
    #[cfg_attr(octray_armv6m, inline(never))]
    #[cfg_attr(not(octray_armv6m), inline(always))]
    fn unit(v: [Self; 3]) -> ([Self; 3], Self) {
        let size = v[0].0.unsigned_abs() | v[1].0.unsigned_abs() | v[2].0.unsigned_abs();
        if size == 0 {
            return (v, Self::from_bits(0));
        }
        // The largest component comes to lie in [2³⁰, 2³¹), whatever the length.
        let up = leading_zeros(size).saturating_sub(1);
        let [x, y, z] = map3(v, |c| c.0 << up);
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
        let unit = map3([x, y, z], |c| {
            let product = multiply::signed(c, inverse_q30 as i32);
            Self::from_bits(((product >> 32) as i32).wrapping_add(half) >> shift)
        });
        let length_q62 = multiply::unsigned(x_q32, inverse_q30);
        (unit, Self::from_bits(shortened(length_q62, up + zeros / 2)))
    }

    #[inline(always)]
    fn to_local(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self::from_bits(self.0 << (exponent & 31))
        } else {
            Self::from_bits(self.0 >> (exponent.unsigned_abs() & 31))
        }
    }

    #[inline(always)]
    fn to_global(self, exponent: i8) -> Self {
        if exponent >= 0 {
            Self::from_bits(self.0 >> (exponent & 31))
        } else {
            Self::from_bits(saturate(
                i64::from(self.0) << (exponent.unsigned_abs() & 31),
            ))
        }
    }
}

impl<const F: u32, C: SaturationCounter> Tolerance for Fixed<F, C> {
    const EXACT_ROOTS: bool = true;

    const HITS_WITHIN_SLACK: bool = F >= 16;

    #[inline(always)]
    fn surface_error(_: Self, curvature_extent: Self) -> Self {
        // Rounding is absolute here, but for a curved shape's normal, which has F bits.
        Self::from_bits((curvature_extent.0 >> (F - 2)).wrapping_add(8))
    }

    #[inline(always)]
    fn coordinate_error(reach: Self) -> Self {
        // Directions have F bits, as has the place of a pixel in the picture; a step for each of four roundings.
        Self::from_bits(2 * (reach.0 >> F) + 4)
    }

    #[inline(always)]
    fn plane_error(reach: Self) -> Self {
        // Normals have F bits, and are multiplied by coordinates; a step for each of four roundings.
        Self::from_bits(3 * (reach.0 >> F) + 4)
    }
}

impl<const F: u32, C: SaturationCounter> Ratio for Fixed<F, C> {
    #[inline(always)]
    fn whole_reciprocal(n: u32) -> Reciprocal {
        // A quotient of two numbers of the same scaling does not depend on the scaling.
        Reciprocal::new(n as i32, F)
    }

    #[inline(always)]
    fn ratio(numerator: i32, n: Reciprocal) -> Self {
        Self::from_bits(n.divide(numerator))
    }
}

impl<const F: u32, C: SaturationCounter> Intensity for Fixed<F, C> {
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
    fn power(self, exponent: Exponent<Self>) -> Self {
        Self::from_bits(power::power(self.0, F, exponent.whole, exponent.fraction.0))
    }
}
