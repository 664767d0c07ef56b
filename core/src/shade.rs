//! The light that a surface sends back by itself: ambient, diffuse and specular (thesis 3.2).

use crate::observe::{Observer, RayKind};
use crate::octree::Accelerator;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::{Scene, Surface};
use crate::shape::{Contact, ObjectRef};
use crate::vec3::Vec3;

/// A surface point as light sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<S> {
    pub(crate) contact: Contact<S>,
    /// The shading normal, turned to face the incoming ray.
    pub(crate) normal: Vec3<S>,
    /// The mirror direction, a unit vector; null where the surface has no use for it.
    pub(crate) mirror: Vec3<S>,
    /// How far off the surface new rays start; see [`Scalar::surface_error`].
    pub(crate) error: S,
}

impl<S: Scalar> Point<S> {
    /// A ray from here. It starts off the surface, on the side to which it leaves: there it cannot
    /// meet the surface it comes from.
    #[inline(always)]
    pub(crate) fn ray(&self, direction: Vec3<S>) -> Ray<S> {
        let outward = self.contact.outward;
        let offset = if outward.dot(direction) < S::ZERO {
            -self.error
        } else {
            self.error
        };
        Ray {
            origin: self.contact.point + outward * offset,
            direction,
        }
    }
}

/// The sum over all lights. `blockers` remembers for each light what blocked it last: most of the
/// time the same object blocks it again, and one test finds that out.
#[inline(always)]
pub(crate) fn local<S: Scalar, A: Accelerator<S>, O: Observer>(
    scene: &Scene<'_, S>,
    accelerator: &A,
    surface: &Surface<S>,
    point: &Point<S>,
    stack: &mut A::Stack,
    blockers: &mut [Option<ObjectRef>],
    observer: &mut O,
) -> Vec3<S> {
    let mut sum = surface.ambient;
    for (i, light) in scene.lights.iter().enumerate() {
        let (to_light, distance) = (light.position - point.contact.point).unit();
        let facing = point.normal.dot(to_light);
        if facing <= S::ZERO {
            continue;
        }
        observer.ray(RayKind::Shadow);
        let ray = point.ray(to_light);
        // A surface at the light itself does not block it.
        let limit = distance - S::surface_error(light.position.size(), S::ZERO) - point.error;
        let last = blockers.get(i).copied().flatten();
        let still = last.filter(|&object| {
            observer.test();
            scene.shapes.blocks(object, &ray, limit)
        });
        let blocker = still.or_else(|| accelerator.any_hit(scene, &ray, limit, stack, observer));
        if blocker.is_some() {
            observer.blocked();
            if let Some(place) = blockers.get_mut(i) {
                *place = blocker;
            }
            continue;
        }
        let mut share = surface.diffuse * facing;
        if surface.specular != Vec3::ZERO {
            let glance = point.mirror.dot(to_light);
            let shine = glance.max(S::ZERO).power(surface.shine);
            share = share + surface.specular * shine;
        }
        sum = sum + light.colour.times(share);
    }
    sum
}
