//! The job of `octray measure`: a checked command line.

use super::board::Board;
use octray_prepare::{Arith, FirmwareTree, RenderSettings};
use octray_scenes::reduce::Reduction;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Everything that `octray measure` was asked to do.
#[derive(Clone, Debug)]
pub struct MeasureJob {
    /// Whether to measure single operations instead of scenes.
    pub kernels: bool,
    /// The scene files; the five figures if empty.
    pub scenes: Vec<PathBuf>,
    /// What is left out of them.
    pub reduction: Reduction,
    /// The boards.
    pub boards: Vec<&'static Board>,
    /// The arithmetics.
    pub ariths: Vec<Arith>,
    /// The picture; its arithmetic and tree are ignored.
    pub settings: RenderSettings,
    /// How firmware is built.
    pub build: FirmwareOptions,
    /// The timeout of a run.
    pub patience: Duration,
    /// How many of the most expensive functions to print.
    pub functions: usize,
    /// Where to write the results as JSON.
    pub json: Option<PathBuf>,
    /// Where to write them as comma-separated values.
    pub csv: Option<PathBuf>,
    /// Where to draw the costs without and with a floating-point unit.
    pub chart: Option<PathBuf>,
}

/// How firmware is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FirmwareOptions {
    /// The tree.
    pub tree: FirmwareTree,
    /// What the compiler optimizes for.
    pub optimize: Goal,
}

/// What the compiler optimizes for.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    Serialize,
    VariantArray,
    EnumMessage,
    EnumString,
    IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "lowercase")]
pub enum Goal {
    /// Speed.
    #[default]
    Speed,
    /// Size.
    Size,
}

impl Goal {
    /// Returns the profile with which firmware is built.
    pub fn profile(self) -> &'static str {
        match self {
            Self::Speed => "firmware",
            Self::Size => "firmware-small",
        }
    }
}
