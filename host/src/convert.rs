//! `octray convert`: reads a picture of one format and writes it in another.

use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::picture::{self, Dither, Picture, RasDepth, Target};
use octray_render::scene_file::note;
use octray_scenes::name::Shown;
use std::path::{Path, PathBuf};

/// What to convert, and into what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConvertJob {
    /// The picture to read; its first bytes tell its format.
    pub input: PathBuf,
    /// The picture to write.
    pub output: Target,
    /// Bits per pixel if it is a Sun rasterfile.
    pub ras_depth: RasDepth,
    /// How grey becomes black and white in one of 1 bit.
    pub dither: Dither,
}

/// Reads and writes. Intensities stay where both formats hold them.
///
/// # Errors
/// If the input cannot be read or is no picture, or the output cannot be written.
pub fn run(job: &ConvertJob, interrupt: &Interrupt) -> Result<(), Error> {
    output::probe(&job.output.path)?;
    let picture = read(&job.input)?;
    interrupt.check()?;
    let dithered = match (job.ras_depth, job.dither) {
        // Diffusion leaves black and white as they are.
        (RasDepth::One, dither @ Dither::Ordered) => Some(dither.apply(&picture)),
        _ => None,
    };
    let picture = dithered.as_ref().unwrap_or(&picture);
    job.output.write(picture, job.ras_depth, interrupt)
}

/// Reads a picture; that it is the first of an animation is told on standard error.
///
/// # Errors
/// Those of [`picture::read`].
pub(crate) fn read(path: &Path) -> Result<Picture, Error> {
    let (picture, count) = picture::read_first(path)?;
    if count > 1 {
        note(&format!(
            "{} is an animation: this is the first of its {count} pictures",
            Shown(path)
        ));
    }
    Ok(picture)
}
