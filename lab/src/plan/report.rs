//! A plan with its reasons, as text and as JSON.

use super::accuracy::{Accuracy, Tried};
use super::choice::{Candidate, Chooser};
use super::decision::{Cost, Decision, Strip, decibels};
use super::events::{Events, Probe, ROWS};
use super::job::{PlanJob, PlanLimits};
use super::reasons::{bounces, capacities, code, numbers, pixels_per_ray, tree};
use super::verify::Verification;
use octray_prepare::plan::Plan;
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_scenes::name;
use serde::Serialize;

/// The contents of the output.
#[derive(Clone, Debug, Serialize)]
pub struct PlanReport {
    /// The scene file as it was named.
    pub scene: String,
    /// The board.
    pub board: &'static str,
    /// The limits.
    pub bounds: PlanLimits,
    /// The decisions.
    pub decisions: Vec<Decision>,
    /// Every tried arithmetic.
    pub tried: Vec<Tried>,
    /// The predicted cost; `None` if nothing is accurate enough.
    pub cost: Option<Cost>,
    /// The measurement, if there was one.
    pub trial: Option<Verification>,
    /// The bounces that were not explored, in words, if any.
    pub unexplored: Option<String>,
    /// Which limits fail, by how much, and with which options the plan fits.
    pub failures: Vec<String>,
    /// The plan.
    #[serde(skip)]
    pub plan: Option<Plan>,
}

impl PlanReport {
    fn empty(job: &PlanJob, accuracy: &Accuracy) -> Self {
        Self {
            scene: job.scene.display().to_string(),
            board: job.board.name,
            bounds: job.limits,
            decisions: Vec::new(),
            tried: accuracy.tried.clone(),
            cost: None,
            trial: None,
            unexplored: accuracy.unexplored.clone(),
            failures: Vec::new(),
            plan: None,
        }
    }

    /// Returns a report that nothing is accurate enough.
    pub fn inaccurate(job: &PlanJob, accuracy: &Accuracy) -> Self {
        let bound = job.limits.min_psnr;
        let why = match accuracy.closest() {
            Some(Tried {
                too_fine: Some(why),
                ..
            }) => format!("resolution: {why}"),
            Some(Tried { format, psnr, .. }) => {
                let psnr = (psnr.unwrap_or(f64::INFINITY) * 100.0).floor() / 100.0;
                format!(
                    "PSNR: nothing reaches {bound} dB; {format} comes nearest, with {psnr} dB: \
                     it would do for --min-psnr {psnr}"
                )
            }
            None => {
                let why = accuracy.refused.as_deref().unwrap_or("nothing was tried");
                format!("range: {why}; f32 might do")
            }
        };
        Self {
            failures: vec![why],
            ..Self::empty(job, accuracy)
        }
    }

    /// Returns the report of a plan that was chosen among candidates.
    ///
    /// # Errors
    /// [`Error::Failed`] if the model does not know the board.
    pub fn new(
        job: &PlanJob,
        accuracy: &Accuracy,
        candidates: &[Candidate],
        chosen: &Candidate,
        chooser: &Chooser<'_>,
    ) -> Result<Self, Error> {
        let weights = chooser.weights(chosen.plan.format)?;
        let tried = |format| accuracy.tried.iter().find(|tried| tried.format == format);
        let instructions = |events: &Events| weights.instructions(events).iter().sum::<f64>();
        let full = instructions(&accuracy.full);
        let less = |events: &Events| (full > 0.0).then(|| instructions(events) / full - 1.0);
        let scope = chooser.scope;
        let strips = Probe::strips(scope.scene, &chosen.plan, scope.interrupt)?;
        let dearest = strips.iter().map(&instructions).fold(0.0, f64::max);
        let rows = chosen.plan.size.1.div_ceil(ROWS as u32).max(1);
        let mean = chosen.cost.instructions / f64::from(rows);
        let decisions = vec![
            bounces(accuracy, less),
            pixels_per_ray(accuracy, less),
            numbers(accuracy, candidates, chosen),
            tree(candidates, chosen),
            capacities(chosen),
            code(chosen, &weights.code),
        ];
        Ok(Self {
            decisions,
            cost: Some(Cost {
                instructions: chosen.cost.instructions.round() as u64,
                dearest: Strip {
                    // A strip of background costs something, too.
                    instructions: dearest.max(mean).round() as u64,
                    mean: mean.round() as u64,
                },
                flash: chosen.cost.flash(),
                ram: chosen.cost.ram(),
                psnr: tried(chosen.plan.format).and_then(|tried| tried.psnr),
                detail: chosen.cost,
                errors: weights.errors,
            }),
            failures: failures(chosen, &job.limits),
            plan: Some(chosen.plan.clone()),
            ..Self::empty(job, accuracy)
        })
    }

    /// Returns the plan as `octray bake --plan` reads it.
    pub fn emitted(&self) -> Option<String> {
        let plan = self.plan.as_ref()?;
        let (scene, board) = (name::line(&self.scene), self.board);
        Some(format!("# octray plan {scene} --target {board}\n{plan}"))
    }

    /// Formats the whole report as text.
    pub fn text(&self) -> String {
        let PlanLimits {
            flash,
            ram,
            min_psnr,
        } = self.bounds;
        let mut text = line("scene", &name::line(&self.scene));
        let (flash, ram) = (thousands(flash), thousands(ram));
        let bounds = format!("{flash} bytes of flash, {ram} of RAM, at least {min_psnr} dB");
        text += &line("bounds", &format!("{}: {bounds}", self.board));
        for decision in &self.decisions {
            let Decision {
                about,
                chosen,
                why,
                cheaper,
            } = decision;
            text += &line(about, &format!("{chosen}: {why}"));
            if let Some(cheaper) = cheaper {
                text += &line("", &format!("next cheaper: {}", cheaper.text()));
            }
        }
        if let Some(cost) = &self.cost {
            let [instructions, flash, ram] =
                cost.errors.map(|error| format!("{:.0} %", 100.0 * error));
            let detail = &cost.detail;
            text += &line(
                "flash",
                &format!(
                    "{} bytes ± {flash}: {} of code, {} of tables",
                    thousands(cost.flash),
                    thousands(detail.code.round() as u64),
                    thousands(detail.tables as u64),
                ),
            );
            text += &line(
                "RAM",
                &format!(
                    "{} bytes ± {ram}: {} of functions' frames, {} lent",
                    thousands(cost.ram),
                    thousands(detail.frames.round() as u64),
                    thousands(detail.lent.total() as u64),
                ),
            );
            let count = thousands(cost.instructions);
            text += &line(
                "instructions",
                &format!("{count} per frame ± {instructions}"),
            );
            let dearest = cost.dearest.text();
            text += &line("", &format!("the dearest strip of {ROWS} rows {dearest}"));
            text += &line("accuracy", &decibels(cost.psnr));
        }
        if let Some(trial) = &self.trial {
            let measured = [trial.instructions, trial.flash, trial.ram].map(thousands);
            let [instructions, flash, ram] = [0, 1, 2].map(|i| {
                format!(
                    "{} (predicted: {:+.1} %)",
                    measured[i],
                    100.0 * trial.errors[i]
                )
            });
            text += &line(
                "measured",
                &format!("{instructions} instructions, {flash} bytes of flash, {ram} of RAM"),
            );
            let (dearest, error) = (trial.dearest.text(), 100.0 * trial.dearest_error);
            text += &line(
                "",
                &format!("the dearest strip {dearest} (predicted: {error:+.1} %)"),
            );
        }
        text
    }
}

/// Formats a name and its text.
fn line(name: &str, what: &str) -> String {
    format!("{name:<16}{what}\n")
}

/// Returns which limits a plan exceeds, and by how much.
fn failures(chosen: &Candidate, limits: &PlanLimits) -> Vec<String> {
    let needs = [
        ("flash", chosen.cost.flash(), limits.flash),
        ("RAM", chosen.cost.ram(), limits.ram),
    ];
    let failed = needs.into_iter().filter(|(_, needs, has)| needs > has);
    let sentences = failed.map(|(what, needs, has)| {
        let [needed, more, has] = [needs, needs - has, has].map(thousands);
        format!("{what}: the nearest plan takes {needed} bytes, {more} more than {has}")
    });
    sentences.collect()
}
