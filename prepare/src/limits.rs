//! What cannot be scaled: light, coefficients, refraction indices. Interval bounds over the scene
//! say how large they and all that is computed from them can become.

use octray_core::quantize::Quantize;
use octray_scenes::model::Scene;
use thiserror::Error;

/// Why a format cannot have a scene.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Overflow {
    /// A value that the format cannot hold.
    #[error("{format} holds numbers below {limit}, but {what} can reach {value:.6}")]
    Range {
        /// The format's name.
        format: &'static str,
        /// What would overflow.
        what: String,
        /// How large it can become.
        value: f64,
        /// What the format holds.
        limit: f64,
    },
    /// A surface that lets more light through than it gets: only floats take that, whose own light is then
    /// less than none.
    #[error("{format} takes transmitted shares up to 1, but that of surface {surface} is {share}")]
    Share {
        /// The format's name.
        format: &'static str,
        /// The surface, the first being 1.
        surface: usize,
        /// Its share.
        share: f64,
    },
}

/// How large something can become that is computed from a scene's colours and coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// What.
    pub what: String,
    /// How large, at most.
    pub value: f64,
}

/// The bounds of all that cannot be scaled, for rays that bounce at most `max_depth` times.
pub fn bounds(scene: &Scene, max_depth: u32) -> Vec<Bound> {
    let mut bounds = Vec::new();
    let mut bound = |value, what| bounds.push(Bound { what, value });
    let largest = |c: [f64; 3]| c.into_iter().fold(0.0, f64::max);
    bound(largest(scene.background), "the background".into());
    for (i, light) in scene.lights.iter().enumerate() {
        let what = format!("the brightness of light {}", i + 1);
        bound(largest(light.colour), what);
    }
    for (i, surface) in scene.surfaces.iter().enumerate() {
        let name = |what: &str| format!("{what} of surface {}", i + 1);
        let response = [0, 1, 2].map(|c| surface.diffuse[c] + surface.specular[c]);
        bound(largest(response), name("diffuse and specular light"));
        let lit = [0, 1, 2].map(|c| {
            let light: f64 = scene.lights.iter().map(|l| l.colour[c]).sum();
            surface.ambient[c] + light * response[c]
        });
        bound(largest(lit), name("the light"));
        let bend = surface.ior.max(1.0 / surface.ior);
        bound(bend * bend, name("the square of the refraction index"));
        let share = surface.reflect.max(surface.refract);
        let weight = share.max(1.0).powi(max_depth.min(1000) as i32);
        bound(weight, name("the weight of reflected rays"));
        // A contribution is at most this before it is added up and clamped.
        bound(weight * largest(lit), name("the reflected light"));
    }
    bounds
}

/// Checks that nothing that is computed from the scene's colours and coefficients overflows.
///
/// # Errors
/// The first value that would.
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
