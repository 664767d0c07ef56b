//! Finds what is too fine for a format. A scene that fits a format can still be finer than the format's directions can
//! resolve; then methods break (`octray stability` shows where).

mod gaps;
mod large;

use super::camera::{is_parallel, length, pixel as pixel_of, starts};
use super::extent::{Extent, shape_box};
use crate::limits::passed_on;
use crate::settings::RenderSettings;
use octray_core::quantize::Quantize;
use octray_scenes::model::{Point, Scene, Shape};
use octray_scenes::point::{add, dot, times};
use std::fmt;

/// Something that is too fine for a format.
#[derive(Clone, Debug, PartialEq)]
pub struct TooFine {
    /// The format's name.
    pub format: &'static str,
    /// What is too fine, and the whole that its size is a share of.
    pub what: String,
    /// The share.
    pub value: f64,
    /// The smallest share that the format resolves.
    pub limit: f64,
}

impl fmt::Display for TooFine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { format, what, .. } = self;
        let [value, limit] = [self.value, self.limit].map(|x| match 1.0 / x {
            n if n < 10.0 => format!("1/{n:.1}"),
            n if n < 1e9 => format!("1/{n:.0}"),
            n if n.is_finite() => format!("1/{n:.0e}"),
            _ if x > 0.0 => "below 1/1e308".into(),
            _ => "0".into(),
        });
        write!(f, "{format} resolves {limit}, but {what} is {value}")
    }
}

impl std::error::Error for TooFine {}

/// Returns the smallest share of a scene's size, and the smallest angle in radians, that format `S` resolves: four
/// times the error of its hits.
pub const fn grain<S: Quantize>() -> f64 {
    4.0 * S::SLACK
}

/// With approximate roots and tips of cones, a pixel must be larger by this factor.
const TIP: f64 = 2.5;

/// The largest sum of light errors along a path: eight grey levels.
const LIGHT: f64 = 8.0 / 255.0;
/// The weight below which a ray's light is less than half a grey level.
const LEAST_WEIGHT: f64 = 1.0 / 512.0;

/// Checks that format `S` resolves the pixels of a view, the eye's distance from curved surfaces, the objects, the gaps
/// between surfaces one behind the other, the shine of surfaces, and the light of repeated reflections. Within these
/// limits no method breaks.
///
/// Gaps are looked for between parallel planes, and between balls and cones that lie inside one another.
///
/// # Errors
/// The first thing that is too fine.
pub fn resolution<S: Quantize>(scene: &Scene, settings: &RenderSettings) -> Result<(), TooFine> {
    let check = |value: f64, limit: f64, what: &dyn Fn() -> String| {
        if value >= limit {
            return Ok(());
        }
        let (format, what) = (S::NAME, what());
        Err(TooFine {
            format,
            what,
            value,
            limit,
        })
    };
    let grain = grain::<S>();
    let rays = settings.rays(scene);
    let extent = Extent::of(scene, &rays);
    let diagonal = extent.diagonal();
    let (pixel, whole) = match is_parallel(&rays) {
        true => (
            pixel_of(&rays, settings.size_of(scene)) / diagonal,
            "the scene",
        ),
        false => (pixel_of(&rays, settings.size_of(scene)), "a radian"),
    };
    let tips = !S::EXACT_ROOTS && scene.objects.iter().any(|object| has_tip(&object.shape));
    let least = if tips { TIP * grain } else { grain };
    check(pixel, least, &|| format!("a pixel's share of {whole}"))?;
    let world = extent.world::<S>();
    let from_middle = |p: Point| length(add(p, times(world.centre, -1.0)));
    let eye = starts(&rays)
        .into_iter()
        .map(from_middle)
        .fold(0.0, f64::max);
    for (i, object) in scene.objects.iter().enumerate() {
        let name = |what: &str| format!("{what} object {} as a share of the scene", i + 1);
        // Where rounding is relative, what is far away does not matter.
        let reach = match S::FRACTION_BITS {
            Some(_) => diagonal,
            None => {
                let [low, high] = shape_box(scene, &object.shape);
                let farthest = [0, 1, 2].map(|i| {
                    let centre = world.centre[i];
                    (low[i] - centre).abs().max((high[i] - centre).abs())
                });
                length(farthest).max(eye).min(diagonal)
            }
        };
        check(size(scene, &object.shape) / reach, grain, &|| {
            if reach < diagonal {
                let i = i + 1;
                return format!("the size of object {i} as a share of its distance");
            }
            match large::culprit(scene, &rays, &extent, i) {
                Some(large) => name("the size of") + &format!(", which {large} makes large,"),
                None => name("the size of"),
            }
        })?;
        for eye in starts(&rays) {
            if let Some(away) = distance(&object.shape, eye) {
                check(away / reach, grain, &|| name("the eye's distance from"))?;
            }
        }
    }
    // A ray has to start between the surfaces, and to tell them apart.
    let off = S::surface_error(S::from_f64(world.length(diagonal / 4.0)), S::ZERO);
    let least = off.to_f64() / world.scale() + S::SLACK / 8.0 * diagonal;
    if let Some(gap) = gaps::narrow_gap(scene, least, world.rounding) {
        check(gap.width / diagonal, least / diagonal, &|| {
            let [a, b] = gap.objects.map(|i| i + 1);
            format!("the gap between objects {a} and {b} as a share of the scene")
        })?;
    }
    // Fixed point rounds the light of every ray by up to half a step.
    let Some(bits) = S::FRACTION_BITS else {
        return Ok(());
    };
    for (i, surface) in scene.surfaces.iter().enumerate() {
        if surface.shine > 0.0 && surface.specular != [0.0; 3] {
            check(surface.shine, 0.5f64.powi(bits as i32 + 1), &|| {
                format!("the shine of surface {}, which counts as 0,", i + 1)
            })?;
        }
        let rays = path(passed_on(surface), settings.max_depth);
        check(LIGHT / rays, 0.5f64.powi(bits as i32 + 1), &|| {
            let i = i + 1;
            format!("the error allowed to each of {rays:.0} rays via surface {i}")
        })?;
    }
    Ok(())
}

/// Returns the number of rays of a path that count if a surface passes on this share each time.
fn path(share: f64, max_depth: u32) -> f64 {
    let bounces = if share >= 1.0 {
        f64::INFINITY
    } else {
        (LEAST_WEIGHT.ln() / share.ln()).floor()
    };
    1.0 + bounces.min(f64::from(max_depth))
}

/// Returns the distance of a point from the surface of a sphere or a cone.
fn distance(shape: &Shape, point: Point) -> Option<f64> {
    match *shape {
        Shape::Sphere { centre, radius } => {
            Some((length(add(point, times(centre, -1.0))) - radius).abs())
        }
        Shape::Cone {
            base,
            base_radius,
            top,
            top_radius,
        } => {
            // In the plane through the axis and the point: a height and a distance from the axis.
            let along = add(top, times(base, -1.0));
            let height = length(along);
            let from_base = add(point, times(base, -1.0));
            let up = dot(from_base, along) / height;
            let aside = length(add(from_base, times(along, -up / height)));
            // The nearest point of the side, a segment there.
            let rise = top_radius - base_radius;
            let share =
                (up * height + (aside - base_radius) * rise) / (height * height + rise * rise);
            let share = share.clamp(0.0, 1.0);
            Some((up - share * height).hypot(aside - base_radius - share * rise))
        }
        _ => None,
    }
}

fn has_tip(shape: &Shape) -> bool {
    matches!(shape, Shape::Cone { base_radius, top_radius, .. } if base_radius.min(*top_radius) == 0.0)
}

/// Returns the radius of a sphere, the larger radius of a cone, or half the largest side of anything else.
fn size(scene: &Scene, shape: &Shape) -> f64 {
    match *shape {
        Shape::Sphere { radius, .. } => radius,
        Shape::Cone {
            base_radius,
            top_radius,
            ..
        } => base_radius.max(top_radius),
        _ => {
            let [low, high]: [Point; 2] = shape_box(scene, shape);
            let sides = [0, 1, 2].map(|i| high[i] - low[i]);
            sides.into_iter().fold(0.0, f64::max) / 2.0
        }
    }
}
