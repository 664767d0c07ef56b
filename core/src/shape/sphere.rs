//! The sphere.

use super::contact::Contact;
use crate::ray::{Aabb, Ray};
use crate::scalar::Tolerance;
use crate::vec3::{Vec3, vec3};

/// A sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Sphere<S> {
    /// Its centre.
    pub centre: Vec3<S>,
    /// Its radius, > 0.
    pub radius: S,
}

impl<S> Sphere<S> {
    /// The sphere of this radius, > 0, around a point.
    pub const fn new(centre: Vec3<S>, radius: S) -> Self {
        Self { centre, radius }
    }
}

impl<S: Tolerance> Sphere<S> {
    /// Thesis (2.8), with the discriminant taken from the vector between the centre and the ray's
    /// closest approach to it: b² − c cancels far from the sphere (Haines, Günther and
    /// Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", 2019).
    #[inline(always)]
    pub(super) fn hit(&self, ray: &Ray<S>, limit: S, slack: S) -> Option<S> {
        let to_centre = self.centre - ray.origin;
        let middle = to_centre.dot(ray.direction);
        let square = self.radius.square();
        // A ray that starts outside leaves most spheres that it starts from that way, without a root.
        let behind = || middle < S::ZERO && to_centre.square_wide() > square;
        // With soft floats this early exit is cheap next to the square root. With a floating-point
        // unit the branch mispredicts too often to pay.
        let early = cfg!(octray_soft_float);
        if early && behind() {
            return None;
        }
        let apart = to_centre - ray.direction * middle;
        let discriminant = square - apart.square_wide();
        if discriminant < S::product(S::ZERO, S::ZERO) || !early && behind() {
            return None;
        }
        let half_chord = S::sqrt_wide(discriminant);
        let near = middle - half_chord;
        let t = if near > S::ZERO {
            near
        } else {
            middle + half_chord
        };
        let half_extent = self.radius + slack;
        let in_box = || S::HITS_WITHIN_SLACK || (ray.at(t) - self.centre).size() <= half_extent;
        (t > S::ZERO && t <= limit && in_box()).then_some(t)
    }

    /// Where a ray that starts on the sphere and goes inward leaves it: as far behind its closest approach to the
    /// centre as it starts before it. Where roots are approximate, so is the direction's length, and that place.
    #[inline(always)]
    pub(super) fn hit_again(&self, ray: &Ray<S>, limit: S, slack: S) -> Option<S> {
        let to_centre = self.centre - ray.origin;
        let middle = to_centre.dot(ray.direction);
        let half_chord = if S::EXACT_ROOTS {
            middle
        } else {
            let apart = to_centre - ray.direction * middle;
            S::sqrt_wide(self.radius.square() - apart.square_wide())
        };
        let t = middle + half_chord;
        let half_extent = self.radius + slack;
        let in_box = || S::HITS_WITHIN_SLACK || (ray.at(t) - self.centre).size() <= half_extent;
        (t > S::ZERO && t <= limit && in_box()).then_some(t)
    }

    /// Whether the sphere holds the ray's end, to within `slack`, and a hit `short` of it is where the ray arrives
    /// there: the ray comes from outside, or the hit is not beyond the middle of its chord.
    #[inline(always)]
    pub(super) fn ends(&self, ray: &Ray<S>, end: Vec3<S>, short: S, slack: S) -> bool {
        let from_centre = end - self.centre;
        let (square, radius_square) = (from_centre.square_wide(), self.radius.square());
        let margin = S::product(slack, self.radius + self.radius + slack);
        let half_chord = from_centre.dot(ray.direction);
        radius_square - margin <= square
            && square <= radius_square + margin
            && (half_chord <= S::ZERO || short <= half_chord)
    }

    /// The box that all hits lie in.
    pub(super) fn bounds(&self, slack: S) -> Aabb<S> {
        let half_extent = self.radius + slack;
        let half_extent = vec3(half_extent, half_extent, half_extent);
        Aabb {
            low: self.centre - half_extent,
            high: self.centre + half_extent,
        }
    }

    /// The point goes back onto the sphere along the normal.
    #[inline(always)]
    pub(super) fn contact(&self, point: Vec3<S>) -> Contact<S> {
        let (outward, _) = (point - self.centre).unit();
        Contact {
            point: self.centre + outward * self.radius,
            outward,
            curvature_extent: self.radius,
            closed: true,
        }
    }
}
