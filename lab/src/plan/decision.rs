//! A decision of a plan, the effect of the next cheaper choice, and the cost of a frame.

use super::choice::Candidate;
use super::model::Prediction;
use octray_render::counts::thousands;
use serde::Serialize;

/// A decision.
#[derive(Clone, Debug, Serialize)]
pub struct Decision {
    /// The subject.
    pub about: &'static str,
    /// What was chosen.
    pub chosen: String,
    /// The reason.
    pub why: String,
    /// The effect of the next cheaper choice.
    pub cheaper: Option<Cheaper>,
}

/// The effect of another choice, relative to the plan.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Cheaper {
    /// The choice.
    pub choice: String,
    /// Its distance from the exact picture, in dB, if its picture differs.
    pub psnr: Option<f64>,
    /// The relative change of instructions.
    pub instructions: Option<f64>,
    /// Additional bytes of flash.
    pub flash: Option<i64>,
    /// Additional bytes of RAM.
    pub ram: Option<i64>,
}

/// The predicted cost of a frame.
#[derive(Clone, Debug, Serialize)]
pub struct Cost {
    /// Instructions, without start-up and panel.
    pub instructions: u64,
    /// The dearest strip of the frame.
    pub dearest: Strip,
    /// Bytes of flash.
    pub flash: u64,
    /// Bytes of RAM, including the stack.
    pub ram: u64,
    /// Distance from the exact picture, in dB; `None` if it is equal.
    pub psnr: Option<f64>,
    /// The details.
    pub detail: Prediction,
    /// The typical relative errors of instructions, flash and RAM, for scenes that the model was not fitted to.
    pub errors: [f64; 3],
}

/// The strip that takes the most instructions: a display waits for it, and no strip takes longer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Strip {
    /// Its instructions.
    pub instructions: u64,
    /// Those of a frame's strips on average.
    pub mean: u64,
}

impl Strip {
    /// Formats it as text.
    pub(super) fn text(&self) -> String {
        let times = self.instructions as f64 / self.mean.max(1) as f64;
        format!(
            "{}, {times:.2} times the mean",
            thousands(self.instructions)
        )
    }
}

impl Cheaper {
    /// Formats it as text.
    pub(super) fn text(&self) -> String {
        let bytes = |more: Option<i64>, what: &str| {
            let more = more.filter(|more| *more != 0)?;
            let sign = if more < 0 { '-' } else { '+' };
            Some(format!(
                "{sign}{} bytes of {what}",
                thousands(more.unsigned_abs())
            ))
        };
        let percent = |more: f64| format!("{:+.1} % instructions", 100.0 * more);
        let parts = [
            self.psnr
                .map(|psnr| decibels(Some(psnr).filter(|psnr| psnr.is_finite()))),
            self.instructions.map(percent),
            bytes(self.flash, "flash"),
            bytes(self.ram, "RAM"),
        ];
        let parts: Vec<_> = parts.into_iter().flatten().collect();
        format!("{}, {}", self.choice, parts.join(", "))
    }

    /// Returns the additional cost of another candidate, relative to the chosen one.
    pub(super) fn candidate(choice: String, other: &Candidate, chosen: &Candidate) -> Self {
        let more = |other: u64, chosen: u64| Some(other as i64 - chosen as i64);
        Self {
            choice,
            psnr: None,
            instructions: Some(other.cost.instructions / chosen.cost.instructions - 1.0),
            flash: more(other.cost.flash(), chosen.cost.flash()),
            ram: more(other.cost.ram(), chosen.cost.ram()),
        }
    }
}

/// Formats a distance from the exact picture; `None` means equal.
pub(super) fn decibels(psnr: Option<f64>) -> String {
    psnr.map_or("the exact picture".into(), |psnr| format!("{psnr:.1} dB"))
}
