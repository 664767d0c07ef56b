//! The number of leading zeros: an instruction, or on Armv6-M and RISC-V without bit manipulation,
//! which have none, steps of halving in place of a call into the compiler's library.

/// How many zeros `x` begins with; 31 for 0 on cores that count in steps.
#[inline(always)]
pub(crate) fn leading_zeros(x: u32) -> u32 {
    #[cfg(not(octray_no_clz))]
    return x.leading_zeros();
    #[cfg(octray_no_clz)]
    return by_steps::leading_zeros(x);
}

/// How many zeros `x` begins with; 63 for 0 on cores that count in steps.
#[inline(always)]
pub(crate) fn leading_zeros_64(x: u64) -> u32 {
    let high = (x >> 32) as u32;
    if high != 0 {
        leading_zeros(high)
    } else {
        32 + leading_zeros(x as u32)
    }
}

#[cfg(any(test, octray_no_clz))]
mod by_steps {
    /// Three comparisons, each halving what is left; the last four bits are looked up in a word.
    #[inline(always)]
    pub(crate) fn leading_zeros(x: u32) -> u32 {
        let (mut x, mut zeros) = (x, 0);
        if x < 1 << 16 {
            (x, zeros) = (x << 16, 16);
        }
        if x < 1 << 24 {
            (x, zeros) = (x << 8, zeros + 8);
        }
        if x < 1 << 28 {
            (x, zeros) = (x << 4, zeros + 4);
        }
        // Zeros of four bits: 4 - 1 for 0, 3, 2, 2, 1 four times, 0 eight times.
        zeros + (0x55_af_u32 >> (x >> 28 << 1) & 3)
    }
}

#[cfg(test)]
mod tests {
    use super::by_steps;

    #[test]
    fn steps_count_what_the_instruction_counts() {
        for bits in 0..32 {
            for low in [0, 1, u32::MAX] {
                let x = 1 << bits | low & ((1 << bits) - 1);
                assert_eq!(by_steps::leading_zeros(x), x.leading_zeros());
            }
        }
    }
}
