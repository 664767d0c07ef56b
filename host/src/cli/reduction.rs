//! Arguments that leave out a part of the scene, for all commands that trace one.

use clap::Args;
use octray_scenes::reduce::Reduction;

/// Arguments that leave out a part of the scene.
#[derive(Clone, Copy, Debug, Args)]
pub struct ReductionArgs {
    /// Keep only the first N lights of the scene; 0 leaves ambient light [default: all]
    #[arg(long, value_name = "N", help_heading = SCENE)]
    lights: Option<u32>,
    /// Let no surface reflect or refract
    #[arg(long, help_heading = SCENE)]
    opaque: bool,
}

const SCENE: &str = "Scene";

impl ReductionArgs {
    /// Returns what is left out.
    pub fn reduction(self) -> Reduction {
        Reduction {
            lights: self.lights.map(|lights| lights as usize),
            opaque: self.opaque,
        }
    }
}
