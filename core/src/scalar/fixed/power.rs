//! Powers of numbers in [0, 1], in 31 bits whatever the format.

use crate::scalar::multiply::{signed, unsigned};

/// x^(whole + fraction) for raw `x` and `fraction` with `f` bits behind the point; `x` is clamped
/// to [0, 1].
pub(super) fn power(x: i32, f: u32, whole: u32, fraction: i32) -> i32 {
    let one = 1i32 << f;
    if x >= one || (whole == 0 && fraction == 0) {
        return one;
    }
    if x <= 0 {
        return 0;
    }
    let x_q31 = (x as u32) << (31 - f);
    let (mut result_q31, mut square_q31, mut rest) = (1u32 << 31, x_q31, whole);
    while rest != 0 && square_q31 != 0 {
        if rest & 1 != 0 {
            result_q31 = mul_q31(result_q31, square_q31);
        }
        square_q31 = mul_q31(square_q31, square_q31);
        rest >>= 1;
    }
    if rest != 0 {
        return 0;
    }
    if fraction > 0 {
        result_q31 = mul_q31(result_q31, root_q31(x_q31, (fraction as u32) << (31 - f)));
    }
    let half = (1u32 << (31 - f)) >> 1;
    (result_q31.saturating_add(half) >> (31 - f)) as i32
}

/// x^f as 2^(f · log2 x), absolute error below 1e-6, for 0 < `x_q31` < 2³¹ and `f_q31` < 2³¹.
fn root_q31(x_q31: u32, f_q31: u32) -> u32 {
    // x = m · 2^−n with m in [1, 2); −log2 x = n − log2 m.
    let n = x_q31.leading_zeros();
    let z_q30 = ((x_q31 << n) & 0x7fff_ffff) as i32 >> 1;
    let log_q30 = mul_q30(z_q30, polynomial_q30(&LOG2_Q30, z_q30));
    let minus_log_q30 = (i64::from(n) << 30) - i64::from(log_q30);
    // Four bits less, or the product would need 66.
    let y_q30 = ((minus_log_q30 >> 4) * i64::from(f_q31)) >> 27;
    // 2^−y = 2^−(whole + 1) · 2^g with g = 1 − (fraction of y).
    let whole = (y_q30 >> 30) as u32 + 1;
    let g_q30 = (1 << 30) - (y_q30 & 0x3fff_ffff) as i32;
    let power_q30 = polynomial_q30(&EXP2_Q30, g_q30);
    if whole > 31 {
        return 0;
    }
    ((power_q30 as u32) << 1) >> whole
}

#[inline(always)]
fn mul_q31(a: u32, b: u32) -> u32 {
    ((unsigned(a, b) + (1 << 30)) >> 31) as u32
}

#[inline(always)]
fn mul_q30(a: i32, b: i32) -> i32 {
    (signed(a, b) >> 30) as i32
}

fn polynomial_q30(coefficients: &[i32], x_q30: i32) -> i32 {
    let mut sum = 0i32;
    for c in coefficients.iter().rev() {
        sum = mul_q30(sum, x_q30).wrapping_add(*c);
    }
    sum
}

const fn q30(x: f64) -> i32 {
    (x * (1u32 << 30) as f64) as i32
}

/// log2(1 + z) / z on [0, 1], error below 4e-7.
const LOG2_Q30: [i32; 8] = [
    q30(1.442_694_767),
    q30(-0.721_310_723),
    q30(0.480_073_749),
    q30(-0.353_454_682),
    q30(0.256_179_700),
    q30(-0.155_599_962),
    q30(0.063_787_592),
    q30(-0.012_370_642),
];

/// 2^g on [0, 1], error below 1.1e-7.
const EXP2_Q30: [i32; 6] = [
    q30(0.999_999_896),
    q30(0.693_154_620),
    q30(0.240_140_770),
    q30(0.055_863_283),
    q30(0.008_946_215),
    q30(0.001_895_107),
];
