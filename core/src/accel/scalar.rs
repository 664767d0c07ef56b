//! What the accelerators ask of a number.

use super::bound::BoundScalar;
use super::clip::ClipBoxes;
use super::inv_direction::InvDirection;
use crate::scalar::{
    Approx, Fixed, Fixed64, SaturationCounter, Scalar, Tolerance, whole_f32, whole_f64,
};

/// A number format that boxes can be built and walked for.
///
/// [`Bvh8`](super::Bvh8) and [`Octree`](super::Octree) hold planes and distances as
/// [`AccelScalar::Bound`]; [`CompactBvh8`](super::CompactBvh8) holds integers alone, on the *grid*.
pub trait AccelScalar: Tolerance {
    /// The number that planes of boxes and distances along a ray are held in.
    type Bound: ClipBoxes;

    /// The same value as a coordinate of a box, exactly.
    fn to_bound(self) -> Self::Bound;

    /// The nearest value to a coordinate of a box.
    fn from_bound(bound: Self::Bound) -> Self;

    /// The reciprocal of a direction's component, as the walk wants it.
    fn inv_direction(self) -> InvDirection<Self::Bound>;

    /// [`BoundScalar::to_grid`] of the same value.
    #[inline(always)]
    fn to_grid(self) -> i32 {
        self.to_bound().to_grid()
    }

    /// A direction's component, −1 to 1, with 30 bits behind the point.
    fn direction_q30(self) -> i32;
}

macro_rules! float {
    ($t:ident, whole: $whole:ident) => {
        impl AccelScalar for $t {
            type Bound = Self;

            #[inline(always)]
            fn to_bound(self) -> Self {
                self
            }

            #[inline(always)]
            fn from_bound(bound: Self) -> Self {
                bound
            }

            #[inline(always)]
            fn inv_direction(self) -> InvDirection<Self> {
                InvDirection::<Self>::of(self)
            }

            #[inline(always)]
            fn direction_q30(self) -> i32 {
                $whole::<30>(self)
            }
        }
    };
}

float!(f32, whole: whole_f32);
float!(f64, whole: whole_f64);

impl<const N: u32> AccelScalar for Approx<N> {
    type Bound = f32;

    #[inline(always)]
    fn to_bound(self) -> f32 {
        self.0
    }

    #[inline(always)]
    fn from_bound(bound: f32) -> Self {
        Self(bound)
    }

    #[inline(always)]
    fn inv_direction(self) -> InvDirection<f32> {
        InvDirection::<f32>::of(self.0)
    }

    #[inline(always)]
    fn direction_q30(self) -> i32 {
        self.0.direction_q30()
    }
}

impl<const F: u32, C: SaturationCounter> AccelScalar for Fixed<F, C> {
    type Bound = i32;

    #[inline(always)]
    fn to_bound(self) -> i32 {
        self.to_bits()
    }

    #[inline(always)]
    fn from_bound(bound: i32) -> Self {
        Self::from_bits(bound)
    }

    #[inline(always)]
    fn inv_direction(self) -> InvDirection<i32> {
        let (mantissa, shift) = self.reciprocal().parts();
        InvDirection::<i32>::new(self.to_bits() < 0, mantissa, shift)
    }

    #[inline(always)]
    fn direction_q30(self) -> i32 {
        self.to_bits() << (30 - F)
    }
}

impl<C: SaturationCounter> AccelScalar for Fixed64<C> {
    type Bound = i64;

    #[inline(always)]
    fn to_bound(self) -> i64 {
        self.to_bits()
    }

    #[inline(always)]
    fn from_bound(bound: i64) -> Self {
        Self::from_bits(bound)
    }

    #[inline(always)]
    fn inv_direction(self) -> InvDirection<i64> {
        let raw = self.to_bits();
        let size = raw.unsigned_abs();
        let (mantissa, shift) = if size == 0 {
            (1i64 << 62, 0)
        } else {
            // 2¹²⁵ / x, for x normalised to [2⁶³, 2⁶⁴), in (2⁶¹, 2⁶²].
            let zeros = size.leading_zeros();
            let mantissa = ((1u128 << 125) / u128::from(size << zeros)) as i64;
            (mantissa, (125 - 32 - zeros) as u8)
        };
        let signed = if raw < 0 { -mantissa } else { mantissa };
        InvDirection::<i64>::new(raw < 0, signed, shift)
    }

    #[inline(always)]
    fn direction_q30(self) -> i32 {
        (self.to_bits() >> 2) as i32
    }
}
