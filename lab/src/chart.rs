//! `octray chart`: charts accuracy against cost over arithmetics and settings, and chooses among them.
//!
//! In the order of the data: [`setting`] makes every combination; [`accuracy`] renders each and measures its distance
//! from the reference; [`cost`] measures its cost, with [`callgrind`] if instructions of this machine are counted;
//! [`choose`] finds the Pareto-optimal points and names some; a panel holds [`point`]s; [`figure`] draws them over
//! [axes](axis), with [`label`]s that do not overlap; [`report`] prints them as tables, JSON and CSV.

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
use crate::measure::frames::{self, NamedScene};
use accuracy::{Accuracy, Judge};
use cost::{CostKind, Meter};
use figure::Chart;
use octray_prepare::RenderSettings;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use octray_scenes::reduce::Reduction;
use point::{Panel, Wishes};
use setting::Grid;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Everything that `octray chart` was asked to do. Values do not contradict each other, and there is at least one
/// setting and one kind of cost.
#[derive(Clone, Debug)]
pub struct ChartJob {
    /// The scene files; the five figures if empty.
    pub scenes: Vec<PathBuf>,
    /// The settings to combine.
    pub grid: Grid,
    /// The kinds of cost, one panel each.
    pub costs: Vec<CostKind>,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Rays per pixel in each direction of the converged reference.
    pub converged_samples: u32,
    /// Number of rounds; the median time counts.
    pub rounds: NonZeroUsize,
    /// The criteria of the choices.
    pub wishes: Wishes,
    /// Where to draw the chart.
    pub output: Option<PathBuf>,
    /// Where to write the points as comma-separated values.
    pub csv: Option<PathBuf>,
    /// Where to write them as JSON.
    pub json: Option<PathBuf>,
}

/// Measures, chooses, draws and prints.
///
/// # Errors
/// If a tool is missing, a scene is refused, something cannot be written, or there is no point.
pub fn run(job: &ChartJob, interrupt: &Interrupt) -> Result<(), Error> {
    for path in job.output.iter().chain(&job.csv).chain(&job.json) {
        output::probe(path)?;
    }
    let panels = measure(job, interrupt)?;
    if let Some(path) = &job.csv {
        output::write_file(path, interrupt, |out| report::write_csv(&panels, out))?;
    }
    if let Some(path) = &job.json {
        output::write_file(path, interrupt, |out| report::write_json(&panels, out))?;
    }
    if let Some(path) = &job.output {
        canvas::write_figure(path, &Chart::of(&panels), interrupt)?;
    }
    let results = job.output.iter().chain(&job.csv).chain(&job.json);
    output::write_report(results, interrupt, |out| {
        out.write_all(report::text(&panels).as_bytes())
    })
}

/// Measures the points of every scene: one panel per kind of cost.
///
/// # Errors
/// If a tool is missing, a scene is refused, or there is no point.
pub fn measure(job: &ChartJob, interrupt: &Interrupt) -> Result<Vec<Panel>, Error> {
    let scenes = frames::scenes(&job.scenes, Reduction::default())?;
    // A missing tool is reported before any work.
    let meter = Meter::new(job, &job.costs, interrupt)?;
    panels(&judge(scenes, job, interrupt)?, job, &job.costs, &meter)
}

/// A scene, and the distance of its picture from the reference for each setting, or why there is none.
pub struct Judged {
    path: PathBuf,
    scene: NamedScene,
    outcomes: Vec<(RenderSettings, Result<Accuracy, String>)>,
    unexplored: Option<String>,
}

/// Measures the distance of every picture of every scene.
///
/// # Errors
/// If a scene does not even fit f64, or the work is interrupted.
pub fn judge(
    scenes: Vec<(PathBuf, NamedScene)>,
    job: &ChartJob,
    interrupt: &Interrupt,
) -> Result<Vec<Judged>, Error> {
    let settings = job.grid.settings(job.size);
    let progress = Bar::new("judging");
    progress.start(scenes.len() * settings.len());
    let judged = |(path, scene): (PathBuf, NamedScene)| {
        let mut judge = Judge::new(&scene.scene, job, interrupt)?;
        let outcomes = (settings.iter())
            .map(|setting| {
                let accuracy = judge.accuracy(setting)?;
                progress.step();
                Ok((*setting, accuracy))
            })
            .collect::<Result<_, Error>>()?;
        let unexplored = judge.unexplored().map(Into::into);
        Ok(Judged {
            path,
            scene,
            outcomes,
            unexplored,
        })
    };
    scenes.into_iter().map(judged).collect()
}

/// Measures the points of every judged scene: one panel per kind of cost.
///
/// # Errors
/// If a tool fails, the work is interrupted, or there is no point.
pub fn panels(
    judged: &[Judged],
    job: &ChartJob,
    costs: &[CostKind],
    meter: &Meter<'_>,
) -> Result<Vec<Panel>, Error> {
    let progress = Bar::new("measuring");
    progress.start(judged.len() * job.grid.settings(job.size).len() * costs.len());
    let mut panels = Vec::new();
    for scene in judged {
        for &kind in costs {
            panels.push(scene.panel(kind, job, meter, &progress)?);
        }
    }
    drop(progress);
    if panels.iter().all(|panel| panel.points.is_empty()) {
        let why = panels.iter().flat_map(|panel| &panel.refused).next();
        let why = why.map_or("", |refused| &*refused.why);
        return Err(Error::Failed(format!("there is no point to draw: {why}")));
    }
    Ok(panels)
}

impl Judged {
    /// Returns the scene's points for one kind of cost.
    fn panel(
        &self,
        kind: CostKind,
        job: &ChartJob,
        meter: &Meter<'_>,
        progress: &dyn Progress,
    ) -> Result<Panel, Error> {
        let fits = |(setting, accuracy): &(RenderSettings, Result<_, _>)| {
            accuracy.is_ok().then_some(*setting)
        };
        let good: Vec<RenderSettings> = self.outcomes.iter().filter_map(fits).collect();
        let mut costs = meter.costs(kind, &self.scene, &good, progress)?.into_iter();
        let measured = self.outcomes.iter().map(|(setting, accuracy)| {
            let measured = accuracy.clone().and_then(|accuracy| {
                let cost = costs.next().unwrap_or_else(|| Err("not measured".into()))?;
                Ok((accuracy, cost))
            });
            (*setting, measured)
        });
        let path = &self.path;
        Ok(Panel {
            unexplored: self.unexplored.clone(),
            ..Panel::new(&self.scene.name, path, kind, job, measured.collect())
        })
    }
}
