//! The light of a surface itself: ambient, diffuse and specular (thesis 3.2).

use crate::accel::Accelerator;
use crate::features::{self, FeatureSet};
use crate::object::ObjectRef;
use crate::observe::{RayKind, RayObserver};
use crate::ray::{Departure, Ray};
use crate::scalar::{Exponent, Intensity, Scalar, Tolerance};
use crate::scene::{Scene, Surface};
use crate::shape::Contact;
use crate::vec3::Vec3;

/// What shading needs to know of a surface point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<S> {
    pub(crate) object: ObjectRef,
    pub(crate) contact: Contact<S>,
    /// The shading normal, flipped to face the incoming ray.
    pub(crate) normal: Vec3<S>,
    /// Whether the surface's own normal faces the other way.
    pub(crate) flipped: bool,
    /// Whether the shading normal is not the surface's own.
    pub(crate) smooth: bool,
    /// The mirror direction; null where the surface has no use for it.
    pub(crate) mirror: Vec3<S>,
    /// Whether it is a unit vector. Where nothing is reflected, only visible lights need that.
    pub(crate) is_unit: bool,
    /// How far off the surface new rays start, along the surface's own normal; see
    /// [`Tolerance::surface_error`].
    pub(crate) offset: Vec3<S>,
}

impl<S: Scalar> Point<S> {
    /// A ray from here, back to where the incoming one came from or through the surface.
    #[inline(always)]
    pub(crate) fn ray<const FEATURES: FeatureSet>(&self, direction: Vec3<S>, back: bool) -> Ray<S> {
        let outward = self.leaves_outward::<FEATURES>(direction, back);
        Ray {
            direction,
            ..self.aimless_ray(outward)
        }
    }

    /// Whether a ray leaves the surface on its outer side, back to where the incoming one came from or through the
    /// surface.
    #[inline(always)]
    fn leaves_outward<const FEATURES: FeatureSet>(&self, direction: Vec3<S>, back: bool) -> bool {
        if features::contains(FEATURES, features::PATCHES) && self.smooth {
            self.contact.outward.dot_wide(direction) >= S::product(S::ZERO, S::ZERO)
        } else {
            back != self.flipped
        }
    }

    /// A ray that has no direction yet. It starts off the surface, on the side to which it leaves: there no other surface
    /// in the same place is in the way.
    #[inline(always)]
    fn aimless_ray(&self, outward: bool) -> Ray<S> {
        Ray {
            origin: if outward {
                self.contact.point + self.offset
            } else {
                self.contact.point - self.offset
            },
            direction: Vec3::ZERO,
            from: Departure::new(self.object, !outward),
        }
    }

    /// The cosine between the mirror direction and a unit vector; `None` where it is not positive.
    #[inline(always)]
    fn reflection_cosine(&mut self, to_light: Vec3<S>) -> Option<S> {
        if !self.is_unit {
            if self.mirror.dot(to_light) <= S::ZERO {
                return None;
            }
            self.mirror = self.mirror.unit().0;
            self.is_unit = true;
        }
        Some(self.mirror.dot(to_light)).filter(|cosine| *cosine > S::ZERO)
    }
}

/// The sum over all lights. `shadow_cache` holds for each light what blocked it last, unless nothing did: most of
/// the time the same object blocks it again, and one test finds that out (Haines and Greenberg, "The Light Buffer: A
/// Shadow-Testing Accelerator", 1986).
#[inline(always)]
pub(crate) fn direct_light<
    S: Tolerance + Intensity,
    A: Accelerator<S, FEATURES>,
    O: RayObserver<S>,
    const FEATURES: FeatureSet,
>(
    scene: &Scene<'_, S, FEATURES>,
    accelerator: &A,
    surface: &Surface<S>,
    mut point: Point<S>,
    stack: &mut A::Stack,
    shadow_cache: &mut [Option<ObjectRef>],
    observer: &mut O,
) -> Vec3<S> {
    let mut sum = surface.ambient;
    if !features::contains(FEATURES, features::SHADOWS) {
        return sum;
    }
    // Shadow rays are aimed from where they start: beside the line to the light they would end beside the light,
    // possibly behind a surface near it.
    let mut ray = point.aimless_ray(!point.flipped);
    for (i, light) in scene.lights.iter().enumerate() {
        if features::contains(FEATURES, features::PATCHES) && point.smooth {
            let to_light = light.from::<FEATURES>(point.contact.point);
            ray = point.aimless_ray(point.leaves_outward::<FEATURES>(to_light, true));
        }
        let to_light = light.from::<FEATURES>(ray.origin);
        // Most lights behind a surface are found without a square root.
        if point.normal.dot_wide(to_light) <= S::product(S::ZERO, S::ZERO) {
            continue;
        }
        let (to_light, distance) = to_light.unit();
        let facing = point.normal.dot(to_light);
        if facing <= S::ZERO {
            continue;
        }
        // All that can block a far light is before it.
        let (distance, end) = match light.far::<FEATURES>() {
            Some(_) => (scene.diameter, None),
            None => (distance, Some(light)),
        };
        observer.ray(RayKind::Shadow);
        ray.direction = to_light;
        let last = shadow_cache.get(i).copied().flatten();
        let still =
            last.filter(|&object| (scene.shapes).blocks(object, &ray, distance, end, observer));
        let blocker =
            still.or_else(|| accelerator.any_hit(scene, &ray, distance, end, stack, observer));
        observer.looked_for_light(i, blocker);
        match shadow_cache.get_mut(i) {
            Some(place) => *place = blocker,
            None if blocker.is_some() => {
                observer.uncached_light();
            }
            None => {}
        }
        if blocker.is_some() {
            observer.blocked();
            continue;
        }
        let mut share = surface.diffuse * facing;
        if features::contains(FEATURES, features::SPECULAR) && surface.specular != Vec3::ZERO {
            let exponent = if features::contains(FEATURES, features::FRACTIONS) {
                surface.shine
            } else {
                Exponent {
                    fraction: S::ZERO,
                    ..surface.shine
                }
            };
            if let Some(glance) = point.reflection_cosine(to_light) {
                share = share + surface.specular * glance.power(exponent);
            } else if exponent == Exponent::default() {
                // 0⁰ is 1.
                share = share + surface.specular;
            }
        }
        sum = sum + light.colour.times(share);
    }
    sum
}
