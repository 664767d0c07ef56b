//! The command `octray`, as a library so that tests and reports can use its parts.
//!
//! In the order of the data: raw arguments ([`cli`]) become a checked job ([`job`], [`diff::DiffJob`]), which a
//! command runs ([`render`], [`check`], [`mod@bake`], [`mod@generate`], [`diff`], [`measure`], [`plan`], [`stability`], [`chart`], [`tables`]) to an exit code ([`error`]).
//!
//! - [`picture`]: pictures, and the files that hold them; [`output`]: files that appear whole or not at all
//! - [`packets`], [`deal`], [`threads`], [`assembly`]: the work cut into packets, dealt to threads, and put together
//! - [`cost`], [`simulate`], [`sweep`]: what parts of a picture cost to trace, and how many processors would share that
//! - [`packing`]: the shape of packets and the way to deal them that suit a scene
//! - [`octray_engine`], [`trace`]: a scene made ready in some arithmetic with some tree, and the picture traced
//! - `ranks`, with the feature `mpi`: the same spread over the ranks of an MPI job
//! - [`interrupt`], [`progress`]: Ctrl-C and the progress bar
//! - [`facts`], [`stats`], [`summary`]: what was in a scene and what it cost, as JSON or to read
//! - [`canvas`]: what charts and maps are drawn on
//! - [`metric`], [`heat`]: how far apart two pictures are, in numbers and as a picture

pub mod assembly;
pub mod bake;
pub mod canvas;
pub mod chart;
pub mod check;
pub mod cli;
pub mod cost;
pub mod deal;
pub mod diff;
pub mod error;
pub mod facts;
pub mod generate;
pub mod heat;
pub mod interrupt;
pub mod job;
pub mod measure;
pub mod metric;
pub mod output;
pub mod packets;
pub mod packing;
pub mod picture;
pub mod plan;
pub mod progress;
#[cfg(feature = "mpi")]
pub mod ranks;
pub mod render;
pub mod report;
pub mod simulate;
pub mod stability;
pub mod stats;
pub mod summary;
pub mod sweep;
pub mod tables;
pub mod threads;
pub mod trace;

use clap::Parser;
use cli::{Cli, Command};
use error::Error;
use interrupt::Interrupt;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

/// Do what a command line of `octray` asks for; the exit code is that of [`launch`].
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    launch(arguments, |cli: Cli, interrupt| run(cli.command, interrupt))
}

/// Do with `run` what a command line asks for; messages go to standard error. The exit code is 0 when done,
/// 1 when it failed, 2 for bad usage and 130 when interrupted.
pub fn launch<A: Parser>(
    arguments: impl IntoIterator<Item = OsString>,
    run: impl FnOnce(A, &Interrupt) -> Result<(), Error>,
) -> ExitCode {
    let arguments = match A::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(answer) => {
            // Help or a complaint; if nobody reads it, so be it.
            let _ = answer.print();
            return match answer.use_stderr() {
                true => ExitCode::from(2),
                false => ExitCode::SUCCESS,
            };
        }
    };
    match Interrupt::on_signal().and_then(|interrupt| run(arguments, &interrupt)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tell(&error);
            error.exit_code()
        }
    }
}

fn run(command: Command, interrupt: &Interrupt) -> Result<(), Error> {
    match command {
        Command::Render(args) => {
            let job = args.job()?;
            match job.work.mpi {
                #[cfg(feature = "mpi")]
                true => ranks::render(&job, interrupt),
                _ => render::run(&job, interrupt, trace::trace),
            }
        }
        Command::Check(args) => check::run(&args.scenes, interrupt),
        Command::Bake(args) => bake::run(&args.job()?, interrupt),
        Command::Generate(args) => generate::run(&args.job(), interrupt),
        Command::Diff(args) => diff::run(&args.job()?, interrupt),
        Command::Measure(args) => measure::run(&args.job()?, interrupt),
        Command::Plan(args) => plan::run(&args.job()?, interrupt),
        Command::Schedule(args) => sweep::run(&args.job()?, interrupt),
        Command::Chart(args) => chart::run(&args.job()?, interrupt),
        Command::Report(args) => report::run(&args.job()?, interrupt),
        Command::Stability(args) => stability::run(&args.job()?, interrupt),
        Command::Tables(args) => tables::run(&args.job()?, interrupt),
    }
}

/// Write a failure to standard error, in the form that bad arguments are told in.
fn tell(error: &Error) {
    let mut stderr = io::stderr().lock();
    // Nothing is left to do if that fails.
    let _ = match error {
        Error::BrokenPipe => Ok(()),
        // Drawn diagnostics bring their own heading.
        Error::Scene(_) | Error::Interrupted => writeln!(stderr, "{error}"),
        Error::Bounds(exceeded) => exceeded
            .iter()
            .try_for_each(|sentence| writeln!(stderr, "error: {sentence}")),
        Error::Usage(_) => writeln!(
            stderr,
            "error: {error}\n\nFor more information, try '--help'."
        ),
        _ => writeln!(stderr, "error: {error}"),
    };
}
