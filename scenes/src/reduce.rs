//! Scenes with less in them: fewer lights, no mirrors and no glass.
//!
//! ```
//! use octray_scenes::reduce::Reduction;
//!
//! let mut scene = octray_scenes::parse("v 0 0 9  l 1 1 1 1  l 2 2 2 1  f 1 1 1 0.5 0.5 9 0.8 1.5")?;
//! Reduction { lights: Some(1), opaque: true }.apply(&mut scene)?;
//! assert_eq!(scene.lights.len(), 1);
//! assert_eq!((scene.surfaces[0].reflect, scene.surfaces[0].refract), (0.0, 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::model::{Scene, Surface};
use thiserror::Error;

/// What is left out of a scene before it is traced; nothing by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reduction {
    /// How many of the first lights are kept; all if `None`.
    pub lights: Option<usize>,
    /// Whether no surface reflects or refracts.
    pub opaque: bool,
}

/// The scene has fewer lights than are to be kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the first {wanted} lights are asked for, but the scene has {found}")]
pub struct TooFewLights {
    /// How many were asked for.
    pub wanted: usize,
    /// How many there are.
    pub found: usize,
}

impl Reduction {
    /// Reduces a scene. The lights that stay are as bright as before: in NFF a light without a colour has the brightness
    /// of one among all the file's.
    ///
    /// # Errors
    /// [`TooFewLights`]; the scene is then as before.
    pub fn apply(self, scene: &mut Scene) -> Result<(), TooFewLights> {
        let found = scene.lights.len();
        if let Some(wanted) = self.lights {
            if wanted > found {
                return Err(TooFewLights { wanted, found });
            }
            scene.lights.truncate(wanted);
        }
        if self.opaque {
            for surface in &mut scene.surfaces {
                *surface = Surface {
                    reflect: 0.0,
                    refract: 0.0,
                    ior: 1.0,
                    ..*surface
                };
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "v 0 0 9 l 1 0 0 1 l 2 0 0 1 l 3 0 0 1
        f 1 1 1 1 1 1 0 0 0 1 0.5 0  f 1 1 1 1 1 1 0 0 0 1 0 0.5 1.5  s 0 0 0 1";

    #[test]
    fn the_first_lights_stay_and_no_light_may_be_asked_for() {
        let whole = crate::parse(SOURCE).unwrap();
        for wanted in 0..=3 {
            let mut scene = whole.clone();
            let reduction = Reduction {
                lights: Some(wanted),
                opaque: false,
            };
            reduction.apply(&mut scene).unwrap();
            assert_eq!(scene.lights, whole.lights[..wanted]);
            assert_eq!(scene.surfaces, whole.surfaces);
        }
    }

    #[test]
    fn more_lights_than_there_are_is_an_error_that_tells_how_many_there_are() {
        let mut scene = crate::parse(SOURCE).unwrap();
        let before = scene.clone();
        let reduction = Reduction {
            lights: Some(4),
            opaque: true,
        };
        let error = reduction.apply(&mut scene).unwrap_err();
        let text = "the first 4 lights are asked for, but the scene has 3";
        assert_eq!(error.to_string(), text);
        assert_eq!(scene, before);
    }

    #[test]
    fn an_opaque_scene_is_a_valid_one_that_neither_mirrors_nor_transmits() {
        let mut scene = crate::parse(SOURCE).unwrap();
        let reduction = Reduction {
            lights: None,
            opaque: true,
        };
        reduction.apply(&mut scene).unwrap();
        assert!(scene.surfaces.iter().all(|s| s.reflect + s.refract == 0.0));
        crate::check::scene(&scene).unwrap();
        assert_eq!((scene.lights.len(), scene.objects.len()), (3, 1));
    }
}
