//! What a scene uses of the tracer, known when it is compiled: code for shapes and light that a
//! scene does not have is then not in the machine code.
//!
//! [`Scene`](crate::scene::Scene) and [`Shapes`](crate::shape::Shapes) carry the set as a parameter.
//! It is [`ALL_FEATURES`] by default; a program that knows its scene beforehand, such as firmware with a
//! baked scene, gives a smaller one. What is left out is treated as absent, whatever the scene holds.
//!
//! ```
//! use octray_core::features::{self, FeatureSet};
//!
//! const FEATURES: FeatureSet = features::SPHERES | features::SHADOWS;
//! assert!(features::contains(FEATURES, features::SPHERES));
//! assert!(!features::contains(FEATURES, features::REFRACTION));
//! ```

use crate::object::ObjectKind;

/// A set of the constants below.
pub type FeatureSet = u32;

/// [`Shapes::spheres`](crate::shape::Shapes::spheres).
pub const SPHERES: FeatureSet = of_kind(ObjectKind::Sphere);
/// [`Shapes::triangles`](crate::shape::Shapes::triangles).
pub const TRIANGLES: FeatureSet = of_kind(ObjectKind::Triangle);
/// [`Shapes::polygons`](crate::shape::Shapes::polygons).
pub const POLYGONS: FeatureSet = of_kind(ObjectKind::Polygon);
/// [`Shapes::cones`](crate::shape::Shapes::cones).
pub const CONES: FeatureSet = of_kind(ObjectKind::Cone);
/// [`Shapes::cuboids`](crate::shape::Shapes::cuboids).
pub const CUBOIDS: FeatureSet = of_kind(ObjectKind::Cuboid);
/// Polygons with many edges, cut into bands.
pub const BANDS: FeatureSet = 1 << 5;
/// Patches: shading normals that vary over a flat shape.
pub const PATCHES: FeatureSet = 1 << 6;
/// Lights, and the shadow rays to them.
pub const SHADOWS: FeatureSet = 1 << 7;
/// Specular light.
pub const SPECULAR: FeatureSet = 1 << 8;
/// Shininess that is not a whole number.
pub const FRACTIONS: FeatureSet = 1 << 9;
/// Reflected rays.
pub const REFLECTION: FeatureSet = 1 << 10;
/// Transmitted rays.
pub const REFRACTION: FeatureSet = 1 << 11;

/// A background that is not of one colour.
pub const SKY: FeatureSet = 1 << 12;
/// Surfaces with a checker.
pub const CHECKERS: FeatureSet = 1 << 13;

/// Lights beyond the scene, [`Light::parallax`](crate::scene::Light::parallax).
pub const FAR_LIGHTS: FeatureSet = 1 << 14;

/// Everything: for programs that do not know the scene beforehand.
pub const ALL_FEATURES: FeatureSet = (1 << 15) - 1;

/// Names and values, to write a set as text.
pub const NAMES: [(&str, FeatureSet); 15] = [
    ("SPHERES", SPHERES),
    ("TRIANGLES", TRIANGLES),
    ("POLYGONS", POLYGONS),
    ("CONES", CONES),
    ("CUBOIDS", CUBOIDS),
    ("BANDS", BANDS),
    ("PATCHES", PATCHES),
    ("SHADOWS", SHADOWS),
    ("SPECULAR", SPECULAR),
    ("FRACTIONS", FRACTIONS),
    ("REFLECTION", REFLECTION),
    ("REFRACTION", REFRACTION),
    ("SKY", SKY),
    ("CHECKERS", CHECKERS),
    ("FAR_LIGHTS", FAR_LIGHTS),
];

/// The shapes of one kind.
pub const fn of_kind(kind: ObjectKind) -> FeatureSet {
    1 << kind as u32
}

/// Whether a set holds a feature, or any of several.
#[inline(always)]
pub const fn contains(set: FeatureSet, what: FeatureSet) -> bool {
    set & what != 0
}
