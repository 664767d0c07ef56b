//! Whether a point is inside a polygon: even–odd over its edges, and the edges themselves.
//!
//! Two polygons that share an edge are seldom projected along the same axis, so what is left of the edge for one
//! may be left of it for the other. What lies on an edge to within rounding therefore belongs to both.

use super::plane::Plane;
use crate::ray::Ray;
use crate::scalar::{Scalar, Tolerance};

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
fn crosses_upward<S: Scalar>([low, high]: [[S; 2]; 2], p: [S; 2]) -> bool {
    low[1] <= p[1]
        && p[1] < high[1]
        && S::product(p[0] - low[0], high[1] - low[1]) < S::product(high[0] - low[0], p[1] - low[1])
}

/// Where a ray meets a plane, projected, with the room around it in which an edge counts as met: a short piece of the
/// ray, as what the plane is off by moves the point along the ray, and a margin on all sides.
#[derive(Clone, Copy)]
struct Near<S> {
    point: [S; 2],
    /// From the middle of the piece to its end.
    half: [S; 2],
    low: [S; 2],
    high: [S; 2],
    margin: S,
}

impl<S: Tolerance> Near<S> {
    #[inline(always)]
    fn new(point: [S; 2], half: [S; 2], margin: S) -> Self {
        let room = half.map(|x| x.abs() + margin);
        Self {
            point,
            half,
            low: [point[0] - room[0], point[1] - room[1]],
            high: [point[0] + room[0], point[1] + room[1]],
            margin,
        }
    }

    /// Whether the edge from `a` to `b` comes near.
    #[inline(always)]
    fn meets(&self, [a, b]: [[S; 2]; 2]) -> bool {
        let below = |i: usize| a[i] < self.low[i] && b[i] < self.low[i];
        let above = |i: usize| self.high[i] < a[i] && self.high[i] < b[i];
        if below(0) || above(0) || below(1) || above(1) {
            return false;
        }
        let edge = [b[0] - a[0], b[1] - a[1]];
        let area = |p: [S; 2]| S::product(p[0], edge[1]) - S::product(p[1], edge[0]);
        let rest = area([self.point[0] - a[0], self.point[1] - a[1]]);
        let half = area(self.half);
        let room = S::product(self.margin, edge[0].abs() + edge[1].abs());
        // |rest| ≤ |half| + room.
        let none = S::product(S::ZERO, S::ZERO);
        let half = if half < none { none - half } else { half };
        rest <= half + room && none - rest <= half + room
    }
}

/// Whether a ray that meets a plane at `t` meets one of these edges there, but for rounding.
///
/// Not inlined, and with as few operands as can be: few rays come here, and the walks keep more in registers. At first
/// all edges are looked at with the scene's slack, which seldom leaves one.
#[inline(never)]
pub(super) fn meets_edge<S: Tolerance>(
    plane: &Plane<S>,
    outline: Outline<'_, S>,
    ray: &Ray<S>,
    t: S,
    slack: S,
) -> bool {
    let hit = ray.at(t);
    let point = plane.project(hit);
    if !outline.meets(&Near::new(point, [S::ZERO; 2], slack)) {
        return false;
    }
    let point = if S::EXACT_ROOTS {
        point
    } else {
        plane.project(ray.at(plane.rounded_distance(ray)))
    };
    let reach = ray.origin.size().max(hit.size());
    // What is beside the plane is met before or after it. An edge that is farther off than the slack is not met,
    // whatever the angle.
    let along = S::plane_error(reach)
        .quotient(plane.rise(ray).abs())
        .min(slack);
    let half = plane.project(ray.direction).map(|x| x * along);
    let near = Near::new(point, half, S::coordinate_error(reach));
    outline.meets(&near) || !S::EXACT_ROOTS && outline.encloses(point)
}

/// The edges of a polygon: all of them by its corners, or those of a band.
#[derive(Clone, Copy)]
pub(super) enum Outline<'a, S> {
    Corners(&'a [[S; 2]]),
    Band(&'a [[[S; 2]; 2]]),
}

impl<S: Tolerance> Outline<'_, S> {
    /// How many edges there are.
    #[inline(always)]
    pub(super) const fn len(&self) -> usize {
        match self {
            Self::Corners(corners) => corners.len(),
            Self::Band(edges) => edges.len(),
        }
    }

    /// Whether a point is inside: even–odd.
    #[inline(always)]
    pub(super) fn encloses(&self, p: [S; 2]) -> bool {
        match *self {
            Self::Corners(corners) => encloses(corners, p),
            Self::Band(edges) => {
                (edges.iter()).fold(false, |inside, &edge| inside ^ crosses_upward(edge, p))
            }
        }
    }

    #[inline(never)]
    fn meets(&self, near: &Near<S>) -> bool {
        match *self {
            Self::Corners(corners) => edges_of(corners).any(|edge| near.meets(edge)),
            Self::Band(edges) => edges.iter().any(|&edge| near.meets(edge)),
        }
    }
}

/// The edges between the corners of an outline.
#[inline(always)]
fn edges_of<S: Copy>(corners: &[[S; 2]]) -> impl Iterator<Item = [[S; 2]; 2]> {
    let mut a = corners.last().copied();
    corners
        .iter()
        .filter_map(move |&b| a.replace(b).map(|a| [a, b]))
}

/// Whether a projected point is inside a polygon: even–odd over its edges.
#[inline(always)]
pub(crate) fn encloses<S: Scalar>(corners: &[[S; 2]], p: [S; 2]) -> bool {
    edges_of(corners).fold(false, |inside, [a, b]| inside ^ crosses(a, b, p))
}
