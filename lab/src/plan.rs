//! `octray plan`: the least a scene needs on a board, each decision with its reason and with what the next
//! cheaper choice would cost.
//!
//! In the order of the data: a checked [`job`]; [`accuracy`] finds by rendering how many bounces, pixels
//! per ray and bits the picture needs; [`events`] counts what happens meanwhile, from which the [`model`]
//! predicts instructions and memory; [`choice`] takes the cheapest arithmetic and tree that fit; and
//! [`report`] tells it, with a remedy if nothing fits; a [`verify`] measures what came of it. The model is
//! [fitted](fit) to a [`record`] of measurements, [`comb`]s among them.

pub mod accuracy;
pub mod choice;
pub mod comb;
pub mod decision;
pub mod events;
pub mod fit;
pub mod job;
pub mod model;
mod reasons;
pub mod record;
mod remedy;
pub mod report;
pub mod verify;

use accuracy::Scope;
use choice::{Chooser, choose};
use job::PlanJob;
use model::Model;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_scenes::model::Scene;
use report::Report;

/// Plan, tell, and write the plan down.
///
/// # Errors
/// When the scene is refused or a file cannot be written; [`Error::Bounds`] when nothing fits, with what
/// fails by how much and what would fit.
pub fn run(job: &PlanJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.emit {
        output::probe(path)?;
    }
    let scene = octray_scenes::read(&job.scene)?;
    let mut report = plan(job, &scene, interrupt)?;
    let fits = report.failures.is_empty();
    if let (true, true, Some(plan), Some(cost)) = (job.measure, fits, &report.plan, &report.cost) {
        let trial = verify::run(&job.scene, &scene, plan, cost, job.board, interrupt)?;
        report.trial = Some(trial);
    }
    output::write_stdout(interrupt, |out| match job.json {
        true => {
            serde_json::to_writer_pretty(&mut *out, &report)?;
            writeln!(out)
        }
        false => out.write_all(report.text().as_bytes()),
    })?;
    if !fits {
        return Err(Error::Bounds(report.failures));
    }
    if let (Some(path), Some(emitted)) = (&job.emit, report.emitted()) {
        output::write_file(path, interrupt, |out| out.write_all(emitted.as_bytes()))?;
    }
    Ok(())
}

/// The plan of a scene; if it does not fit, with what would.
///
/// # Errors
/// [`Error::Failed`] if no packed tree can hold the scene; [`Error::Interrupted`].
pub fn plan(job: &PlanJob, scene: &Scene, interrupt: &Interrupt) -> Result<Report, Error> {
    let plan = |job: &PlanJob| nearest(job, scene, interrupt);
    let mut report = plan(job)?;
    let options = remedy::options(job, &report, plan)?;
    if !options.is_empty() {
        let options = options.join(", or with ");
        report.failures.push(format!("it fits with {options}"));
    }
    Ok(report)
}

/// The plan that fits, or the one that is nearest to it.
fn nearest(job: &PlanJob, scene: &Scene, interrupt: &Interrupt) -> Result<Report, Error> {
    let scope = Scope {
        scene,
        size: job.size.unwrap_or((scene.width, scene.height)),
        min_psnr: job.bounds.min_psnr,
        interrupt,
    };
    let model = Model::shipped()?;
    let chooser = Chooser {
        scope: &scope,
        board: job.board,
        model: &model,
    };
    let accuracy = scope.accuracy(job.numbers)?;
    let candidates = chooser.candidates(&accuracy)?;
    match choose(&candidates, &job.bounds) {
        None => Ok(Report::inaccurate(job, &accuracy)),
        Some(chosen) => Report::new(job, &accuracy, &candidates, chosen, &chooser),
    }
}
