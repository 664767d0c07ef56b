//! A scene in the arithmetic it is rendered in: borrowed slices, in memory or flash.

mod fits;

pub use fits::OutOfRoom;

use crate::accel::AccelScalar;
use crate::checker::Checker;
use crate::features::{self, ALL_FEATURES, FeatureSet};
use crate::object::{ObjectKind, ObjectRef};
use crate::scalar::{Exponent, Scalar};
use crate::shape::Shapes;
use crate::vec3::Vec3;

/// A scene, ready to be traced.
///
/// Fixed point is safe from overflow if the middle of all shapes, lights and viewpoints is at the
/// origin, and their largest distance, [`Scene::diameter`], is at most ⅔ of [`Scalar::MAX`]: then every
/// point within the diameter of a ray has coordinates in range. octray-scenes places and scales scene
/// files so.
///
/// Lengths are in units of the scene, colours are linear and 1 at full intensity. What a scene has none of
/// is not in the machine code if `FEATURES` leaves it out.
///
/// ```
/// use octray_core::accel::{Accelerator, BruteForce};
/// use octray_core::object::{ObjectKind, ObjectRef};
/// use octray_core::ray::Ray;
/// use octray_core::scene::{Attributes, Scene, Surface};
/// use octray_core::shape::{Shapes, Sphere};
/// use octray_core::vec3::{Vec3, vec3};
///
/// // A row of ten spheres along z, the first in the file the farthest.
/// let spheres: Vec<_> = (0..10)
///     .map(|i| Sphere { centre: vec3(0.0, 0.0, 3.0 * i as f32 - 15.0), radius: 1.0 })
///     .collect();
/// let attributes: Vec<_> = (0..10).map(|id| Attributes::new(id, 0)).collect();
/// let surfaces = [Surface::default()];
/// let scene: Scene<f32> = Scene::new(
///     Shapes { spheres: &spheres, ..Shapes::empty(1e-5) },
///     &attributes,
///     &surfaces,
///     &[],
///     Vec3::ZERO,
///     64.0,
/// );
///
/// let objects: Vec<_> = scene.shapes.refs().collect();
/// let ray = Ray::new(vec3(0.0, 0.0, 20.0), vec3(0.0, 0.0, -1.0));
/// let hit = BruteForce(&objects).nearest(&scene, &ray, &mut (), &mut ()).unwrap();
/// assert_eq!(hit.object, ObjectRef::new(ObjectKind::Sphere, 9));
/// assert_eq!(scene.attributes_of(hit.object).id, 9);
/// assert_eq!(hit.t, 7.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, S: Scalar, const FEATURES: FeatureSet = ALL_FEATURES> {
    /// The geometry.
    pub shapes: Shapes<'a, S, FEATURES>,
    /// The identity and the surface of each object, kind by kind in the order of [`ObjectKind`].
    pub attributes: &'a [Attributes],
    /// Where each kind begins in `attributes`.
    pub first: [u32; 5],
    /// The surfaces.
    pub surfaces: &'a [Surface<S>],
    /// The lights.
    pub lights: &'a [Light<S>],
    /// The light of a ray that hits nothing; with a sky, of one straight down.
    pub background: Vec3<S>,
    /// How the background changes from there upward.
    pub sky: Sky<S>,
    /// The checkers of surfaces.
    pub checkers: &'a [Checker<S>],
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

    /// Those of an object that is no patch.
    pub const fn new(id: u32, surface: u32) -> Self {
        Self {
            id,
            surface,
            patch: Self::FLAT,
        }
    }
}

/// How a surface reflects light. All coefficients are linear, 0 to 1 as a rule.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Surface<S> {
    /// Light that it sends out without any lamp.
    pub ambient: Vec3<S>,
    /// Diffuse coefficients: times the light's colour and the cosine to its direction.
    pub diffuse: Vec3<S>,
    /// Specular coefficients: times the light's colour and a power of the cosine between mirror
    /// direction and light.
    pub specular: Vec3<S>,
    /// That power's exponent, ≥ 0; the larger, the smaller the highlight.
    pub shine: Exponent<S>,
    /// Weight of the reflected ray, 0 to 1.
    pub reflect: S,
    /// Weight of the transmitted ray, 0 to 1; the surface itself is seen with what is left.
    pub refract: S,
    /// n1/n2 on the way in: 1 / index of refraction.
    pub entering: S,
    /// n1/n2 on the way out: the index of refraction.
    pub leaving: S,
    /// Its checker in [`Scene::checkers`], counted from 1; 0 if it has none.
    pub checker: u32,
}

impl<S: Scalar> Surface<S> {
    /// Black: it sends out nothing.
    pub const BLACK: Self = Self {
        ambient: Vec3::ZERO,
        diffuse: Vec3::ZERO,
        specular: Vec3::ZERO,
        shine: Exponent {
            whole: 0,
            fraction: S::ZERO,
        },
        reflect: S::ZERO,
        refract: S::ZERO,
        entering: S::ONE,
        leaving: S::ONE,
        checker: 0,
    };

    /// A surface that scatters light of this colour.
    pub const fn matt(diffuse: Vec3<S>) -> Self {
        Self {
            diffuse,
            ..Self::BLACK
        }
    }

    /// The same, which also sends out this light without any lamp.
    #[must_use]
    pub const fn with_ambient(self, ambient: Vec3<S>) -> Self {
        Self { ambient, ..self }
    }

    /// The same with highlights: their colour, and the exponent that makes them small.
    #[must_use]
    pub const fn with_highlights(self, specular: Vec3<S>, shine: u32) -> Self {
        Self {
            specular,
            shine: Exponent {
                whole: shine,
                fraction: S::ZERO,
            },
            ..self
        }
    }

    /// The same as a mirror that returns this share, 0 to 1, of the light that comes along the mirrored ray.
    #[must_use]
    pub const fn with_mirror(self, reflect: S) -> Self {
        Self { reflect, ..self }
    }

    /// The same as glass that lets this share, 0 to 1, of the light through. The index of refraction and 1 over it
    /// tell how rays bend: both ≤ [`Scalar::MAX`], both 1 if they do not.
    #[must_use]
    pub const fn with_glass(self, refract: S, index: S, inverse: S) -> Self {
        Self {
            refract,
            entering: inverse,
            leaving: index,
            ..self
        }
    }
}

/// A background that changes with the ray's direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Sky<S> {
    /// What is added for a level ray; twice that for one straight up.
    pub rise: Vec3<S>,
    /// The unit vector straight up.
    pub up: Vec3<S>,
}

/// A point light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Light<S> {
    /// Where it is; the unit vector from the origin to it if it is far away.
    pub position: Vec3<S>,
    /// Its intensity, linear; it does not fall off with distance.
    pub colour: Vec3<S>,
    /// How the direction to a light changes with the place that is so far away that its own place is no number of
    /// the scene: beyond everything that can block it.
    pub parallax: Option<Parallax<S>>,
}

/// 1 over the distance to a light: `share` times 2^`exponent`. In formats whose precision is relative the exponent
/// is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Parallax<S> {
    /// From 1 to 2 in fixed point.
    pub share: S,
    /// At most 0.
    pub exponent: i8,
}

impl<S> Light<S> {
    /// A light of this intensity at a place.
    pub const fn new(position: Vec3<S>, colour: Vec3<S>) -> Self {
        Self {
            position,
            colour,
            parallax: None,
        }
    }
}

impl<S: Scalar> Light<S> {
    /// A vector from a place to the light; to a far one it is about as long as a unit vector.
    #[inline(always)]
    pub(crate) fn from<const FEATURES: FeatureSet>(&self, place: Vec3<S>) -> Vec3<S> {
        match self.far::<FEATURES>() {
            Some(Parallax { share, exponent }) => {
                self.position - place.map(|x| x.to_local(exponent)) * share
            }
            None => self.position - place,
        }
    }

    /// What is known of a far light.
    #[inline(always)]
    pub(crate) const fn far<const FEATURES: FeatureSet>(&self) -> Option<Parallax<S>> {
        if features::contains(FEATURES, features::FAR_LIGHTS) {
            self.parallax
        } else {
            None
        }
    }
}

impl<'a, S: Scalar, const FEATURES: FeatureSet> Scene<'a, S, FEATURES> {
    /// A scene of these parts; see the fields. There is an element of `attributes` for each object, kind
    /// by kind.
    pub fn new(
        shapes: Shapes<'a, S, FEATURES>,
        attributes: &'a [Attributes],
        surfaces: &'a [Surface<S>],
        lights: &'a [Light<S>],
        background: Vec3<S>,
        diameter: S,
    ) -> Self {
        Self {
            shapes,
            attributes,
            first: Self::first_of(&shapes),
            surfaces,
            lights,
            background,
            sky: Sky::default(),
            checkers: &[],
            diameter,
        }
    }

    /// The light along a ray that hits nothing.
    #[inline(always)]
    pub fn background_along(&self, direction: Vec3<S>) -> Vec3<S> {
        if features::contains(FEATURES, features::SKY) && self.sky.rise != Vec3::ZERO {
            self.background + self.sky.rise * (S::ONE + direction.dot(self.sky.up))
        } else {
            self.background
        }
    }

    /// What holds instead of a surface's colours at a point, if anything does.
    #[inline(always)]
    pub(crate) fn checker_at(&self, surface: &Surface<S>, point: Vec3<S>) -> Option<&Checker<S>>
    where
        S: AccelScalar,
    {
        if !features::contains(FEATURES, features::CHECKERS) || surface.checker == 0 {
            return None;
        }
        let checker = self.checkers.get(surface.checker as usize - 1)?;
        checker.contains(point).then_some(checker)
    }

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

    /// The object of this identity, for instance to move it. Looks at one after another.
    pub fn object(&self, id: u32) -> Option<ObjectRef> {
        let same = |object: &ObjectRef| self.attributes_of(*object).id == id;
        self.shapes.refs().find(same)
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
