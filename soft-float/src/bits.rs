//! The fields of a binary32, and what all operations share: normalising, rounding, packing.
//!
//! A *significand* here is a `u32` whose bit 31 is the leading one: 24 bits that the format keeps,
//! a bit to round by, and seven bits below. The last is *sticky*: it is set if anything but zeros
//! was cut off. With an *exponent* `e`, as the format stores it, its value is
//! significand · 2^(e − 127 − 31).

/// The sign bit.
pub(crate) const SIGN: u32 = 1 << 31;
/// Infinity: the largest stored exponent, no fraction.
pub(crate) const INFINITY: u32 = 0x7f80_0000;
/// The NaN that an invalid operation brings.
pub(crate) const NAN: u32 = 0x7fc0_0000;
/// What makes a NaN quiet.
pub(crate) const QUIET: u32 = 1 << 22;

/// Without the sign.
#[inline(always)]
pub(crate) const fn magnitude(x: u32) -> u32 {
    x & !SIGN
}

/// The stored exponent: 0 for zero and subnormal numbers, 255 for infinity and NaN.
#[inline(always)]
pub(crate) const fn exponent(x: u32) -> u32 {
    (x << 1) >> 24
}

/// Whether it is that of a number neither zero nor subnormal nor infinite nor NaN.
#[inline(always)]
pub(crate) const fn is_normal(exponent: u32) -> bool {
    exponent.wrapping_sub(1) < 254
}

/// The significand of a normal number.
#[inline(always)]
pub(crate) const fn significand(x: u32) -> u32 {
    (x << 8) | SIGN
}

/// Exponent and half the significand of a finite number; that of a subnormal one is not normal.
pub(crate) const fn fraction(x: u32) -> (u32, u32) {
    match exponent(x) {
        0 => (1, x << 8 >> 1),
        e => (e, significand(x) >> 1),
    }
}

/// Exponent and significand of a finite number other than zero.
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

/// `m` shifted right by fewer than 32 bits, the last bit sticky.
#[inline(always)]
pub(crate) const fn shift_sticky(m: u32, shift: u32) -> u32 {
    let shifted = m >> shift;
    shifted | (shifted << shift != m) as u32
}

/// A significand rounded to 24 bits, to nearest, ties to even; 2²⁴ if it rounds up to that.
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

/// The number of this sign bit, exponent and significand, if the exponent is normal before
/// rounding; rounding up to infinity works out.
#[inline(always)]
pub(crate) const fn pack_normal(sign: u32, exponent: u32, m: u32) -> u32 {
    // The leading one adds 1 to the exponent.
    sign + (((exponent - 1) << 23) + round(m))
}

/// The same for any exponent.
pub(crate) const fn pack(sign: u32, exponent: i32, m: u32) -> u32 {
    match exponent {
        255.. => sign | INFINITY,
        1..255 => pack_normal(sign, exponent as u32, m),
        // Subnormal; one that rounds up to the least normal number works out.
        -30..1 => sign | round(shift_sticky(m, (1 - exponent) as u32)),
        _ => sign,
    }
}

/// The NaN that an operation on `a` and `b` brings, if one of them is NaN: the first, made quiet.
pub(crate) const fn propagate(a: u32, b: u32) -> Option<u32> {
    if magnitude(a) > INFINITY {
        Some(a | QUIET)
    } else if magnitude(b) > INFINITY {
        Some(b | QUIET)
    } else {
        None
    }
}
