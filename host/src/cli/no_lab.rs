//! The laboratory's commands in a build without the laboratory: each reports how to get it.

use clap::{Args, Subcommand};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;

/// How to get the laboratory.
pub const INSTALL_LAB: &str = "build it with 'cargo install --path host --features lab'";

/// A command of the laboratory, which this build does not contain.
#[derive(Debug, Subcommand)]
pub enum LabCommand {
    #[command(hide = true)]
    #[allow(missing_docs, reason = "documented in the build with the laboratory")]
    Schedule(Missing),
    #[command(hide = true)]
    #[allow(missing_docs, reason = "the same")]
    Measure(Missing),
    #[command(hide = true)]
    #[allow(missing_docs, reason = "the same")]
    Plan(Missing),
    #[command(hide = true)]
    #[allow(missing_docs, reason = "the same")]
    Chart(Missing),
    #[command(hide = true)]
    #[allow(missing_docs, reason = "the same")]
    Report(Missing),
    #[command(hide = true)]
    #[allow(missing_docs, reason = "the same")]
    Stability(Missing),
    #[command(hide = true)]
    #[allow(missing_docs, reason = "the same")]
    Tables(Missing),
    #[command(hide = true)]
    #[allow(missing_docs, reason = "the same")]
    Panel(Missing),
}

/// Any arguments; they are ignored.
#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub struct Missing {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    arguments: Vec<std::ffi::OsString>,
}

impl LabCommand {
    /// Reports how to build the command.
    ///
    /// # Errors
    /// Always [`Error::Usage`].
    pub fn run(self, _: &Interrupt) -> Result<(), Error> {
        let name = format!("{self:?}").to_lowercase();
        let name = name.split('(').next().unwrap_or_default();
        Err(Error::Usage(format!(
            "'{name}' is a command of the laboratory: {INSTALL_LAB}"
        )))
    }
}
