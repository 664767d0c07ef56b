//! `octray tables`: the tables of the thesis, I to IX, from our own runs beside its numbers.
//!
//! In the order of the data: [`runs`] traces variants of a [`subject`]. From the counts, [`octrees`] makes
//! table I (with [`plane`]), [`traced`] II and IV to VII; [`emulated`] takes III from a [`record`] of `octray measure`;
//! [`shared`] simulates VIII and IX. Each is a draft, which becomes a [`table`] beside the [`thesis`]'s numbers, and a [`text`];
//! VIII and IX also become [`chart`]s.

pub mod chart;
pub mod emulated;
pub mod number;
pub mod octrees;
pub mod plane;
pub mod record;
pub mod runs;
pub mod shared;
pub mod subject;
pub mod table;
pub mod text;
pub mod thesis;
pub mod traced;

use crate::canvas;
use chart::Chart;
use number::TableNumber;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use runs::Runs;
use shared::{Figure, MOST_PROCESSORS, Outcomes, PROCESSORS, Simulation};
use std::path::PathBuf;
use std::{fs, io};
use table::Table;
use thesis::Thesis;

/// Everything that `octray tables` was asked to do.
#[derive(Clone, Debug, PartialEq)]
pub struct TablesJob {
    /// The tables, without duplicates.
    pub tables: Vec<TableNumber>,
    /// Columns and rows of the pictures; the scenes' own if `None`.
    pub size: Option<(u32, u32)>,
    /// Whether to measure the time of tracing.
    pub time: bool,
    /// The file of the thesis's numbers; those that come with octray if `None`.
    pub thesis: Option<PathBuf>,
    /// The record of table III; the newest that comes with octray if `None`.
    pub record: Option<PathBuf>,
    /// The simulation of tables VIII and IX.
    pub simulation: Simulation,
    /// Whether to print JSON.
    pub json: bool,
    /// The file to write; standard output if `None`.
    pub output: Option<PathBuf>,
    /// The folder for figures 24 and 25.
    pub charts: Option<PathBuf>,
}

/// Makes the tables, and prints them.
///
/// # Errors
/// If a file cannot be read, has the wrong form, or cannot be written; on an interrupt.
pub fn run(job: &TablesJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.output {
        output::probe(path)?;
    }
    if let Some(folder) = &job.charts {
        fs::create_dir_all(folder).map_err(|source| Error::write(folder, source))?;
    }
    let tables = make(job, interrupt)?;
    let print = |out: &mut dyn io::Write| match job.json {
        true => {
            serde_json::to_writer_pretty(&mut *out, &tables)?;
            writeln!(out)
        }
        false => {
            let texts: Vec<String> = tables.iter().map(text::of).collect();
            out.write_all(texts.join("\n").as_bytes())
        }
    };
    match &job.output {
        Some(path) => output::write_file(path, interrupt, print),
        None => output::write_stdout(interrupt, print),
    }
}

/// Makes the tables, and draws the charts of some.
fn make(job: &TablesJob, interrupt: &Interrupt) -> Result<Vec<Table>, Error> {
    let thesis = Thesis::read(job.thesis.as_deref())?;
    let runs = Runs::new(job.size, job.time, interrupt);
    let progress = Bar::new("tracing");
    progress.start(job.tables.len());
    let figures = match job
        .tables
        .iter()
        .any(|number| *number >= TableNumber::Eight)
    {
        true => Figure::all(&runs)?,
        false => Vec::new(),
    };
    let simulation = &job.simulation;
    let mut tables = Vec::new();
    for number in &job.tables {
        let draft = match number {
            TableNumber::One => octrees::one(&runs)?,
            TableNumber::Two => traced::two(&runs)?,
            TableNumber::Three => emulated::three(job.record.as_deref(), &runs)?,
            TableNumber::Four => traced::four(&runs)?,
            TableNumber::Five => traced::five(&runs)?,
            TableNumber::Six => traced::six(&runs)?,
            TableNumber::Seven => traced::seven(&runs)?,
            TableNumber::Eight => {
                let outcomes = Outcomes::by_rows(&figures, simulation);
                let chart = Chart::of_rows(&outcomes, simulation);
                draw(job, "figure-24", &chart, interrupt)?;
                shared::eight(&outcomes, simulation, runs.size.is_none())
            }
            TableNumber::Nine => {
                if job.charts.is_some() {
                    let across: Vec<u32> = (1..=MOST_PROCESSORS).collect();
                    let outcomes = Outcomes::by_processors(&figures, &across, simulation);
                    let chart = Chart::of_processors(&outcomes, simulation);
                    draw(job, "figure-25", &chart, interrupt)?;
                }
                let outcomes = Outcomes::by_processors(&figures, &PROCESSORS, simulation);
                shared::nine(&outcomes, &figures, simulation, runs.size.is_none())
            }
        };
        tables.push(draft.beside(&thesis));
        progress.step();
    }
    Ok(tables)
}

/// Draws a chart if charts are requested.
fn draw(
    job: &TablesJob,
    name: &str,
    chart: &Chart<'_>,
    interrupt: &Interrupt,
) -> Result<(), Error> {
    let Some(folder) = &job.charts else {
        return Ok(());
    };
    for ending in ["svg", "png"] {
        let path = folder.join(format!("{name}.{ending}"));
        canvas::write_figure(&path, chart, interrupt)?;
    }
    Ok(())
}
