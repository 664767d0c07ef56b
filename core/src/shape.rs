//! The five kinds of shape: each says where a ray meets it, what box it lies in, and what its
//! surface is like at a point.
//!
//! A hit counts only if the computed point lies in the shape's own box. That makes a hit, in any
//! arithmetic however coarse, something that an octree of boxes cannot miss. For spheres and boxes
//! in arithmetics that are [sound](Scalar::SOUND) it goes without asking.

mod cone;
mod cuboid;
mod polygon;
mod sphere;

pub use cone::Cone;
pub use cuboid::Cuboid;
pub(crate) use polygon::encloses;
pub use polygon::{Bands, Flat, Outlines, Patch, Polygon, Triangle};
pub use sphere::Sphere;

use crate::needs::{self, EVERYTHING, Needs};
use crate::observe::Observer;
use crate::ray::{Bounds, Ray};
use crate::scalar::Scalar;
use crate::vec3::{Vec3, vec3};

/// Which of the arrays of [`Shapes`] an object lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Kind {
    /// [`Shapes::spheres`].
    Sphere,
    /// [`Shapes::triangles`].
    Triangle,
    /// [`Shapes::polygons`].
    Polygon,
    /// [`Shapes::cones`].
    Cone,
    /// [`Shapes::cuboids`].
    Cuboid,
}

impl Kind {
    /// All kinds, in the order of their numbers.
    pub const ALL: [Self; 5] = [
        Self::Sphere,
        Self::Triangle,
        Self::Polygon,
        Self::Cone,
        Self::Cuboid,
    ];
}

/// One object: its kind and its place in that kind's array, in one word. In a list of links a
/// mark tells the last one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(transparent)]
pub struct ObjectRef(u32);

impl ObjectRef {
    /// The most objects of one kind.
    pub const MAX_OBJECTS: usize = 1 << 28;
    const LAST: u32 = 1 << 31;

    /// Object `index` of its kind; `index` below [`ObjectRef::MAX_OBJECTS`].
    #[inline(always)]
    pub const fn new(kind: Kind, index: u32) -> Self {
        Self((kind as u32) << 28 | index & 0x0fff_ffff)
    }

    /// Its kind.
    #[inline(always)]
    pub const fn kind(self) -> Kind {
        match (self.0 >> 28) & 7 {
            0 => Kind::Sphere,
            1 => Kind::Triangle,
            2 => Kind::Polygon,
            3 => Kind::Cone,
            _ => Kind::Cuboid,
        }
    }

    /// Its place in its kind's array.
    #[inline(always)]
    pub const fn index(self) -> usize {
        (self.0 & 0x0fff_ffff) as usize
    }

    /// Whether it is marked as the last of its list.
    #[inline(always)]
    pub const fn is_last(self) -> bool {
        self.0 & Self::LAST != 0
    }

    /// The same object with or without the mark.
    #[inline(always)]
    #[must_use]
    pub const fn marked_last(self, last: bool) -> Self {
        Self(self.0 & !Self::LAST | if last { Self::LAST } else { 0 })
    }
}

/// All shapes of a scene, by kind. Kinds that `NEEDS` leaves out are never looked at.
#[derive(Clone, Copy, Debug)]
pub struct Shapes<'a, S: Scalar, const NEEDS: Needs = EVERYTHING> {
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
    /// How far a hit may lie outside its shape for want of precision; see [`Bounds`].
    pub slack: S,
}

/// What a surface is like at the point where a ray meets it.
#[derive(Clone, Copy, Debug)]
pub struct Contact<S> {
    /// The point, refined onto the surface.
    pub point: Vec3<S>,
    /// The surface's own unit normal: outward for closed shapes, either way for flat ones.
    pub outward: Vec3<S>,
    /// The size of a curved shape, 0 for a flat one; see [`Scalar::surface_error`].
    pub reach: S,
    /// Whether the shape has an inside.
    pub closed: bool,
}

impl<S: Scalar, const NEEDS: Needs> Shapes<'_, S, NEEDS> {
    /// Every object, kind by kind.
    pub fn refs(&self) -> impl Iterator<Item = ObjectRef> + '_ {
        Kind::ALL.into_iter().flat_map(|kind| {
            (0..self.count(kind) as u32).map(move |index| ObjectRef::new(kind, index))
        })
    }

    /// How many objects there are.
    pub fn len(&self) -> usize {
        Kind::ALL.into_iter().map(|kind| self.count(kind)).sum()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many objects of a kind there are.
    pub const fn count(&self, kind: Kind) -> usize {
        match kind {
            Kind::Sphere => self.spheres.len(),
            Kind::Triangle => self.triangles.len(),
            Kind::Polygon => self.polygons.len(),
            Kind::Cone => self.cones.len(),
            Kind::Cuboid => self.cuboids.len(),
        }
    }

    #[inline(always)]
    fn sphere(&self, i: usize) -> Option<&Sphere<S>> {
        needed::<_, NEEDS>(needs::SPHERES, self.spheres).get(i)
    }

    #[inline(always)]
    fn triangle(&self, i: usize) -> Option<&Triangle<S>> {
        needed::<_, NEEDS>(needs::TRIANGLES, self.triangles).get(i)
    }

    #[inline(always)]
    fn polygon(&self, i: usize) -> Option<&Polygon<S>> {
        needed::<_, NEEDS>(needs::POLYGONS, self.polygons).get(i)
    }

    #[inline(always)]
    fn cone(&self, i: usize) -> Option<&Cone<S>> {
        needed::<_, NEEDS>(needs::CONES, self.cones).get(i)
    }

    #[inline(always)]
    fn cuboid(&self, i: usize) -> Option<&Cuboid<S>> {
        needed::<_, NEEDS>(needs::CUBOIDS, self.cuboids).get(i)
    }

    #[inline(always)]
    const fn outlines(&self) -> Outlines<'_, S> {
        Outlines {
            bands: needed::<_, NEEDS>(needs::BANDS, self.outlines.bands),
            ..self.outlines
        }
    }

    /// The distance at which `ray` first meets the object, if it does at 0 < t ≤ `limit`. The
    /// observer is told how far the test goes, but not that there is one. On cores
    /// that emulate floats one copy is all there is: that costs nothing, since the trees' walks keep
    /// more in registers without it.
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
            Kind::Sphere => self.sphere(i)?.hit(ray, limit, self.slack),
            Kind::Triangle => self.triangle(i)?.hit(ray, limit),
            Kind::Polygon => self.polygon(i)?.hit(ray, limit, &self.outlines(), observer),
            Kind::Cone => self.cone(i)?.hit(ray, limit, observer),
            Kind::Cuboid => self.cuboid(i)?.hit(ray, limit, self.slack),
        }
    }

    /// Whether `ray` meets the object at 0 < t ≤ `limit`: [`Shapes::hit`], once more in the code
    /// for where it is not the innermost loop.
    #[inline(never)]
    pub fn blocks<O: Observer>(
        &self,
        object: ObjectRef,
        ray: &Ray<S>,
        limit: S,
        observer: &mut O,
    ) -> bool {
        self.hit(object, ray, limit, observer).is_some()
    }

    /// The box that every hit of the object lies in.
    pub fn bounds(&self, object: ObjectRef) -> Bounds<S> {
        let i = object.index();
        let bounds = match object.kind() {
            Kind::Sphere => self.sphere(i).map(|s| s.bounds(self.slack)),
            Kind::Triangle => self.triangle(i).map(Triangle::bounds),
            Kind::Polygon => self.polygon(i).map(|p| p.bounds),
            Kind::Cone => self.cone(i).map(|c| c.bounds),
            Kind::Cuboid => self.cuboid(i).map(|c| c.bounds(self.slack)),
        };
        bounds.unwrap_or_default()
    }

    /// The surface at the point at distance `t` of a ray that meets the object there.
    #[inline(always)]
    pub fn contact(&self, object: ObjectRef, ray: &Ray<S>, t: S) -> Contact<S> {
        let i = object.index();
        let contact = match object.kind() {
            Kind::Sphere => self.sphere(i).map(|s| s.contact(ray.at(t))),
            Kind::Triangle => self.triangle(i).map(|p| p.plane.contact(ray.at(t))),
            Kind::Polygon => self.polygon(i).map(|p| p.plane.contact(ray.at(t))),
            Kind::Cone => self.cone(i).map(|c| c.contact(ray.at(t))),
            Kind::Cuboid => self.cuboid(i).map(|c| c.contact(ray, t)),
        };
        contact.unwrap_or(Contact {
            point: ray.at(t),
            outward: -ray.direction,
            reach: S::ZERO,
            closed: false,
        })
    }

    /// The interpolated unit normal of patch `patch` at a point of `object`.
    pub fn patch_normal(&self, object: ObjectRef, patch: u32, point: Vec3<S>) -> Option<Vec3<S>> {
        let patch = needed::<_, NEEDS>(needs::PATCHES, self.patches).get(patch as usize)?;
        match object.kind() {
            Kind::Triangle => {
                let triangle = self.triangle(object.index())?;
                patch.normal(
                    triangle.plane.project(point),
                    &triangle.corners,
                    self.normals,
                )
            }
            Kind::Polygon => {
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
const fn needed<T, const NEEDS: Needs>(what: Needs, things: &[T]) -> &[T] {
    if needs::needs(NEEDS, what) {
        things
    } else {
        &[]
    }
}

/// A box around `centre` that reaches `reach` in each direction.
fn around<S: Scalar>(centre: Vec3<S>, reach: S) -> Bounds<S> {
    let reach = vec3(reach, reach, reach);
    Bounds {
        low: centre - reach,
        high: centre + reach,
    }
}
