//! All shapes of a scene, and operations on any of them.

use super::bands::Outlines;
use super::cone::Cone;
use super::contact::Contact;
use super::cuboid::Cuboid;
use super::patch::Patch;
use super::polygon::Polygon;
use super::sphere::Sphere;
use super::triangle::Triangle;
use crate::features::{self, ALL_FEATURES, FeatureSet};
use crate::object::{ObjectKind, ObjectRef};
use crate::observe::Observer;
use crate::ray::{Aabb, Ray};
use crate::scalar::{Scalar, Tolerance};
use crate::scene::Light;
use crate::vec3::Vec3;

/// All shapes of a scene, by kind. Kinds that `FEATURES` leaves out are never looked at.
///
/// Spheres and cuboids can be written by hand. Cones, triangles, polygons and patches hold values that are
/// derived from their corners and radii; octray-scenes computes them.
#[derive(Clone, Copy, Debug)]
pub struct Shapes<'a, S: Scalar, const FEATURES: FeatureSet = ALL_FEATURES> {
    /// Spheres.
    pub spheres: &'a [Sphere<S>],
    /// Polygons of three vertices.
    pub triangles: &'a [Triangle<S>],
    /// Polygons of more.
    pub polygons: &'a [Polygon<S>],
    /// Truncated cones and cylinders.
    pub cones: &'a [Cone<S>],
    /// Boxes.
    pub cuboids: &'a [Cuboid<S>],
    /// The outlines of [`Shapes::polygons`].
    pub outlines: Outlines<'a, S>,
    /// How the normal varies over the triangles and polygons that are patches.
    pub patches: &'a [Patch<S>],
    /// The unit normals at the vertices of patches.
    pub normals: &'a [Vec3<S>],
    /// How far a computed hit may lie outside its shape, as a length of the scene: its diameter times
    /// [`Quantize::SLACK`](crate::quantize::Quantize::SLACK). Boxes of spheres and cuboids are this much
    /// wider, and a light this near to a surface is held by it.
    pub slack: S,
}

impl<S: Scalar, const FEATURES: FeatureSet> Shapes<'_, S, FEATURES> {
    /// No shapes, to be filled in by struct update; `slack` is that of the scene.
    pub const fn empty(slack: S) -> Self {
        Self {
            spheres: &[],
            triangles: &[],
            polygons: &[],
            cones: &[],
            cuboids: &[],
            outlines: Outlines {
                corners: &[],
                bands: &[],
                edges: &[],
            },
            patches: &[],
            normals: &[],
            slack,
        }
    }

    /// Every object, kind by kind.
    pub fn refs(&self) -> impl Iterator<Item = ObjectRef> + '_ {
        ObjectKind::ALL.into_iter().flat_map(|kind| {
            (0..self.count(kind) as u32).map(move |index| ObjectRef::new(kind, index))
        })
    }

    /// How many objects there are.
    pub fn len(&self) -> usize {
        ObjectKind::ALL
            .into_iter()
            .map(|kind| self.count(kind))
            .sum()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many objects of a kind there are.
    pub const fn count(&self, kind: ObjectKind) -> usize {
        match kind {
            ObjectKind::Sphere => self.spheres.len(),
            ObjectKind::Triangle => self.triangles.len(),
            ObjectKind::Polygon => self.polygons.len(),
            ObjectKind::Cone => self.cones.len(),
            ObjectKind::Cuboid => self.cuboids.len(),
        }
    }
}

impl<S: Tolerance, const FEATURES: FeatureSet> Shapes<'_, S, FEATURES> {
    #[inline(always)]
    pub(super) fn sphere(&self, i: usize) -> Option<&Sphere<S>> {
        enabled::<_, FEATURES>(features::SPHERES, self.spheres).get(i)
    }

    #[inline(always)]
    pub(super) fn triangle(&self, i: usize) -> Option<&Triangle<S>> {
        enabled::<_, FEATURES>(features::TRIANGLES, self.triangles).get(i)
    }

    #[inline(always)]
    pub(super) fn polygon(&self, i: usize) -> Option<&Polygon<S>> {
        enabled::<_, FEATURES>(features::POLYGONS, self.polygons).get(i)
    }

    #[inline(always)]
    pub(super) fn cone(&self, i: usize) -> Option<&Cone<S>> {
        enabled::<_, FEATURES>(features::CONES, self.cones).get(i)
    }

    #[inline(always)]
    pub(super) fn cuboid(&self, i: usize) -> Option<&Cuboid<S>> {
        enabled::<_, FEATURES>(features::CUBOIDS, self.cuboids).get(i)
    }

    #[inline(always)]
    const fn outlines(&self) -> Outlines<'_, S> {
        Outlines {
            bands: enabled::<_, FEATURES>(features::BANDS, self.outlines.bands),
            ..self.outlines
        }
    }

    /// The distance at which `ray` first meets the object, if it does at 0 < t ≤ `limit`. Reports
    /// to the observer how far the test goes, not the test itself. The object is not one that the ray leaves.
    ///
    /// Not inlined on soft-float targets: one shared copy is smaller and costs nothing there, since
    /// the walks keep more in registers without it.
    #[cfg_attr(octray_soft_float, inline(never))]
    #[cfg_attr(not(octray_soft_float), inline(always))]
    pub fn hit<O: Observer>(
        &self,
        object: ObjectRef,
        ray: &Ray<S>,
        limit: S,
        observer: &mut O,
    ) -> Option<S> {
        let i = object.index();
        match object.kind() {
            ObjectKind::Sphere => self.sphere(i)?.hit(ray, limit, self.slack),
            ObjectKind::Triangle => self.triangle(i)?.hit(ray, limit, self.slack),
            ObjectKind::Polygon => {
                (self.polygon(i)?).hit(ray, limit, self.slack, &self.outlines(), observer)
            }
            ObjectKind::Cone => self.cone(i)?.hit(ray, limit, observer),
            ObjectKind::Cuboid => self.cuboid(i)?.hit(ray, limit, self.slack),
        }
    }

    /// [`Shapes::hit`], once more in the code for where it is not the innermost loop.
    #[inline(never)]
    fn shared_hit<O: Observer>(
        &self,
        object: ObjectRef,
        ray: &Ray<S>,
        limit: S,
        observer: &mut O,
    ) -> Option<S> {
        self.hit(object, ray, limit, observer)
    }

    /// Where a ray meets the object at 0 < t ≤ `limit`, other than where it leaves it or arrives at `light`, its aim. The
    /// object that it leaves does not count as tested.
    ///
    /// With `INLINE` the test is compiled into the caller. Without, hosts call [`Shapes::shared_hit`], so that a walk is a
    /// fifth of the code. Firmware has one walk, and always inlines.
    #[inline(always)]
    pub(crate) fn meets<const INLINE: bool, O: Observer>(
        &self,
        object: ObjectRef,
        ray: &Ray<S>,
        limit: S,
        light: Option<&Light<S>>,
        observer: &mut O,
    ) -> Option<S> {
        let leaves = ray.from.leaves(object);
        let hit = if leaves {
            self.hit_again(object, ray, limit)
        } else if INLINE || cfg!(target_os = "none") {
            self.hit(object, ray, limit, observer)
        } else {
            self.shared_hit(object, ray, limit, observer)
        };
        let hit = match hit {
            Some(t) if !self.is_arrival(object, ray, t, limit, light) => Some(t),
            _ => None,
        };
        if !leaves {
            observer.test(object.kind(), hit.is_some());
        }
        hit
    }

    /// Whether the object keeps `ray` from going as far as `limit`, to `light` if that is its aim: whether the ray meets
    /// it other than where it leaves it or arrives at the light. Firmware has a function for it, as nothing else there
    /// shares the test.
    #[inline(never)]
    pub fn blocks<O: Observer>(
        &self,
        object: ObjectRef,
        ray: &Ray<S>,
        limit: S,
        light: Option<&Light<S>>,
        observer: &mut O,
    ) -> bool {
        self.meets::<false, _>(object, ray, limit, light, observer)
            .is_some()
    }

    /// The box that every hit of the object lies in.
    pub fn bounds(&self, object: ObjectRef) -> Aabb<S> {
        let i = object.index();
        let bounds = match object.kind() {
            ObjectKind::Sphere => self.sphere(i).map(|s| s.bounds(self.slack)),
            ObjectKind::Triangle => self.triangle(i).map(|t| t.bounds(self.slack)),
            ObjectKind::Polygon => self.polygon(i).map(|p| p.bounds),
            ObjectKind::Cone => self.cone(i).map(|c| c.bounds),
            ObjectKind::Cuboid => self.cuboid(i).map(|c| c.bounds(self.slack)),
        };
        bounds.unwrap_or_default()
    }

    /// Whether two objects are the same shape at the same place.
    pub fn coincide(&self, a: ObjectRef, b: ObjectRef) -> bool {
        let (i, j) = (a.index(), b.index());
        if a.kind() != b.kind() {
            return false;
        }
        match a.kind() {
            ObjectKind::Sphere => self.sphere(i) == self.sphere(j),
            ObjectKind::Triangle => self.triangle(i) == self.triangle(j),
            ObjectKind::Polygon => match (self.polygon(i), self.polygon(j)) {
                (Some(a), Some(b)) => {
                    let corners = self.outlines.corners;
                    a.plane == b.plane && a.corners(corners) == b.corners(corners)
                }
                _ => false,
            },
            ObjectKind::Cone => self.cone(i) == self.cone(j),
            ObjectKind::Cuboid => self.cuboid(i) == self.cuboid(j),
        }
    }

    /// The surface at the point at distance `t` of a ray that meets the object there.
    #[inline(always)]
    pub fn contact(&self, object: ObjectRef, ray: &Ray<S>, t: S) -> Contact<S> {
        let i = object.index();
        let contact = match object.kind() {
            ObjectKind::Sphere => self.sphere(i).map(|s| s.contact(ray.at(t))),
            ObjectKind::Triangle => self.triangle(i).map(|p| p.plane.contact(ray.at(t))),
            ObjectKind::Polygon => self.polygon(i).map(|p| p.plane.contact(ray.at(t))),
            ObjectKind::Cone => self.cone(i).map(|c| c.contact(ray.at(t))),
            ObjectKind::Cuboid => self.cuboid(i).map(|c| c.contact(ray, t)),
        };
        contact.unwrap_or(Contact {
            point: ray.at(t),
            outward: -ray.direction,
            curvature_extent: S::ZERO,
            closed: false,
        })
    }

    /// The interpolated unit normal of patch `patch` at a point of `object`.
    pub fn patch_normal(&self, object: ObjectRef, patch: u32, point: Vec3<S>) -> Option<Vec3<S>> {
        let patch = enabled::<_, FEATURES>(features::PATCHES, self.patches).get(patch as usize)?;
        match object.kind() {
            ObjectKind::Triangle => {
                let triangle = self.triangle(object.index())?;
                patch.normal(
                    triangle.plane.project(point),
                    &triangle.corners,
                    self.normals,
                )
            }
            ObjectKind::Polygon => {
                let polygon = self.polygon(object.index())?;
                let corners = polygon.corners(self.outlines.corners)?;
                patch.normal(polygon.plane.project(point), corners, self.normals)
            }
            _ => None,
        }
    }
}

/// The things, or none of them if they are not needed: then what is done with them is not compiled.
#[inline(always)]
const fn enabled<T, const FEATURES: FeatureSet>(what: FeatureSet, things: &[T]) -> &[T] {
    if features::contains(FEATURES, what) {
        things
    } else {
        &[]
    }
}
