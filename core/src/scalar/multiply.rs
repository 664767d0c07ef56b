//! 32 × 32 → 64 bits: on cores with a long multiplication one instruction, on Armv6-M, which has
//! none, four short ones in place of the 64-bit multiplication of the compiler's library.

/// The product of two signed numbers.
#[cfg(not(octray_armv6m))]
#[inline(always)]
pub(crate) fn signed(a: i32, b: i32) -> i64 {
    i64::from(a) * i64::from(b)
}

/// The product of two unsigned numbers.
#[cfg(not(octray_armv6m))]
#[inline(always)]
pub(crate) fn unsigned(a: u32, b: u32) -> u64 {
    u64::from(a) * u64::from(b)
}

/// The square of a signed number.
#[cfg(not(octray_armv6m))]
#[inline(always)]
pub(crate) fn square(a: i32) -> u64 {
    signed(a, a) as u64
}

#[cfg(octray_armv6m)]
pub(crate) use short::{signed, square, unsigned};

#[cfg(any(test, octray_armv6m))]
mod short {
    /// The product of two signed numbers. No sum of a product and a half word overflows.
    #[inline(never)]
    pub(crate) fn signed(a: i32, b: i32) -> i64 {
        let (a_low, b_low) = (a & 0xffff, b & 0xffff);
        let (a_high, b_high) = (a >> 16, b >> 16);
        let low = (a_low as u32).wrapping_mul(b_low as u32);
        let middle = (a_high * b_low).wrapping_add((low >> 16) as i32);
        let other = (a_low * b_high).wrapping_add(middle & 0xffff);
        let high = (a_high * b_high)
            .wrapping_add(middle >> 16)
            .wrapping_add(other >> 16);
        i64::from(high) << 32 | i64::from((other as u32) << 16 | low & 0xffff)
    }

    /// The product of two unsigned numbers.
    #[inline(never)]
    pub(crate) fn unsigned(a: u32, b: u32) -> u64 {
        let (a_low, b_low) = (a & 0xffff, b & 0xffff);
        let (a_high, b_high) = (a >> 16, b >> 16);
        let low = a_low * b_low;
        let middle = (a_high * b_low).wrapping_add(low >> 16);
        let other = (a_low * b_high).wrapping_add(middle & 0xffff);
        let high = (a_high * b_high)
            .wrapping_add(middle >> 16)
            .wrapping_add(other >> 16);
        u64::from(high) << 32 | u64::from(other << 16 | low & 0xffff)
    }

    /// The square of a signed number, in three products.
    #[inline(never)]
    pub(crate) fn square(a: i32) -> u64 {
        let size = a.unsigned_abs();
        let (low, high) = (size & 0xffff, size >> 16);
        let middle = low * high;
        let outer = u64::from(high * high) << 32 | u64::from(low * low);
        outer + (u64::from(middle) << 17)
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn four_short_products_make_a_long_one() {
        let edges = [
            0u32,
            1,
            2,
            0x7fff,
            0x8000,
            0xffff,
            0x1_0000,
            0x7fff_ffff,
            0x8000_0000,
            0xffff_0000,
            0xffff_ffff,
            0x1234_5678,
            0xdead_beef,
        ];
        for a in edges {
            for b in edges {
                assert_eq!(short::unsigned(a, b), u64::from(a) * u64::from(b));
                let (a, b) = (a as i32, b as i32);
                assert_eq!(short::signed(a, b), i64::from(a) * i64::from(b));
                assert_eq!(short::square(a), (i64::from(a) * i64::from(a)) as u64);
            }
        }
    }
}
