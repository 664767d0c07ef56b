//! The command `octray`, as a library so that tests can call it.
//!
//! [`cli`] turns raw arguments into a checked job, and a command runs the job: [`render`], [`check`], [`mod@bake`],
//! [`mod@generate`], [`diff`], or a command of the laboratory. [`main`] turns the result into an exit code. [`stats`]
//! and [`summary`] are what `render` reports; `ranks`, with the feature `mpi`, distributes a rendering over the ranks
//! of an MPI job.

pub mod bake;
pub mod check;
pub mod cli;
pub mod diff;
pub mod generate;
pub mod job;
#[cfg(feature = "mpi")]
pub mod ranks;
pub mod render;
pub mod stats;
pub mod summary;

use clap::Parser;
use cli::{Cli, Command};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

/// The exit code of a process that was interrupted, as shells have it for Ctrl-C.
pub const INTERRUPTED: u8 = 130;

/// Does what a command line of `octray` asks for. Messages go to standard error. The exit code is 0 when done,
/// 1 when it failed, 2 for bad usage and 130 when interrupted.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Cli::try_parse_from(arguments) {
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
    match on_signal().and_then(|interrupt| run(arguments.command, &interrupt)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report_error(&error);
            exit_code(&error)
        }
    }
}

/// A flag that Ctrl-C, a termination or a hang-up of the terminal sets; a second one ends the process at once, in case
/// it is stuck where nothing polls.
fn on_signal() -> Result<Interrupt, Error> {
    let interrupt = Interrupt::new();
    let flag = interrupt.clone();
    ctrlc::set_handler(move || {
        if flag.requested() {
            std::process::exit(INTERRUPTED.into());
        }
        flag.request();
    })
    .map_err(|cause| Error::Failed(format!("cannot watch for Ctrl-C: {cause}")))?;
    Ok(interrupt)
}

fn run(command: Command, interrupt: &Interrupt) -> Result<(), Error> {
    match command {
        Command::Render(args) => {
            let job = args.job()?;
            match job.mpi {
                #[cfg(feature = "mpi")]
                true => ranks::render(&job, interrupt),
                _ => render::run(&job, interrupt, render::trace),
            }
        }
        Command::Check(args) => check::run(&args.scenes, interrupt),
        Command::Bake(args) => bake::run(&args.job()?, interrupt),
        Command::Generate(args) => generate::run(&args.job(), interrupt),
        Command::Diff(args) => diff::run(&args.job()?, interrupt),
        Command::Lab(command) => command.run(interrupt),
    }
}

/// 2 for bad usage, 130 for an interrupt, 0 for a reader of standard output that went away, 1 for the rest.
fn exit_code(error: &Error) -> ExitCode {
    ExitCode::from(match error {
        Error::Usage(_) => 2,
        Error::Interrupted => INTERRUPTED,
        Error::BrokenPipe => 0,
        _ => 1,
    })
}

/// Writes a failure to standard error, in the form in which bad arguments are reported.
fn report_error(error: &Error) {
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
