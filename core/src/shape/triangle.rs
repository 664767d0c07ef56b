//! The triangle.

use super::even_odd::{Near, crosses, edges_of};
use super::plane::Plane;
use crate::ray::{Aabb, Ray};
use crate::scalar::{Scalar, Tolerance};
use crate::vec3::Vec3;

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

impl<S: Tolerance> Triangle<S> {
    #[inline(always)]
    pub(super) fn hit(&self, ray: &Ray<S>, limit: S, slack: S) -> Option<S> {
        let t = self.plane.hit(ray, limit)?;
        let point = ray.at(t);
        let p = self.plane.project(point);
        let [a, b, c] = self.corners;
        let odd = crosses(a, b, p) ^ crosses(b, c, p) ^ crosses(c, a, p);
        // Rounding must not let the parity be odd outside the triangle's own box.
        let depth = point[self.plane.axis];
        let in_box = self.range(0, slack).contains(p[0])
            && self.range(1, slack).contains(p[1])
            && self.depth[0] <= depth
            && depth <= self.depth[1];
        let hit = in_box && (odd || self.on_edge(ray, point, slack));
        hit.then_some(t)
    }

    /// Whether a point of the plane lies on an edge but for rounding. Not inlined: tests that fail seldom get this far.
    #[inline(never)]
    fn on_edge(&self, ray: &Ray<S>, point: Vec3<S>, slack: S) -> bool {
        let near = Near::new(ray, point, self.plane.project(point), slack);
        edges_of(&self.corners).any(|edge| near.meets(edge))
    }

    #[inline(always)]
    fn range(&self, i: usize, slack: S) -> Range<S> {
        let [a, b, c] = self.corners;
        let (low, high) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        Range(low - slack, high + slack)
    }

    /// The box that all hits lie in.
    pub(super) fn bounds(&self, slack: S) -> Aabb<S> {
        let (u, v) = self.plane.axis.others();
        let mut bounds = Aabb::default();
        for (axis, i) in [(u, 0), (v, 1)] {
            let Range(low, high) = self.range(i, slack);
            bounds.low[axis] = low;
            bounds.high[axis] = high;
        }
        bounds.low[self.plane.axis] = self.depth[0];
        bounds.high[self.plane.axis] = self.depth[1];
        bounds
    }
}

struct Range<S>(S, S);

impl<S: Scalar> Range<S> {
    #[inline(always)]
    fn contains(&self, x: S) -> bool {
        self.0 <= x && x <= self.1
    }
}
