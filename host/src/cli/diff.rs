//! Arguments of `octray diff`.

use super::{files, value};
use crate::diff::{DiffJob, DiffLimits, Share};
use clap::Args;
use octray_prepare::choice::Choice;
use octray_render::error::Error;
use octray_render::picture::{RasDepth, Target};
use std::path::PathBuf;

/// Arguments of `octray diff`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Pictures are PNG, PPM (P6), PFM, Sun rasterfiles or intensity files; the file's contents decide. They are compared by their \
8-bit levels. A pixel's difference is the largest of its channels' differences. The exit code is 1 when \
any bound is exceeded. In JSON, the PSNR of equal pictures, which is infinite, is null.")]
pub struct DiffArgs {
    /// The first picture
    #[arg(value_name = "A")]
    a: PathBuf,
    /// The second picture
    #[arg(value_name = "B")]
    b: PathBuf,
    /// Write a heat map: dim grey where the pictures are equal, violet to yellow where they differ
    #[arg(short, long, value_name = "FILE", value_parser = value::target())]
    output: Option<Target>,
    /// Bits per pixel of a heat map that is a Sun rasterfile
    #[arg(long, value_name = "BITS", value_parser = value::choice::<RasDepth>(), default_value = RasDepth::default().name())]
    ras_depth: RasDepth,
    /// Print one JSON object instead of text
    #[arg(long)]
    json: bool,
    /// The largest root-mean-square error, in levels
    #[arg(long, value_name = "LEVELS", value_parser = value::not_negative, help_heading = BOUNDS)]
    max_rmse: Option<f64>,
    /// The smallest peak signal-to-noise ratio, in dB
    #[arg(long, value_name = "DB", value_parser = value::not_negative, help_heading = BOUNDS)]
    min_psnr: Option<f64>,
    /// The largest difference of any pixel, in levels
    #[arg(long, value_name = "LEVELS", help_heading = BOUNDS)]
    max_difference: Option<u8>,
    /// The most pixels that differ by more than one level, as a number or in per cent
    #[arg(long = "max-beyond-1", value_name = "N|P%", value_parser = value::share, help_heading = BOUNDS)]
    max_beyond_1: Option<Share>,
    /// The most pixels that differ by more than eight levels, as a number or in per cent
    #[arg(long = "max-beyond-8", value_name = "N|P%", value_parser = value::share, help_heading = BOUNDS)]
    max_beyond_8: Option<Share>,
}

const BOUNDS: &str = "Bounds";

impl DiffArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if the heat map would replace a picture.
    pub fn job(self) -> Result<DiffJob, Error> {
        let heat = self.output.as_ref().map(|target| &target.path);
        files::distinct([&self.a, &self.b], heat)?;
        Ok(DiffJob {
            a: self.a,
            b: self.b,
            heat: self.output,
            ras_depth: self.ras_depth,
            json: self.json,
            limits: DiffLimits {
                rmse: self.max_rmse,
                psnr: self.min_psnr,
                largest: self.max_difference,
                beyond_1: self.max_beyond_1,
                beyond_8: self.max_beyond_8,
            },
        })
    }
}
