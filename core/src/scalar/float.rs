//! `f32` and `f64`: hardware or software floating point, with roots by libm,
//! or by an instruction where there is one ([`root`]).

use super::{Exponent, Intensity, Ratio, Scalar, Tolerance, root};

/// One definition of every operation for both widths.
macro_rules! float {
    ($t:ident, $sqrt:path, $power:path, position: $p:expr, curvature: $r:expr) => {
        impl Scalar for $t {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const MAX: Self = $t::MAX;

            type Wide = Self;

            #[inline(always)]
            fn product(a: Self, b: Self) -> Self {
                a * b
            }

            #[inline(always)]
            fn narrow(wide: Self) -> Self {
                wide
            }

            #[inline(always)]
            fn sqrt_wide(wide: Self) -> Self {
                if wide > 0.0 { $sqrt(wide) } else { 0.0 }
            }

            type Reciprocal = Self;

            #[inline(always)]
            fn reciprocal(self) -> Self {
                // Not below the smallest normal number, whose reciprocal would be infinite.
                if self.abs() >= $t::MIN_POSITIVE {
                    1.0 / self
                } else {
                    $t::MAX.copysign(self)
                }
            }

            #[inline(always)]
            fn times_reciprocal(self, reciprocal: Self) -> Self {
                self * reciprocal
            }

            #[inline(always)]
            fn quotient(self, divisor: Self) -> Self {
                self / divisor
            }

            // A division costs no more than this test would.
            #[inline(always)]
            fn quotient_exceeds(_: Self, _: Self, _: Self) -> bool {
                false
            }

            #[inline(always)]
            fn scale_to_index(self, n: u32) -> u32 {
                (self * n as $t) as u32
            }

            #[inline(always)]
            fn unit(v: [Self; 3]) -> ([Self; 3], Self) {
                let square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
                if square > 0.0 {
                    let length = $sqrt(square);
                    let inverse = 1.0 / length;
                    ([v[0] * inverse, v[1] * inverse, v[2] * inverse], length)
                } else {
                    (v, 0.0)
                }
            }

            #[inline(always)]
            fn to_local(self, _: i8) -> Self {
                self
            }

            #[inline(always)]
            fn to_global(self, _: i8) -> Self {
                self
            }
        }

        impl Tolerance for $t {
            const EXACT_ROOTS: bool = true;

            const HITS_WITHIN_SLACK: bool = true;

            #[inline(always)]
            fn surface_error(position: Self, curvature_extent: Self) -> Self {
                position * $p + curvature_extent * $r
            }

            #[inline(always)]
            fn coordinate_error(reach: Self) -> Self {
                reach * (4.0 * $t::EPSILON)
            }

            #[inline(always)]
            fn plane_error(reach: Self) -> Self {
                reach * (16.0 * $t::EPSILON)
            }

            #[inline(always)]
            fn slack_near(reach: Self, slack: Self) -> Self {
                Scalar::min(reach * (16.0 * $t::EPSILON), slack)
            }

            #[inline(always)]
            fn with_rounding_margin(self) -> Self {
                // Four roundings.
                self * (1.0 + 2.0 * $t::EPSILON)
            }
        }

        impl Ratio for $t {
            #[inline(always)]
            fn whole_reciprocal(n: u32) -> Self {
                1.0 / (n as $t)
            }

            #[inline(always)]
            fn ratio(numerator: i32, n: Self) -> Self {
                numerator as $t * n
            }
        }

        impl Intensity for $t {
            #[inline(always)]
            fn level(self) -> u8 {
                // The cast saturates.
                (self * 255.0 + 0.5) as u8
            }

            #[inline(always)]
            fn accumulate(self, light: Self) -> Self {
                self + light
            }

            #[inline(always)]
            fn power(self, exponent: Exponent<Self>) -> Self {
                $power(self, exponent)
            }
        }
    };
}

float!(f32, root::sqrt_f32, power_f32, position: 1.0 / 524_288.0, curvature: 1.0 / 524_288.0);
float!(f64, libm::sqrt, power_f64, position: 1.0 / (1u64 << 44) as f64, curvature: 1.0 / (1u64 << 44) as f64);

#[inline(always)]
fn power_f64(x: f64, exponent: Exponent<f64>) -> f64 {
    libm::pow(x.min(1.0), f64::from(exponent.whole) + exponent.fraction)
}

/// Repeated squaring for the whole part, then [`root_f32`] for the rest.
#[inline(always)]
pub(super) fn power_f32(x: f32, exponent: Exponent<f32>) -> f32 {
    // A dot product of unit vectors can exceed 1 by rounding.
    let x = if x > 1.0 { 1.0 } else { x };
    let (mut result, mut square, mut rest) = (1.0, x, exponent.whole);
    while rest != 0 {
        // On hosts a product costs less than a mispredicted branch.
        if cfg!(not(target_os = "none")) {
            result *= if rest & 1 != 0 { square } else { 1.0 };
        } else if rest & 1 != 0 {
            result *= square;
        }
        square *= square;
        rest >>= 1;
    }
    if exponent.fraction > 0.0 {
        result *= root_f32(x, exponent.fraction);
    }
    result
}

/// x^f for 0 ≤ x ≤ 1 and 0 < f < 1 as 2^(f · log2 x), absolute error below 1e-6: the mantissa's
/// logarithm and the remaining fraction's exponential by polynomials (near-minimax, on [0, 1]).
fn root_f32(x: f32, f: f32) -> f32 {
    if x < f32::MIN_POSITIVE {
        return 0.0;
    }
    let bits = x.to_bits();
    let exponent = (bits >> 23) as i32 - 127;
    let z = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000) - 1.0;
    let mut log = LOG2[7];
    for c in LOG2[..7].iter().rev() {
        log = log * z + c;
    }
    let y = f * (exponent as f32 + log * z);
    // y ≤ 0 up to rounding; split it into a whole number and a fraction in [0, 1).
    let whole = y as i32 - 1;
    let g = y - whole as f32;
    let mut power = EXP2[5];
    for c in EXP2[..5].iter().rev() {
        power = power * g + c;
    }
    power * f32::from_bits(((whole + 127).max(0) as u32) << 23)
}

/// log2(1 + z) / z on [0, 1], error below 4e-7.
const LOG2: [f32; 8] = [
    1.442_694_8,
    -0.721_310_7,
    0.480_073_75,
    -0.353_454_68,
    0.256_179_7,
    -0.155_599_96,
    0.063_787_594,
    -0.012_370_642,
];

/// 2^g on [0, 1], error below 1.1e-7.
const EXP2: [f32; 6] = [
    0.999_999_9,
    0.693_154_6,
    0.240_140_77,
    0.055_863_284,
    0.008_946_214,
    0.001_895_107_3,
];
