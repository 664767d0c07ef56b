//! The laboratory's commands.

mod chart;
mod lists;
mod measure;
mod panel;
mod plan;
mod report;
mod schedule;
mod stability;
mod tables;

pub use chart::ChartArgs;
pub use measure::MeasureArgs;
pub use panel::PanelArgs;
pub use plan::PlanArgs;
pub use report::ReportArgs;
pub use schedule::ScheduleArgs;
pub use stability::StabilityArgs;
pub use tables::TablesArgs;

use clap::Subcommand;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;

/// A command of the laboratory with its arguments.
#[derive(Debug, Subcommand)]
pub enum LabCommand {
    /// Simulate how well tiles of a picture keep any number of processors busy
    Schedule(ScheduleArgs),
    /// Measure the cost of pictures on microcontrollers, in an emulator
    Measure(MeasureArgs),
    /// Find the least that a scene needs on a microcontroller, and predict its cost
    Plan(PlanArgs),
    /// Chart accuracy against cost over arithmetics and settings, and choose a point
    Chart(ChartArgs),
    /// Write one page with pictures, charts, tables and limits
    Report(ReportArgs),
    /// Show up to which values methods hold, degrade and break, in every arithmetic
    Stability(StabilityArgs),
    /// Reproduce the tables of the thesis from our own runs
    Tables(TablesArgs),
    /// Draw a scene on a simulated panel, strip by strip, with the code that boards run
    Panel(PanelArgs),
}

impl LabCommand {
    /// Runs the command.
    ///
    /// # Errors
    /// [`Error::Usage`] if the arguments contradict each other; otherwise the command's own errors.
    pub fn run(self, interrupt: &Interrupt) -> Result<(), Error> {
        match self {
            Self::Schedule(args) => octray_lab::schedule::run(&args.job()?, interrupt),
            Self::Measure(args) => octray_lab::measure::run(&args.job()?, interrupt),
            Self::Plan(args) => octray_lab::plan::run(&args.job()?, interrupt),
            Self::Chart(args) => octray_lab::chart::run(&args.job()?, interrupt),
            Self::Report(args) => octray_lab::report::run(&args.job()?, interrupt),
            Self::Stability(args) => octray_lab::stability::run(&args.job()?, interrupt),
            Self::Tables(args) => octray_lab::tables::run(&args.job()?, interrupt),
            Self::Panel(args) => octray_panel::run(&args.job()?, interrupt),
        }
    }
}
