//! A ray in ticks, and its distances to planes.

use super::node::Header;
use crate::accel::scalar::AccelScalar;
use crate::scalar::{leading_zeros, reciprocal_q15};

/// The scene's diameter, and with it every difference of two coordinates, is below 2 to this, in ticks.
pub(super) const REACH_BITS: u32 = 14;
/// How far rounding can bring a distance in ticks off; proved at [`Along`].
const MARGIN: i32 = 4;

/// A ray along one axis. The distance of a plane is (plane − origin) · inv_direction / 2^shift, with 8
/// bits behind the point: the reciprocal 1/|d| ≤ 2⁷ has 16 bits, so that no product exceeds 2³⁰.
///
/// Distances that matter are below 2¹⁴ ticks. They are off, in ticks, by half a tick of the
/// origin times 1/|d|; by 2 for the reciprocal (relative 2⁻¹³, the same in both products); by 1 for the
/// step's product, 255 · 2⁻⁸; by 1 for the product of the node's origin, the direction's own
/// rounding (2⁻²⁹ over at least 2⁻⁷) and the limit's. `loose` is their sum.
///
/// A ray flatter than 2⁻⁷ drifts by less than diameter/2⁷ along the axis. It is taken for one of 2⁻⁷
/// that is loose by twice the diameter: where it can touch a box within its drift, (low − origin) 2⁷
/// ≤ diameter and (high − origin) 2⁷ ≥ −diameter, so the box is entered before 0 and left after diameter.
#[derive(Clone, Copy)]
pub(super) struct Along {
    /// In ticks, to nearest.
    origin: i32,
    /// With the direction's sign.
    pub(super) inv_direction: i32,
    shift: u32,
    loose_q8: i32,
}

/// The least component of a direction, with 30 bits behind the point, that is not flat.
const FLAT_Q30: u32 = 1 << 23;

impl Along {
    #[inline(always)]
    pub(super) fn new<S: AccelScalar>(origin: S, direction: S, tick: u32) -> Self {
        let direction_q30 = direction.direction_q30();
        let size = direction_q30.unsigned_abs();
        let flat = size < FLAT_Q30;
        let size = if flat { FLAT_Q30 } else { size };
        // size · 2^zeros / 2³² is in [½, 1), its reciprocal y in (1, 2]; 1/|d| = y 2^(zeros − 2).
        let zeros = leading_zeros(size);
        let inverse = reciprocal_q15(size << zeros >> 16) as i32;
        let shift = 9u32.wrapping_sub(zeros) & 15;
        Self {
            origin: ((origin.to_grid() >> (tick.wrapping_sub(1) & 31)) + 1) >> 1,
            inv_direction: if direction_q30 < 0 { -inverse } else { inverse },
            shift,
            loose_q8: (MARGIN << 8)
                + if flat {
                    2 << (REACH_BITS + 8)
                } else {
                    inverse >> (shift + 1)
                },
        }
    }

    /// Against the planes of one node.
    #[inline(always)]
    pub(super) fn at(&self, header: &Header, axis: usize) -> Slab {
        let apart = header.origin[axis].wrapping_sub(self.origin);
        let base = apart.wrapping_mul(self.inv_direction) >> self.shift;
        Slab {
            near_q8: base.wrapping_sub(self.loose_q8),
            far_q8: base.wrapping_add(self.loose_q8),
            step_q8: self.inv_direction << header.shift[axis] >> self.shift,
        }
    }
}

/// The planes of one node along one axis, as a ray meets them: the ticks of the node's origin
/// and per step.
#[derive(Clone, Copy)]
pub(super) struct Slab {
    near_q8: i32,
    far_q8: i32,
    step_q8: i32,
}

impl Slab {
    /// Narrows the ray to what lies between two planes of a child, the one it meets first and
    /// the other. False if nothing is left.
    #[inline(always)]
    pub(super) fn clip(&self, first: u32, second: u32, enter: &mut i32, exit: &mut i32) -> bool {
        let near = (first as i32)
            .wrapping_mul(self.step_q8)
            .wrapping_add(self.near_q8);
        let far = (second as i32)
            .wrapping_mul(self.step_q8)
            .wrapping_add(self.far_q8);
        *enter = near.max(*enter);
        *exit = far.min(*exit);
        *enter <= *exit
    }
}
