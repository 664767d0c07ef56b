//! `octray tables`: the tables of the thesis, I to IX, from our own runs beside its figures.
//!
//! In the order of the data: a [`subject`] in a variant is a trial, which the [`runs`] traces. Of what it counts
//! [`traced`] makes tables I, II (with [`agreement`]) and IV to VII; [`emulated`] takes III from a [`record`] of `octray measure`;
//! [`shared`] simulates VIII and IX. Each is a draft, which becomes a [`table`] beside the [`thesis`]'s figures,
//! and a [`text`]; VIII and IX become [`chart`]s, too.

pub mod agreement;
pub mod chart;
pub mod emulated;

pub mod number;
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
use number::Number;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use runs::Runs;
use shared::{Figure, Outcomes, Simulation};
use std::path::PathBuf;
use std::{fs, io};
use table::Table;
use thesis::Thesis;

/// What `octray tables` was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct TablesJob {
    /// Which tables, each once.
    pub tables: Vec<Number>,
    /// Columns and rows of the pictures; the scenes' own if `None`.
    pub size: Option<(u32, u32)>,
    /// Whether to take the time of tracing.
    pub time: bool,
    /// The thesis's figures; those that come with octray if `None`.
    pub thesis: Option<PathBuf>,
    /// The record of table III; the newest that comes with octray if `None`.
    pub record: Option<PathBuf>,
    /// What is simulated for tables VIII and IX.
    pub simulation: Simulation,
    /// Whether to tell them as JSON.
    pub json: bool,
    /// The file to write; standard output if `None`.
    pub output: Option<PathBuf>,
    /// The folder for figures 24 and 25.
    pub charts: Option<PathBuf>,
}

/// Make the tables, and tell them.
///
/// # Errors
/// When a file cannot be read, is not of the form, or cannot be written; when interrupted.
pub fn run(job: &TablesJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.output {
        output::probe(path)?;
    }
    if let Some(folder) = &job.charts {
        fs::create_dir_all(folder).map_err(|source| Error::write(folder, source))?;
    }
    let tables = make(job, interrupt)?;
    let tell = |out: &mut dyn io::Write| match job.json {
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
        Some(path) => output::write_file(path, interrupt, tell),
        None => output::write_stdout(interrupt, tell),
    }
}

/// Makes the tables, and draws those that are charts, too.
fn make(job: &TablesJob, interrupt: &Interrupt) -> Result<Vec<Table>, Error> {
    let thesis = Thesis::read(job.thesis.as_deref())?;
    let runs = Runs::new(job.size, job.time, interrupt);
    let progress = Bar::new("tracing");
    progress.start(job.tables.len());
    let figures = match job.tables.iter().any(|number| *number >= Number::Eight) {
        true => Figure::all(&runs)?,
        false => Vec::new(),
    };
    let simulation = &job.simulation;
    let mut tables = Vec::new();
    for number in &job.tables {
        let draft = match number {
            Number::One => traced::one(&runs)?,
            Number::Two => traced::two(&runs, &thesis)?,
            Number::Three => emulated::three(job.record.as_deref())?,
            Number::Four => traced::four(&runs)?,
            Number::Five => traced::five(&runs, &thesis)?,
            Number::Six => traced::six(&runs)?,
            Number::Seven => traced::seven(&runs)?,
            Number::Eight => {
                let outcomes = Outcomes::by_rows(&figures, simulation);
                draw(
                    job,
                    "figure-24",
                    &Chart::of_rows(&outcomes, simulation),
                    interrupt,
                )?;
                shared::eight(&outcomes, simulation)
            }
            Number::Nine => {
                let outcomes = Outcomes::by_processors(&figures, simulation);
                draw(
                    job,
                    "figure-25",
                    &Chart::of_processors(&outcomes, simulation),
                    interrupt,
                )?;
                shared::nine(&outcomes, simulation)
            }
        };
        tables.push(draft.beside(&thesis));
        progress.step();
    }
    Ok(tables)
}

/// Draws a chart if charts are asked for.
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
