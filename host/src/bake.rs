//! `octray bake`: a scene as constant tables, Rust source for a program without files.

use crate::check;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::output;
use clap::ValueEnum;
use octray_core::accel::{self, COMPACT_MAX_DEPTH};
use octray_engine::options::{Arith, PixelsPerRay};
use octray_scenes::bake::{Options, Tree, bake};
use octray_scenes::plan::Plan;
use octray_scenes::quantise::View;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// What to bake, and where to write it.
#[derive(Clone, Debug, PartialEq)]
pub struct BakeJob {
    /// The scene file.
    pub scene: PathBuf,
    /// The arithmetic to render in.
    pub arith: Arith,
    /// Columns and rows; the scene's own if `None`.
    pub size: Option<(u32, u32)>,
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// What finds the objects.
    pub tree: TreeKind,
    /// The most bounces.
    pub max_depth: u32,
    /// The weight below which a ray is not traced, 0 to 1.
    pub cut_off: f64,
    /// Objects up to which a node is not divided.
    pub leaf_size: u32,
    /// A plan that says all of these.
    pub plan: Option<PathBuf>,
    /// The Rust source; standard output if `None`.
    pub output: Option<PathBuf>,
}

/// The trees of baked scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TreeKind {
    /// Up to eight tight boxes per node in few bytes, walked in integers.
    #[default]
    Packed,
    /// The same, built by the device in its own memory.
    Device,
    /// None: every ray tries every object.
    None,
}

/// Bake the scene and write the source.
///
/// # Errors
/// When the scene is refused, does not fit the arithmetic or the tree, or the source cannot be written.
pub fn run(job: &BakeJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.output {
        output::probe(path)?;
    }
    let scene = check::read(&job.scene)?;
    interrupt.check()?;
    let name = job
        .scene
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let plan = job.plan.as_ref().map(|path| read_plan(path)).transpose()?;
    let growth = accel::BuildOptions {
        depth: COMPACT_MAX_DEPTH,
        leaf_size: job.leaf_size,
    };
    let chosen = Options {
        name: &name,
        view: View {
            size: job.size,
            pixels_per_ray: job.pixels_per_ray.number(),
            samples: 1,
            max_depth: job.max_depth,
        },
        cut_off: job.cut_off,
        tree: match job.tree {
            TreeKind::Packed => Tree::Packed(growth),
            TreeKind::Device => Tree::Device(growth),
            TreeKind::None => Tree::None,
        },
        rays: None,
    };
    let (arith, options) = match &plan {
        Some(plan) => {
            let options = plan.options(&scene, &name);
            (
                plan.arith,
                options.map_err(|why| Error::Failed(why.to_string()))?,
            )
        }
        None => (job.arith.name(), chosen),
    };
    let baked = bake(&scene, arith, &options).map_err(|error| Error::Failed(error.to_string()))?;
    interrupt.check()?;
    let write = |out: &mut dyn Write| -> io::Result<()> { out.write_all(baked.source.as_bytes()) };
    match &job.output {
        Some(path) => output::write_file(path, interrupt, write),
        None => output::write_stdout(interrupt, write),
    }
}

/// Reads a plan that `octray plan --emit` has written.
///
/// # Errors
/// If it cannot be read, or is none.
pub fn read_plan(path: &Path) -> Result<Plan, Error> {
    let text = fs::read_to_string(path).map_err(|cause| Error::read(path, cause))?;
    text.parse()
        .map_err(|why| Error::Failed(format!("{}: {why}", path.display())))
}
