//! The fields of a binary32, and the steps that all operations share: normalising, rounding, packing.
//!
//! A *significand* here is a `u32` whose bit 31 is the leading one: 24 bits that the format keeps,
//! a rounding bit, and seven bits below. The last bit is *sticky*: it is set if any bit that was cut off was set. With
//! the stored *exponent* `e`, its value is significand · 2^(e − 127 − 31).

/// The sign bit.
pub(crate) const SIGN: u32 = 1 << 31;
/// Infinity: the largest stored exponent, no fraction.
pub(crate) const INFINITY: u32 = 0x7f80_0000;
/// The NaN that an invalid operation returns.
pub(crate) const NAN: u32 = 0x7fc0_0000;
/// The bit that makes a NaN quiet.
pub(crate) const QUIET: u32 = 1 << 22;

/// Returns `x` without the sign.
#[inline(always)]
pub(crate) const fn magnitude(x: u32) -> u32 {
    x & !SIGN
}

/// Returns the stored exponent: 0 for zero and subnormal numbers, 255 for infinity and NaN.
#[inline(always)]
pub(crate) const fn exponent(x: u32) -> u32 {
    (x << 1) >> 24
}

/// Returns whether a stored exponent is that of a normal number: not zero, subnormal, infinite or NaN.
#[inline(always)]
pub(crate) const fn is_normal(exponent: u32) -> bool {
    exponent.wrapping_sub(1) < 254
}

/// Returns the significand of a normal number.
#[inline(always)]
pub(crate) const fn significand(x: u32) -> u32 {
    (x << 8) | SIGN
}

/// Returns the exponent and half the significand of a finite number; a subnormal one is not normalised.
pub(crate) const fn fraction(x: u32) -> (u32, u32) {
    match exponent(x) {
        0 => (1, x << 8 >> 1),
        e => (e, significand(x) >> 1),
    }
}

/// Returns the exponent and the significand of a finite number other than zero.
pub(crate) const fn unpack(x: u32) -> (i32, u32) {
    match exponent(x) {
        0 => normalise(1, x << 8),
        e => (e as i32, significand(x)),
    }
}

/// Shifts the leading one of `m` ≠ 0 into bit 31.
#[inline(always)]
pub(crate) const fn normalise(mut exponent: i32, mut m: u32) -> (i32, u32) {
    #[cfg(leading_zeros)]
    {
        let shift = m.leading_zeros();
        m <<= shift;
        exponent -= shift as i32;
    }
    #[cfg(not(leading_zeros))]
    {
        while m < 1 << 24 {
            m <<= 8;
            exponent -= 8;
        }
        while m < SIGN {
            m <<= 1;
            exponent -= 1;
        }
    }
    (exponent, m)
}

/// Returns `m` shifted right by fewer than 32 bits, with a sticky last bit.
#[inline(always)]
pub(crate) const fn shift_sticky(m: u32, shift: u32) -> u32 {
    let shifted = m >> shift;
    shifted | (shifted << shift != m) as u32
}

/// Rounds a significand to 24 bits, to nearest, ties to even; the result is 2²⁴ if it rounds up to that.
#[inline(always)]
pub(crate) const fn round(m: u32) -> u32 {
    let kept = m >> 8;
    if m & 0x80 == 0 {
        kept
    } else if m & 0x7f != 0 {
        kept + 1
    } else {
        kept + (kept & 1)
    }
}

/// Returns the number with this sign bit, exponent and significand, if the exponent is normal before rounding. Rounding
/// up to infinity is handled correctly.
#[inline(always)]
pub(crate) const fn pack_normal(sign: u32, exponent: u32, m: u32) -> u32 {
    // The leading one adds 1 to the exponent.
    sign + (((exponent - 1) << 23) + round(m))
}

/// Returns the same for any exponent.
pub(crate) const fn pack(sign: u32, exponent: i32, m: u32) -> u32 {
    match exponent {
        255.. => sign | INFINITY,
        1..255 => pack_normal(sign, exponent as u32, m),
        // Subnormal; rounding up to the least normal number is handled correctly.
        -30..1 => sign | round(shift_sticky(m, (1 - exponent) as u32)),
        _ => sign,
    }
}

/// Returns the result of an operation on `a` and `b` if one of them is NaN: the first NaN, made quiet.
pub(crate) const fn propagate(a: u32, b: u32) -> Option<u32> {
    if magnitude(a) > INFINITY {
        Some(a | QUIET)
    } else if magnitude(b) > INFINITY {
        Some(b | QUIET)
    } else {
        None
    }
}
