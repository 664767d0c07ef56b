//! The two ends of a ray: the surface that it leaves, and those that hold the light it goes to.
//!
//! At either end a ray meets a surface where it should not count, at a t that rounding moves to either side of 0 or of
//! the light. No distance along the ray tells such a hit from one that counts: the error in t is the error across the
//! surface divided by the cosine between them. So it is told by which of the surface's hits it is.

use super::shapes::Shapes;
use crate::features::FeatureSet;
use crate::object::{ObjectKind, ObjectRef};
use crate::ray::Ray;
use crate::scalar::Tolerance;
use crate::scene::Light;

impl<S: Tolerance, const FEATURES: FeatureSet> Shapes<'_, S, FEATURES> {
    /// Where a ray that leaves the object meets it once more, at 0 < t ≤ `limit`.
    #[inline(always)]
    pub(super) fn hit_again(&self, object: ObjectRef, ray: &Ray<S>, limit: S) -> Option<S> {
        if ray.from.is_inward() {
            self.hit_from_inside(object, ray, limit)
        } else {
            None
        }
    }

    /// The same for a ray that goes inward. Not in the code of the walks: few rays do.
    #[cold]
    #[inline(never)]
    fn hit_from_inside(&self, object: ObjectRef, ray: &Ray<S>, limit: S) -> Option<S> {
        let i = object.index();
        match object.kind() {
            ObjectKind::Sphere => self.sphere(i)?.hit_again(ray, limit, self.slack),
            ObjectKind::Cone => self.cone(i)?.hit_again(ray, limit),
            ObjectKind::Cuboid => self.cuboid(i)?.hit_again(ray, limit, self.slack),
            ObjectKind::Triangle | ObjectKind::Polygon => None,
        }
    }

    /// Whether a hit at `t` ≤ `limit` is where a ray arrives at its light, which the object holds: it blocks nothing.
    #[inline(always)]
    pub(super) fn is_arrival(
        &self,
        object: ObjectRef,
        ray: &Ray<S>,
        t: S,
        limit: S,
        light: Option<&Light<S>>,
    ) -> bool {
        // In the nearer half even the light's own surface is met only by a ray in that surface, to within rounding.
        light.is_some_and(|light| t > limit - t && self.holds(object, ray, limit - t, light))
    }

    /// Whether the object holds the light, to within [`Shapes::slack`], and the hit of the ray to it that is `short`
    /// of the light is where the ray arrives there.
    ///
    /// The slack is more than the error of any computed hit across its surface. So a surface that is farther from the
    /// light is met on the right side of it, and one that is nearer cannot be told from one that holds it.
    #[cold]
    #[inline(never)]
    fn holds(&self, object: ObjectRef, ray: &Ray<S>, short: S, light: &Light<S>) -> bool {
        let (i, place) = (object.index(), light.position);
        let slack = S::slack_near(place.size().max(ray.origin.size()), self.slack);
        let held = match object.kind() {
            ObjectKind::Sphere => self.sphere(i).map(|s| s.ends(ray, place, short, slack)),
            ObjectKind::Triangle => self.triangle(i).map(|p| p.plane.holds(place, slack)),
            ObjectKind::Polygon => self.polygon(i).map(|p| p.plane.holds(place, slack)),
            ObjectKind::Cone => self.cone(i).map(|c| c.ends(ray, place, short, slack)),
            ObjectKind::Cuboid => self.cuboid(i).map(|c| c.ends(ray, place, slack)),
        };
        held == Some(true)
    }
}
