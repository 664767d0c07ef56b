//! The command line: arguments, their help texts, and the values that each may have.
//!
//! A command's arguments become a job, which the command then runs. Errors in the arguments are reported here, before
//! any work.

mod bake;
mod check;
mod convert;
mod diff;
pub mod files;
mod frames;
mod generate;
#[cfg(feature = "lab")]
pub mod lab;
#[cfg(not(feature = "lab"))]
#[path = "cli/no_lab.rs"]
pub mod lab;
mod overlaps;
mod reduction;
mod render;
mod trace;
pub mod value;

pub use bake::BakeArgs;
pub use check::CheckArgs;
pub use convert::ConvertArgs;
pub use diff::DiffArgs;
pub use generate::GenerateArgs;
pub use overlaps::OverlapsArgs;
pub use reduction::ReductionArgs;
pub use render::RenderArgs;
pub use trace::TraceArgs;

use clap::{CommandFactory, Parser, Subcommand};
use lab::LabCommand;

/// Ray tracer that measures speed against accuracy
#[derive(Debug, Parser)]
#[command(name = "octray", version, max_term_width = 100, after_help = AFTER)]
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
    /// Tell what the rays of one pixel meet
    Trace(TraceArgs),
    /// Check scenes: print what is in them or what is wrong with them
    Check(CheckArgs),
    /// List objects that pass through each other or are inside another
    Overlaps(OverlapsArgs),
    /// Turn a scene into constant tables for a program without a file system
    Bake(BakeArgs),
    /// Generate a scene of any size
    Generate(GenerateArgs),
    /// Compare two pictures
    Diff(DiffArgs),
    /// Write a picture in another format
    Convert(ConvertArgs),
    /// A command of the laboratory
    #[command(flatten)]
    Lab(LabCommand),
}

/// Returns the command line as it is parsed. A negative number after an option is its value, to be refused with what was
/// expected where it is none.
pub fn command() -> clap::Command {
    let takes_value =
        |argument: &clap::Arg| !argument.is_positional() && argument.get_action().takes_values();
    Cli::command().mut_subcommands(|command| {
        command.mut_args(|argument| match takes_value(&argument) {
            true => argument.allow_negative_numbers(true),
            false => argument,
        })
    })
}

#[cfg(feature = "lab")]
const AFTER: &str = "Exit codes: 0 done, 1 failed, 2 bad usage, 130 interrupted.";
#[cfg(not(feature = "lab"))]
const AFTER: &str = "\
Built with --features lab, there are also: schedule, measure, plan, chart, report, stability, tables, panel.

Exit codes: 0 done, 1 failed, 2 bad usage, 130 interrupted.";
