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
    /// The cosine of that angle, > 0 (1 for a cylinder) unless it rounds to 0.
    pub cos: S,
    /// Half the difference of the radii, local, if the cone is flat; 0 if not. It is flat if they differ by more than
    /// [`Cone::FLAT`] times its height.
    pub half_widening: S,
    /// The radius of the bounding sphere around `centre`, with slack.
    pub bounding_radius: S,
    /// The scale of the local lengths.
    pub exponent: i8,
    /// The box that all hits lie in.
    pub bounds: Aabb<S>,
}

/// A ray near a cone: its closest approach to the centre, and from there on.
struct Crossing<S> {
    /// How far along the ray that is.
    middle: S,
    /// The vector there from the centre, local.
    w: Vec3<S>,
    /// The ray's direction.
    d: Vec3<S>,
    /// The height of `w` along the axis.
    height: S,
    /// What that grows by along the ray.
    rise: S,
    /// The ray's direction without that.
    across: Vec3<S>,
    /// The quadratic's first coefficient. Where it is not positive the ray is as steep as the side or steeper, and
    /// meets either half of the double cone once.
    a: S,
}

impl<S> Cone<S> {
    /// A cone is flat if its radii differ by more than this times its height.
    pub const FLAT: f64 = 8.0;
}

impl<S: Tolerance> Cone<S> {
    #[inline(always)]
    pub(super) fn hit<O: Observer>(&self, ray: &Ray<S>, limit: S, observer: &mut O) -> Option<S> {
        let crossing = self.cross(ray, observer)?;
        let [first, second] = self.in_order(&crossing)?;
        if self.is_met(&crossing) {
            return self.on_flat_side(&crossing, [first, second], ray, limit);
        }
        for t in [first, second].into_iter().flatten() {
            let found = self.on_side(&crossing, t, ray, limit);
            if found.is_some() {
                return found;
            }
        }
        None
    }

    /// Where a ray that starts on the side and goes inward meets it once more. A ray steeper than the side meets each
    /// half of the double cone once, and the side lies on one of them.
    #[inline(always)]
    pub(super) fn hit_again(&self, ray: &Ray<S>, limit: S) -> Option<S> {
        let crossing = self.cross(ray, &mut ())?;
        if crossing.a <= S::ZERO {
            return None;
        }
        let [first, second] = self.in_order(&crossing)?;
        self.on_side(&crossing, first.and(second)?, ray, limit)
    }

    /// The quadratic is set up at the ray's closest approach to the cone, in the cone's own scale:
    /// from a distant origin it would cancel.
    #[inline(always)]
    fn cross<O: Observer>(&self, ray: &Ray<S>, observer: &mut O) -> Option<Crossing<S>> {
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
        let across = d - self.axis * rise;
        let a = if S::EXACT_ROOTS {
            (self.cos - rise) * (self.cos + rise)
        } else {
            // Where roots are approximate, so is the direction's length.
            let (across, steep) = (across * self.cos, self.sin * rise);
            S::narrow(across.square_wide() - steep.square())
        };
        Some(Crossing {
            middle,
            w,
            d,
            across,
            height: w.dot(self.axis),
            rise,
            a,
        })
    }

    /// The roots, the lesser one first.
    #[inline(always)]
    fn in_order(&self, crossing: &Crossing<S>) -> Option<[Option<S>; 2]> {
        let (first, second) = if S::EXACT_ROOTS {
            self.roots(crossing)?
        } else {
            self.roots_by_coefficients(crossing)?
        };
        Some(match (first, second) {
            (Some(x), Some(y)) if y < x => [second, first],
            _ => [first, second],
        })
    }

    /// Whether the cone is flat and the ray steeper than its side: it meets both halves of the double cone, even if
    /// rounding says that it meets neither.
    #[inline(always)]
    fn is_met(&self, crossing: &Crossing<S>) -> bool {
        self.half_widening > S::ZERO && crossing.a <= S::ZERO
    }

    /// The distance along the ray of a root, if the ray is on the side there, within `limit`.
    #[inline(always)]
    fn on_side(&self, crossing: &Crossing<S>, t: S, ray: &Ray<S>, limit: S) -> Option<S> {
        let h = crossing.height + crossing.rise * t;
        let t = crossing.middle + t.to_global(self.exponent);
        (h.abs() <= self.half_length
            && t > S::ZERO
            && t <= limit
            && self.bounds.contains(ray.at(t)))
        .then_some(t)
    }

    /// The same on a flat cone, for a ray steeper than the side. The height says little there about the place on the
    /// side, and the halves of the double cone nearly touch; but along the ray the cone's radius grows from below 0 on
    /// one half to above 0 on the other, which is the one of the side, or the other way round.
    #[inline(always)]
    fn on_flat_side(
        &self,
        crossing: &Crossing<S>,
        [first, second]: [Option<S>; 2],
        ray: &Ray<S>,
        limit: S,
    ) -> Option<S> {
        let t = if (self.sin > S::ZERO) == (crossing.rise > S::ZERO) {
            second.or(first)?
        } else {
            first.or(second)?
        };
        let point = crossing.w + crossing.d * t;
        let from_axis = (point - self.axis * point.dot(self.axis)).square_wide();
        let (inner, outer) = (
            (self.mid_radius - self.half_widening).square(),
            (self.mid_radius + self.half_widening).square(),
        );
        let t = crossing.middle + t.to_global(self.exponent);
        (inner <= from_axis
            && from_axis <= outer
            && t > S::ZERO
            && t <= limit
            && self.bounds.contains(ray.at(t)))
        .then_some(t)
    }

    /// Whether the side, or the cone that it is cut from, holds the ray's end to within `slack`, and a hit `short` of
    /// it is where the ray arrives there: the ray comes from outside, or the hit is not beyond the middle of its
    /// chord. Along the ray from the end back, the cone's quadratic form is f − 2bs + as², with its other root at
    /// 2b/a.
    #[inline(always)]
    pub(super) fn ends(&self, ray: &Ray<S>, end: Vec3<S>, short: S, slack: S) -> bool {
        let from_centre = end - self.centre;
        let reach = self.bounding_radius + slack;
        if from_centre.square_wide() > reach.square() {
            return false;
        }
        let w = from_centre.map(|c| c.to_local(self.exponent));
        let [height, rise] = [w, ray.direction].map(|v| v.dot(self.axis));
        let radial = (w - self.axis * height) * self.cos;
        let edge = self.cos * self.mid_radius + self.sin * height;
        let slack = slack.to_local(self.exponent);
        let margin = S::product(slack, edge.abs() + edge.abs() + slack);
        let (square, edge_square) = (radial.square_wide(), edge.square());
        if square > edge_square + margin || square + margin < edge_square {
            return false;
        }
        // All that meets the tip meets it there.
        if edge <= slack + slack {
            return true;
        }
        let a = (self.cos - rise) * (self.cos + rise);
        let b = S::narrow(
            S::product(self.cos, radial.dot(ray.direction)) - S::product(self.sin * rise, edge),
        );
        b <= S::ZERO || a * short.to_local(self.exponent) <= b
    }

    /// Where the ray may meet the side, if it meets the double cone: where
    /// cos · (distance from the axis) is cos · mid_radius + sin · height.
    ///
    /// The discriminant is a difference of squares about as small as the radius (Lagrange's
    /// identity): those of the coefficients are lost in coarse formats, and in thin cones.
    #[inline(always)]
    fn roots(&self, crossing: &Crossing<S>) -> Option<(Option<S>, Option<S>)> {
        let &Crossing {
            w,
            d,
            height,
            rise,
            a,
            ..
        } = crossing;
        let mid_edge = self.cos * self.mid_radius;
        let edge = mid_edge + self.sin * height;
        let steep = self.sin * rise;
        let turn = d * edge - w * steep - self.axis * (rise * mid_edge);
        let past = self.cos * d.cross(w).dot(self.axis);
        let discriminant = turn.square_wide() - past.square();
        if discriminant < S::product(S::ZERO, S::ZERO) && !self.is_met(crossing) {
            return None;
        }
        let root = self.cos * S::sqrt_wide(discriminant);
        let cos_square = self.cos * self.cos;
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
    fn roots_by_coefficients(&self, crossing: &Crossing<S>) -> Option<(Option<S>, Option<S>)> {
        let &Crossing {
            w,
            height,
            rise,
            across,
            a,
            ..
        } = crossing;
        let radial = w - self.axis * height;
        let edge = self.cos * self.mid_radius + self.sin * height;
        let cos_square = self.cos * self.cos;
        let b = S::narrow(
            S::product(cos_square, across.dot(radial)) - S::product(self.sin * rise, edge),
        );
        let c = S::narrow(S::product(cos_square, radial.dot(radial)) - S::product(edge, edge));
        let discriminant = S::product(b, b) - S::product(a, c);
        if discriminant < S::product(S::ZERO, S::ZERO) && !self.is_met(crossing) {
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
