//! What to measure: a command line that has been checked.

use super::board::Board;
use super::reference::View;
use clap::ValueEnum;
use octray_engine::options::Arith;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;

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
    /// The picture.
    pub view: View,
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
    pub tree: TreeKind,
    /// What the compiler makes small.
    pub optimize: Goal,
}

/// The tree of the firmware.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TreeKind {
    /// The packed tree, baked.
    #[default]
    Packed,
    /// The packed tree, built by the device in its memory.
    Device,
    /// The packed tree where it pays, none otherwise.
    Auto,
    /// None: every ray tries every object.
    None,
}

/// What the compiler makes small.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Goal {
    /// Time.
    #[default]
    Speed,
    /// Code.
    Size,
}

impl TreeKind {
    /// Its name on the command line and for the firmware's build script.
    pub fn name(self) -> &'static str {
        match self {
            Self::Packed => "packed",
            Self::Device => "device",
            Self::Auto => "auto",
            Self::None => "none",
        }
    }
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
