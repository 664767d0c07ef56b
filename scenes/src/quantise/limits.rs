//! What cannot be scaled: light, coefficients, refraction indices. Interval bounds over the scene
//! say how large they and all that is computed from them can become.

use crate::model::Scene;
use octray_core::scalar::Quantize;
use std::fmt;

/// A value of the scene that a format cannot hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Overflow {
    /// The format's name.
    pub format: &'static str,
    /// What would overflow.
    pub what: String,
    /// How large it can become.
    pub value: f64,
    /// What the format holds.
    pub limit: f64,
}

impl fmt::Display for Overflow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            format,
            what,
            value,
            limit,
        } = self;
        write!(
            f,
            "{format} holds numbers below {limit}, but {what} can reach {value:.6}"
        )
    }
}

impl std::error::Error for Overflow {}

/// Checks that nothing that is computed from the scene's colours and coefficients overflows.
///
/// # Errors
/// The first value that would.
pub fn limits<S: Quantize>(scene: &Scene, max_depth: u32) -> Result<(), Overflow> {
    let limit = S::MAX.to_f64() * (1.0 - 1e-6);
    let floating = S::FRACTION_BITS.is_none();
    let check = |value: f64, what: &dyn Fn() -> String| {
        if value < limit {
            return Ok(());
        }
        Err(Overflow {
            format: S::NAME,
            what: what(),
            value,
            limit: S::MAX.to_f64(),
        })
    };
    let largest = |c: [f64; 3]| c.into_iter().fold(0.0, f64::max);
    check(largest(scene.background), &|| "the background".into())?;
    for (i, light) in scene.lights.iter().enumerate() {
        check(largest(light.colour), &|| {
            format!("the brightness of light {}", i + 1)
        })?;
    }
    for (i, surface) in scene.surfaces.iter().enumerate() {
        let name = |what: &str| format!("{what} of surface {}", i + 1);
        let response = [0, 1, 2].map(|c| surface.diffuse[c] + surface.specular[c]);
        check(largest(response), &|| name("diffuse and specular light"))?;
        let lit = [0, 1, 2].map(|c| {
            let light: f64 = scene.lights.iter().map(|l| l.colour[c]).sum();
            surface.ambient[c] + light * response[c]
        });
        check(largest(lit), &|| name("the light"))?;
        let bend = surface.ior.max(1.0 / surface.ior);
        check(bend * bend, &|| name("the square of the refraction index"))?;
        let share = surface.reflect.max(surface.refract);
        let weight = share.max(1.0).powi(max_depth.min(1000) as i32);
        check(weight, &|| name("the weight of reflected rays"))?;
        // A contribution is at most this before it is added up and clamped.
        check(weight * largest(lit), &|| name("the reflected light"))?;
        if !floating && surface.refract > 1.0 {
            return Err(Overflow {
                format: S::NAME,
                what: name("the transmitted share"),
                value: surface.refract,
                limit: 1.0,
            });
        }
    }
    Ok(())
}
