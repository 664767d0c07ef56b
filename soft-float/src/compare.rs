//! Comparisons: any with NaN is false, and -0 equals 0.

use crate::bits::{INFINITY, magnitude};

/// Whether one of them is NaN.
#[inline(always)]
pub const fn unordered(a: u32, b: u32) -> bool {
    magnitude(a) > INFINITY || magnitude(b) > INFINITY
}

/// `a` = `b`.
#[inline(always)]
pub const fn equal(a: u32, b: u32) -> bool {
    if a == b {
        magnitude(a) <= INFINITY
    } else {
        (a | b) << 1 == 0
    }
}

/// `a` < `b`.
#[inline(always)]
pub const fn less(a: u32, b: u32) -> bool {
    if (a | b) as i32 >= 0 {
        // The order of numbers without sign is that of their bits.
        a < b && b <= INFINITY
    } else if unordered(a, b) {
        false
    } else if (a & b) as i32 >= 0 {
        // One is negative, or -0.
        (a as i32) < (b as i32) && (a | b) << 1 != 0
    } else {
        a > b
    }
}

/// `a` ≤ `b`.
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
