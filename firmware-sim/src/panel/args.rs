//! The command line of the panel simulator.

use clap::{Parser, ValueEnum, value_parser};
use octray::cli::{files, value};
use octray::error::Error;
use octray::picture::Target;
use octray_engine::options::Arith;
use std::path::PathBuf;

/// Draws a scene on a simulated panel, strip by strip, by the code that draws on boards
#[derive(Clone, Debug, Parser)]
#[command(name = "octray-firmware", version, max_term_width = 100, after_help = EXIT_CODES)]
pub(crate) struct PanelArgs {
    /// The scene file
    scene: PathBuf,
    /// Columns and rows of the panel
    #[arg(long, value_name = "WxH", default_value = "320x240", value_parser = value::size)]
    panel: (u32, u32),
    /// What its pixels can show
    #[arg(long, value_name = "KIND", value_enum, default_value_t)]
    color: Color,
    /// The arithmetic to trace in
    #[arg(long, value_name = "NAME", value_enum, default_value_t = Arith::Auto)]
    arith: Arith,
    /// Round colours to the nearest instead of dithering them
    #[arg(long)]
    no_dither: bool,
    /// Leave out the line at the bottom that tells arithmetic, rays and time
    #[arg(long)]
    no_overlay: bool,
    /// Show every pixel of the panel as N x N
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=16))]
    scale: u32,
    /// The picture of the panel: .png, .ppm, .pfm or .ras [default: the scene's name with -panel.png,
    /// in the current folder]
    #[arg(short, long, value_name = "FILE", value_parser = value::target())]
    output: Option<Target>,
    /// Write a picture after each strip into this folder, as frame-0001.png and so on
    #[arg(long, value_name = "DIR")]
    frames: Option<PathBuf>,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 failed, 2 bad usage, 130 interrupted.";

/// What the pixels of a panel can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// 5 bits of red, 6 of green, 5 of blue
    #[default]
    Rgb565,
    /// 8 bits each
    Rgb888,
    /// 256 greys
    Gray8,
    /// Black and white
    Bw,
}

/// What to draw, and on what. Everything is in the ranges told in the help.
#[derive(Clone, Debug)]
pub(crate) struct PanelJob {
    /// The scene file.
    pub(crate) scene: PathBuf,
    /// Columns and rows of the panel.
    pub(crate) panel: (u32, u32),
    /// What its pixels can show.
    pub(crate) color: Color,
    /// The arithmetic to trace in.
    pub(crate) arith: Arith,
    /// Whether colours are dithered.
    pub(crate) dither: bool,
    /// Whether there is a line of text at the bottom.
    pub(crate) overlay: bool,
    /// Columns and rows of a pixel in pictures.
    pub(crate) scale: u32,
    /// The picture of the finished panel.
    pub(crate) output: Target,
    /// Where pictures after each strip go.
    pub(crate) frames: Option<PathBuf>,
}

/// The most pixels that a picture of the panel may have.
const MOST_PIXELS: u64 = 1 << 26;

impl PanelArgs {
    /// The job that these arguments ask for.
    ///
    /// # Errors
    /// [`Error::Usage`] if the panel is too large, or the picture would replace the scene.
    pub(crate) fn job(self) -> Result<PanelJob, Error> {
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
                let mut name = self.scene.file_stem().unwrap_or_default().to_owned();
                name.push("-panel.png");
                Target::new(name.into()).map_err(Error::Usage)?
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
