//! Arguments of `octray tables`.

use crate::cli::{files, value};
use clap::Args;
use octray_lab::simulate::Machine;
use octray_lab::tables::number::TableNumber;
use octray_lab::tables::shared::{COHERENCE, Simulation};
use octray_lab::tables::{self, TablesJob};
use octray_prepare::choice::Choice;
use octray_render::error::Error;
use std::num::NonZeroU32;
use std::path::PathBuf;

/// Arguments of `octray tables`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Each row is a row of the thesis, in its conditions: lights, surfaces, pixels per ray, H and processors. At other sizes than \
its own only ratios are compared. The output is the same in every run, except for what --time adds.")]
pub struct TablesArgs {
    /// The tables [default: all]
    #[arg(value_name = "TABLE", value_parser = value::choice::<TableNumber>().ignore_case())]
    tables: Vec<TableNumber>,
    /// Print JSON instead of tables to read
    #[arg(long)]
    json: bool,
    /// Write to this file instead of standard output: a page with charts if its name ends in .html
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write figures 24 and 25 into this folder, as SVG and PNG
    #[arg(long, value_name = "FOLDER")]
    charts: Option<PathBuf>,
    /// Columns and rows of the pictures; the framing stays the same [default: the scenes' own, 512x512]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// Print tracing times too, measured on one thread
    #[arg(long)]
    time: bool,
    /// The thesis's numbers, as comma-separated values [default: those that come with octray]
    #[arg(long, value_name = "FILE")]
    thesis: Option<PathBuf>,
    /// The record for table III, written by `octray measure --csv` [default: the newest that comes with octray]
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Processors in table VIII
    #[arg(long, value_name = "N", default_value = "8", value_parser = value::count)]
    processors: NonZeroU32,
    /// Rows of a tile in table IX
    #[arg(long, alias = "packet-rows", value_name = "H", default_value = "2", value_parser = value::count)]
    tile_rows: NonZeroU32,
    /// Instructions for which handing out a tile blocks the other processors, in VIII and IX
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    hand_out: f64,
    /// Slowdown of all processors per further busy processor, as a fraction, in VIII and IX
    #[arg(long, value_name = "C", default_value = "0", value_parser = value::not_negative)]
    contention: f64,
    /// Slowdown of all processors per pair of busy processors and direction, as a fraction, in VIII and IX
    #[arg(long, value_name = "K", default_value_t = COHERENCE, value_parser = value::not_negative)]
    coherence: f64,
    /// Instructions that one processor executes before the others begin, in VIII and IX
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    serial: f64,
}

impl TablesArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if charts are requested without their tables, JSON for a page, or if the output would replace an
    /// input.
    pub fn job(self) -> Result<TablesJob, Error> {
        let inputs = [&self.thesis, &self.record];
        files::distinct(inputs.into_iter().flatten(), &self.output)?;
        if self.json && self.output.as_deref().is_some_and(tables::is_page) {
            return Err(Error::Usage(
                "a page is no JSON: name another file, or leave out --json".into(),
            ));
        }
        let mut tables = self.tables;
        if tables.is_empty() {
            tables = TableNumber::all();
        }
        tables.sort_unstable();
        tables.dedup();
        if self.charts.is_some() && !tables.iter().any(|number| *number >= TableNumber::Eight) {
            return Err(Error::Usage(
                "--charts draws figure 24 with table VIII and figure 25 with table IX: name one of them".into(),
            ));
        }
        Ok(TablesJob {
            tables,
            size: self.size,
            time: self.time,
            thesis: self.thesis,
            record: self.record,
            simulation: Simulation {
                processors: self.processors,
                rows: self.tile_rows,
                machine: Machine {
                    hand_out: self.hand_out,
                    contention: self.contention,
                    coherence: self.coherence,
                    serial: self.serial,
                },
            },
            json: self.json,
            output: self.output,
            charts: self.charts,
        })
    }
}
