//! Reciprocals of ray directions, for clipping rays against boxes.

use super::bound::{BoundScalar, Shifted};

/// The reciprocal of a ray's direction along one axis, twice: rounded so that no box is missed.
///
/// The two make the slab test conservative in the way of Ize, "Robust BVH Ray Traversal" (JCGT
/// 2013), on both sides and in fixed point as well.
///
/// Let u be the unit of rounding, d the direction's component, o the origin's, [l, h] a box's side
/// widened by [`BoundScalar::round_down`] and [`BoundScalar::round_up`], and P = o ⊕ (t ⊗ d) a point with
/// l' ≤ P ≤ h', where l' and h' are the sides before widening. Say d > 0. With three roundings
/// between P and t, t d (1 + 3u) ≥ l' − u|l'| − o and, with three more in the walk, the distance
/// (l − o) ⊗ 1/d is at most t (1 + 6u) if l ≤ l' − u|l'|: that is what the widening is for. `near`
/// is 1/d less 8u of it, so the box is entered at ≤ t; `far` is 1/d and 8u more, so it is left at
/// ≥ t. In fixed point the same holds with absolute errors: P is off by half a unit, and the
/// widening is four. A component that is 0, or so small that o ⊕ (t ⊗ d) = o, is replaced by the
/// smallest one that is not: a box whose widened side holds o is entered before every t and left
/// after, one whose side does not hold it is missed.
#[derive(Clone, Copy, Debug)]
pub struct InvDirection<B: BoundScalar> {
    /// Whether the ray goes down the axis.
    pub negative: bool,
    /// For the plane where a box is entered.
    pub near: B::Inverse,
    /// For the plane where it is left.
    pub far: B::Inverse,
}

macro_rules! float {
    ($t:ident, unit: $unit:expr, least: $least:expr) => {
        impl InvDirection<$t> {
            /// Of a direction's component.
            #[inline(always)]
            pub fn of(d: $t) -> Self {
                // Scenes are scaled to a size of about 1, so this moves nothing by a unit.
                const LEAST: $t = $least * $least;
                let d = if d.abs() < LEAST {
                    LEAST.copysign(d)
                } else {
                    d
                };
                let inverse = 1.0 / d;
                Self {
                    negative: d < 0.0,
                    near: inverse * (1.0 - 8.0 * $unit),
                    far: inverse * (1.0 + 8.0 * $unit),
                }
            }
        }
    };
}

float!(f32, unit: 1.0 / (1u64 << 24) as f32, least: 1.0 / (1u64 << 40) as f32);
float!(f64, unit: 1.0 / (1u64 << 53) as f64, least: 1.0 / (1u64 << 60) as f64);

macro_rules! fixed {
    ($t:ident) => {
        impl InvDirection<$t> {
            /// Of a component with the given sign whose reciprocal is mantissa · 2^−shift, with a
            /// relative error below 2^−27; the mantissa has the component's sign.
            #[inline(always)]
            pub fn new(negative: bool, mantissa: $t, shift: u8) -> Self {
                let slack = if negative { -16 } else { 16 };
                Self {
                    negative,
                    near: Shifted {
                        mantissa: mantissa - slack,
                        shift,
                    },
                    far: Shifted {
                        mantissa: mantissa.saturating_add(slack),
                        shift,
                    },
                }
            }
        }
    };
}

fixed!(i32);
fixed!(i64);
