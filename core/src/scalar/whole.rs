//! From an `f32` to an integer times a power of two: on cores that emulate floats by a shift of
//! the mantissa, in a tenth of a multiplication and a conversion.

/// `x` · 2^`BITS` towards 0, for |x| · 2^`BITS` < 2³¹; 8 ≤ `BITS` ≤ 31.
#[inline(always)]
pub(crate) fn whole_f32<const BITS: u32>(x: f32) -> i32 {
    #[cfg(not(octray_soft_float))]
    return (x * (1u64 << BITS) as f32) as i32;
    #[cfg(octray_soft_float)]
    return by_shift::<BITS>(x);
}

/// The same of an `f64`.
#[inline(always)]
pub(crate) fn whole_f64<const BITS: u32>(x: f64) -> i32 {
    (x * (1u64 << BITS) as f64) as i32
}

/// 0 beyond the range, where the product saturates: coordinates and directions never are.
#[cfg(any(test, octray_soft_float))]
#[inline(always)]
fn by_shift<const BITS: u32>(x: f32) -> i32 {
    let bits = x.to_bits();
    let exponent = bits >> 23 & 0xff;
    let mantissa_q31 = (bits | 1 << 23) << 8;
    // x = mantissa · 2^(exponent − 127); what is shifted out entirely is 0.
    let right = (158 - BITS).wrapping_sub(exponent);
    let size = if right < 32 {
        (mantissa_q31 >> right) as i32
    } else {
        0
    };
    if (bits as i32) < 0 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::by_shift;

    #[test]
    fn a_shift_does_what_a_product_does() {
        let edges = [
            0.0,
            1e-30,
            1e-9,
            0.1,
            0.333_333_34,
            0.5,
            0.999_999_94,
            1.0,
            1.5,
        ];
        for x in edges.into_iter().flat_map(|x| [x, -x]) {
            assert_eq!(by_shift::<30>(x), (x * (1u32 << 30) as f32) as i32, "{x}");
            assert_eq!(by_shift::<29>(x), (x * (1u32 << 29) as f32) as i32, "{x}");
            assert_eq!(by_shift::<8>(x), (x * 256.0) as i32, "{x}");
        }
        let mut x = 1.999_f32;
        while x > 1e-12 {
            assert_eq!(by_shift::<29>(-x), (-x * (1u32 << 29) as f32) as i32, "{x}");
            x *= 0.997;
        }
    }
}
