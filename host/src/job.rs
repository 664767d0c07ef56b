//! What to render and how: a command line that has been checked.

use crate::deal::Policy;
use crate::packets::Shape;
use crate::picture::{Format, RasDepth, Target};
use clap::ValueEnum;
use octray_engine::options::{Arith, TreeOptions, ViewOptions};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread::available_parallelism;

/// Everything `octray render` was asked for. Values are in the ranges given; nothing contradicts.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderJob {
    /// The scene file.
    pub scene: PathBuf,
    /// The picture to write.
    pub output: Target,
    /// Bits per pixel if the picture is a Sun rasterfile.
    pub ras_depth: RasDepth,
    /// The arithmetic to trace in.
    pub arith: Arith,
    /// The octree to build.
    pub tree: TreeOptions,
    /// What to trace.
    pub view: ViewOptions,
    /// How the work is dealt out.
    pub work: WorkOptions,
    /// What to tell about it.
    pub stats: StatsFormat,
}

impl RenderJob {
    /// For a picture that stays in memory: no file is named.
    pub fn in_memory(
        arith: Arith,
        tree: TreeOptions,
        view: ViewOptions,
        work: WorkOptions,
    ) -> Self {
        Self {
            scene: PathBuf::new(),
            output: Target {
                path: PathBuf::new(),
                format: Format::Png,
            },
            ras_depth: RasDepth::default(),
            arith,
            tree,
            view,
            work,
            stats: StatsFormat::None,
        }
    }
}

/// How the work is dealt out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkOptions {
    /// How many threads trace.
    pub threads: NonZeroUsize,
    /// Which thread gets which packet; chosen for the scene ([`crate::packing`]) if `None`.
    pub policy: Option<Policy>,
    /// How large packets are, rows and columns even with four pixels per ray; chosen if `None`.
    pub packet: Option<Shape>,
    /// Whether each thread stays on one core.
    pub pin: bool,
    /// Whether the ranks of an MPI job share the work, each on one thread.
    pub mpi: bool,
}

/// One thread for each core, the packing chosen.
impl Default for WorkOptions {
    fn default() -> Self {
        Self {
            threads: available_parallelism().unwrap_or(NonZeroUsize::MIN),
            policy: None,
            packet: None,
            pin: false,
            mpi: false,
        }
    }
}

/// In which form statistics are told on standard output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum StatsFormat {
    /// A summary to read.
    #[default]
    Text,
    /// One JSON object.
    Json,
    /// Nothing.
    None,
}
