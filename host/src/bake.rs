//! `octray bake`: turns a scene into constant tables, Rust source for a program without a file system.

#[cfg(not(feature = "lab"))]
use crate::cli::lab::INSTALL_LAB;
use octray_prepare::bake::{BakeOptions, bake};
use octray_prepare::plan::Plan;
use octray_prepare::{FirmwareTree, RenderSettings};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::scene_file;
#[cfg(feature = "lab")]
use octray_scenes::input;
use octray_scenes::name::Shown;
use octray_scenes::reduce::Reduction;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The most bytes of a plan.
#[cfg(feature = "lab")]
const MOST_PLAN: u64 = 1 << 16;

/// What to bake, and where to write it.
#[derive(Clone, Debug, PartialEq)]
pub struct BakeJob {
    /// The scene file.
    pub scene: PathBuf,
    /// What is left out of it.
    pub reduction: Reduction,
    /// What to render. Of the tree's settings only the leaf size is used.
    pub settings: RenderSettings,
    /// The tree.
    pub tree: FirmwareTree,
    /// The target's triple, if it is known.
    pub target: Option<String>,
    /// Two opposite corners of a box in which things can move.
    pub room: Option<[[f64; 3]; 2]>,
    /// A plan that replaces all of these settings.
    pub plan: Option<PathBuf>,
    /// The Rust source; standard output if `None`.
    pub output: Option<PathBuf>,
}

/// Bakes the scene and writes the source.
///
/// # Errors
/// If the scene is refused, does not fit the arithmetic or the tree, or the source cannot be written.
pub fn run(job: &BakeJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.output {
        output::probe(path)?;
    }
    let read = |path| read_plan(path).map(|plan| (path, plan));
    let plan = job.plan.as_deref().map(read).transpose()?;
    let mut scene = scene_file::read_reduced(&job.scene, job.reduction)?;
    scene.room = job.room;
    interrupt.check()?;
    let name = job
        .scene
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let options = match &plan {
        Some((path, plan)) => plan
            .options(&scene, &name)
            .map_err(|why| Error::Failed(format!("{}: {why}", path.display())))?,
        None => {
            let mut settings = job.settings;
            let format = settings.arith.format(&scene, settings.max_depth);
            let target = job.target.as_deref();
            let objects = scene.objects.len();
            settings.tree.kind = job.tree.kind_for(objects, format, target);
            BakeOptions {
                name: &name,
                settings,
                on_device: job.tree.on_device,
                target,
                rays: None,
            }
        }
    };
    let baked = bake(&scene, &options).map_err(|error| Error::Failed(error.to_string()))?;
    interrupt.check()?;
    if let Some(what) = &baked.too_fine {
        // A warning that cannot be written stops nothing.
        let _ = writeln!(
            io::stderr().lock(),
            "warning: {}: too coarse: {what}",
            Shown(&job.scene)
        );
    }
    let write = |out: &mut dyn Write| -> io::Result<()> { out.write_all(baked.source.as_bytes()) };
    match &job.output {
        Some(path) => output::write_file(path, interrupt, write),
        None => output::write_stdout(interrupt, write),
    }
}

/// Reads a plan that `octray plan --emit` wrote.
#[cfg(feature = "lab")]
fn read_plan(path: &Path) -> Result<Plan, Error> {
    let text = input::read_text(path, MOST_PLAN).map_err(|cause| Error::read(path, cause))?;
    text.parse()
        .map_err(|why| Error::Failed(format!("{}: {why}", Shown(path))))
}

/// Reports how to build a command that reads plans.
#[cfg(not(feature = "lab"))]
fn read_plan(_: &Path) -> Result<Plan, Error> {
    Err(Error::Usage(format!(
        "'--plan' is an option of the laboratory: {INSTALL_LAB}"
    )))
}
