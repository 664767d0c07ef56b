//! The panel simulator: a scene file drawn strip by strip as a board would, by the board's own code.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`args`] | the command line, checked |
//! | [`screen`] | the simulated panel: pictures of it, and a live window |
//! | [`overlay`] | a line of text at the bottom |

mod args;
mod overlay;
mod screen;

pub(crate) use args::PanelArgs;

use args::{Color, PanelJob};
use embedded_graphics::pixelcolor::{BinaryColor, Gray8, Rgb565, Rgb888};
use octray::error::Error;
use octray::interrupt::Interrupt;
use octray::{check, output};
use octray_core::frame::Region;
use octray_engine as engine;
use octray_engine::options::{PixelsPerRay, Tree, TreeOptions, ViewOptions};
use octray_engine::packet::Packet;
use octray_firmware_sim::dither::{Dithered, PanelColor};
use octray_firmware_sim::render::{ROWS, Strips};
use octray_scenes::bake::CUT_OFF;
use screen::Screen;
use std::time::Instant;

/// Bounces, as the firmware has them baked.
const MAX_DEPTH: u32 = 8;

/// Draws the scene on the panel, writes pictures of it, and tells what it took.
///
/// # Errors
/// When the scene is refused or does not fit the arithmetic, a picture cannot be written, or the user
/// stops it.
pub(crate) fn run(job: &PanelJob, interrupt: &Interrupt) -> Result<(), Error> {
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
    let scene = check::read(&job.scene)?;
    let (width, height) = job.panel;
    let tree = TreeOptions::of(Tree::Tight);
    let view = ViewOptions {
        size: Some(job.panel),
        pixels_per_ray: PixelsPerRay::One,
        samples: 1,
        max_depth: MAX_DEPTH,
        cut_off: CUT_OFF,
    };
    let engine = engine::build(&scene, job.arith, &tree, &view)?;
    let strips = Strips {
        width,
        height,
        block: engine.built().block,
    };
    let mut screen = Screen::<C>::new(job, interrupt)?;
    let mut dithered = Dithered {
        panel: &mut screen,
        ordered: job.dither,
    };
    let mut worker = engine.worker();
    let mut strip = vec![[0; 3]; (width * ROWS) as usize];
    // Not the time that the simulated panel takes.
    let mut tracing = std::time::Duration::ZERO;
    strips.draw(&mut dithered, &mut strip, |rows, pixels| {
        let begin = Instant::now();
        let columns = 0..width;
        worker.trace(Packet {
            region: Region { columns, rows },
            levels: pixels,
            intensities: None,
        });
        tracing += begin.elapsed();
    })?;
    let told = overlay::text(
        engine.built().format,
        worker.counters().all_rays(),
        tracing.as_secs_f64(),
    );
    if job.overlay {
        screen.overlay(&told)?;
    }
    job.output
        .write(&screen.picture()?, Default::default(), interrupt)?;
    output::write_stdout(interrupt, |out| {
        writeln!(out, "{}: {told}", job.output.path.display())
    })?;
    screen.wait()
}
