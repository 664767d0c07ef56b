//! A simulated panel: a scene file drawn strip by strip as a board would, by the board's own code.
//!
//! | module | what it holds |
//! | --- | --- |
//! | `screen` | the simulated panel: pictures of it, and a live window |
//! | `overlay` | a line of text at the bottom |

mod overlay;
mod screen;

use embedded_graphics::pixelcolor::{BinaryColor, Gray8, Rgb565, Rgb888};
use octray_core::frame::Region;
use octray_embedded::dither::{Dithered, PanelColor};
use octray_embedded::render::{ROWS, Strips};
use octray_prepare::{Arith, RenderSettings};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::picture::Target;
use octray_render::renderer;
use octray_render::scene_file;
use octray_render::tile::Tile;
use octray_scenes::name::Shown;
use screen::Screen;
use std::path::PathBuf;
use std::time::Instant;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// What the pixels of a panel can show.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "lowercase")]
pub enum Color {
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

/// What to draw, and on what. Everything is in the ranges that the help names.
#[derive(Clone, Debug)]
pub struct PanelJob {
    /// The scene file.
    pub scene: PathBuf,
    /// Columns and rows of the panel.
    pub panel: (u32, u32),
    /// What its pixels can show.
    pub color: Color,
    /// The arithmetic to trace in.
    pub arith: Arith,
    /// Whether colours are dithered.
    pub dither: bool,
    /// Whether there is a line of text at the bottom.
    pub overlay: bool,
    /// Columns and rows of a pixel in pictures.
    pub scale: u32,
    /// The picture of the finished panel.
    pub output: Target,
    /// Where pictures after each strip go.
    pub frames: Option<PathBuf>,
}

/// Draws the scene on the panel, writes pictures of it, and tells what it took.
///
/// # Errors
/// When the scene is refused or does not fit the arithmetic, a picture cannot be written, or the user
/// stops it.
pub fn run(job: &PanelJob, interrupt: &Interrupt) -> Result<(), Error> {
    match job.color {
        Color::Rgb565 => show::<Rgb565>(job, interrupt),
        Color::Rgb888 => show::<Rgb888>(job, interrupt),
        Color::Gray8 => show::<Gray8>(job, interrupt),
        Color::Bw => show::<BinaryColor>(job, interrupt),
    }
}

fn show<C>(job: &PanelJob, interrupt: &Interrupt) -> Result<(), Error>
where
    C: PanelColor + Into<Rgb888> + From<Rgb888>,
{
    output::probe(&job.output.path)?;
    let scene = scene_file::read(&job.scene)?;
    let (width, height) = job.panel;
    let settings = RenderSettings {
        arith: job.arith,
        size: Some(job.panel),
        ..RenderSettings::DEFAULT
    };
    let renderer = renderer::prepare(&scene, &settings)?;
    let strips = Strips {
        width,
        height,
        block: renderer.built().block,
    };
    let mut screen = Screen::<C>::new(job, interrupt)?;
    let mut dithered = Dithered {
        panel: &mut screen,
        ordered: job.dither,
    };
    let mut worker = renderer.worker(interrupt);
    let mut strip = vec![[0; 3]; (width * ROWS) as usize];
    // Not the time that the simulated panel takes.
    let mut tracing = std::time::Duration::ZERO;
    strips.draw(&mut dithered, &mut strip, |rows, pixels| {
        let begin = Instant::now();
        let columns = 0..width;
        worker.trace(Tile {
            region: Region { columns, rows },
            levels: pixels,
            intensities: None,
        });
        tracing += begin.elapsed();
    })?;
    let caption = overlay::text(
        renderer.built().format.name(),
        worker.counters().all_rays(),
        tracing.as_secs_f64(),
    );
    if job.overlay {
        screen.overlay(&caption)?;
    }
    job.output
        .write(&screen.picture()?, Default::default(), interrupt)?;
    output::write_report([&job.output.path], interrupt, |out| {
        writeln!(out, "{}: {caption}", Shown(&job.output.path))
    })?;
    screen.wait()
}
