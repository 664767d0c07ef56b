//! Planar polygons: the triangle, the polygon of any number of vertices, and the normals of
//! patches.

use super::Contact;
use crate::observe::Observer;
use crate::ray::{Aabb, Ray};
use crate::scalar::Scalar;
use crate::vec3::{Axis, Vec3};

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

impl<S: Scalar> Plane<S> {
    /// Thesis (2.4), with the plane's offset that it lacks. Along a nearly parallel ray the quotient
    /// has no bound: it saturates, which is beyond every limit.
    #[inline(always)]
    fn hit(&self, ray: &Ray<S>, limit: S) -> Option<S> {
        let above = S::narrow(S::product(self.offset, S::ONE) - self.normal.dot_wide(ray.origin));
        let rise = self.normal.dot(ray.direction);
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

    /// The point's two coordinates besides the projection axis.
    #[inline(always)]
    pub(super) fn project(&self, p: Vec3<S>) -> [S; 2] {
        let (u, v) = self.axis.others();
        [p[u], p[v]]
    }

    /// The point goes back onto the plane.
    #[inline(always)]
    pub(super) fn contact(&self, point: Vec3<S>) -> Contact<S> {
        let above = S::narrow(self.normal.dot_wide(point) - S::product(self.offset, S::ONE));
        Contact {
            point: point - self.normal * above,
            outward: self.normal,
            curvature_extent: S::ZERO,
            closed: false,
        }
    }
}

/// Whether a point's horizontal line to the right crosses the edge from `a` to `b`. The edge owns
/// its lower end and not its upper one, and is always looked at from its lower end, so that two
/// polygons that share it agree.
#[inline(always)]
fn crosses<S: Scalar>(a: [S; 2], b: [S; 2], p: [S; 2]) -> bool {
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

impl<S: Scalar> Triangle<S> {
    #[inline(always)]
    pub(super) fn hit(&self, ray: &Ray<S>, limit: S) -> Option<S> {
        let t = self.plane.hit(ray, limit)?;
        let point = ray.at(t);
        let p = self.plane.project(point);
        let [a, b, c] = self.corners;
        if !(crosses(a, b, p) ^ crosses(b, c, p) ^ crosses(c, a, p)) {
            return None;
        }
        // Rounding must not let the parity be odd outside the triangle's own box.
        let depth = point[self.plane.axis];
        let inside = self.range(0).contains(p[0])
            && self.range(1).contains(p[1])
            && self.depth[0] <= depth
            && depth <= self.depth[1];
        inside.then_some(t)
    }

    #[inline(always)]
    fn range(&self, i: usize) -> Range<S> {
        let [a, b, c] = self.corners;
        Range(a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]))
    }

    /// The box that all hits lie in.
    pub(super) fn bounds(&self) -> Aabb<S> {
        let (u, v) = self.plane.axis.others();
        let mut bounds = Aabb::default();
        for (axis, Range(low, high)) in [(u, self.range(0)), (v, self.range(1))] {
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

/// A polygon of any number of vertices, convex or not.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Polygon<S: Scalar> {
    /// Its plane.
    pub plane: Plane<S>,
    /// Its first vertex in [`Outlines::corners`].
    pub first: u32,
    /// How many vertices it has.
    pub count: u32,
    /// The box that all hits lie in.
    pub bounds: Aabb<S>,
    /// Which of its edges can matter at a given height.
    pub bands: Bands<S>,
}

/// A polygon's extent along the second projected axis, cut into equal bands, each with the edges
/// that pass through it: a point is tested against a few edges even if there are hundreds.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Bands<S: Scalar> {
    /// The first band's place in [`Outlines::bands`].
    pub first: u32,
    /// How many bands there are; none for a polygon of few edges, which is tested edge by edge.
    pub count: u32,
    /// Where the lowest band begins.
    pub low: S,
    /// The reciprocal of the height of all bands together.
    pub scale: S::Reciprocal,
}

impl<S: Scalar> Bands<S> {
    /// The band that holds height `v`; a higher point is never in a lower band.
    #[inline(always)]
    pub fn of(&self, v: S) -> u32 {
        let share = (v - self.low).times_reciprocal(self.scale);
        let last = self.count.saturating_sub(1);
        share
            .max(S::ZERO)
            .min(S::ONE)
            .scale_to_index(self.count)
            .min(last)
    }
}

/// The outlines of polygons.
#[derive(Clone, Copy, Debug)]
pub struct Outlines<'a, S> {
    /// The vertices of all polygons, each projected along its polygon's axis.
    pub corners: &'a [[S; 2]],
    /// Where each band's edges begin in `edges`, and after a polygon's last band where they end.
    pub bands: &'a [u32],
    /// Edges, band by band, lower end first; level ones are left out.
    pub edges: &'a [[[S; 2]; 2]],
}

impl<S: Scalar> Polygon<S> {
    #[inline(always)]
    pub(super) fn hit<O: Observer>(
        &self,
        ray: &Ray<S>,
        limit: S,
        outlines: &Outlines<'_, S>,
        observer: &mut O,
    ) -> Option<S> {
        let t = self.plane.hit(ray, limit)?;
        let point = ray.at(t);
        if !self.bounds.contains(point) {
            return None;
        }
        let p = self.plane.project(point);
        let inside = if self.bands.count == 0 {
            let corners = self.corners(outlines.corners)?;
            observer.edges(corners.len());
            encloses(corners, p)
        } else {
            let band = (self.bands.first + self.bands.of(p[1])) as usize;
            let (start, end) = (outlines.bands.get(band)?, outlines.bands.get(band + 1)?);
            let edges = outlines.edges.get(*start as usize..*end as usize)?;
            observer.edges(edges.len());
            edges
                .iter()
                .fold(false, |odd, edge| odd ^ crosses_upward(*edge, p))
        };
        inside.then_some(t)
    }

    /// Its vertices, projected.
    #[inline(always)]
    pub(crate) fn corners<'a>(&self, corners: &'a [[S; 2]]) -> Option<&'a [[S; 2]]> {
        corners
            .get(self.first as usize..)?
            .get(..self.count as usize)
    }
}

/// How the normal varies over a patch: interpolated over the triangles that the first vertex
/// forms with each edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Patch<S> {
    /// The normal of the first vertex in [`super::Shapes::normals`]; one for each vertex.
    pub first_normal: u32,
    /// The scale, for [`Scalar::to_local`], that brings the patch's projected extent to [½, 1).
    pub exponent: i8,
    /// The area that counts as nothing, in that scale.
    pub least_area: S,
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
        let local = |a: [S; 2], b: [S; 2]| [0, 1].map(|i| (a[i] - b[i]).to_local(self.exponent));
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
