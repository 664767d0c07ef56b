//! Addition and subtraction.

use crate::bits::{
    INFINITY, NAN, SIGN, exponent, fraction, is_normal, magnitude, normalise, pack, pack_normal,
    propagate, shift_sticky, significand,
};

/// If the exponents differ by more than this, the smaller number is less than half of a last place of the sum, even if
/// the sum is one binade lower.
const FAR: u32 = 25;

/// Returns `a` + `b`.
#[inline(always)]
pub const fn add(a: u32, b: u32) -> u32 {
    if a << 1 < b << 1 {
        add_ordered::<true>(b, a)
    } else {
        add_ordered::<false>(a, b)
    }
}

/// Returns `a` − `b`.
#[inline(always)]
pub const fn sub(a: u32, b: u32) -> u32 {
    add(a, b ^ SIGN)
}

/// Returns `a` + `b` for |`a`| ≥ |`b`|; `SWAPPED` states whether the operands were swapped to achieve that.
#[inline(always)]
const fn add_ordered<const SWAPPED: bool>(a: u32, b: u32) -> u32 {
    let (large, small) = (exponent(a), exponent(b));
    if !is_normal(large) || small == 0 {
        // Zeros are common in normals and in directions along an axis.
        if b << 1 == 0 && large != 255 {
            // -0 only if both operands are -0.
            return if a << 1 == 0 { a & b } else { a };
        }
        return if SWAPPED {
            add_special(b, a)
        } else {
            add_special(a, b)
        };
    }
    let distance = large - small;
    if distance > FAR {
        return a;
    }
    // A significand with one bit less leaves room for the carry.
    let x = significand(a) >> 1;
    let y = shift_sticky(significand(b) >> 1, distance);
    let sign = a & SIGN;
    if (a ^ b) & SIGN == 0 {
        let sum = x + y;
        if sum & SIGN == 0 {
            pack_normal(sign, large, sum << 1)
        } else if large < 254 {
            pack_normal(sign, large + 1, sum)
        } else {
            sign | INFINITY
        }
    } else {
        let difference = x - y;
        if difference == 0 {
            return 0;
        }
        let (exponent, m) = normalise(large as i32 + 1, difference);
        if exponent <= 0 {
            return pack(sign, exponent, m);
        }
        pack_normal(sign, exponent as u32, m)
    }
}

/// Returns the sum of any two numbers.
#[cold]
#[inline(never)]
const fn add_special(a: u32, b: u32) -> u32 {
    if let Some(nan) = propagate(a, b) {
        return nan;
    }
    let (a, b) = if magnitude(a) < magnitude(b) {
        (b, a)
    } else {
        (a, b)
    };
    if magnitude(a) == INFINITY {
        return if a ^ b == SIGN { NAN } else { a };
    }
    let ((large, x), (small, y)) = (fraction(a), fraction(b));
    if large - small > FAR {
        return a;
    }
    let y = shift_sticky(y, large - small);
    let total = if (a ^ b) & SIGN == 0 { x + y } else { x - y };
    if total == 0 {
        return 0;
    }
    let (exponent, m) = normalise(large as i32 + 1, total);
    pack(a & SIGN, exponent, m)
}
