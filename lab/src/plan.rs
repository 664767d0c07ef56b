//! `octray plan`: finds the least that a scene needs on a board. Each decision states its reason and the cost of the
//! next cheaper choice.
//!
//! In the order of the data: [`job`] is a checked command line; [`accuracy`] finds by rendering how many bounces,
//! pixels per ray and bits the picture needs; [`events`] counts the events of a frame, from which the [`model`]
//! predicts instructions and memory; [`choice`] takes the cheapest arithmetic and tree that fit; [`report`] prints the
//! plan, with a remedy if nothing fits; [`verify`] measures the result. The model is [fitted](fit) to a [`record`] of
//! measurements, some of which are of [`comb`]s.

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
use octray_render::scene_file;
use octray_scenes::model::Scene;
use report::PlanReport;

/// Plans, prints, and writes the plan to its file.
///
/// # Errors
/// If the scene is refused or a file cannot be written; [`Error::Bounds`] if nothing fits, which states what fails by
/// how much and what would fit.
pub fn run(job: &PlanJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.emit {
        output::probe(path)?;
    }
    let scene = scene_file::read(&job.scene)?;
    let mut report = plan(job, &scene, interrupt)?;
    let fits = report.failures.is_empty();
    if let (true, true, Some(plan), Some(cost)) = (job.measure, fits, &report.plan, &report.cost) {
        let trial = verify::run(&job.scene, &scene, plan, cost, job.board, interrupt)?;
        report.trial = Some(trial);
    }
    output::write_report(&job.emit, interrupt, |out| match job.json {
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

/// Returns the plan of a scene; if it does not fit, its failures include options with which it would.
///
/// # Errors
/// [`Error::Failed`] if no compact BVH can hold the scene; [`Error::Interrupted`].
pub fn plan(job: &PlanJob, scene: &Scene, interrupt: &Interrupt) -> Result<PlanReport, Error> {
    let plan = |job: &PlanJob| nearest(job, scene, interrupt);
    let mut report = plan(job)?;
    let options = remedy::options(job, &report, plan)?;
    if !options.is_empty() {
        let options = options.join(", or with ");
        report.failures.push(format!("it fits with {options}"));
    }
    Ok(report)
}

/// Returns the plan that fits, or the one that comes closest.
fn nearest(job: &PlanJob, scene: &Scene, interrupt: &Interrupt) -> Result<PlanReport, Error> {
    let scope = Scope {
        scene,
        size: job.size.unwrap_or((scene.width, scene.height)),
        min_psnr: job.limits.min_psnr,
        interrupt,
    };
    let model = Model::shipped()?;
    let chooser = Chooser {
        scope: &scope,
        board: job.board,
        model: &model,
    };
    let accuracy = scope.accuracy(job.numbers)?;
    if accuracy.full.hits() == 0.0 && !scene.objects.is_empty() {
        scene_file::note(scene_file::NOTHING_IN_SIGHT);
    }
    let candidates = chooser.candidates(&accuracy)?;
    match choose(&candidates, &job.limits) {
        None => Ok(PlanReport::inaccurate(job, &accuracy)),
        Some(chosen) => PlanReport::new(job, &accuracy, &candidates, chosen, &chooser),
    }
}
