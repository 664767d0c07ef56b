//! Checks values that cannot be scaled: light, coefficients, refraction indices. Interval bounds over the scene limit
//! these values and everything computed from them.

use octray_core::quantize::Quantize;
use octray_scenes::model::{Scene, Surface};
use thiserror::Error;

/// Why a scene does not fit a format.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Overflow {
    /// A value that the format cannot hold.
    #[error("{format} holds numbers below {limit}, but {what} can reach {value:.6}")]
    Range {
        /// The format's name.
        format: &'static str,
        /// What would overflow.
        what: String,
        /// The largest possible value.
        value: f64,
        /// The limit of the format's numbers.
        limit: f64,
    },
    /// A surface that transmits more light than it receives. Only floats support that, because the share that remains
    /// for the surface's own light is negative.
    #[error("{format} takes transmitted shares up to 1, but that of surface {surface} is {share}")]
    Share {
        /// The format's name.
        format: &'static str,
        /// The surface, counted from 1.
        surface: usize,
        /// Its share.
        share: f64,
    },
}

/// A bound of a value that is computed from a scene's colours and coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The name of the value.
    pub what: String,
    /// The bound.
    pub value: f64,
}

/// Returns bounds of all values that cannot be scaled, for rays with at most `max_depth` bounces.
pub fn bounds(scene: &Scene, max_depth: u32) -> Vec<Bound> {
    let mut bounds = Vec::new();
    let mut bound = |value, what| bounds.push(Bound { what, value });
    let largest = |c: [f64; 3]| c.into_iter().fold(0.0, f64::max);
    let zenith = scene.zenith.unwrap_or_default();
    bound(
        largest(scene.background).max(largest(zenith)),
        "the background".into(),
    );
    for (i, light) in scene.lights.iter().enumerate() {
        let what = format!("the brightness of light {}", i + 1);
        bound(largest(light.colour), what);
    }
    for (i, surface) in scene.surfaces.iter().enumerate() {
        let name = |what: &str| format!("{what} of surface {}", i + 1);
        // Of a checker's two colours the larger.
        let other = (surface.checker).map_or([[0.0; 3]; 2], |c| [c.ambient, c.diffuse]);
        let [ambient, diffuse] = [(surface.ambient, other[0]), (surface.diffuse, other[1])]
            .map(|(a, b)| [0, 1, 2].map(|c| f64::max(a[c], b[c])));
        let response = [0, 1, 2].map(|c| diffuse[c] + surface.specular[c]);
        bound(largest(response), name("diffuse and specular light"));
        let lit = [0, 1, 2].map(|c| {
            let light: f64 = scene.lights.iter().map(|l| l.colour[c]).sum();
            ambient[c] + light * response[c]
        });
        bound(largest(lit), name("the light"));
        let bend = surface.ior.max(1.0 / surface.ior);
        bound(bend * bend, name("the square of the refraction index"));
        let weight = passed_on(surface).max(1.0).powi(max_depth.min(1000) as i32);
        bound(weight, name("the weight of reflected rays"));
        // The most that a contribution can be before it is added and clamped.
        bound(weight * largest(lit), name("the reflected light"));
    }
    bounds
}

/// Returns the largest share of its light that a single ray brings to a surface: at total internal reflection, the
/// transmitted share is mirrored with the other.
pub(crate) fn passed_on(surface: &Surface) -> f64 {
    if surface.refract > 0.0 && surface.ior != 1.0 {
        surface.reflect + surface.refract
    } else {
        surface.reflect.max(surface.refract)
    }
}

/// Checks that no value that is computed from the scene's colours and coefficients overflows.
///
/// # Errors
/// The first value that would overflow.
pub fn limits<S: Quantize>(scene: &Scene, max_depth: u32) -> Result<(), Overflow> {
    let (format, limit) = (S::NAME, S::MAX.to_f64());
    for Bound { what, value } in bounds(scene, max_depth) {
        if value >= limit * (1.0 - 1e-6) {
            return Err(Overflow::Range {
                format,
                what,
                value,
                limit,
            });
        }
    }
    let heavy = (scene.surfaces.iter()).position(|surface| surface.refract > 1.0);
    match heavy {
        Some(i) if S::FRACTION_BITS.is_some() => Err(Overflow::Share {
            format,
            surface: i + 1,
            share: scene.surfaces[i].refract,
        }),
        _ => Ok(()),
    }
}
