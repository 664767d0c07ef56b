//! `octray report`: one page with all results for some scenes.
//!
//! Each part is a section of the page, in this order: `pictures` in every arithmetic and where they differ; `costs`,
//! the charts of accuracy against cost; `boards`, table III and sizes from the newest record of `octray measure`;
//! `limits`, the maps of where methods fail.

mod boards;
mod costs;
mod limits;
mod pictures;

use crate::chart::ChartJob;
use crate::measure::frames;
use crate::page::{self, Section};
use octray_prepare::Arith;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use octray_scenes::name::Shown;
use octray_scenes::reduce::Reduction;
use octray_stability::method::Method;
use std::num::NonZeroUsize;
use std::path::PathBuf;

const TITLE: &str = "What speed costs in accuracy";
const ABOUT: &str = "The cost of rendering in every arithmetic, where each method fails, and what microcontrollers need.";

/// Everything that `octray report` was asked to do.
#[derive(Clone, Debug)]
pub struct ReportJob {
    /// The page to write.
    pub output: PathBuf,
    /// The arithmetics of the pictures.
    pub ariths: Vec<Arith>,
    /// Columns and rows of the pictures.
    pub size: (u32, u32),
    /// What to chart: scenes, settings and kinds of cost.
    pub chart: ChartJob,
    /// The methods whose limits are shown.
    pub methods: Vec<Method>,
    /// The number of threads that measure them.
    pub threads: NonZeroUsize,
}

/// Renders, measures, and writes the page.
///
/// # Errors
/// If a scene is refused, the page cannot be written, or the work is interrupted. If a tool that counts costs is
/// missing, the page says so.
pub fn run(job: &ReportJob, interrupt: &Interrupt) -> Result<(), Error> {
    output::probe(&job.output)?;
    let scenes = frames::scenes(&job.chart.scenes, Reduction::default())?;
    let progress = Bar::new("rendering");
    progress.start(scenes.len() * job.ariths.len());
    let pictures = (scenes.iter().enumerate())
        .map(|(i, (path, scene))| pictures::section(i, scene, path, job, &progress, interrupt))
        .collect::<Result<Vec<Section>, _>>()?;
    drop(progress);
    let mut sections = pictures;
    sections.push(costs::section(scenes, &job.chart, interrupt)?);
    sections.extend(boards::sections(interrupt)?);
    sections.push(limits::section(job, interrupt)?);
    let page = page::of(TITLE, ABOUT, &sections).into_string();
    output::write_file(&job.output, interrupt, |out| out.write_all(page.as_bytes()))?;
    let summary = format!("{}: {} bytes\n", Shown(&job.output), page.len());
    output::write_report([&job.output], interrupt, |out| {
        out.write_all(summary.as_bytes())
    })
}
