//! Checks of the invariants of [`crate::model`]: what makes a scene renderable.

use crate::model::{Camera, Checker, Colour, Light, Object, Point, Scene, Shape, Surface};
use crate::point;
use std::fmt;
use thiserror::Error;

pub(crate) mod plane;

pub(crate) use plane::Oddity;

/// What is wrong with one value of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Fault {
    /// NaN or infinite, as written or after colour and coefficient are multiplied.
    #[error("a number that is not finite")]
    NotFinite,
    /// A sphere of radius 0.
    #[error("sphere with radius 0")]
    ZeroRadius,
    /// A radius below 0; the parser drops the sign instead.
    #[error("negative radius")]
    NegativeRadius,
    /// A cone whose base and top have radius 0.
    #[error("cone with both radii 0")]
    ZeroRadii,
    /// A cone whose base is its top.
    #[error("cone whose base is its top")]
    BaseIsTop,
    /// A box with a side of length 0 or below.
    #[error("box with a side that is not above 0")]
    FlatBox {
        /// 0, 1 or 2 for x, y or z.
        axis: usize,
    },
    /// A polygon of fewer than three vertices.
    #[error("polygon with fewer than 3 vertices")]
    TooFewVertices,
    /// A list longer than `u32` can count.
    #[error("more than a scene can hold")]
    TooLarge,
    /// A vertex or normal range outside its list.
    #[error("vertices out of range")]
    VertexRange,
    /// All vertices on one line.
    #[error("polygon with all its vertices on one line")]
    Collinear,
    /// A vertex off the polygon's plane.
    #[error("polygon that is not planar")]
    NotPlanar {
        /// The vertex farthest from the plane.
        vertex: usize,
        /// Its distance from the plane, in scene units.
        distance: f64,
        /// The distance that would be allowed, in scene units.
        tolerance: f64,
    },
    /// A patch's normal of length 0.
    #[error("normal of length 0")]
    ZeroNormal {
        /// Which of the patch's normals.
        vertex: usize,
    },
    /// A colour, coefficient, brightness or exponent below 0.
    #[error("negative colour or coefficient")]
    Negative,
    /// A checker of size 0 or below.
    #[error("checker with a size that is not above 0")]
    CheckerSize,
    /// A refraction index of 0 or below on a transparent surface.
    #[error("refraction index not above 0 on a transparent surface")]
    RefractionIndex,
    /// A thesis viewpoint with z = 0.
    #[error("viewpoint in the picture plane")]
    ViewpointInPlane,
    /// An NFF camera that looks at its own place.
    #[error("viewpoint at the point it looks at")]
    FromIsAt,
    /// An up direction of length 0.
    #[error("up direction of length 0")]
    ZeroUp,
    /// An up direction within [`NEARLY_PARALLEL`] of the view.
    #[error("up direction parallel to the view")]
    UpParallel,
    /// An angle outside (0, 180).
    #[error("angle outside 0 to 180 degrees")]
    Angle,
    /// A resolution that is 0, above 65535 or not whole.
    #[error("resolution that is no whole number from 1 to 65535")]
    Resolution,
    /// A surface index outside the list.
    #[error("surface index out of range")]
    SurfaceIndex,
}

/// The place of a [`Fault`]; the numbers are indices into the scene's lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The camera.
    Camera,
    /// The resolution.
    Resolution,
    /// The background colour.
    Background,
    /// A light.
    Light(usize),
    /// A surface.
    Surface(usize),
    /// An object.
    Object(usize),
    /// The room to move.
    Room,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Camera => f.write_str("camera"),
            Self::Resolution => f.write_str("resolution"),
            Self::Background => f.write_str("background"),
            Self::Light(index) => write!(f, "light {index}"),
            Self::Surface(index) => write!(f, "surface {index}"),
            Self::Object(index) => write!(f, "object {index}"),
            Self::Room => f.write_str("room"),
        }
    }
}

/// The first violated invariant of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{place}: {fault}")]
pub struct Broken {
    /// Where it was found.
    pub place: Place,
    /// What is wrong.
    pub fault: Fault,
}

/// Checks a scene that was not parsed against the invariants of [`crate::model`].
///
/// # Errors
/// The first violated invariant, in the order camera, resolution, background, lights, surfaces, objects, room.
pub fn scene(scene: &Scene) -> Result<(), Broken> {
    let at = |place| move |fault| Broken { place, fault };
    camera(&scene.camera).map_err(at(Place::Camera))?;
    for size in [scene.width, scene.height] {
        resolution(f64::from(size)).map_err(at(Place::Resolution))?;
    }
    background(&scene.background, scene.zenith.as_ref()).map_err(at(Place::Background))?;
    for (index, value) in scene.lights.iter().enumerate() {
        light(value).map_err(at(Place::Light(index)))?;
    }
    for (index, value) in scene.surfaces.iter().enumerate() {
        surface(value).map_err(at(Place::Surface(index)))?;
    }
    for (index, value) in scene.objects.iter().enumerate() {
        object(scene, value).map_err(at(Place::Object(index)))?;
    }
    let corners = scene.room.as_slice().as_flattened();
    finite(corners.as_flattened()).map_err(at(Place::Room))
}

/// The least angle between the view and `up`, in radians: at a smaller one, rounding in `f64` turns the picture by more
/// than a ten thousandth of a radian.
pub const NEARLY_PARALLEL: f64 = 1e-12;

/// Checks a camera.
///
/// # Errors
/// The first violated invariant.
pub fn camera(camera: &Camera) -> Result<(), Fault> {
    match camera {
        Camera::Thesis { viewpoint, .. } => {
            finite(viewpoint)?;
            ensure(viewpoint[2] != 0.0, Fault::ViewpointInPlane)
        }
        Camera::Nff {
            from,
            at,
            up,
            angle,
            ..
        } => {
            finite(from)?;
            finite(at)?;
            finite(up)?;
            let view = plane::unit(plane::half_difference(at, from)).ok_or(Fault::FromIsAt)?;
            let up = plane::unit(*up).ok_or(Fault::ZeroUp)?;
            ensure(
                plane::length(point::cross(view, up)) > NEARLY_PARALLEL,
                Fault::UpParallel,
            )?;
            ensure(*angle > 0.0 && *angle < 180.0, Fault::Angle)
        }
    }
}

pub(crate) fn resolution(size: f64) -> Result<(), Fault> {
    ensure(
        size.fract() == 0.0 && (1.0..=65535.0).contains(&size),
        Fault::Resolution,
    )
}

/// Checks the background, and the zenith if the sky is not of one colour.
pub(crate) fn background(background: &Colour, zenith: Option<&Colour>) -> Result<(), Fault> {
    coefficients(background)?;
    zenith.map_or(Ok(()), |zenith| coefficients(zenith))
}

pub(crate) fn light(light: &Light) -> Result<(), Fault> {
    finite(&light.position)?;
    coefficients(&light.colour)
}

pub(crate) fn surface(surface: &Surface) -> Result<(), Fault> {
    let Surface {
        ambient,
        diffuse,
        specular,
        shine,
        reflect,
        refract,
        ior,
        checker: of_checker,
    } = surface;
    for colour in [ambient, diffuse, specular] {
        coefficients(colour)?;
    }
    coefficients(&[*shine, *reflect, *refract])?;
    finite(&[*ior])?;
    of_checker.as_ref().map_or(Ok(()), checker)?;
    let allowed = if *refract > 0.0 {
        *ior > 0.0
    } else {
        *ior == 1.0
    };
    ensure(allowed, Fault::RefractionIndex)
}

pub(crate) fn checker(checker: &Checker) -> Result<(), Fault> {
    let Checker {
        size,
        ambient,
        diffuse,
    } = checker;
    coefficients(ambient)?;
    coefficients(diffuse)?;
    finite(&[*size])?;
    ensure(*size > 0.0, Fault::CheckerSize)
}

fn coefficients(numbers: &[f64]) -> Result<(), Fault> {
    finite(numbers)?;
    ensure(numbers.iter().all(|&number| number >= 0.0), Fault::Negative)
}

fn sphere(centre: &Point, radius: f64) -> Result<(), Fault> {
    finite(centre)?;
    radii(&[radius])?;
    ensure(radius != 0.0, Fault::ZeroRadius)
}

fn cone(base: &Point, top: &Point, radii_of_both: [f64; 2]) -> Result<(), Fault> {
    finite(base)?;
    finite(top)?;
    radii(&radii_of_both)?;
    ensure(radii_of_both != [0.0; 2], Fault::ZeroRadii)?;
    ensure(base != top, Fault::BaseIsTop)
}

fn cuboid(centre: &Point, size: &Point) -> Result<(), Fault> {
    finite(centre)?;
    finite(size)?;
    match size.iter().position(|&side| side <= 0.0) {
        Some(axis) => Err(Fault::FlatBox { axis }),
        None => Ok(()),
    }
}

/// Returns what is odd about a polygon that can be rendered, if anything.
fn polygon(vertices: &[Point]) -> Result<Option<Oddity>, Fault> {
    ensure(vertices.len() >= 3, Fault::TooFewVertices)?;
    finite(vertices.as_flattened())?;
    plane::polygon(vertices)
}

/// Checks an object against the lists of its scene. Returns what is odd about it, if anything.
pub(crate) fn object(scene: &Scene, object: &Object) -> Result<Option<Oddity>, Fault> {
    ensure(
        (object.surface as usize) < scene.surfaces.len(),
        Fault::SurfaceIndex,
    )?;
    match &object.shape {
        Shape::Sphere { centre, radius } => sphere(centre, *radius)?,
        Shape::Cone {
            base,
            base_radius,
            top,
            top_radius,
        } => cone(base, top, [*base_radius, *top_radius])?,
        Shape::Cuboid { centre, size } => cuboid(centre, size)?,
        Shape::Polygon { first, count } => {
            return polygon(range(&scene.vertices, *first, *count)?);
        }
        Shape::Patch {
            first,
            count,
            first_normal,
        } => {
            let normals = range(&scene.normals, *first_normal, *count)?;
            // Also of a patch without area, which is left out.
            finite(normals.as_flattened())?;
            let oddity = polygon(range(&scene.vertices, *first, *count)?)?;
            let zero = normals.iter().position(|normal| *normal == [0.0; 3]);
            return zero.map_or(Ok(oddity), |vertex| Err(Fault::ZeroNormal { vertex }));
        }
    }
    Ok(None)
}

fn range(points: &[Point], first: u32, count: u32) -> Result<&[Point], Fault> {
    let first = first as usize;
    let end = first.saturating_add(count as usize);
    points.get(first..end).ok_or(Fault::VertexRange)
}

fn radii(radii: &[f64]) -> Result<(), Fault> {
    finite(radii)?;
    ensure(
        radii.iter().all(|&radius| radius >= 0.0),
        Fault::NegativeRadius,
    )
}

fn finite(numbers: &[f64]) -> Result<(), Fault> {
    ensure(
        numbers.iter().all(|number| number.is_finite()),
        Fault::NotFinite,
    )
}

fn ensure(holds: bool, fault: Fault) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(fault) }
}
