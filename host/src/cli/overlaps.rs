//! Arguments of `octray overlaps`.

use crate::overlaps::OverlapsJob;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `octray overlaps`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Spheres and boxes are closed; cones, polygons and patches are open. Two objects cross if points of one surface lie on both \
sides of the other; one is inside a closed one if nothing of it is outside. What only touches, also along a common edge or \
face, is not listed. Two cones are compared along 256 lines and 65 circles of each, and flat shapes with those circles; \
all other tests are exact.")]
pub struct OverlapsArgs {
    /// The scene file
    scene: PathBuf,
    /// Print one JSON array instead of text
    #[arg(long)]
    json: bool,
}

impl OverlapsArgs {
    /// Returns the job.
    pub fn job(self) -> OverlapsJob {
        OverlapsJob {
            scene: self.scene,
            json: self.json,
        }
    }
}
