//! The plane that a polygon lies in.

use super::contact::Contact;
use crate::ray::Ray;
use crate::scalar::Tolerance;
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
