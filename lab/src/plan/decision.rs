//! A decision of a plan, what the next cheaper choice would bring, and what a frame costs.

use super::choice::Candidate;
use super::model::Prediction;
use octray_render::counts::thousands;
use serde::Serialize;

/// A decision.
#[derive(Clone, Debug, Serialize)]
pub struct Decision {
    /// About what.
    pub about: &'static str,
    /// What was chosen.
    pub chosen: String,
    /// Why.
    pub why: String,
    /// What the next cheaper choice would bring.
    pub cheaper: Option<Cheaper>,
}

/// What another choice would bring, compared with the plan.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Cheaper {
    /// The choice.
    pub choice: String,
    /// Its distance from the exact picture, in dB, where the picture is another one.
    pub psnr: Option<f64>,
    /// By how much of themselves instructions grow.
    pub instructions: Option<f64>,
    /// Bytes of flash more.
    pub flash: Option<i64>,
    /// Bytes of RAM more.
    pub ram: Option<i64>,
}

/// What a frame costs, as predicted.
#[derive(Clone, Debug, Serialize)]
pub struct Cost {
    /// Instructions, start-up and panel left out.
    pub instructions: u64,
    /// Bytes of flash.
    pub flash: u64,
    /// Bytes of RAM, the stack included.
    pub ram: u64,
    /// Distance from the exact picture, in dB; none if it is the same.
    pub psnr: Option<f64>,
    /// In detail.
    pub detail: Prediction,
    /// The typical relative errors of instructions, flash and RAM, for scenes that the model was not fitted to.
    pub errors: [f64; 3],
}

impl Cheaper {
    /// It to read.
    pub(super) fn text(&self) -> String {
        let bytes = |more: Option<i64>, what: &str| {
            let more = more.filter(|more| *more != 0)?;
            let sign = if more < 0 { '−' } else { '+' };
            Some(format!(
                "{sign}{} bytes of {what}",
                thousands(more.unsigned_abs())
            ))
        };
        let percent = |more: f64| {
            let sign = if more < 0.0 { '−' } else { '+' };
            format!("{sign}{:.1} % instructions", 100.0 * more.abs())
        };
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

    /// What another candidate costs more than the chosen one.
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

/// A distance from the exact picture; none if it is the same.
pub(super) fn decibels(psnr: Option<f64>) -> String {
    psnr.map_or("the exact picture".into(), |psnr| format!("{psnr:.1} dB"))
}
