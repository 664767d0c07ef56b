//! `octray measure`: what pictures cost on small targets, counted in an emulator.
//!
//! In the order of the data: a checked [`job`]; [`workspace`] builds the firmware and the
//! emulator's plugin; [`emulate`] runs a [`board`] and reads what was [counted](count);
//! [`reference`](mod@reference) is the same picture on the host; [`memory`] and [`cycles`] are read
//! from the program and from tables; [`frames`] puts it together, a [`row`] for each combination,
//! and [`report`] and [`table`] tell it, with the [`ratio`]s that the thesis's table III has, and their [`chart`].
//! [`kernels`] does the same with single operations.

pub mod board;
pub mod chart;
pub mod child;
pub mod count;
pub mod cycles;
pub mod emulate;
pub mod frames;
pub mod job;
pub mod kernels;
pub mod memory;
pub mod ratio;
pub mod reference;
pub mod report;
pub mod row;
pub mod table;
pub mod workspace;

use crate::canvas;
use chart::Chart;
use emulate::Emulator;
use frames::{Bench, Named};
use job::MeasureJob;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use report::{Report, With};
use row::Row;
use std::path::PathBuf;
use workspace::{Program, Workspace};

/// Measure, and tell.
///
/// # Errors
/// When something is missing, a scene is refused, a result cannot be written, or any combination
/// failed: then all others have been told.
pub fn run(job: &MeasureJob, interrupt: &Interrupt) -> Result<(), Error> {
    for path in job.json.iter().chain(&job.csv).chain(&job.chart) {
        output::probe(path)?;
    }
    if job.kernels {
        return kernels::run(job, interrupt);
    }
    let report = measure(job, interrupt)?;
    report.write(&row::COLUMNS, job, interrupt)?;
    if let Some(path) = &job.chart {
        let chart = Chart::of(&report.rows).ok_or_else(|| {
            Error::Failed("no core was measured without and with its floating-point unit".into())
        })?;
        canvas::write_figure(path, &chart, interrupt)?;
    }
    output::write_stdout(interrupt, |out| {
        let ratios = ratio::text(&report.rows);
        out.write_all(table::text(&report.rows, &ratios, job.functions).as_bytes())
    })?;
    all_done(report.rows.iter().filter(|row| row.cost.is_none()).count())
}

/// Measure every combination.
///
/// # Errors
/// When something is missing, a scene is refused, or cargo or the emulator cannot be run. A combination that
/// fails is a row that says so.
pub fn measure(job: &MeasureJob, interrupt: &Interrupt) -> Result<Report<Row>, Error> {
    let root = Workspace::root()?;
    let scenes = frames::scenes(&job.scenes)?.into_iter();
    let scenes: Vec<Named> = scenes.map(|(_, scene)| scene).collect();
    board::require(&job.boards, &root)?;
    let workspace = Workspace::open(root)?;
    let plugin = plugin(&workspace, interrupt)?;
    let progress = Bar::new("measuring");
    progress.start(scenes.len() * job.ariths.len() * job.boards.len());
    let bench = Bench {
        workspace: &workspace,
        emulator: &Emulator {
            plugin: &plugin,
            patience: job.patience,
            watch: frames::SEARCH,
        },
        progress: &progress,
        interrupt,
    };
    let rows = bench.frames(&scenes, job)?;
    drop(progress);
    Ok(Report {
        with: With::of(&workspace, &job.boards),
        rows,
    })
}

/// An error if some of what was to be measured failed.
fn all_done(failures: usize) -> Result<(), Error> {
    match failures {
        0 => Ok(()),
        n => Err(Error::Failed(format!("{n} of the combinations failed"))),
    }
}

/// Builds the plugin that counts.
///
/// # Errors
/// If it cannot be built.
pub fn plugin(workspace: &Workspace, interrupt: &Interrupt) -> Result<PathBuf, Error> {
    let program = Program {
        package: "octray-count",
        arguments: &["--release"],
        variables: &[],
        artifact: "octray_count",
    };
    workspace
        .build(&program, interrupt)?
        .map_err(|why| Error::Failed(format!("the emulator's plugin cannot be built: {why}")))
}
