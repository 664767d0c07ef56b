//! Arguments of `octray stability`.

use super::lists;
use crate::cli::{files, value};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use octray_lab::stability::StabilityJob;
use octray_render::error::Error;
use octray_stability::method::Method;
use octray_stability::number::ARITHMETICS;
use octray_stability::sweep;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Arguments of `octray stability`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
References are exact, and the cases are the same on every machine. The text above each table states what holds, degrades \
and breaks; the limits are those around the easiest value. A value is admitted if its scene fits the arithmetic and is not \
too fine for it; no form that octray ships breaks there. In maps, a dot means holds, a pale symbol degrades, a dark one \
breaks; a bar marks the end of the admitted values.")]
pub struct StabilityArgs {
    /// The methods to examine [default: all]
    #[arg(value_name = "METHOD", value_parser = method())]
    methods: Vec<Method>,
    /// Print only the limits in these arithmetics, in one table for all methods
    #[arg(
        long,
        value_name = "ARITH,...",
        value_parser = arithmetic(),
        value_delimiter = ','
    )]
    limits: Option<Vec<usize>>,
    /// Write a map of each method into this folder, as SVG and PNG; for polygons also the queries
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Write all measurements as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write all measurements as CSV, one line per value, form and arithmetic
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = value::threads)]
    threads: Option<NonZeroUsize>,
}

impl StabilityArgs {
    /// Returns the job, without duplicates.
    ///
    /// # Errors
    /// [`Error::Usage`] if two results are one file.
    pub fn job(self) -> Result<StabilityJob, Error> {
        let results = [&self.json, &self.csv];
        files::distinct([""; 0], results.into_iter().flatten())?;
        Ok(StabilityJob {
            methods: if self.methods.is_empty() {
                sweep::ALL.to_vec()
            } else {
                lists::once(self.methods, |a, b| a.about.name == b.about.name)
            },
            folder: self.output,
            overview: (self.limits).map(|numbers| lists::once(numbers, |a, b| a == b)),
            json: self.json,
            csv: self.csv,
            threads: self.threads.unwrap_or_else(|| {
                std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
            }),
        })
    }
}

fn arithmetic() -> impl TypedValueParser<Value = usize> {
    PossibleValuesParser::new(ARITHMETICS).try_map(|name| {
        let named = ARITHMETICS.iter().position(|other| *other == name);
        named.ok_or("no such arithmetic")
    })
}

fn method() -> impl TypedValueParser<Value = Method> {
    let values = sweep::ALL
        .iter()
        .map(|method| PossibleValue::new(method.about.name).help(method.about.title));
    PossibleValuesParser::new(values).try_map(|name| {
        let named = sweep::ALL.iter().find(|method| method.about.name == name);
        named.copied().ok_or("no such method")
    })
}
