//! Whitted's recursion, unrolled onto a bounded stack.

use crate::accel::{Accelerator, Hit};
use crate::features::{self, ALL_FEATURES, FeatureSet};
use crate::object::ObjectRef;
use crate::observe::{Observer, RayKind};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::{Attributes, Scene, Surface};
use crate::shade::{self, Point};
use crate::vec3::Vec3;

/// A ray that waits to be traced.
#[derive(Clone, Copy, Debug)]
pub struct QueuedRay<S> {
    ray: Ray<S>,
    /// The share of its light that reaches the picture.
    weight: S,
    depth: u32,
    kind: RayKind,
}

impl<S: Scalar> QueuedRay<S> {
    /// Fills an unused place.
    pub const EMPTY: Self = Self {
        ray: Ray {
            origin: Vec3::ZERO,
            direction: Vec3::ZERO,
        },
        weight: S::ZERO,
        depth: 0,
        kind: RayKind::Primary,
    };
}

/// The memory one thread traces with, lent and kept from ray to ray.
#[derive(Debug)]
pub struct Workspace<'a, S, K> {
    /// Room for the rays that wait: one more than the deepest bounce.
    pub rays: &'a mut [QueuedRay<S>],
    /// Room for the tree's walk, [`Accelerator::Stack`].
    pub stack: &'a mut K,
    /// What blocked each light last; may be shorter than the list of lights.
    pub shadow_cache: &'a mut [Option<ObjectRef>],
}

impl<S, K> Workspace<'_, S, K> {
    /// Forgets what blocked the lights, so that what is counted does not depend on the past.
    pub fn clear_shadow_cache(&mut self) {
        self.shadow_cache.fill(None);
    }
}

/// What is traced, and how far.
#[derive(Clone, Copy, Debug)]
pub struct Tracer<'a, S: Scalar, A, const FEATURES: FeatureSet = ALL_FEATURES> {
    /// The scene.
    pub scene: &'a Scene<'a, S, FEATURES>,
    /// What finds its objects.
    pub accelerator: &'a A,
    /// The most bounces; what the workspace has no room for is not traced either.
    pub max_depth: u32,
    /// Rays of less weight are not traced.
    pub cut_off: S,
}

impl<S: Scalar, A: Accelerator<S, FEATURES>, const FEATURES: FeatureSet>
    Tracer<'_, S, A, FEATURES>
{
    /// The light that comes along a ray of the camera, not clamped (fixed point: at most 1).
    pub fn radiance<O: Observer>(
        &self,
        ray: Ray<S>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        observer: &mut O,
    ) -> Vec3<S> {
        let mut sum = Vec3::ZERO;
        let mut waiting = 0;
        let mut next = QueuedRay {
            ray,
            weight: S::ONE,
            depth: 0,
            kind: RayKind::Primary,
        };
        if next.weight < self.cut_off {
            return sum;
        }
        loop {
            observer.ray(next.kind);
            let light = match self.nearest(&next.ray, workspace, observer) {
                None => self.scene.background,
                Some(hit) => {
                    observer.hit(next.kind);
                    self.shade_hit(&next, hit, workspace, &mut waiting, observer)
                }
            };
            // The weight of a camera's ray is 1.
            let light = if next.depth == 0 {
                light
            } else {
                light * next.weight
            };
            sum.x = sum.x.accumulate(light.x);
            sum.y = sum.y.accumulate(light.y);
            sum.z = sum.z.accumulate(light.z);
            if waiting == 0 {
                return sum;
            }
            waiting -= 1;
            match workspace.rays.get(waiting) {
                Some(pending) => next = *pending,
                None => return sum,
            }
        }
    }

    /// The object that a ray of the camera meets first.
    pub fn nearest<O: Observer>(
        &self,
        ray: &Ray<S>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        self.accelerator
            .nearest(self.scene, ray, workspace.stack, observer)
    }

    /// The light of the surface itself, less what a transparent one lets through. The reflected
    /// and the transmitted ray are put on the stack.
    #[inline(always)]
    fn shade_hit<O: Observer>(
        &self,
        from: &QueuedRay<S>,
        hit: Hit<S>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        waiting: &mut usize,
        observer: &mut O,
    ) -> Vec3<S> {
        let scene = self.scene;
        let incoming = from.ray.direction;
        let contact = scene.shapes.contact(hit.object, &from.ray, hit.t);
        let attributes = scene.attributes_of(hit.object);
        let Some(surface) = scene.surfaces.get(attributes.surface as usize) else {
            return Vec3::ZERO;
        };
        let mut normal = contact.outward;
        if features::contains(FEATURES, features::PATCHES)
            && attributes.patch != Attributes::FLAT
            && let Some(n) = scene
                .shapes
                .patch_normal(hit.object, attributes.patch, contact.point)
        {
            normal = n;
        }
        let mut n_dot_i = normal.dot(incoming);
        let flipped = n_dot_i > S::ZERO;
        if flipped {
            (normal, n_dot_i) = (-normal, -n_dot_i);
        }
        let reflects =
            features::contains(FEATURES, features::REFLECTION) && surface.reflect > S::ZERO;
        let shines =
            features::contains(FEATURES, features::SPECULAR) && surface.specular != Vec3::ZERO;
        let refracts =
            features::contains(FEATURES, features::REFRACTION) && surface.refract > S::ZERO;
        let mut mirror = Vec3::ZERO;
        if reflects || shines {
            mirror = incoming - normal * (n_dot_i + n_dot_i);
        }
        if reflects {
            mirror = mirror.unit().0;
        }
        let error = S::surface_error(contact.point.size(), contact.curvature_extent);
        let point = Point {
            contact,
            normal,
            flipped,
            smooth: attributes.patch != Attributes::FLAT,
            mirror,
            is_unit: reflects,
            error,
            offset: contact.outward * error,
        };
        let light = shade::direct_light(
            scene,
            self.accelerator,
            surface,
            point,
            workspace.stack,
            workspace.shadow_cache,
            observer,
        );
        let mut follow = |share: S, direction: Option<Vec3<S>>, kind: RayKind| {
            if share == S::ZERO || from.depth >= self.max_depth {
                return;
            }
            let weight = from.weight * share;
            if weight < self.cut_off {
                return;
            }
            if let (Some(direction), Some(place)) = (direction, workspace.rays.get_mut(*waiting)) {
                *place = QueuedRay {
                    ray: point.ray::<FEATURES>(direction, kind == RayKind::Reflected),
                    weight,
                    depth: from.depth + 1,
                    kind,
                };
                *waiting += 1;
                observer.queued(*waiting);
            }
        };
        if refracts {
            let leaves = contact.closed && contact.outward.dot(incoming) > S::ZERO;
            let through = refract(surface, incoming, normal, -n_dot_i, leaves);
            follow(surface.refract, through, RayKind::Transmitted);
        }
        if reflects {
            follow(surface.reflect, Some(point.mirror), RayKind::Reflected);
        }
        if refracts {
            light * (S::ONE - surface.refract)
        } else {
            light
        }
    }
}

/// The direction behind the surface by Snell's law, none at total internal reflection. Thesis
/// (1.0a–d) divide by the cosine of the incoming ray; this form does not.
#[inline(always)]
fn refract<S: Scalar>(
    surface: &Surface<S>,
    incoming: Vec3<S>,
    normal: Vec3<S>,
    cosine: S,
    leaves: bool,
) -> Option<Vec3<S>> {
    let ratio = if leaves {
        surface.leaving
    } else {
        surface.entering
    };
    let sine = S::ONE - cosine * cosine;
    let square = S::ONE - ratio * (ratio * sine);
    if square < S::ZERO {
        return None;
    }
    let along = ratio * cosine - square.sqrt();
    Some((incoming * ratio + normal * along).unit().0)
}
