//! Whether a point is inside a polygon: even–odd over its edges, and the edges themselves.
//!
//! Two polygons that share an edge are seldom projected along the same axis, so what is left of the edge for one
//! may be left of it for the other. What lies on an edge to within rounding therefore belongs to both.

use crate::ray::Ray;
use crate::scalar::{Scalar, Tolerance};
use crate::vec3::Vec3;

/// Whether a point's horizontal line to the right crosses the edge from `a` to `b`. The edge owns
/// its lower end and not its upper one, and is always looked at from its lower end, so that two
/// polygons that share it agree.
#[inline(always)]
pub(super) fn crosses<S: Scalar>(a: [S; 2], b: [S; 2], p: [S; 2]) -> bool {
    let upward = a[1] <= p[1];
    if upward == (b[1] <= p[1]) {
        return false;
    }
    let (low, high) = if upward { (a, b) } else { (b, a) };
    S::product(p[0] - low[0], high[1] - low[1]) < S::product(high[0] - low[0], p[1] - low[1])
}

/// The same for an edge whose lower end is known.
#[inline(always)]
pub(super) fn crosses_upward<S: Scalar>([low, high]: [[S; 2]; 2], p: [S; 2]) -> bool {
    low[1] <= p[1]
        && p[1] < high[1]
        && S::product(p[0] - low[0], high[1] - low[1]) < S::product(high[0] - low[0], p[1] - low[1])
}

/// A projected point with the room around it in which an edge counts as met.
#[derive(Clone, Copy)]
pub(super) struct Near<S> {
    point: [S; 2],
    low: [S; 2],
    high: [S; 2],
    slack: S,
}

impl<S: Tolerance> Near<S> {
    /// The room around `hit`, which is projected to `point`.
    #[inline(always)]
    pub(super) fn new(ray: &Ray<S>, hit: Vec3<S>, point: [S; 2], slack: S) -> Self {
        let slack = S::hit_error(ray.origin.size().max(hit.size()), slack);
        Self {
            point,
            low: [point[0] - slack, point[1] - slack],
            high: [point[0] + slack, point[1] + slack],
            slack,
        }
    }

    /// Whether the edge from `a` to `b` is no farther than about the slack: at most √2 times that.
    #[inline(always)]
    pub(super) fn meets(&self, [a, b]: [[S; 2]; 2]) -> bool {
        let beside = |i: usize| a[i].max(b[i]) < self.low[i] || self.high[i] < a[i].min(b[i]);
        if beside(0) || beside(1) {
            return false;
        }
        let [u, v] = [b[0] - a[0], b[1] - a[1]];
        let right = S::product(self.point[0] - a[0], v);
        let left = S::product(self.point[1] - a[1], u);
        let room = S::product(self.slack, u.abs() + v.abs());
        right <= left + room && left <= right + room
    }
}

/// Whether a projected point is inside a polygon: even–odd over its edges.
#[inline(always)]
pub(crate) fn encloses<S: Scalar>(corners: &[[S; 2]], p: [S; 2]) -> bool {
    let Some(&last) = corners.last() else {
        return false;
    };
    let mut inside = false;
    let mut a = last;
    for &b in corners {
        inside ^= crosses(a, b, p);
        a = b;
    }
    inside
}

/// The edges of an outline.
#[inline(always)]
pub(super) fn edges_of<S: Copy>(corners: &[[S; 2]]) -> impl Iterator<Item = [[S; 2]; 2]> {
    let mut a = corners.last().copied();
    corners
        .iter()
        .filter_map(move |&b| a.replace(b).map(|a| [a, b]))
}
