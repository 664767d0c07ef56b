//! Reciprocal and reciprocal square root of a normalised 32-bit number: a short table and two
//! Newton steps, products of 32 by 32 bits only.

use crate::scalar::multiply::{square, unsigned};

/// 1/x for `x_q32` in [2³¹, 2³²), that is x in [½, 1); 1/x in (1, 2] with 30 bits behind the
/// point, clamped below 2. Relative error below 2⁻²⁷.
#[cfg_attr(octray_armv6m, inline(never))]
#[cfg_attr(not(octray_armv6m), inline(always))]
pub(crate) fn reciprocal_q30(x_q32: u32) -> u32 {
    let start_q15 = u32::from(RECIPROCAL_Q15[(x_q32 >> 25) as usize & 63]);
    // y ← y (2 − x y), twice.
    let rest_q30 = 0x8000_0000u32.wrapping_sub(high(x_q32, start_q15 << 15));
    let y_q30 = times_q15::<15>(rest_q30, start_q15);
    let rest_q30 = 0x8000_0000u32.wrapping_sub(high(x_q32, y_q30));
    let y_q30 = (unsigned(y_q30, rest_q30) >> 30) as u32;
    y_q30.min(0x7fff_ffff)
}

/// 1/x for `x_q16` in [2¹⁵, 2¹⁶), that is x in [½, 1); 1/x in (1, 2) with 15 bits behind the point.
/// Relative error below 2⁻¹³, by 16-bit products; never too large.
#[inline(always)]
pub(crate) fn reciprocal_q15(x_q16: u32) -> u32 {
    let start_q15 = u32::from(RECIPROCAL_Q15[(x_q16 >> 9) as usize & 63]);
    // y ← y (2 − x y)
    let rest_q31 = (x_q16 * start_q15).wrapping_neg();
    (start_q15 * (rest_q31 >> 16)) >> 15
}

/// 1/√x for `x_q32` in [2³⁰, 2³²), that is x in [¼, 1); 1/√x in (1, 2] with 30 bits behind the
/// point, clamped below 2. Relative error below 2⁻²⁷.
#[cfg_attr(octray_armv6m, inline(never))]
#[cfg_attr(not(octray_armv6m), inline(always))]
pub(super) fn rsqrt_q30(x_q32: u32) -> u32 {
    // Seven bits of x, the first of them set; which half of [¼, 1) they come from is the eighth.
    let upper = x_q32 >> 31;
    let index = upper << 6 | (x_q32 >> (24 + upper)) & 63;
    let start_q15 = u32::from(RSQRT_Q15[index as usize & 127]);
    // y ← y (3 − x y²) / 2, twice.
    let rest_q28 = 0x3000_0000u32.wrapping_sub(high(x_q32, (start_q15 * start_q15) >> 2));
    let y_q30 = times_q15::<14>(rest_q28, start_q15);
    // Of 2³¹ or less, as a signed number the same but for a sign.
    let square_q28 = (square(y_q30 as i32) >> 32) as u32;
    let rest_q28 = 0x3000_0000u32.wrapping_sub(high(x_q32, square_q28));
    let y_q30 = (unsigned(y_q30, rest_q28) >> 29) as u32;
    y_q30.min(0x7fff_ffff)
}

/// The product with a number of 16 bits, without its last `DOWN` ≤ 16 bits; below 2³². Two short
/// products.
#[inline(always)]
fn times_q15<const DOWN: u32>(x: u32, short: u32) -> u32 {
    (((x >> 16) * short) << (16 - DOWN)) + (((x & 0xffff) * short) >> DOWN)
}

/// The high half of the product.
#[inline(always)]
fn high(a: u32, b: u32) -> u32 {
    (unsigned(a, b) >> 32) as u32
}

/// 1/x in the middle of each 64th of [½, 1), with 15 bits behind the point, indexed by the six bits
/// behind the first.
const RECIPROCAL_Q15: [u16; 64] = {
    let mut table = [0; 64];
    let mut i = 0;
    while i < 64 {
        // x = (64 + i + ½) / 128.
        let x_q8 = 2 * (64 + i as u32) + 1;
        table[i] = ((1 << 23) / x_q8) as u16;
        i += 1;
    }
    table
};

/// 1/√x in the middle of each 64th of [¼, ½), then of [½, 1), with 15 bits behind the point.
const RSQRT_Q15: [u16; 128] = {
    let mut table = [0; 128];
    let mut i = 0;
    while i < 128 {
        // x = (64 + i + ½) / 256, or (i + ½) / 128 from the 64th on.
        let x_q9 = if i < 64 {
            2 * (64 + i as u64) + 1
        } else {
            4 * i as u64 + 2
        };
        table[i] = ((1u64 << 39) / x_q9).isqrt() as u16;
        i += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::reciprocal_q15;

    #[test]
    fn short_reciprocals_are_close_and_never_too_large() {
        for x_q16 in 1 << 15..1 << 16 {
            let exact_q15 = f64::from(1u32 << 31) / f64::from(x_q16);
            let short = (exact_q15 - f64::from(reciprocal_q15(x_q16))) / exact_q15;
            assert!((0.0..1.0 / 8192.0).contains(&short), "{x_q16}: {short}");
        }
    }
}
