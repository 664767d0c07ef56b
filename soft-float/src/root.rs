//! Square root.

use crate::bits::{
    INFINITY, NAN, QUIET, SIGN, exponent, is_normal, magnitude, significand, unpack,
};

/// Returns √`x`.
#[inline(always)]
pub const fn sqrt(x: u32) -> u32 {
    let e = exponent(x);
    if x & SIGN != 0 || !is_normal(e) {
        return sqrt_special(x);
    }
    root(e, significand(x))
}

/// Returns the root of a number with this significand and this exponent plus a multiple of 2.
///
/// Let z = N / 2³² from 1/4 to 1. A table and one Newton step give 1/√z; from that follows √z · 2¹⁶; the missing nine
/// bits follow from the distance of its square to N. They are off by less than 1 before truncation. Squares wrap
/// around, but their distances to N are small.
#[inline(always)]
const fn root(exponent: u32, significand: u32) -> u32 {
    let odd = exponent & 1;
    // The bias of 127 is odd, too.
    let n_q32 = significand >> odd;
    let n_q16 = n_q32 >> 16;
    let first_q8 = 256 + INVERSE_ROOTS[(n_q32 >> 24) as usize - 64] as u32;
    let correction_q30 = (3 << 30) - ((first_q8 * first_q8) >> 2) * n_q16;
    let inverse_q15 = (first_q8 * (correction_q30 >> 16)) >> 8;
    let root_q16 = (n_q16 * inverse_q15) >> 15;
    let distance_q32 = n_q32.wrapping_sub(root_q16.wrapping_mul(root_q16)) as i32;
    let missing_q25 = ((distance_q32 >> 5) * inverse_q15 as i32) >> 18;
    let mut root_q25 = (root_q16 << 9).wrapping_add_signed(missing_q25);
    let rest = (n_q32 << 18).wrapping_sub(root_q25.wrapping_mul(root_q25)) as i32;
    if rest < 0 {
        root_q25 -= 1;
    } else if rest as u32 > 2 * root_q25 {
        root_q25 += 1;
    }
    // The last bit decides: no root lies halfway between two numbers.
    let rounded = (root_q25 + 1) >> 1;
    (((exponent + odd) / 2 + 62) << 23) + rounded
}

/// 256 · (1 / √z − 1) in the middles of 192 intervals of z from 1/4 to 1.
static INVERSE_ROOTS: [u8; 192] = {
    let mut table = [0; 192];
    let mut i = 0;
    while i < 192 {
        // r = 256 / √z: r² · (2i + 129) = 2²⁵ where z = (2i + 129) / 2⁹.
        let mut r: u32 = 256;
        while (2 * r + 1) * (2 * r + 1) * (2 * i as u32 + 129) < 1 << 27 {
            r += 1;
        }
        table[i] = (r - 256) as u8;
        i += 1;
    }
    table
};

/// Returns the root of any number.
#[cold]
#[inline(never)]
const fn sqrt_special(x: u32) -> u32 {
    match magnitude(x) {
        0 => x,
        INFINITY.. if magnitude(x) > INFINITY => x | QUIET,
        _ if x & SIGN != 0 => NAN,
        INFINITY => x,
        _ => {
            // Subnormal: an even number makes its exponent positive.
            let (exponent, m) = unpack(x);
            root((exponent + 32) as u32, m) - (16 << 23)
        }
    }
}
