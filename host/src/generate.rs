//! `octray generate`: writes a scene of any size, made from a seed.

use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_scenes::generate::{Spec, generate};
use std::io::{self, Write};
use std::path::PathBuf;

/// What to generate, and where to write it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GenerateJob {
    /// The kind and the number of objects.
    pub spec: Spec,
    /// The seed of the random numbers.
    pub seed: u64,
    /// The scene file; standard output if `None`.
    pub output: Option<PathBuf>,
}

/// Generates the scene and writes it. A comment at the top states the command that made it.
///
/// # Errors
/// If it cannot be written, or writing is interrupted.
pub fn run(job: &GenerateJob, interrupt: &Interrupt) -> Result<(), Error> {
    if let Some(path) = &job.output {
        output::probe(path)?;
    }
    let scene = generate(job.spec, job.seed);
    interrupt.check()?;
    let write = |mut out: &mut dyn Write| -> io::Result<()> {
        let Spec { kind, objects } = job.spec;
        let (kind, seed) = (kind.name(), job.seed);
        writeln!(
            out,
            "# octray generate {kind} --count {objects} --seed {seed}"
        )?;
        octray_scenes::write(&scene, &mut out)
    };
    match &job.output {
        Some(path) => output::write_file(path, interrupt, write),
        None => output::write_stdout(interrupt, write),
    }
}
