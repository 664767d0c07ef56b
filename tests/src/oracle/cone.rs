//! The side of a cone, a frustum or a cylinder.

use super::shape::least_positive;
use super::vector::{Ray, V3};

/// The side of a cone: the points at distance `radius + slope · z` from the axis, for 0 ≤ z ≤
/// `height` above the base.
#[derive(Debug)]
pub(super) struct Cone {
    base: V3,
    /// Unit vector from the base to the top.
    axis: V3,
    height: f64,
    /// The radius at the base.
    radius: f64,
    /// Growth of the radius per unit of height.
    slope: f64,
}

impl Cone {
    pub(super) fn new(base: V3, base_radius: f64, top: V3, top_radius: f64) -> Self {
        let height = (top - base).length();
        let slope = (top_radius - base_radius) / height;
        Self {
            base,
            axis: (top - base).unit(),
            height,
            radius: base_radius,
            slope,
        }
    }

    /// Returns the least t > 0 at which a ray hits the side.
    ///
    /// Solves |p + t·q|² = (r + t·g)², where p and q are the parts of origin and direction perpendicular to the axis, r
    /// is the cone's radius at the origin's height and g its growth along the ray. Before that, the origin is moved to
    /// the ray's closest approach to the cone's middle, where the numbers are small.
    pub(super) fn hit(&self, ray: &Ray) -> Option<f64> {
        let middle = self.base + self.axis * (self.height / 2.0);
        let moved = (middle - ray.origin).dot(ray.direction);
        let origin = ray.at(moved) - self.base;
        let z = origin.dot(self.axis);
        let climb = ray.direction.dot(self.axis);
        let p = origin - self.axis * z;
        let q = ray.direction - self.axis * climb;
        let r = self.radius + self.slope * z;
        let g = self.slope * climb;

        let a = q.dot(q) - g * g;
        let half_b = p.dot(q) - r * g;
        let c = p.dot(p) - r * r;
        let discriminant = half_b * half_b - a * c;
        if discriminant < 0.0 {
            return None;
        }
        let w = -(half_b + discriminant.sqrt().copysign(half_b));
        let on_side = |t: f64| {
            let height = z + t * climb;
            if (0.0..=self.height).contains(&height) {
                moved + t
            } else {
                f64::NAN
            }
        };
        least_positive([on_side(w / a), on_side(c / w)])
    }

    /// Returns the outward normal at a point of the side.
    pub(super) fn normal(&self, point: V3) -> V3 {
        let from_base = point - self.base;
        let radial = from_base - self.axis * from_base.dot(self.axis);
        (radial.unit() - self.axis * self.slope).unit()
    }

    pub(super) fn bounding_sphere(&self) -> (V3, f64) {
        let half = self.height / 2.0;
        let widest = self.radius.max(self.radius + self.slope * self.height);
        (self.base + self.axis * half, half.hypot(widest))
    }
}
