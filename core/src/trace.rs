//! Whitted's recursion, unrolled onto a bounded stack.

mod workspace;

pub use workspace::{QueuedRay, Workspace, WorkspaceTooSmall, required_rays};

use crate::accel::{AccelScalar, Accelerator, Hit};
use crate::features::{self, ALL_FEATURES, FeatureSet};
use crate::object::ObjectRef;
use crate::observe::{Observer, RayKind, RayObserver};
use crate::ray::Ray;
use crate::scalar::{Intensity, Ratio, Scalar, Tolerance};
use crate::scene::{Attributes, Scene, Surface};
use crate::shade::{self, Point};
use crate::vec3::Vec3;

/// All that a rendering asks of a number format. Every type with the parts has it.
pub trait TraceScalar: Scalar + Tolerance + Ratio + Intensity + AccelScalar {}

impl<S: Scalar + Tolerance + Ratio + Intensity + AccelScalar> TraceScalar for S {}

/// What is traced, and how far.
///
/// ```
/// use octray_core::accel::BruteForce;
/// use octray_core::features;
/// use octray_core::object::{ObjectKind, ObjectRef};
/// use octray_core::ray::Ray;
/// use octray_core::scene::{Attributes, Scene, Surface};
/// use octray_core::shape::{Cuboid, Shapes};
/// use octray_core::trace::{QueuedRay, Tracer, required_rays};
/// use octray_core::vec3::vec3;
///
/// let cuboids = [Cuboid { low: vec3(-1.0, -1.0, -1.0), high: vec3(1.0, 1.0, 1.0) }];
/// let surfaces = [Surface { ambient: vec3(0.25, 0.0, 0.0), reflect: 0.5, ..Surface::default() }];
/// let attributes = [Attributes::new(0, 0)];
/// let background = vec3(0.0, 0.0, 1.0);
/// let scene: Scene<f64> = Scene::new(
///     Shapes { cuboids: &cuboids, ..Shapes::empty(1e-14) },
///     &attributes, &surfaces, &[], background, 32.0);
/// let tracer = Tracer {
///     scene: &scene,
///     accelerator: &BruteForce(&[ObjectRef::new(ObjectKind::Cuboid, 0)]),
///     max_depth: 8,
///     cut_off: 1.0 / 512.0,
/// };
///
/// const RAYS: usize = required_rays(8, features::ALL_FEATURES);
/// let (mut rays, mut stack) = ([QueuedRay::EMPTY; RAYS], ());
/// let mut workspace = tracer.workspace(&mut rays, &mut stack, &mut [])?;
/// let ray = Ray::new(vec3(0.0, 0.0, 8.0), vec3(0.0, 0.0, -1.0));
/// let colour = tracer.radiance(ray, &mut workspace, &mut ());
/// // The box itself, and half of the background in its mirror.
/// assert_eq!(colour, vec3(0.25, 0.0, 0.5));
/// # Ok::<(), octray_core::trace::WorkspaceTooSmall>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tracer<'a, S: Scalar, A, const FEATURES: FeatureSet = ALL_FEATURES> {
    /// The scene.
    pub scene: &'a Scene<'a, S, FEATURES>,
    /// What finds its objects.
    pub accelerator: &'a A,
    /// The most bounces of a ray.
    pub max_depth: u32,
    /// Reflected and transmitted rays of less weight, 0 to 1, are not traced: 1/512 is half an
    /// 8-bit level.
    pub cut_off: S,
}

impl<S: TraceScalar, A: Accelerator<S, FEATURES>, const FEATURES: FeatureSet>
    Tracer<'_, S, A, FEATURES>
{
    /// Memory to trace with.
    ///
    /// # Errors
    /// If there is no room for [`required_rays`], or for each light in the shadow cache.
    pub fn workspace<'w>(
        &self,
        rays: &'w mut [QueuedRay<S>],
        stack: &'w mut A::Stack,
        shadow_cache: &'w mut [Option<ObjectRef>],
    ) -> Result<Workspace<'w, S, A::Stack>, WorkspaceTooSmall> {
        let needed = WorkspaceTooSmall {
            rays: required_rays(self.max_depth, FEATURES),
            lights: self.scene.lights.len(),
        };
        if rays.len() < needed.rays || shadow_cache.len() < needed.lights {
            return Err(needed);
        }
        Ok(Workspace {
            rays,
            stack,
            shadow_cache,
        })
    }

    /// The light that comes along a ray of the camera, not clamped (fixed point: at most 1).
    pub fn radiance<O: RayObserver<S>>(
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
            if observer.stopped() {
                return sum;
            }
            observer.ray(next.kind);
            observer.begins(&next);
            let light = match self.nearest(&next.ray, workspace, observer) {
                None => self.scene.background_along(next.ray.direction),
                Some(hit) => {
                    observer.hit(next.kind);
                    observer.meets(hit);
                    self.shade_hit(&next, hit, workspace, &mut waiting, observer)
                }
            };
            observer.brings(light);
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

    /// The light of the surface itself, less the share that a transparent one transmits. The reflected
    /// and the transmitted ray are queued.
    #[inline(always)]
    fn shade_hit<O: RayObserver<S>>(
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
        let other;
        let surface = match scene.checker_at(surface, contact.point) {
            Some(checker) => {
                other = Surface {
                    ambient: checker.ambient,
                    diffuse: checker.diffuse,
                    ..*surface
                };
                &other
            }
            None => surface,
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
        let smooth = attributes.patch != Attributes::FLAT;
        let error = S::surface_error(contact.point.size(), contact.curvature_extent);
        let point = Point {
            object: hit.object,
            contact,
            normal,
            flipped,
            smooth,
            mirror,
            is_unit: reflects,
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
        let mut follow = |share: S, direction: Vec3<S>, kind: RayKind| {
            if from.depth >= self.max_depth {
                observer.not_followed(kind, None);
                return;
            }
            let weight = from.weight * share;
            if weight < self.cut_off {
                observer.not_followed(kind, Some(weight));
                return;
            }
            if let Some(place) = workspace.rays.get_mut(*waiting) {
                *place = QueuedRay {
                    ray: point.ray::<FEATURES>(direction, kind == RayKind::Reflected),
                    weight,
                    depth: from.depth + 1,
                    kind,
                };
                *waiting += 1;
                observer.queued(*waiting);
            } else {
                observer.dropped_ray();
            }
        };
        let mut mirrored = surface.reflect;
        if refracts {
            let leaves = contact.closed && contact.outward.dot(incoming) > S::ZERO;
            match refract(surface, incoming, normal, -n_dot_i, leaves) {
                Some(through) => follow(surface.refract, through, RayKind::Transmitted),
                None => {
                    mirrored = mirrored + surface.refract;
                    mirror = (incoming - normal * (n_dot_i + n_dot_i)).unit().0;
                }
            }
        }
        if (reflects || refracts) && mirrored > S::ZERO {
            follow(mirrored, mirror, RayKind::Reflected);
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
