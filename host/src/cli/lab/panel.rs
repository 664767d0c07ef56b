//! Arguments of `octray panel`.

use crate::cli::{files, value};
use clap::{Args, value_parser};
use octray_panel::{Color, PanelJob};
use octray_prepare::Arith;
use octray_prepare::choice::Choice;
use octray_render::error::Error;
use octray_render::picture::Target;
use std::path::PathBuf;

/// Arguments of `octray panel`.
#[derive(Clone, Debug, Args)]
pub struct PanelArgs {
    /// The scene file
    scene: PathBuf,
    /// Columns and rows of the panel
    #[arg(long, value_name = "WxH", default_value = "320x240", value_parser = value::size)]
    panel: (u32, u32),
    /// Colours of the panel's pixels
    #[arg(long, value_name = "KIND", value_parser = value::choice::<Color>(), default_value = Color::default().name())]
    color: Color,
    /// The arithmetic to trace in
    #[arg(long, value_name = "NAME", value_parser = value::choice::<Arith>(), default_value = Arith::Auto.name())]
    arith: Arith,
    /// Round to the nearest colour instead of dithering
    #[arg(long)]
    no_dither: bool,
    /// Omit the line at the bottom with arithmetic, rays and time
    #[arg(long)]
    no_overlay: bool,
    /// Draw every pixel of the panel as N x N pixels
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=16))]
    scale: u32,
    /// The picture of the panel: .png, .ppm, .pfm or .ras [default: the scene's name with -panel.png,
    /// in the current folder]
    #[arg(short, long, value_name = "FILE", value_parser = value::target())]
    output: Option<Target>,
    /// Write a picture after each strip into this folder: frame-0001.png and so on
    #[arg(long, value_name = "DIR")]
    frames: Option<PathBuf>,
}

/// The largest number of pixels of a picture of the panel.
const MOST_PIXELS: u64 = 1 << 26;

impl PanelArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if the panel is too large, or the picture would replace the scene.
    pub fn job(self) -> Result<PanelJob, Error> {
        let (width, height) = self.panel;
        let scale = u64::from(self.scale);
        if u64::from(width) * u64::from(height) * scale * scale > MOST_PIXELS {
            return Err(Error::Usage(format!(
                "a panel of {width}x{height} at --scale {scale} is too large: \
                 expected at most {MOST_PIXELS} pixels"
            )));
        }
        let output = match self.output {
            Some(output) => output,
            None => {
                let name = files::named_after(&self.scene, "-panel.png")?;
                Target::new(name).map_err(Error::Usage)?
            }
        };
        files::distinct([&self.scene], [&output.path])?;
        Ok(PanelJob {
            scene: self.scene,
            panel: self.panel,
            color: self.color,
            arith: self.arith,
            dither: !self.no_dither,
            overlay: !self.no_overlay,
            scale: self.scale,
            output,
            frames: self.frames,
        })
    }
}
