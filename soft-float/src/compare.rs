//! Comparisons: any comparison with NaN is false, and -0 equals 0.

use crate::bits::{INFINITY, magnitude};

/// Returns whether one operand is NaN.
#[inline(always)]
pub const fn unordered(a: u32, b: u32) -> bool {
    magnitude(a) > INFINITY || magnitude(b) > INFINITY
}

/// Returns whether `a` = `b`.
#[inline(always)]
pub const fn equal(a: u32, b: u32) -> bool {
    if a == b {
        magnitude(a) <= INFINITY
    } else {
        (a | b) << 1 == 0
    }
}

/// Returns whether `a` < `b`.
#[inline(always)]
pub const fn less(a: u32, b: u32) -> bool {
    if (a | b) as i32 >= 0 {
        // Numbers without a sign have the order of their bits.
        a < b && b <= INFINITY
    } else if unordered(a, b) {
        false
    } else if (a & b) as i32 >= 0 {
        // Exactly one has its sign set; it may be -0.
        (a as i32) < (b as i32) && (a | b) << 1 != 0
    } else {
        a > b
    }
}

/// Returns whether `a` ≤ `b`.
#[inline(always)]
pub const fn less_equal(a: u32, b: u32) -> bool {
    if (a | b) as i32 >= 0 {
        a <= b && b <= INFINITY
    } else if unordered(a, b) {
        false
    } else if (a & b) as i32 >= 0 {
        (a as i32) < (b as i32) || (a | b) << 1 == 0
    } else {
        a >= b
    }
}
