//! The command `octray`, as a library so that tests can call it.
//!
//! [`cli`] turns raw arguments into a checked job, and a command runs the job: [`render`], [`trace`], [`check`], [`overlaps`], [`mod@bake`],
//! [`mod@generate`], [`diff`], [`convert`], or a command of the laboratory. [`main`] turns the result into an exit code. [`stats`]
//! and [`summary`] are what `render` reports; `ranks`, with the feature `mpi`, distributes a rendering over the ranks
//! of an MPI job.

pub mod bake;
pub mod check;
pub mod cli;
pub mod convert;
pub mod diff;
pub mod frames;
pub mod generate;
pub mod job;
pub mod overlaps;
#[cfg(feature = "mpi")]
pub mod ranks;
pub mod render;
pub mod signal;
pub mod stats;
pub mod summary;
pub mod trace;

use clap::FromArgMatches;
use cli::{Cli, Command};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_scenes::name;
use signal::Signals;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

/// Runs a command line of `octray`. Messages go to standard error. The exit code is 0 for success, 1 for failure and 2
/// for bad usage; after a signal it is 128 and the signal's number: 130 for Ctrl-C, 143 for SIGTERM.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let parsed = cli::command()
        .try_get_matches_from(arguments)
        .and_then(|matches| Cli::from_arg_matches(&matches));
    let arguments = match parsed {
        Ok(arguments) => arguments,
        Err(answer) => {
            // Help or an error message; it is not an error if it cannot be printed.
            let _ = answer.print();
            return match answer.use_stderr() {
                true => ExitCode::from(2),
                false => ExitCode::SUCCESS,
            };
        }
    };
    let signals = match Signals::watch() {
        Ok(signals) => signals,
        Err(cause) => {
            report_error(&Error::Failed(format!("cannot watch for Ctrl-C: {cause}")));
            return ExitCode::FAILURE;
        }
    };
    match run(arguments.command, &signals.interrupt) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report_error(&error);
            match error {
                Error::Interrupted => signals.exit_code(),
                _ => exit_code(&error),
            }
        }
    }
}

fn run(command: Command, interrupt: &Interrupt) -> Result<(), Error> {
    match command {
        Command::Render(args) => {
            let job = args.job()?;
            match job.mpi {
                #[cfg(feature = "mpi")]
                true => ranks::render(&job, interrupt),
                _ => match &job.frames {
                    Some(frames) => frames::run(&job, frames, interrupt),
                    None => render::run(&job, interrupt, render::trace),
                },
            }
        }
        Command::Trace(args) => trace::run(&args.job()?, interrupt),
        Command::Check(args) => check::run(&args.scenes, interrupt),
        Command::Overlaps(args) => overlaps::run(&args.job(), interrupt),
        Command::Bake(args) => bake::run(&args.job()?, interrupt),
        Command::Generate(args) => generate::run(&args.job(), interrupt),
        Command::Convert(args) => convert::run(&args.job()?, interrupt),
        Command::Diff(args) => diff::run(&args.job()?, interrupt),
        Command::Lab(command) => command.run(interrupt),
    }
}

/// Returns 2 for bad usage, 0 for a closed pipe at standard output, 1 otherwise.
fn exit_code(error: &Error) -> ExitCode {
    ExitCode::from(match error {
        Error::Usage(_) => 2,
        Error::BrokenPipe => 0,
        _ => 1,
    })
}

/// A message as a terminal may show it: whatever a file contains of which it tells, no line commands the terminal, and none
/// is endless.
fn readable(message: &str) -> String {
    const LONGEST: usize = 400;
    let shortened = message
        .split('\n')
        .map(|line| match line.char_indices().nth(LONGEST) {
            Some((end, _)) => name::line(&line[..end]) + "...",
            None => name::line(line),
        });
    shortened.collect::<Vec<_>>().join("\n")
}

/// Writes a failure to standard error, in the form in which bad arguments are reported.
fn report_error(error: &Error) {
    let mut stderr = io::stderr().lock();
    // A failure to print cannot be reported.
    let _ = match error {
        Error::BrokenPipe => Ok(()),
        // Drawn diagnostics have their own heading.
        Error::Scene(_) | Error::Interrupted => writeln!(stderr, "{error}"),
        Error::Bounds(exceeded) => exceeded
            .iter()
            .try_for_each(|sentence| writeln!(stderr, "error: {sentence}")),
        Error::Usage(_) => writeln!(
            stderr,
            "error: {error}\n\nFor more information, try '--help'."
        ),
        _ => writeln!(stderr, "error: {}", readable(&error.to_string())),
    };
}
