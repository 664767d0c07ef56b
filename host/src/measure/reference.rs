//! The same picture on the host: what the firmware's must be like to the byte, how many rays it
//! takes, and how far it is from the one in 64-bit floats.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::job::{RenderJob, WorkOptions};
use crate::metric::Difference;
use crate::progress::Progress;
use crate::render::Traced;
use crate::trace::trace;
use octray_engine::options::{Arith, PixelsPerRay, Tree, TreeOptions, ViewOptions};
use octray_scenes::model::Scene;
use std::num::NonZeroUsize;

/// What the firmware renders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Columns and rows.
    pub size: (u32, u32),
    /// The most bounces.
    pub max_depth: u32,
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// The weight below which no ray is traced, 0 to 1.
    pub cut_off: f64,
}

/// The host's picture.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Picture, rays, format.
    pub traced: Traced,
    /// Its distance from the picture in `f64`, in dB; infinite if they are equal.
    pub psnr: f64,
}

impl Reference {
    /// Renders in an arithmetic, on one thread.
    ///
    /// # Errors
    /// [`Error::Failed`] if the scene does not fit the arithmetic, [`Error::Interrupted`].
    pub fn render(
        scene: &Scene,
        arith: Arith,
        view: View,
        exact: &Traced,
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let traced = render(scene, arith, view, interrupt)?;
        let psnr = Difference::between(&exact.picture, &traced.picture)?.psnr();
        Ok(Self { traced, psnr })
    }
}

/// The picture in one arithmetic.
///
/// # Errors
/// As [`trace`].
pub fn render(
    scene: &Scene,
    arith: Arith,
    view: View,
    interrupt: &Interrupt,
) -> Result<Traced, Error> {
    let view = ViewOptions {
        size: Some(view.size),
        pixels_per_ray: view.pixels_per_ray,
        samples: 1,
        max_depth: view.max_depth,
        cut_off: view.cut_off,
    };
    let work = WorkOptions {
        threads: NonZeroUsize::MIN,
        ..WorkOptions::default()
    };
    let job = RenderJob::in_memory(arith, TreeOptions::of(Tree::Tight), view, work);
    trace(scene, &job, &Progress::hidden(), interrupt)
}
