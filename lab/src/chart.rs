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
use crate::measure::frames::{self, Named};
use accuracy::{Accuracy, Judge};
use cost::{CostKind, Meter};
use figure::Chart;
use octray_prepare::RenderSettings;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use point::{Panel, Wishes};
use setting::Grid;
use std::num::NonZeroUsize;
use std::path::PathBuf;

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
    output::write_stdout(interrupt, |out| {
        out.write_all(report::text(&panels).as_bytes())
    })
}

/// The points of every scene: a panel for each kind of cost.
///
/// # Errors
/// When a tool is missing, a scene is refused, or there is no point at all.
pub fn measure(job: &ChartJob, interrupt: &Interrupt) -> Result<Vec<Panel>, Error> {
    let scenes = frames::scenes(&job.scenes)?;
    // What is missing is told before any work.
    let meter = Meter::new(job, &job.costs, interrupt)?;
    panels(&judge(scenes, job, interrupt)?, job, &job.costs, &meter)
}

/// A scene, and how far off its picture is with each setting; or why it has none.
pub struct Judged {
    path: PathBuf,
    scene: Named,
    outcomes: Vec<(RenderSettings, Result<Accuracy, String>)>,
}

/// How far off every picture of every scene is.
///
/// # Errors
/// When a scene does not even fit f64, or the work is interrupted.
pub fn judge(
    scenes: Vec<(PathBuf, Named)>,
    job: &ChartJob,
    interrupt: &Interrupt,
) -> Result<Vec<Judged>, Error> {
    let settings = job.grid.settings(job.size);
    let progress = Bar::new("judging");
    progress.start(scenes.len() * settings.len());
    let judged = |(path, scene): (PathBuf, Named)| {
        let mut judge = Judge::new(&scene.scene, job, interrupt)?;
        let outcomes = (settings.iter())
            .map(|setting| {
                let accuracy = judge.accuracy(setting)?;
                progress.step();
                Ok((*setting, accuracy))
            })
            .collect::<Result<_, Error>>()?;
        Ok(Judged {
            path,
            scene,
            outcomes,
        })
    };
    scenes.into_iter().map(judged).collect()
}

/// The points of every scene that has been judged: a panel for each of some kinds of cost.
///
/// # Errors
/// When a tool fails, the work is interrupted, or there is no point at all.
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
    /// The scene's points on one scale of cost.
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
        Ok(Panel::new(
            &self.scene.name,
            &self.path,
            kind,
            job,
            measured.collect(),
        ))
    }
}
