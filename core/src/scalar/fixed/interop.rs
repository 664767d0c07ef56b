//! Conversions from and to the numbers of the crate `fixed`, with the feature of that name.
//!
//! What loses nothing is `From`: between [`Fixed<F>`](Fixed) and `FixedI32` of as many fraction bits, between [`Fixed64`]
//! and `FixedI64<U32>`, and from any 32-bit number to a 64-bit one of the other crate. All else is rounded and may be out of
//! range; the two functions that do it say so by their names. No conversion counts a saturation.

use super::{Fixed, Fixed64};
use fixed::traits::Fixed as AnyFixed;
use fixed::types::extra::{
    LeEqU32, U4, U5, U6, U7, U8, U9, U10, U11, U12, U13, U14, U15, U16, U17, U18, U19, U20, U21,
    U22, U23, U24, U25, U26, U27, U28, U32, U64,
};
use fixed::{FixedI32, FixedI64, FixedI128};

macro_rules! same_bits {
    ($($f:literal $frac:ty)*) => {$(
        /// The same bits.
        impl<C> From<FixedI32<$frac>> for Fixed<$f, C> {
            #[inline(always)]
            fn from(x: FixedI32<$frac>) -> Self {
                Self::from_bits(x.to_bits())
            }
        }

        /// The same bits.
        impl<C> From<Fixed<$f, C>> for FixedI32<$frac> {
            #[inline(always)]
            fn from(x: Fixed<$f, C>) -> Self {
                Self::from_bits(x.to_bits())
            }
        }
    )*};
}

same_bits! {
    4 U4 5 U5 6 U6 7 U7 8 U8 9 U9 10 U10 11 U11 12 U12 13 U13 14 U14 15 U15 16 U16 17 U17 18 U18
    19 U19 20 U20 21 U21 22 U22 23 U23 24 U24 25 U25 26 U26 27 U27 28 U28
}

/// The same bits.
impl<C> From<FixedI64<U32>> for Fixed64<C> {
    #[inline(always)]
    fn from(x: FixedI64<U32>) -> Self {
        Self::from_bits(x.to_bits())
    }
}

/// The same bits.
impl<C> From<Fixed64<C>> for FixedI64<U32> {
    #[inline(always)]
    fn from(x: Fixed64<C>) -> Self {
        Self::from_bits(x.to_bits())
    }
}

/// The same number: 32 bits behind the point hold those of any 32-bit number.
impl<C, Frac: LeEqU32> From<FixedI32<Frac>> for Fixed64<C> {
    #[inline(always)]
    fn from(x: FixedI32<Frac>) -> Self {
        Self::from_bits(i64::from(x.to_bits()) << (32 - Frac::U32))
    }
}

/// The same number: 32 bits behind the point hold those of any 32-bit number.
impl<const F: u32, C> From<Fixed<F, C>> for FixedI64<U32> {
    #[inline(always)]
    fn from(x: Fixed<F, C>) -> Self {
        Self::from_bits(i64::from(x.to_bits()) << (32 - F))
    }
}

impl<const F: u32, C> Fixed<F, C> {
    /// The number nearest to one of the crate `fixed`, of any width and any number of fraction bits: halves go up, towards
    /// +∞, as in [`Quantize::from_f64`](crate::quantize::Quantize::from_f64). Saturates at ±[`Scalar::MAX`].
    ///
    /// Only with the feature `fixed`.
    ///
    /// [`Scalar::MAX`]: crate::scalar::Scalar::MAX
    pub fn from_fixed_rounded(x: impl AnyFixed) -> Self {
        let limit = i64::from(i32::MAX);
        Self::from_bits(nearest(x, F).clamp(-limit, limit) as i32)
    }

    /// The number of the crate `fixed` that is nearest: halves go up, towards +∞. Saturates at the ends of its range.
    ///
    /// Only with the feature `fixed`.
    pub fn to_fixed_rounded<T: AnyFixed>(self) -> T {
        rounded(self.into())
    }
}

impl<C> Fixed64<C> {
    /// The number nearest to one of the crate `fixed`: as [`Fixed::from_fixed_rounded`].
    pub fn from_fixed_rounded(x: impl AnyFixed) -> Self {
        Self::from_bits(nearest(x, 32).max(-i64::MAX))
    }

    /// The number of the crate `fixed` that is nearest: as [`Fixed::to_fixed_rounded`].
    pub fn to_fixed_rounded<T: AnyFixed>(self) -> T {
        rounded(self.into())
    }
}

/// Returns ⌊x · 2ᶠ + ½⌋, `f` ≤ 32, saturating.
fn nearest(x: impl AnyFixed, f: u32) -> i64 {
    // What is below 2⁻⁶⁴ is cut off towards −∞, and no half is that small. What does not fit saturates here, or below.
    let x_q64 = x.saturating_to_num::<FixedI128<U64>>().to_bits();
    let halves = x_q64 >> (63 - f);
    ((halves + 1) >> 1).clamp(i64::MIN.into(), i64::MAX.into()) as i64
}

/// Returns the nearest `T`, halves up, saturating.
fn rounded<T: AnyFixed>(x: FixedI64<U32>) -> T {
    // Conversions to fewer fraction bits cut off towards −∞. Of as many or more, nothing is cut off.
    let half_q64 = (1i128 << 63) >> T::FRAC_NBITS.min(127);
    let half = if T::FRAC_NBITS < 32 { half_q64 } else { 0 };
    let x_q64 = i128::from(x.to_bits()) << 32;
    FixedI128::<U64>::from_bits(x_q64 + half).saturating_to_num()
}
