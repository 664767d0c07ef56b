//! Conversions to and from integers.

use crate::bits::{INFINITY, SIGN, exponent, magnitude, normalise, pack_normal, significand};

/// Returns the number nearest to `x`, ties to even.
#[inline(always)]
pub const fn from_u32(x: u32) -> u32 {
    signed_from(0, x)
}

/// Returns the number nearest to `x`, ties to even.
#[inline(always)]
pub const fn from_i32(x: i32) -> u32 {
    signed_from(x as u32 & SIGN, x.unsigned_abs())
}

#[inline(always)]
const fn signed_from(sign: u32, x: u32) -> u32 {
    if x == 0 {
        return 0;
    }
    let (exponent, m) = normalise(127 + 31, x);
    pack_normal(sign, exponent as u32, m)
}

/// Truncates `x` toward zero; returns the nearest integer if it is out of range, 0 for NaN.
#[inline(always)]
pub const fn to_i32(x: u32) -> i32 {
    let e = exponent(x);
    if e >= 127 + 31 {
        return out_of_range(x);
    }
    if e < 127 {
        return 0;
    }
    let whole = (significand(x) >> (127 + 31 - e)) as i32;
    if x & SIGN == 0 { whole } else { -whole }
}

#[cold]
#[inline(never)]
const fn out_of_range(x: u32) -> i32 {
    if magnitude(x) > INFINITY {
        0
    } else if x & SIGN == 0 {
        i32::MAX
    } else {
        i32::MIN
    }
}

/// Truncates `x` toward zero; returns the nearest integer if it is out of range, 0 for NaN.
#[inline(always)]
pub const fn to_u32(x: u32) -> u32 {
    let e = exponent(x);
    if x & SIGN != 0 || e < 127 {
        return 0;
    }
    if e > 127 + 31 {
        return if x > INFINITY { 0 } else { u32::MAX };
    }
    significand(x) >> (127 + 31 - e)
}
