//! Renders the same picture on the host: the firmware's must equal it, it gives the number of rays, and its distance
//! from the picture in 64-bit floats is measured.

use crate::budget;
use octray_prepare::{Arith, RenderSettings, TreeSettings};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::metric::Difference;
use octray_render::render::{Rendering, render_with};
use octray_render::schedule::Schedule;
use octray_scenes::model::Scene;
use std::num::NonZeroUsize;

/// The host's picture.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Picture, rays, format.
    pub traced: Rendering,
    /// Its distance from the picture in `f64` (PSNR), in dB; infinite if they are equal.
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
        settings: &RenderSettings,
        exact: &Rendering,
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let traced = render(scene, arith, settings, interrupt)?;
        let psnr = Difference::between(&exact.picture, &traced.picture)?.psnr();
        Ok(Self { traced, psnr })
    }
}

/// Renders with the settings, but in this arithmetic and with the default tree, on one thread, if the picture does not
/// take too many rays.
///
/// # Errors
/// As [`render_with`]; [`Error::TooManyRays`] among them.
pub fn render(
    scene: &Scene,
    arith: Arith,
    settings: &RenderSettings,
    interrupt: &Interrupt,
) -> Result<Rendering, Error> {
    let settings = RenderSettings {
        arith,
        tree: TreeSettings::default(),
        ..*settings
    };
    let work = Schedule {
        threads: NonZeroUsize::MIN,
        ..Schedule::default()
    };
    let budget = budget::rays(settings.size_of(scene), settings.samples);
    let interrupt = interrupt.with_budget(budget);
    render_with(scene, &settings, &work, false, &(), &interrupt)
}
