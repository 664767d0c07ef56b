//! `octray chart`: what accuracy costs, over arithmetics and settings, and which of them to choose.
//!
//! In the order of the data: every combination of what is asked for is a [`setting`]; [`accuracy`] renders it
//! and tells how far off it is; [`cost`] measures what it takes, by [`callgrind`] where instructions of this
//! machine are counted; [`choose`] finds the points that no other beats, and names some; a panel of [`point`]s; [`figure`] draws them
//! over [axes](axis), with [`label`]s that do not overlap; [`report`] tells them as tables, JSON and CSV.

pub mod accuracy;
pub mod axis;
pub mod callgrind;
pub mod choose;
pub mod cost;
pub mod figure;
pub mod label;
pub mod point;
pub mod report;
pub mod setting;

use crate::canvas;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::measure::FIGURES;
use crate::measure::frames::Named;
use crate::measure::workspace::Workspace;
use crate::output;
use crate::progress::Progress;
use accuracy::Judge;
use cost::{CostKind, Meter};
use figure::Chart;
use point::{Panel, Wishes};
use setting::{Grid, Setting};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Everything `octray chart` was asked for. Nothing contradicts, and there is at least one setting and one kind
/// of cost.
#[derive(Clone, Debug)]
pub struct ChartJob {
    /// The scene files; the five figures if there is none.
    pub scenes: Vec<PathBuf>,
    /// The settings to combine.
    pub grid: Grid,
    /// What is counted as cost: a panel for each.
    pub costs: Vec<CostKind>,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Rays per pixel in each direction of the converged reference.
    pub converged_samples: u32,
    /// Rounds of which the median time counts.
    pub rounds: NonZeroUsize,
    /// What to choose by.
    pub wishes: Wishes,
    /// Where to draw the chart.
    pub output: Option<PathBuf>,
    /// Where to write the points as comma-separated values.
    pub csv: Option<PathBuf>,
    /// Where to write them as JSON.
    pub json: Option<PathBuf>,
}

/// Measure, choose, draw and tell.
///
/// # Errors
/// When a tool is missing, a scene is refused, something cannot be written, or there is no point at all.
pub fn run(job: &ChartJob, interrupt: &Interrupt) -> Result<(), Error> {
    for path in job.output.iter().chain(&job.csv).chain(&job.json) {
        output::probe(path)?;
    }
    let paths = match &*job.scenes {
        [] => {
            let root = Workspace::root()?;
            FIGURES.iter().map(|name| root.join(name)).collect()
        }
        scenes => scenes.to_vec(),
    };
    let scenes: Vec<_> = (paths.iter())
        .map(|path| Named::read(path))
        .collect::<Result<_, _>>()?;
    let meter = Meter::new(job, interrupt)?;
    let progress = Progress::new("measuring");
    progress.start(scenes.len() * job.grid.settings().len() * (1 + job.costs.len()));
    let mut panels = Vec::new();
    for (scene, path) in scenes.iter().zip(&paths) {
        panels.extend(of_scene(scene, path, job, &meter, &progress)?);
    }
    drop(progress);
    if panels.iter().all(|panel| panel.points.is_empty()) {
        let why = panels.iter().flat_map(|panel| &panel.refused).next();
        let why = why.map_or("", |refused| &*refused.why);
        return Err(Error::Failed(format!("there is no point to draw: {why}")));
    }
    if let Some(path) = &job.csv {
        output::write_file(path, interrupt, |out| report::write_csv(&panels, out))?;
    }
    if let Some(path) = &job.json {
        output::write_file(path, interrupt, |out| report::write_json(&panels, out))?;
    }
    if let Some(path) = &job.output {
        canvas::write_figure(path, &Chart::of(&panels), interrupt)?;
    }
    output::write_stdout(interrupt, |out| {
        out.write_all(report::text(&panels).as_bytes())
    })
}

/// A panel for each kind of cost.
fn of_scene(
    scene: &Named,
    path: &Path,
    job: &ChartJob,
    meter: &Meter<'_>,
    progress: &Progress,
) -> Result<Vec<Panel>, Error> {
    let settings = job.grid.settings();
    let mut judge = Judge::new(&scene.scene, job, meter.interrupt)?;
    let mut judged = Vec::new();
    for setting in &settings {
        judged.push(judge.accuracy(setting)?);
        progress.step();
    }
    let fits = |(setting, judged): (&Setting, &Result<_, _>)| judged.is_ok().then_some(*setting);
    let good: Vec<Setting> = (settings.iter().zip(&judged)).filter_map(fits).collect();
    let mut panels = Vec::new();
    for &kind in &job.costs {
        let mut costs = meter.costs(kind, scene, &good, progress)?.into_iter();
        let measured = judged.iter().map(|judged| {
            let accuracy = judged.clone()?;
            let cost = costs.next().unwrap_or_else(|| Err("not measured".into()))?;
            Ok((accuracy, cost))
        });
        let measured: Vec<_> = settings.iter().copied().zip(measured).collect();
        panels.push(Panel::new(&scene.name, path, kind, job, measured));
    }
    Ok(panels)
}
