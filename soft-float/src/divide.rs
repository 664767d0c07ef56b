//! Division.

use crate::bits::{
    INFINITY, NAN, SIGN, exponent, is_normal, magnitude, pack, pack_normal, propagate, significand,
    unpack,
};

/// Returns `a` / `b`.
#[inline(always)]
pub const fn div(a: u32, b: u32) -> u32 {
    let (ea, eb) = (exponent(a), exponent(b));
    if !is_normal(ea) || !is_normal(eb) {
        return div_special(a, b);
    }
    let (x, y) = (significand(a) >> 8, significand(b) >> 8);
    // Wraps around if negative.
    let exponent = (ea + 127).wrapping_sub(eb).wrapping_sub((x < y) as u32);
    if !is_normal(exponent) {
        return div_special(a, b);
    }
    pack_normal((a ^ b) & SIGN, exponent, quotient(x, y))
}

/// Returns x / y, or 2x / y if that is less than 1, as a significand: x and y have 24 bits.
#[inline(always)]
const fn quotient(x: u32, y: u32) -> u32 {
    let twice = if x < y { x << 1 } else { x };
    let (digits, rest) = fraction(twice - y, y);
    SIGN | digits << 7 | (rest != 0) as u32
}

/// Returns the quotient's 24 bits below the leading one, and whether there is a remainder, for rest < y < 2²⁴.
#[cfg(divide)]
#[inline(always)]
const fn fraction(mut rest: u32, y: u32) -> (u32, u32) {
    // Eight bits per step.
    let mut digits = 0;
    let mut i = 0;
    while i < 3 {
        let digit = (rest << 8) / y;
        rest = (rest << 8) - digit * y;
        digits = digits << 8 | digit;
        i += 1;
    }
    (digits, rest)
}

/// The same without a division instruction: twelve bits per step, by the reciprocal.
///
/// The reciprocal is at most one part in 5000 too small, and never too large. With the eight bits cut off the rest, a
/// digit is less than 4096/5000 + 1/8 too small before truncation, so at most 1 too small after it. Products wrap
/// around, but the remainder is small.
#[cfg(not(divide))]
#[inline(always)]
const fn fraction(mut rest: u32, y: u32) -> (u32, u32) {
    let reciprocal_q15 = reciprocal_q15(y);
    let mut digits = 0;
    let mut i = 0;
    while i < 2 {
        let mut digit = ((rest >> 8) * reciprocal_q15) >> 19;
        rest = (rest << 12).wrapping_sub(digit.wrapping_mul(y));
        if rest >= y {
            rest -= y;
            digit += 1;
        }
        digits = digits << 12 | digit;
        i += 1;
    }
    (digits, rest)
}

/// Returns 2²⁴ / y with 15 fraction bits, at most one part in 5000 too small and never too large, for y of 24 bits:
/// from a table and one Newton step, whose error is never positive.
#[cfg(any(test, not(divide)))]
#[inline(always)]
const fn reciprocal_q15(y: u32) -> u32 {
    // Rounded up, so it is at least y.
    let y_q16 = (y >> 8) + 1;
    let first_q8 = 256 + RECIPROCALS[(y >> 17 & 63) as usize] as u32;
    let correction_q24 = (2 << 24) - first_q8 * y_q16;
    (first_q8 * (correction_q24 >> 9)) >> 8
}

/// 256 · (1 / z − 1) in the middles of 64 intervals of z from 1/2 to 1.
#[cfg(any(test, not(divide)))]
static RECIPROCALS: [u8; 64] = {
    let mut table = [0; 64];
    let mut i = 0;
    while i < 64 {
        let middle_q8 = 2 * (64 + i as u32) + 1;
        table[i] = ((256 * 256 + middle_q8 / 2) / middle_q8 - 256) as u8;
        i += 1;
    }
    table
};

/// Returns the quotient of any two numbers.
#[cold]
#[inline(never)]
const fn div_special(a: u32, b: u32) -> u32 {
    if let Some(nan) = propagate(a, b) {
        return nan;
    }
    let sign = (a ^ b) & SIGN;
    match (magnitude(a), magnitude(b)) {
        (0, 0) | (INFINITY, INFINITY) => return NAN,
        (0, _) | (_, INFINITY) => return sign,
        (_, 0) | (INFINITY, _) => return sign | INFINITY,
        _ => {}
    }
    let ((ea, x), (eb, y)) = (unpack(a), unpack(b));
    pack(
        sign,
        ea - eb + 127 - (x < y) as i32,
        quotient(x >> 8, y >> 8),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reciprocals_are_close_and_never_too_large() {
        for y in (1 << 23..1 << 24).step_by(37).chain([(1 << 24) - 1]) {
            let exact = f64::from(1 << 24) / f64::from(y);
            let found = f64::from(reciprocal_q15(y)) / 32768.0;
            let short = (exact - found) / exact;
            assert!((0.0..1.0 / 5000.0).contains(&short), "{y}: {short}");
        }
    }
}
