//! The truncated cone, the cylinder included: its side surface, without caps.

use super::contact::Contact;
use crate::observe::Observer;
use crate::ray::{Aabb, Ray};
use crate::scalar::Tolerance;
use crate::vec3::Vec3;

/// The side of a truncated cone.
///
/// Lengths marked *local* are scaled by [`to_local`](crate::scalar::Scalar::to_local) with `exponent`, which brings the
/// radius of the bounding sphere to [½, 1) in fixed point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Cone<S> {
    /// The middle of the axis.
    pub centre: Vec3<S>,
    /// The unit vector from the base to the top.
    pub axis: Vec3<S>,
    /// Half the axis's length, local.
    pub half_length: S,
    /// The radius in the middle, local.
    pub mid_radius: S,
    /// The sine of the angle between axis and side, positive if the cone widens to the top.
    pub sin: S,
    /// The cosine of that angle, > 0 (1 for a cylinder).
    pub cos: S,
    /// The radius of the bounding sphere around `centre`, with slack.
    pub bounding_radius: S,
    /// The scale of the local lengths.
    pub exponent: i8,
    /// The box that all hits lie in.
    pub bounds: Aabb<S>,
}

impl<S: Tolerance> Cone<S> {
    /// The quadratic is set up at the ray's closest approach to the cone, in the cone's own scale:
    /// from a distant origin it would cancel.
    #[inline(always)]
    pub(super) fn hit<O: Observer>(&self, ray: &Ray<S>, limit: S, observer: &mut O) -> Option<S> {
        let d = ray.direction;
        let to_centre = self.centre - ray.origin;
        let middle = to_centre.dot(d);
        let apart = d * middle - to_centre;
        if apart.square_wide() > self.bounding_radius.square() {
            return None;
        }
        observer.side();
        let w = apart.map(|c| c.to_local(self.exponent));

        let rise = d.dot(self.axis);
        let height = w.dot(self.axis);
        let (first, second) = if S::EXACT_ROOTS {
            self.roots(w, d, height, rise)?
        } else {
            self.roots_by_coefficients(w, d, height, rise)?
        };
        let (first, second) = match (first, second) {
            (Some(x), Some(y)) if y < x => (second, first),
            _ => (first, second),
        };
        for t in [first, second].into_iter().flatten() {
            let h = height + rise * t;
            let t = middle + t.to_global(self.exponent);
            if h.abs() <= self.half_length
                && t > S::ZERO
                && t <= limit
                && self.bounds.contains(ray.at(t))
            {
                return Some(t);
            }
        }
        None
    }

    /// Where the ray at `w` + t `d`, of local `height` and `rise` along the axis, may meet the side,
    /// if it meets the double cone: where cos · (distance from the axis) is
    /// cos · mid_radius + sin · height.
    ///
    /// The discriminant is a difference of squares about as small as the radius (Lagrange's
    /// identity): those of the coefficients are lost in coarse formats, and in thin cones.
    #[inline(always)]
    fn roots(&self, w: Vec3<S>, d: Vec3<S>, height: S, rise: S) -> Option<(Option<S>, Option<S>)> {
        let mid_edge = self.cos * self.mid_radius;
        let edge = mid_edge + self.sin * height;
        let steep = self.sin * rise;
        let turn = d * edge - w * steep - self.axis * (rise * mid_edge);
        let past = self.cos * d.cross(w).dot(self.axis);
        let discriminant = turn.square_wide() - past.square();
        if discriminant < S::product(S::ZERO, S::ZERO) {
            return None;
        }
        let root = self.cos * S::sqrt_wide(discriminant);
        let cos_square = self.cos * self.cos;
        let a = (self.cos - rise) * (self.cos + rise);
        let along = S::narrow(d.dot_wide(w) - S::product(rise, height));
        let b = S::narrow(S::product(cos_square, along) - S::product(steep, edge));
        let (q, rest) = if b < S::ZERO {
            (root - b, -b - root)
        } else {
            (-b - root, root - b)
        };
        // The smaller root is divided by what is larger: along the side a vanishes, and in a thin
        // cone q.
        let second = if a.abs() < q.abs() {
            let apart = S::narrow(w.dot_wide(w) - S::product(height, height));
            let c = S::product(cos_square, apart) - S::product(edge, edge);
            self.root(S::narrow(c), q)
        } else {
            self.root(rest, a)
        };
        Some((self.root(q, a), second))
    }

    /// The same from the quadratic's coefficients, its smaller root as c/q. The identity holds for
    /// unit vectors only, and where roots are approximate there are none.
    #[inline(always)]
    fn roots_by_coefficients(
        &self,
        w: Vec3<S>,
        d: Vec3<S>,
        height: S,
        rise: S,
    ) -> Option<(Option<S>, Option<S>)> {
        let radial = w - self.axis * height;
        let edge = self.cos * self.mid_radius + self.sin * height;
        let cos_square = self.cos * self.cos;
        let a = (self.cos - rise) * (self.cos + rise);
        let b =
            S::narrow(S::product(cos_square, d.dot(radial)) - S::product(self.sin * rise, edge));
        let c = S::narrow(S::product(cos_square, radial.dot(radial)) - S::product(edge, edge));
        let discriminant = S::product(b, b) - S::product(a, c);
        if discriminant < S::product(S::ZERO, S::ZERO) {
            return None;
        }
        let root = S::sqrt_wide(discriminant);
        let q = if b < S::ZERO { root - b } else { -b - root };
        Some((self.root(q, a), self.root(c, q)))
    }

    /// The quotient, if it can be within the bounding sphere's diameter: every hit lies there, at
    /// |t| ≤ 1 in local scale for fixed point, so compare before dividing.
    #[inline(always)]
    fn root(&self, numerator: S, denominator: S) -> Option<S> {
        let diameter = self.bounding_radius.to_local(self.exponent)
            + self.bounding_radius.to_local(self.exponent);
        let within = S::product(numerator.abs(), S::ONE) <= S::product(denominator.abs(), diameter);
        (within && denominator != S::ZERO).then(|| numerator.quotient(denominator))
    }

    /// The point goes back onto the side along the normal.
    #[inline(always)]
    pub(super) fn contact(&self, point: Vec3<S>) -> Contact<S> {
        let w = (point - self.centre).map(|c| c.to_local(self.exponent));
        let height = w.dot(self.axis);
        let (radial, distance) = (w - self.axis * height).unit();
        let outward = radial * self.cos - self.axis * self.sin;
        let above = self.cos * (distance - self.mid_radius) - self.sin * height;
        Contact {
            point: point - outward * above.to_global(self.exponent),
            outward,
            curvature_extent: self.bounding_radius,
            closed: true,
        }
    }
}
