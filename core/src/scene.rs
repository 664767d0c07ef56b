//! A scene in the arithmetic it is rendered in: slices that somebody else owns, in memory or flash.

use crate::features::{ALL_FEATURES, FeatureSet};
use crate::object::{ObjectKind, ObjectRef};
use crate::scalar::{Exponent, Scalar};
use crate::shape::Shapes;
use crate::vec3::Vec3;

/// A scene, ready to be traced. Whoever fills it in proves that nothing overflows: the middle of
/// all shapes, lights and viewpoints is at the origin, and their largest distance, `diameter`, is at
/// most ⅔ of [`Scalar::MAX`], so that every point a ray comes to within its diameter has coordinates
/// in range.
///
/// What a scene has none of is not in the machine code if `FEATURES` leaves it out.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, S: Scalar, const FEATURES: FeatureSet = ALL_FEATURES> {
    /// The geometry.
    pub shapes: Shapes<'a, S, FEATURES>,
    /// Who and of what surface each object is, kind by kind in the order of [`ObjectKind`].
    pub attributes: &'a [Attributes],
    /// Where each kind begins in `attributes`.
    pub first: [u32; 5],
    /// The surfaces.
    pub surfaces: &'a [Surface<S>],
    /// The lights.
    pub lights: &'a [Light<S>],
    /// What a ray that hits nothing brings.
    pub background: Vec3<S>,
    /// No two points of shapes, lights and viewpoint are farther apart; no hit is looked for beyond.
    pub diameter: S,
}

/// What is known of an object besides its geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C)]
pub struct Attributes {
    /// Its place in the scene file, counted from 0. Of two objects met at the same distance the
    /// one with the smaller identity counts.
    pub id: u32,
    /// Its surface in [`Scene::surfaces`].
    pub surface: u32,
    /// Its patch in [`Shapes::patches`]; [`Attributes::FLAT`] if it has none.
    pub patch: u32,
}

impl Attributes {
    /// Not a patch.
    pub const FLAT: u32 = u32::MAX;
}

/// How a surface answers to light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Surface<S> {
    /// Shown without any light.
    pub ambient: Vec3<S>,
    /// Diffuse coefficients.
    pub diffuse: Vec3<S>,
    /// Specular coefficients.
    pub specular: Vec3<S>,
    /// Exponent of the specular term.
    pub shine: Exponent<S>,
    /// Share of the reflected ray.
    pub reflect: S,
    /// Share of the transmitted ray.
    pub refract: S,
    /// n1/n2 on the way in: 1/ior.
    pub entering: S,
    /// n1/n2 on the way out: ior.
    pub leaving: S,
}

/// A point light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Light<S> {
    /// Where it is.
    pub position: Vec3<S>,
    /// How bright it is.
    pub colour: Vec3<S>,
    /// The [`Scalar::surface_error`] of a flat surface at the light, which does not block it.
    pub clearance: S,
}

impl<S: Scalar, const FEATURES: FeatureSet> Scene<'_, S, FEATURES> {
    /// An object's attributes.
    #[inline(always)]
    pub fn attributes_of(&self, object: ObjectRef) -> Attributes {
        let slot = self.first[object.kind() as usize] as usize + object.index();
        self.attributes.get(slot).copied().unwrap_or(Attributes {
            id: u32::MAX,
            surface: 0,
            patch: Attributes::FLAT,
        })
    }

    /// Where each kind begins in the attributes of a scene with these shapes.
    pub fn first_of(shapes: &Shapes<'_, S, FEATURES>) -> [u32; 5] {
        let mut first = [0; 5];
        let mut sum = 0;
        for kind in ObjectKind::ALL {
            first[kind as usize] = sum;
            sum += shapes.count(kind) as u32;
        }
        first
    }
}
