//! Measures frames on boards: builds, runs, counts, and compares them with the host's.

use super::board::Board;
use super::emulate::Emulator;
use super::job::{FirmwareOptions, MeasureJob};
use super::memory::Memory;
use super::reference::{self, Reference};
use super::row::{Cost, FrameRow};
use super::source_tree::SourceTree;
use crate::tables::subject::FIGURES;
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, RenderSettings};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::progress::Progress;
use octray_render::render::Rendering;
use octray_render::scene_file;
use octray_scenes::model::Scene;
use octray_scenes::name;
use octray_scenes::reduce::Reduction;
use std::fs;
use std::path::{Path, PathBuf};

/// The functions whose calls are the search for the object that a ray hits.
pub const SEARCH: &str = "nearest:any_hit:blocks";

/// A parsed scene with its name.
#[derive(Debug)]
pub struct NamedScene {
    /// Its name: the file's, without folder and extension.
    pub name: String,
    /// The file, relative to the root.
    pub path: PathBuf,
    /// What was left out of the file's scene.
    pub reduction: Reduction,
    /// The scene.
    pub scene: Scene,
}

impl NamedScene {
    /// Reads a scene file, and leaves out what is said.
    ///
    /// # Errors
    /// If it cannot be read, has mistakes, or too few lights.
    pub fn read(path: &Path, reduction: Reduction) -> Result<Self, Error> {
        let scene = scene_file::read_reduced(path, reduction)?;
        let path = fs::canonicalize(path).map_err(|cause| Error::read(path, cause))?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Self {
            name: name::line(&name),
            path: path.clone(),
            reduction,
            scene,
        })
    }
}

/// Reads the named scenes, or the five figures of octray's sources. Each is returned with its path for output.
///
/// # Errors
/// If one cannot be read, has mistakes, or too few lights.
pub fn scenes(
    named: &[PathBuf],
    reduction: Reduction,
) -> Result<Vec<(PathBuf, NamedScene)>, Error> {
    let read = |name: PathBuf, path: &Path| Ok((name, NamedScene::read(path, reduction)?));
    if !named.is_empty() {
        let named = named.iter();
        return named.map(|path| read(path.clone(), path)).collect();
    }
    let root = SourceTree::root()?;
    (FIGURES.iter())
        .map(|figure| {
            let name = PathBuf::from(format!("scenes/{}.scene", figure.name));
            let path = root.join(&name);
            read(name, &path)
        })
        .collect()
}

/// The environment of measurements.
pub struct Bench<'a> {
    /// The firmware's sources.
    pub sources: &'a SourceTree,
    /// The boards' emulator.
    pub emulator: &'a Emulator<'a>,
    /// Displays the progress.
    pub progress: &'a dyn Progress,
    /// Requests a stop.
    pub interrupt: &'a Interrupt,
}

impl Bench<'_> {
    /// Measures every scene in every arithmetic on every board, in this order.
    ///
    /// # Errors
    /// [`Error::Interrupted`], or if cargo or the emulator cannot be run. The row of a combination that fails states
    /// why.
    pub fn frames(&self, scenes: &[NamedScene], job: &MeasureJob) -> Result<Vec<FrameRow>, Error> {
        let mut rows = Vec::new();
        for scene in scenes {
            let exact = self.exact(scene, &job.settings)?;
            for &arith in &job.ariths {
                let exact = exact.as_ref().map_err(|rays| Error::TooManyRays(*rays));
                let reference = exact.and_then(|exact| {
                    Reference::render(&scene.scene, arith, &job.settings, exact, self.interrupt)
                });
                for &board in &job.boards {
                    let mut row = row(scene, arith, board, job);
                    let measured = match &reference {
                        Err(Error::Interrupted) => return Err(Error::Interrupted),
                        Err(refused) => Err(format!("refused: {refused}")),
                        Ok(reference) => self.frame(scene, arith, board, job, reference)?,
                    };
                    match measured {
                        Ok((cost, functions)) => {
                            (row.cost, row.functions) = (Some(cost), functions);
                        }

                        Err(why) => row.outcome = why,
                    }
                    rows.push(row);
                    self.progress.step();
                }
            }
        }
        Ok(rows)
    }

    /// Renders in 64-bit floats; says why not if that takes too many rays.
    fn exact(
        &self,
        scene: &NamedScene,
        settings: &RenderSettings,
    ) -> Result<Result<Rendering, u64>, Error> {
        match reference::render(&scene.scene, Arith::F64, settings, self.interrupt) {
            Err(Error::TooManyRays(rays)) => Ok(Err(rays)),
            other => other.map(Ok),
        }
    }

    /// Measures one combination: its cost and its functions, or why there is none.
    fn frame(
        &self,
        scene: &NamedScene,
        arith: Arith,
        board: &Board,
        job: &MeasureJob,
        reference: &Reference,
    ) -> Result<Result<(Cost, Functions), String>, Error> {
        let program = match self.firmware(scene, arith, board, &job.settings, job.build)? {
            Ok(program) => program,
            Err(why) => return Ok(Err(format!("not built: {why}"))),
        };
        let run = match self.emulator.run(board, &program, self.interrupt)? {
            Ok(run) => run,
            Err(why) => return Ok(Err(why)),
        };
        let file = fs::read(&program).map_err(|cause| Error::read(&program, cause))?;
        let memory = Memory::of(&file)
            .map_err(|cause| Error::Failed(format!("{}: {cause}", program.display())))?;
        let value = |name| run.values.get(name).cloned().unwrap_or_default();
        let (hash, expected) = (value("hash"), reference.traced.picture.hash());
        if hash != format!("{expected:016x}") {
            return Ok(Err(format!(
                "wrong picture: its hash is {hash}, the host's {expected:016x}"
            )));
        }
        let Ok(stack) = value("stack").parse() else {
            return Ok(Err("its stack is not known".into()));
        };
        let cost = Cost::new(board, &run.count, reference, memory, stack, hash);
        Ok(Ok((cost, run.count.functions)))
    }

    /// Builds the firmware.
    fn firmware(
        &self,
        scene: &NamedScene,
        arith: Arith,
        board: &Board,
        settings: &RenderSettings,
        options: FirmwareOptions,
    ) -> Result<Result<PathBuf, String>, Error> {
        let (width, height) = settings.size.unwrap_or_default();
        let size = format!("{width}x{height}");
        let depth = settings.max_depth.to_string();
        let pixels = settings.pixels_per_ray.number().to_string();
        let cut_off = settings.cut_off.to_string();
        let path = scene.path.to_string_lossy();
        let lights = scene.scene.lights.len().to_string();
        let opaque = u8::from(scene.reduction.opaque).to_string();
        let variables = [
            ("OCTRAY_SCENE", &*path),
            ("OCTRAY_LIGHTS", &lights),
            ("OCTRAY_OPAQUE", &opaque),
            ("OCTRAY_ARITH", arith.name()),
            ("OCTRAY_SIZE", &size),
            ("OCTRAY_MAX_DEPTH", &depth),
            ("OCTRAY_PIXELS_PER_RAY", &pixels),
            ("OCTRAY_CUT_OFF", &cut_off),
            ("OCTRAY_TREE", options.tree.name()),
        ];
        let firmware = ("octray-firmware", None);
        (self.sources).firmware(
            firmware,
            board,
            options.optimize,
            &variables,
            self.interrupt,
        )
    }
}

/// Functions and their own instructions.
type Functions = Vec<(String, u64)>;

fn row(scene: &NamedScene, arith: Arith, board: &'static Board, job: &MeasureJob) -> FrameRow {
    FrameRow {
        scene: scene.name.clone(),
        objects: scene.scene.objects.len(),
        lights: scene.scene.lights.len(),
        opaque: scene.reduction.opaque,
        width: job.settings.size.map_or(0, |size| size.0),
        height: job.settings.size.map_or(0, |size| size.1),
        max_depth: job.settings.max_depth,
        pixels_per_ray: job.settings.pixels_per_ray.number(),
        cut_off: job.settings.cut_off,
        board,
        arith,
        tree: job.build.tree,
        optimize: job.build.optimize,
        outcome: "ok".into(),
        cost: None,
        functions: Vec::new(),
    }
}
