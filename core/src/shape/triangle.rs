//! The triangle.

use super::even_odd::{Outline, crosses, meets_edge};
use super::plane::Plane;
use crate::quantize::Quantize;
use crate::ray::{Aabb, Ray};
use crate::scalar::{Scalar, Tolerance};
use crate::vec3::Vec3;
use crate::world::{World, box_of};

/// A polygon of three vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Triangle<S> {
    /// Its plane.
    pub plane: Plane<S>,
    /// The vertices, projected.
    pub corners: [[S; 2]; 3],
    /// Its extent along the projection axis, with slack.
    pub depth: [S; 2],
}

impl<S: Quantize> Triangle<S> {
    /// The triangle of three points, in scene units. Of points in one line it is one that no ray meets.
    pub fn new(world: &World, vertices: &[[f64; 3]; 3]) -> Self {
        let (plane, _) = Plane::through(world, vertices);
        let bounds = world.bounds::<S>(box_of(vertices), 0.0);
        Self {
            plane,
            corners: vertices.each_ref().map(|v| plane.corner(world, v)),
            depth: [bounds.low[plane.axis], bounds.high[plane.axis]],
        }
    }
}

impl<S: Tolerance> Triangle<S> {
    #[inline(always)]
    pub(super) fn hit(&self, ray: &Ray<S>, limit: S, slack: S) -> Option<S> {
        let t = self.plane.hit(ray, limit)?;
        let point = ray.at(t);
        let p = self.plane.project(point);
        let [a, b, c] = self.corners;
        let inside = crosses(a, b, p) ^ crosses(b, c, p) ^ crosses(c, a, p);
        // Rounding must not let the parity be odd outside the triangle's own box, and no edge is met from farther away
        // than the slack.
        let room = if inside { S::ZERO } else { slack };
        let in_box = self.range(0).contains(p[0], room)
            && self.range(1).contains(p[1], room)
            && self.depth_contains(point);
        let meets_edge = || meets_edge(&self.plane, Outline::Corners(&self.corners), ray, t, slack);
        (in_box && (inside || meets_edge())).then_some(t)
    }

    #[inline(always)]
    fn depth_contains(&self, point: Vec3<S>) -> bool {
        let depth = point[self.plane.axis];
        self.depth[0] <= depth && depth <= self.depth[1]
    }

    #[inline(always)]
    fn range(&self, i: usize) -> Range<S> {
        let [a, b, c] = self.corners;
        Range(a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]))
    }

    /// The box that all hits lie in.
    pub(super) fn bounds(&self, slack: S) -> Aabb<S> {
        let (u, v) = self.plane.axis.others();
        let mut bounds = Aabb::default();
        for (axis, i) in [(u, 0), (v, 1)] {
            let Range(low, high) = self.range(i);
            bounds.low[axis] = low - slack;
            bounds.high[axis] = high + slack;
        }
        bounds.low[self.plane.axis] = self.depth[0];
        bounds.high[self.plane.axis] = self.depth[1];
        bounds
    }
}

struct Range<S>(S, S);

impl<S: Scalar> Range<S> {
    #[inline(always)]
    fn contains(&self, x: S, room: S) -> bool {
        self.0 - room <= x && x <= self.1 + room
    }
}
