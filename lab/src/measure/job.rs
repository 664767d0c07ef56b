//! What to measure: a command line that has been checked.

use super::board::Board;
use octray_prepare::{Arith, FirmwareTree, RenderSettings};
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Everything `octray measure` was asked for.
#[derive(Clone, Debug)]
pub struct MeasureJob {
    /// Single operations instead of scenes.
    pub kernels: bool,
    /// The scene files; the five figures if there is none.
    pub scenes: Vec<PathBuf>,
    /// The boards.
    pub boards: Vec<&'static Board>,
    /// The arithmetics.
    pub ariths: Vec<Arith>,
    /// The picture; its arithmetic and tree do not count.
    pub settings: RenderSettings,
    /// How firmware is built.
    pub build: BuildOptions,
    /// How long a run may take.
    pub patience: Duration,
    /// How many of the costliest functions to tell.
    pub functions: usize,
    /// Where to write the results as JSON.
    pub json: Option<PathBuf>,
    /// Where to write them as comma-separated values.
    pub csv: Option<PathBuf>,
    /// Where to draw costs without and with a floating-point unit.
    pub chart: Option<PathBuf>,
}

/// How firmware is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildOptions {
    /// The tree.
    pub tree: FirmwareTree,
    /// What the compiler makes small.
    pub optimize: Goal,
}

/// What the compiler makes small.
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
    /// Time.
    #[default]
    Speed,
    /// Code.
    Size,
}

impl Goal {
    /// The profile that firmware is built with.
    pub fn profile(self) -> &'static str {
        match self {
            Self::Speed => "firmware",
            Self::Size => "firmware-small",
        }
    }
}
