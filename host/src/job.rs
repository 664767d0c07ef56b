//! The job of `octray render`: a checked command line.

use octray_prepare::RenderSettings;
use octray_render::picture::{RasDepth, Target};
use octray_render::schedule::Schedule;
use octray_scenes::reduce::Reduction;
use std::path::PathBuf;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Everything that `octray render` was asked to do. Values are in range and do not contradict each other.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderJob {
    /// The scene file.
    pub scene: PathBuf,
    /// What is left out of it.
    pub reduction: Reduction,
    /// The picture to write.
    pub output: Target,
    /// Bits per pixel if the picture is a Sun rasterfile.
    pub ras_depth: RasDepth,
    /// What to render.
    pub settings: RenderSettings,
    /// How the work is shared.
    pub work: Schedule,
    /// Whether the ranks of an MPI job share the work, each on one thread.
    pub mpi: bool,
    /// Whether to draw lines where the object that is seen changes, instead of surfaces.
    pub wire: bool,
    /// Several pictures instead of one.
    pub frames: Option<FramesJob>,
    /// What to report on standard output.
    pub stats: StatsFormat,
}

/// Pictures from viewpoints along a path.
#[derive(Clone, Debug, PartialEq)]
pub struct FramesJob {
    /// How many; one for each view of a file if `None`.
    pub count: Option<u32>,
    /// The path.
    pub path: ViewPath,
    /// Where they go.
    pub files: FrameFiles,
}

/// A path of viewpoints.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewPath {
    /// About what the camera looks at, through this many degrees.
    Orbit(f64),
    /// Through the views in a file.
    File(PathBuf),
}

/// Where frames go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameFiles {
    /// Each into a file of its own, whose name has its number.
    Numbered,
    /// All into one animated PNG.
    Animation {
        /// Frames in a second.
        per_second: u16,
    },
}

/// The form in which statistics are printed.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum StatsFormat {
    /// A readable summary.
    #[default]
    Text,
    /// One JSON object.
    Json,
    /// Nothing.
    None,
}
