//! Multiplication.

use crate::bits::{
    INFINITY, NAN, SIGN, exponent, is_normal, magnitude, pack, pack_normal, propagate, significand,
    unpack,
};

/// Returns `a` · `b`.
#[inline(always)]
pub const fn mul(a: u32, b: u32) -> u32 {
    let (ea, eb) = (exponent(a), exponent(b));
    if !is_normal(ea) || !is_normal(eb) {
        // Zeros are common in normals and in directions along an axis.
        if (a << 1 == 0 && eb != 255) || (b << 1 == 0 && ea != 255) {
            return (a ^ b) & SIGN;
        }
        return mul_special(a, b);
    }
    let mut m = product(significand(a), significand(b));
    // The exponent if the product of the two significands, each from 1 to 2, is below 2; wraps around if negative.
    let mut exponent = (ea + eb).wrapping_sub(127);
    if m & SIGN == 0 {
        m <<= 1;
    } else {
        exponent = exponent.wrapping_add(1);
    }
    if !is_normal(exponent) {
        return mul_special(a, b);
    }
    pack_normal((a ^ b) & SIGN, exponent, m)
}

/// Returns the upper half of the product of two significands, with a sticky last bit: 2³⁰ or more.
#[inline(always)]
const fn product(x: u32, y: u32) -> u32 {
    #[cfg(long_multiply)]
    {
        let product = x as u64 * y as u64;
        (product >> 32) as u32 | (product as u32 != 0) as u32
    }
    #[cfg(not(long_multiply))]
    {
        // Four products of at most 16 x 16 bits: significands have 24.
        let (x1, x0) = (x >> 24, x >> 8 & 0xffff);
        let (y1, y0) = (y >> 24, y >> 8 & 0xffff);
        let low = x0 * y0;
        let high = (x1 * y1 << 16) + (x1 * y0 + x0 * y1) + (low >> 16);
        high | (low << 16 != 0) as u32
    }
}

/// Returns the product of any two numbers.
#[cold]
#[inline(never)]
const fn mul_special(a: u32, b: u32) -> u32 {
    if let Some(nan) = propagate(a, b) {
        return nan;
    }
    let sign = (a ^ b) & SIGN;
    let infinite = magnitude(a) == INFINITY || magnitude(b) == INFINITY;
    if infinite {
        let zero = magnitude(a) == 0 || magnitude(b) == 0;
        return if zero { NAN } else { sign | INFINITY };
    }
    let ((ea, x), (eb, y)) = (unpack(a), unpack(b));
    let m = product(x, y);
    match m & SIGN {
        0 => pack(sign, ea + eb - 127, m << 1),
        _ => pack(sign, ea + eb - 126, m),
    }
}
