//! `octray measure`: the cost of pictures on microcontrollers, counted in an emulator.
//!
//! In the order of the data: [`job`] is a checked command line; [`source_tree`] builds the firmware and the emulator's
//! plugin; [`emulate`] runs a [`board`] and reads the [counts](count); [`reference`](mod@reference) renders the same
//! picture on the host; [`memory`] and [`cycles`] come from the program and from tables; [`frames`] combines them into
//! a [`row`] per combination; [`report`] and [`table`] print the rows, with the [`ratio`]s of the thesis's table III
//! and their [`chart`]. [`kernels`] does the same with single operations.

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
pub mod source_tree;
pub mod table;

use crate::canvas;
use chart::Chart;
use emulate::Emulator;
use frames::{Bench, NamedScene};
use job::MeasureJob;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use report::{MeasureReport, With};
use row::FrameRow;
use source_tree::{Program, SourceTree};
use std::path::PathBuf;

/// Measures and prints.
///
/// # Errors
/// If something is missing, a scene is refused, a result cannot be written, or a combination failed; then the others
/// are printed first.
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
    let results = job.json.iter().chain(&job.csv).chain(&job.chart);
    output::write_report(results, interrupt, |out| {
        let ratios = ratio::text(&report.rows);
        out.write_all(table::text(&report.rows, &ratios, job.functions).as_bytes())
    })?;
    all_done(report.rows.iter().filter(|row| row.cost.is_none()).count())
}

/// Measures every combination.
///
/// # Errors
/// If something is missing, a scene is refused, or cargo or the emulator cannot be run. The row of a combination that
/// fails states why.
pub fn measure(job: &MeasureJob, interrupt: &Interrupt) -> Result<MeasureReport<FrameRow>, Error> {
    let root = SourceTree::root()?;
    let scenes = frames::scenes(&job.scenes, job.reduction)?.into_iter();
    let scenes: Vec<NamedScene> = scenes.map(|(_, scene)| scene).collect();
    board::require(&job.boards, &root)?;
    let sources = SourceTree::open(root)?;
    let plugin = plugin(&sources, interrupt)?;
    let progress = Bar::new("measuring");
    progress.start(scenes.len() * job.ariths.len() * job.boards.len());
    let bench = Bench {
        sources: &sources,
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
    Ok(MeasureReport {
        with: With::of(&sources, &job.boards),
        rows,
    })
}

/// Returns an error if combinations failed.
fn all_done(failures: usize) -> Result<(), Error> {
    match failures {
        0 => Ok(()),
        n => Err(Error::Failed(format!("{n} of the combinations failed"))),
    }
}

/// Builds the plugin that counts instructions.
///
/// # Errors
/// If it cannot be built.
pub fn plugin(sources: &SourceTree, interrupt: &Interrupt) -> Result<PathBuf, Error> {
    let program = Program {
        package: "octray-count",
        arguments: &["--release"],
        variables: &[],
        artifact: "octray_count",
    };
    sources
        .build(&program, interrupt)?
        .map_err(|why| Error::Failed(format!("the emulator's plugin cannot be built: {why}")))
}
