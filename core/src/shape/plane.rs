//! The plane that a polygon lies in.

use super::contact::Contact;
use crate::quantize::Quantize;
use crate::ray::Ray;
use crate::scalar::Tolerance;
use crate::vec3::{Axis, Vec3};
use crate::world::{World, unit, vector};

/// The plane of a polygon, and the axis along which the polygon is projected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Plane<S> {
    /// Its unit normal.
    pub normal: Vec3<S>,
    /// The dot product of the normal with the plane's points.
    pub offset: S,
    /// The axis of the normal's largest component.
    pub axis: Axis,
}

impl<S: Quantize> Plane<S> {
    /// The plane through the middle of vertices, in scene units, and how far they are off it at most. Vertices in one
    /// line have no plane, and no ray meets the one that is returned.
    pub(super) fn through(world: &World, vertices: &[[f64; 3]]) -> (Self, f64) {
        let sum = (vertices.iter()).fold(Vec3::ZERO, |sum, v| sum + Vec3::from(*v));
        let middle = sum * (1.0 / vertices.len() as f64);
        let normal = normal(vertices, middle);
        let off_plane = |v: &[f64; 3]| normal.dot(Vec3::from(*v) - middle).abs();
        let sizes = normal.map(f64::abs);
        let axis = if sizes.x >= sizes.y && sizes.x >= sizes.z {
            Axis::X
        } else if sizes.y >= sizes.z {
            Axis::Y
        } else {
            Axis::Z
        };
        // The offset belongs to the rounded normal.
        let rounded: Vec3<S> = vector(normal.to_array());
        let offset = (rounded.map(S::to_f64)).dot(world.point(middle.to_array()).into());
        let plane = Self {
            normal: rounded,
            offset: S::from_f64(offset),
            axis,
        };
        (plane, vertices.iter().map(off_plane).fold(0.0, f64::max))
    }

    /// A vertex in scene units, projected.
    pub(super) fn corner(&self, world: &World, vertex: &[f64; 3]) -> [S; 2] {
        self.project(Vec3::from(world.point(*vertex)).map(S::from_f64))
    }
}

/// The unit normal of the plane that vertices span.
///
/// It is that of Newell's sum, to which every edge contributes, so that the noise of written digits averages out. Where
/// lobes of an outline that crosses itself cancel in that sum, noise is what is left of it: then it is the normal
/// of the widest triangle of the first vertex, the one farthest from it and any third.
///
/// `middle` is the mean of the vertices; sums are taken from there, where they cancel least.
fn normal(vertices: &[[f64; 3]], middle: Vec3<f64>) -> Vec3<f64> {
    let Some(&first) = vertices.first() else {
        return Vec3::ZERO;
    };
    let from = |origin: Vec3<f64>| move |v: &[f64; 3]| Vec3::from(*v) - origin;
    let (from_first, from_middle) = (from(first.into()), from(middle));
    let longest = |a: Vec3<f64>, b: Vec3<f64>| if b.dot(b) > a.dot(a) { b } else { a };
    let far = vertices.iter().map(from_first).fold(Vec3::ZERO, longest);
    let widest = (vertices.iter().map(|v| far.cross(from_first(v)))).fold(Vec3::ZERO, longest);
    let next = vertices.iter().cycle().skip(1);
    let newell = vertices.iter().zip(next).fold(Vec3::ZERO, |sum, (a, b)| {
        sum + from_middle(a).cross(from_middle(b))
    });
    if 16.0 * newell.dot(newell) < widest.dot(widest) {
        unit(widest)
    } else {
        unit(newell)
    }
}

impl<S: Tolerance> Plane<S> {
    /// Thesis (2.4), with the plane's offset that it lacks. Along a nearly parallel ray the quotient
    /// has no bound: it saturates, which is beyond every limit.
    #[inline(always)]
    pub(super) fn hit(&self, ray: &Ray<S>, limit: S) -> Option<S> {
        let above = S::narrow(S::product(self.offset, S::ONE) - self.normal.dot_wide(ray.origin));
        let rise = self.rise(ray);
        let (above, rise) = if rise < S::ZERO {
            (-above, -rise)
        } else {
            (above, rise)
        };
        if above <= S::ZERO || S::quotient_exceeds(above, rise, limit) {
            return None;
        }
        let t = above.quotient(rise);
        (t > S::ZERO && t <= limit).then_some(t)
    }

    /// The distance along a ray at which it meets the plane, exact but for rounding.
    #[inline(always)]
    pub(super) fn rounded_distance(&self, ray: &Ray<S>) -> S {
        let above = self.above(ray.origin);
        above.abs().rounded_quotient(self.rise(ray).abs())
    }

    /// How far a ray gets to the normal's side per length.
    #[inline(always)]
    pub(super) fn rise(&self, ray: &Ray<S>) -> S {
        self.normal.dot(ray.direction)
    }

    /// Whether it holds a point, to within `slack`. A ray to the point meets the plane nowhere else.
    #[inline(always)]
    pub(super) fn holds(&self, point: Vec3<S>, slack: S) -> bool {
        self.above(point).abs() <= slack
    }

    /// How far a point is on the normal's side.
    #[inline(always)]
    fn above(&self, point: Vec3<S>) -> S {
        S::narrow(self.normal.dot_wide(point) - S::product(self.offset, S::ONE))
    }

    /// The point's two coordinates besides the projection axis.
    #[inline(always)]
    pub(super) fn project(&self, p: Vec3<S>) -> [S; 2] {
        let (u, v) = self.axis.others();
        [p[u], p[v]]
    }

    /// The point goes back onto the plane.
    #[inline(always)]
    pub(super) fn contact(&self, point: Vec3<S>) -> Contact<S> {
        Contact {
            point: point - self.normal * self.above(point),
            outward: self.normal,
            curvature_extent: S::ZERO,
            closed: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lobes_that_cancel_leave_the_plane_of_the_vertices() {
        // Z order, once exactly and once with a vertex off by what three decimals leave.
        for noise in [0.0, 5e-4, -5e-4] {
            let z = [
                [0.0, 0.0, 0.0],
                [2.0, 0.0, noise],
                [0.0, 1.0, 0.0],
                [2.0, 1.0, 0.0],
            ];
            let n = normal(&z, [1.0, 0.5, noise / 4.0].into());
            assert!(n.z.abs() > 0.999_999, "{n:?}");
        }
    }

    #[test]
    fn what_turns_left_faces_up() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| [x, y, 7.0]);
        let n = normal(&square, [0.5, 0.5, 7.0].into());
        assert_eq!(n.to_array(), [0.0, 0.0, 1.0]);
    }
}
