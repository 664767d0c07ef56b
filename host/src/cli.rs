//! The command line as it is typed: arguments, their help, and the values that each may have.
//!
//! A command's arguments turn into a job that the command then runs; whatever is wrong with them is found
//! here, before any work.

mod bake;
mod chart;
mod check;
mod diff;
pub mod files;
mod generate;
mod measure;
mod plan;
mod render;
mod report;
mod schedule;
mod stability;
mod tables;
pub mod value;

pub use bake::BakeArgs;
pub use chart::ChartArgs;
pub use check::CheckArgs;
pub use diff::DiffArgs;
pub use generate::GenerateArgs;
pub use measure::MeasureArgs;
pub use plan::PlanArgs;
pub use render::RenderArgs;
pub use report::ReportArgs;
pub use schedule::ScheduleArgs;
pub use stability::StabilityArgs;
pub use tables::TablesArgs;

use clap::{Parser, Subcommand};

/// Ray tracer that measures speed against accuracy
#[derive(Debug, Parser)]
#[command(name = "octray", version, max_term_width = 100, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// One subcommand with its arguments.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene to a picture
    Render(RenderArgs),
    /// Read scenes, and tell what is in them or what is wrong with them
    Check(CheckArgs),
    /// Turn a scene into constant tables for a program without files
    Bake(BakeArgs),
    /// Generate a scene of any size
    Generate(GenerateArgs),
    /// Compare two pictures
    Diff(DiffArgs),
    /// Simulate how well a picture is shared among any number of processors
    Schedule(ScheduleArgs),
    /// Measure what pictures cost on small targets, in an emulator
    Measure(MeasureArgs),
    /// Find the least a scene needs on a small target, and predict what it costs
    Plan(PlanArgs),
    /// Chart what accuracy costs, over arithmetics and settings, and choose
    Chart(ChartArgs),
    /// Write one page with pictures, charts, tables and limits
    Report(ReportArgs),
    /// Show where methods hold, degrade and break, in every arithmetic
    Stability(StabilityArgs),
    /// Reprint the tables of the thesis from our own runs
    Tables(TablesArgs),
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 failed, 2 bad usage, 130 interrupted.";
