//! The normals of patches.

use crate::quantize::Quantize;
use crate::scalar::Scalar;
use crate::vec3::Vec3;
use crate::world::{World, box_of, length, local_exponent, vector};

/// How the normal varies over a patch: interpolated over the triangles that the first vertex
/// forms with each edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Patch<S> {
    /// The normal of the first vertex in [`Shapes::normals`](super::Shapes::normals); one for each vertex.
    pub first_normal: u32,
    /// The scale, for [`Scalar::to_local`], that brings the patch's projected extent to [½, 1).
    pub exponent: i8,
    /// The area that counts as nothing, in that scale.
    pub least_area: S,
}

impl<S: Quantize> Patch<S> {
    /// The patch of these vertices, in scene units, that a triangle or polygon was made of, with a normal for each
    /// vertex, of any length: lengths are weights of the interpolation, and only their ratios count. What they are in
    /// the format is written to `stored`, which has as many elements, and is
    /// [`Shapes::normals`](super::Shapes::normals) from `first` on.
    pub fn new(
        world: &World,
        vertices: &[[f64; 3]],
        normals: &[[f64; 3]],
        first: u32,
        stored: &mut [Vec3<S>],
    ) -> Self {
        let longest = (normals.iter()).fold(0.0, |most: f64, n| most.max(length((*n).into())));
        for (place, normal) in stored.iter_mut().zip(normals) {
            *place = vector(normal.map(|x| x * (1.0 / longest)));
        }
        let [low, high] = box_of(vertices);
        let size = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
        let local = if S::FRACTION_BITS.is_some() {
            1.0
        } else {
            world.length(size)
        };
        Self {
            first_normal: first,
            exponent: local_exponent::<S>(world.length(size)),
            least_area: S::from_f64(local * local * 1e-9),
        }
    }
}

impl<S: Scalar> Patch<S> {
    /// The unit normal at a projected point. Of the fan's triangles it is the one the point lies
    /// in, or, outside all of them (a concave patch), the one it is the least outside of.
    pub(super) fn normal(
        &self,
        p: [S; 2],
        corners: &[[S; 2]],
        normals: &[Vec3<S>],
    ) -> Option<Vec3<S>> {
        let normals = normals.get(self.first_normal as usize..)?;
        let local = |a: [S; 2], b: [S; 2]| {
            let along = |i: usize| (a[i] - b[i]).to_local(self.exponent);
            [along(0), along(1)]
        };
        let area =
            |a: [S; 2], b: [S; 2]| S::narrow(S::product(a[0], b[1]) - S::product(a[1], b[0]));
        let origin = *corners.first()?;
        let w = local(p, origin);
        let mut best = (-S::MAX, [S::ONE, S::ZERO, S::ZERO], 1);
        for (k, pair) in corners.windows(2).enumerate().skip(1) {
            let (e, f) = (local(pair[0], origin), local(pair[1], origin));
            let whole = area(e, f);
            if whole.abs() <= self.least_area {
                continue;
            }
            let reciprocal = whole.reciprocal();
            let second = area(w, f).times_reciprocal(reciprocal);
            let third = area(e, w).times_reciprocal(reciprocal);
            let first = S::ONE - second - third;
            let least = first.min(second).min(third);
            if least > best.0 {
                best = (least, [first, second, third], k);
            }
        }
        let (_, weights, k) = best;
        let sum = *normals.first()? * weights[0]
            + *normals.get(k)? * weights[1]
            + *normals.get(k + 1)? * weights[2];
        Some(sum.unit().0)
    }
}
