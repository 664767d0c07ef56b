//! Arguments of `octray convert`.

use super::{files, value};
use crate::convert::ConvertJob;
use clap::Args;
use octray_render::error::Error;
use octray_render::picture::{Dither, Format, RasDepth, Target};
use std::path::PathBuf;

/// Arguments of `octray convert`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
The input's first bytes decide its format, the output's name decides its own. '-' is standard input, or standard output, \
which gets PNG unless --format is given. PFM and intensity files hold linear intensities; the other formats hold 8-bit \
levels, so that intensities become levels there.")]
pub struct ConvertArgs {
    /// The picture to read: PNG, PPM (P6), PFM, Sun rasterfile or intensity file
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The picture to write: .png, .ppm, .pfm, .ras or .int
    #[arg(value_name = "OUT")]
    output: PathBuf,
    /// The output's format, whatever its name [default: what the name says]
    #[arg(long, value_name = "FORMAT", value_parser = value::choice::<Format>())]
    format: Option<Format>,
    /// Bits per pixel of a Sun rasterfile [default: 8]
    #[arg(long, alias = "ras-depth", value_name = "BITS", value_parser = value::choice::<RasDepth>())]
    depth: Option<RasDepth>,
    /// How grey becomes black and white in a Sun rasterfile of 1 bit [default: diffusion]
    #[arg(long, value_name = "HOW", value_parser = value::choice::<Dither>())]
    dither: Option<Dither>,
}

impl ConvertArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if the output's format is unknown, an option does not apply to it, or it would replace the input.
    pub fn job(self) -> Result<ConvertJob, Error> {
        let usage = |why: &str| Err(Error::Usage(why.into()));
        let output = match self.format {
            Some(format) => Target::in_format(self.output, format),
            None => Target::new(self.output),
        };
        let output = output.map_err(Error::Usage)?;
        files::distinct([&self.input], [&output.path])?;
        if self.depth.is_some() && output.format != Format::Ras {
            return usage("--depth is for Sun rasterfiles (.ras)");
        }
        if self.dither.is_some() && self.depth != Some(RasDepth::One) {
            return usage("--dither is for Sun rasterfiles of --depth 1");
        }
        Ok(ConvertJob {
            input: self.input,
            output,
            ras_depth: self.depth.unwrap_or(RasDepth::Eight),
            dither: self.dither.unwrap_or_default(),
        })
    }
}
