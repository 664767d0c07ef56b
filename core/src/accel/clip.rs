//! A ray against the boxes of eight children at once.

use super::bound::BoundScalar;
use super::inv_direction::InvDirection;

/// The planes of eight boxes in the order in which a ray meets them on each axis.
#[derive(Clone, Copy, Debug)]
pub struct SlabPlanes<'a, B> {
    /// Where it may enter.
    pub near: [&'a [B; 8]; 3],
    /// Where it may leave.
    pub far: [&'a [B; 8]; 3],
}

/// A number that a ray can be clipped with against eight boxes.
pub trait ClipBoxes: BoundScalar {
    /// Clips a ray against eight boxes by the slab method (Kay and Kajiya 1986). Returns the
    /// distance at which each is entered, not less than 0, and a bit for each box that is entered
    /// before it is left and not beyond `limit`.
    #[inline(always)]
    fn clip_boxes(
        boxes: SlabPlanes<'_, Self>,
        origin: [Self; 3],
        inv_direction: &[InvDirection<Self>; 3],
        limit: Self,
    ) -> ([Self; 8], u32) {
        let mut entry = [Self::ZERO; 8];
        let mut exit = [limit; 8];
        for i in 0..3 {
            for k in 0..8 {
                let near = boxes.near[i][k].distance(origin[i], inv_direction[i].near);
                let far = boxes.far[i][k].distance(origin[i], inv_direction[i].far);
                entry[k] = near.max(entry[k]);
                exit[k] = far.min(exit[k]);
            }
        }
        let met = |mask, k: usize| mask | u32::from(entry[k] <= exit[k]) << k;
        (entry, (0..8).fold(0, met))
    }
}

impl ClipBoxes for i32 {}
impl ClipBoxes for i64 {}
impl ClipBoxes for f64 {}

impl ClipBoxes for f32 {
    // The default loop does not become vector instructions by itself; the results are the same.
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    #[inline(always)]
    fn clip_boxes(
        boxes: SlabPlanes<'_, Self>,
        origin: [Self; 3],
        inv_direction: &[InvDirection<Self>; 3],
        limit: Self,
    ) -> ([Self; 8], u32) {
        vector::clip_boxes(boxes, origin, inv_direction, limit)
    }
}

/// In vectors of four numbers, which every x86-64 has.
#[cfg(target_arch = "x86_64")]
mod vector {
    use super::{InvDirection, SlabPlanes};
    use safe_arch::{
        cmp_le_mask_m128, m128, max_m128, min_m128, move_mask_m128, mul_m128, set_splat_m128,
        sub_m128, zeroed_m128,
    };

    #[inline(always)]
    pub(super) fn clip_boxes(
        boxes: SlabPlanes<'_, f32>,
        origin: [f32; 3],
        inv_direction: &[InvDirection<f32>; 3],
        limit: f32,
    ) -> ([f32; 8], u32) {
        let halves = |planes: &[f32; 8]| {
            let [a, b, c, d, e, f, g, h] = *planes;
            [
                m128::from_array([a, b, c, d]),
                m128::from_array([e, f, g, h]),
            ]
        };
        let (mut entry, mut exit) = ([zeroed_m128(); 2], [set_splat_m128(limit); 2]);
        for i in 0..3 {
            let o = set_splat_m128(origin[i]);
            let (near, far) = (halves(boxes.near[i]), halves(boxes.far[i]));
            let enter = set_splat_m128(inv_direction[i].near);
            let leave = set_splat_m128(inv_direction[i].far);
            for k in 0..2 {
                entry[k] = max_m128(mul_m128(sub_m128(near[k], o), enter), entry[k]);
                exit[k] = min_m128(mul_m128(sub_m128(far[k], o), leave), exit[k]);
            }
        }
        let met = |k: usize| move_mask_m128(cmp_le_mask_m128(entry[k], exit[k])) as u32;
        let ([a, b, c, d], [e, f, g, h]) = (entry[0].to_array(), entry[1].to_array());
        ([a, b, c, d, e, f, g, h], met(0) | met(1) << 4)
    }
}

/// In vectors of eight numbers.
#[cfg(target_arch = "aarch64")]
mod vector {
    use super::{InvDirection, SlabPlanes};
    use wide::f32x8;

    #[inline(always)]
    pub(super) fn clip_boxes(
        boxes: SlabPlanes<'_, f32>,
        origin: [f32; 3],
        inv_direction: &[InvDirection<f32>; 3],
        limit: f32,
    ) -> ([f32; 8], u32) {
        let (mut entry, mut exit) = (f32x8::splat(0.0), f32x8::splat(limit));
        for i in 0..3 {
            let o = f32x8::splat(origin[i]);
            let near = (f32x8::new(*boxes.near[i]) - o) * f32x8::splat(inv_direction[i].near);
            let far = (f32x8::new(*boxes.far[i]) - o) * f32x8::splat(inv_direction[i].far);
            entry = near.fast_max(entry);
            exit = far.fast_min(exit);
        }
        (entry.to_array(), entry.simd_le(exit).to_bitmask())
    }
}
