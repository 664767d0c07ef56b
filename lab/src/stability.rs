//! `octray stability`: shows where methods hold, degrade and break, as a table, as data and as maps.

mod data;
pub(crate) mod map;
pub(crate) mod overview;
pub(crate) mod queries;
pub(crate) mod table;

use crate::canvas;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use octray_stability::method::{Method, Sweep};
use octray_stability::survey::{self, survey};
use octray_stability::sweep::polygon::Polygon;
use std::fs;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// The methods to examine, and the results to write.
#[derive(Clone, Debug)]
pub struct StabilityJob {
    /// The methods.
    pub methods: Vec<Method>,
    /// Where to write the maps.
    pub folder: Option<PathBuf>,
    /// Where to write everything as JSON.
    pub json: Option<PathBuf>,
    /// Where to write everything as CSV.
    pub csv: Option<PathBuf>,
    /// The arithmetics, by their numbers, whose limits are printed in one table for all methods.
    pub overview: Option<Vec<usize>>,
    /// The number of threads.
    pub threads: NonZeroUsize,
}

/// Measures, prints the limits, and writes the requested files.
///
/// # Errors
/// If something cannot be written or drawn, or the work is interrupted.
pub fn run(job: &StabilityJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(folder) = &job.folder {
        fs::create_dir_all(folder).map_err(|source| Error::write(folder, source))?;
    }
    for file in [&job.json, &job.csv].into_iter().flatten() {
        output::probe(file)?;
    }
    let progress = Bar::new("measuring");
    progress.start(survey::steps(&job.methods));
    let proceed = || {
        progress.step();
        !interrupt.requested()
    };
    let survey = survey(&job.methods, job.threads, &proceed).ok_or(Error::Interrupted)?;
    drop(progress);
    if let Some(file) = &job.json {
        output::write_file(file, interrupt, |out| data::json(&survey, out))?;
    }
    if let Some(file) = &job.csv {
        output::write_file(file, interrupt, |out| data::csv(&survey, out))?;
    }
    if let Some(folder) = &job.folder {
        for outcome in &survey.outcomes {
            let name = outcome.about.name;
            for end in ["svg", "png"] {
                let file = folder.join(format!("{name}.{end}"));
                canvas::write_figure(&file, &map::Map(outcome), interrupt)?;
            }
            if name == Polygon::ABOUT.name {
                let file = folder.join("polygon-queries.png");
                canvas::write_figure(&file, &queries::Queries::new(), interrupt)?;
            }
        }
    }
    output::write_stdout(interrupt, |out| {
        if let Some(arithmetics) = &job.overview {
            return write!(out, "{}", overview::of(&survey, arithmetics));
        }
        for outcome in &survey.outcomes {
            writeln!(out, "{}", table::of(outcome))?;
        }
        Ok(())
    })
}
