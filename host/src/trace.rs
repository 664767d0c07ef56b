//! `octray trace`: tells what every ray of one pixel meets, as a tree (thesis, figure 4).

mod node;
mod pair;
mod svg;
mod text;
mod through;

pub(crate) use node::{Names, Object};

use node::Node;
use octray_prepare::{Arith, Format, RenderSettings};
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::renderer;
use octray_render::scene_file;
use octray_render::tile::{Intensity, Level};
use octray_scenes::model::Scene;
use octray_scenes::reduce::Reduction;
use serde::Serialize;
use std::path::PathBuf;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Trees of more rays than this are not drawn; the looks at the number are a thousand rays apart.
const MOST_RAYS: u64 = 50_000;

/// Everything that `octray trace` was asked to do.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceJob {
    /// The scene file.
    pub scene: PathBuf,
    /// What is left out of it.
    pub reduction: Reduction,
    /// Column and row of the pixel, counted from 0 at the upper left corner.
    pub pixel: (u32, u32),
    /// What to render; its arithmetic is ignored.
    pub settings: RenderSettings,
    /// One arithmetic, or two to be compared.
    pub ariths: Vec<Arith>,
    /// Whether to go straight through all surfaces instead, and tell each.
    pub through: bool,
    /// The form of the tree.
    pub format: TraceFormat,
    /// Where to write it; standard output if `None`.
    pub output: Option<PathBuf>,
}

/// The form in which a tree is told.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum TraceFormat {
    /// Lines for a terminal.
    #[default]
    Text,
    /// One JSON object.
    Json,
    /// A drawing.
    Svg,
}

/// A pixel in one arithmetic, or in two.
#[derive(Clone, Debug, Serialize)]
struct Report {
    /// The scene file as it was named.
    scene: String,
    /// Column and row.
    pixel: (u32, u32),
    /// Columns and rows of the picture.
    size: (u32, u32),
    /// One for each arithmetic.
    traces: Vec<Trace>,
    /// Where two arithmetics part.
    #[serde(skip_serializing_if = "Option::is_none")]
    differences: Option<Vec<pair::Parting>>,
}

/// A pixel in one arithmetic.
#[derive(Clone, Debug, Serialize)]
struct Trace {
    /// The arithmetic that was asked for.
    arith: Arith,
    /// The number format.
    format: Format,
    /// The pixel as it is in the picture.
    level: Level,
    /// The same in floating point.
    intensity: Intensity,
    /// The camera's rays.
    rays: Vec<Node>,
}

/// Traces the pixel and tells its tree.
///
/// # Errors
/// [`Error::Usage`] if the pixel is outside of the picture; if the scene is refused, does not fit the arithmetic, takes
/// too many rays, or the result cannot be written.
pub fn run(job: &TraceJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.output {
        output::probe(path)?;
    }
    let (mut scene, lines) = scene_file::read_with_lines(&job.scene, job.reduction)?;
    let size = job.settings.size_of(&scene);
    let (column, row) = job.pixel;
    if column >= size.0 || row >= size.1 {
        return Err(Error::Usage(format!(
            "pixel {column},{row} is outside of the picture, whose last one is {},{}",
            size.0 - 1,
            size.1 - 1
        )));
    }
    let names = Names::new(&scene, &lines);
    if job.through {
        scene.lights.clear();
        scene.surfaces.fill(through::GLASS);
    }
    let traces = (job.ariths.iter())
        .map(|&arith| trace(job, &scene, &names, arith, interrupt))
        .collect::<Result<Vec<_>, _>>()?;
    let report = Report {
        scene: job.scene.display().to_string(),
        pixel: job.pixel,
        size,
        differences: match &*traces {
            [a, b] => Some(pair::differences(&a.rays, &b.rays)),
            _ => None,
        },
        traces,
    };
    if job.through {
        return through::write(job, &report, interrupt);
    }
    let write = |out: &mut dyn std::io::Write| match job.format {
        TraceFormat::Text => write!(out, "{}", text::Tree(&report)),
        TraceFormat::Svg => write!(out, "{}", svg::Drawing(&report)),
        TraceFormat::Json => {
            serde_json::to_writer(&mut *out, &report)?;
            writeln!(out)
        }
    };
    match &job.output {
        Some(path) => output::write_file(path, interrupt, write),
        None => output::write_stdout(interrupt, write),
    }
}

/// Traces the pixel in one arithmetic.
fn trace(
    job: &TraceJob,
    scene: &Scene,
    names: &Names,
    arith: Arith,
    interrupt: &Interrupt,
) -> Result<Trace, Error> {
    let settings = match job.through {
        false => job.settings,
        true => through::settings(job.settings),
    };
    let settings = RenderSettings { arith, ..settings };
    let renderer = renderer::prepare(scene, &settings)?;
    interrupt.check()?;
    let limited = interrupt.with_budget(MOST_RAYS);
    let mut worker = renderer.worker(&limited);
    let pixel = worker.trace_pixel(job.pixel.0, job.pixel.1);
    // Every ray is off the budget now.
    drop(worker);
    limited.check().map_err(|error| match error {
        Error::TooManyRays(_) => Error::Failed(format!(
            "more than {} rays colour this pixel: lower --max-depth, or raise --cut-off",
            thousands(MOST_RAYS)
        )),
        other => other,
    })?;
    Ok(Trace {
        arith,
        format: renderer.built().format,
        level: pixel.level,
        intensity: pixel.intensity,
        rays: pixel.rays.iter().map(|ray| names.node(ray)).collect(),
    })
}
