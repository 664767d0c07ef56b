//! The reciprocal of a 32-bit fixed-point number.

use super::root::reciprocal_q30;
use crate::scalar::multiply;
use crate::scalar::zeros::leading_zeros;

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
    pub(super) fn new(raw: i32, fraction_bits: u32) -> Self {
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
    pub(super) fn divide(self, a: i32) -> i32 {
        let twice = multiply::signed(a, self.mantissa) >> (self.shift.wrapping_sub(1) & 63);
        saturate((twice + 1) >> 1)
    }
}

#[inline(always)]
pub(super) fn saturate(raw: i64) -> i32 {
    if raw == i64::from(raw as i32) {
        raw as i32
    } else if raw < 0 {
        -i32::MAX
    } else {
        i32::MAX
    }
}
