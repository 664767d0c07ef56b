//! `octray tables`: the tables of the thesis, I to IX, from our own runs beside its numbers.
//!
//! In the order of the data: [`runs`] traces variants of a [`subject`]. From the counts, [`octrees`] makes
//! table I (with [`plane`]), [`traced`] II and IV to VII; [`emulated`] takes III from a [`record`] of `octray measure`;
//! [`shared`] simulates VIII and IX. Each is a draft, which becomes a [`table`] beside the [`thesis`]'s numbers, and a [`text`] or a
//! `page`; VIII and IX also become [`chart`]s.

pub mod chart;
pub mod emulated;
pub mod number;
pub mod octrees;
pub(crate) mod page;
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
use std::path::{Path, PathBuf};
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
    /// The file to write, a page if its name ends in `.html`; standard output if `None`.
    pub output: Option<PathBuf>,
    /// The folder for figures 24 and 25.
    pub charts: Option<PathBuf>,
}

/// In which form tables are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Text,
    Json,
    Page,
}

impl TablesJob {
    fn form(&self) -> Form {
        match &self.output {
            _ if self.json => Form::Json,
            Some(path) if is_page(path) => Form::Page,
            _ => Form::Text,
        }
    }
}

/// Whether a file of this name is a page.
pub fn is_page(path: &Path) -> bool {
    path.extension()
        .is_some_and(|end| end.eq_ignore_ascii_case("html"))
}

/// A table, and its chart as SVG if it has one.
type Charted = (Table, Option<String>);

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
    let made = make(job, interrupt)?;
    let print = |out: &mut dyn io::Write| match job.form() {
        Form::Json => {
            let tables: Vec<&Table> = made.iter().map(|(table, _)| table).collect();
            serde_json::to_writer_pretty(&mut *out, &tables)?;
            writeln!(out)
        }
        Form::Page => out.write_all(page::of(&made, job).as_bytes()),
        Form::Text => {
            let texts: Vec<String> = made.iter().map(|(table, _)| text::of(table)).collect();
            out.write_all(texts.join("\n").as_bytes())
        }
    };
    match &job.output {
        Some(path) => output::write_file(path, interrupt, print),
        None => output::write_stdout(interrupt, print),
    }
}

/// Makes the tables, and draws the charts of some.
fn make(job: &TablesJob, interrupt: &Interrupt) -> Result<Vec<Charted>, Error> {
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
        let mut svg = None;
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
                svg = draw(job, "figure-24", &chart, interrupt)?;
                shared::eight(&outcomes, simulation, runs.size.is_none())
            }
            TableNumber::Nine => {
                if job.charts.is_some() || job.form() == Form::Page {
                    let across: Vec<u32> = (1..=MOST_PROCESSORS).collect();
                    let outcomes = Outcomes::by_processors(&figures, &across, simulation);
                    let chart = Chart::of_processors(&outcomes, simulation);
                    svg = draw(job, "figure-25", &chart, interrupt)?;
                }
                let outcomes = Outcomes::by_processors(&figures, &PROCESSORS, simulation);
                shared::nine(&outcomes, &figures, simulation, runs.size.is_none())
            }
        };
        tables.push((draft.beside(&thesis), svg));
        progress.step();
    }
    Ok(tables)
}

/// Draws a chart if charts are requested; returns it if a page shows it.
fn draw(
    job: &TablesJob,
    name: &str,
    chart: &Chart<'_>,
    interrupt: &Interrupt,
) -> Result<Option<String>, Error> {
    if let Some(folder) = &job.charts {
        for ending in ["svg", "png"] {
            let path = folder.join(format!("{name}.{ending}"));
            canvas::write_figure(&path, chart, interrupt)?;
        }
    }
    (job.form() == Form::Page)
        .then(|| canvas::svg(chart))
        .transpose()
}
