//! How far off a picture is: from f64 of the same settings, and from what all settings converge to.

use super::ChartJob;
use super::setting::Setting;
use crate::budget;
use octray_core::observe::RayKind;
use octray_prepare::format::Format;
use octray_prepare::{Adaptive, Arith, RenderSettings};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::metric::Difference;
use octray_render::picture::Picture;
use octray_render::render::render_prepared;
use octray_render::renderer::{self, FirstHit, Renderer};
use octray_render::scene_file;
use octray_render::schedule::Schedule;
use octray_scenes::model::Scene;

/// How far off a picture is.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// The number format that was used.
    pub format: Format,
    /// From f64 of the same settings: the error of the arithmetic alone.
    pub same: Difference,
    /// From the converged picture: of arithmetic and settings together.
    pub converged: Difference,
    /// What the camera's rays meet first, beside f64 of the same settings.
    pub sight: Sight,
}

/// What the camera's rays meet first, in one arithmetic beside another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sight {
    /// The share of pixels in which a ray meets another object first, or the background instead, 0 to 1.
    pub other: f64,
    /// The largest relative difference of distances, where the object is the same.
    pub depth: f64,
}

/// The PSNR of a picture in dB. Equal pictures count as if they differed half as much as pictures can differ
/// at least, by one level in one channel of one pixel: that is finite, and above all that are not equal.
pub fn decibels(difference: &Difference) -> f64 {
    if !difference.is_zero() {
        return difference.psnr();
    }
    let least = Difference {
        squares: 1,
        ..*difference
    };
    least.psnr() + 20.0 * 2f64.log10()
}

/// Judges pictures of one scene, and keeps what it judges them by.
pub struct Judge<'a> {
    scene: &'a Scene,
    interrupt: &'a Interrupt,
    converged: Picture,
    unexplored: Option<String>,
    exact: Vec<Exact>,
}

/// A picture in f64.
struct Exact {
    setting: RenderSettings,
    picture: Picture,
    renderer: Box<dyn Renderer>,
}

/// Bounces of the converged picture, and the weight below which a ray is not traced: a thirtieth of a level. Without
/// a cut-off, rays within glass would double at every bounce.
const CONVERGED_DEPTH: u32 = 16;
const CONVERGED_CUT_OFF: f64 = 1.0 / 8192.0;

impl<'a> Judge<'a> {
    /// Renders the converged picture: f64, many rays per pixel, and bounces as long as they change anything.
    ///
    /// # Errors
    /// [`Error::Failed`] if the scene does not even fit f64; [`Error::Interrupted`]; [`Error::TooManyRays`] if the
    /// picture takes too many even without bounces.
    pub fn new(scene: &'a Scene, job: &ChartJob, interrupt: &'a Interrupt) -> Result<Self, Error> {
        let converged = RenderSettings {
            arith: Arith::F64,
            size: Some(job.size),
            max_depth: CONVERGED_DEPTH,
            cut_off: CONVERGED_CUT_OFF,
            samples: job.converged_samples,
            ..RenderSettings::DEFAULT
        };
        let budget = budget::rays(job.size, job.converged_samples);
        let (explored, picture) = budget::deepest(CONVERGED_DEPTH, |max_depth| {
            let renderer = build(
                scene,
                &RenderSettings {
                    max_depth,
                    ..converged
                },
            )?;
            let interrupt = interrupt.with_budget(budget);
            let rendered = render_prepared(
                &*renderer,
                None,
                &Schedule::default(),
                false,
                &(),
                &interrupt,
            )?;
            let hits = rendered.1.hits[RayKind::Primary as usize];
            Ok((rendered.0, hits))
        })?;
        let (picture, hits) = picture;
        if hits == 0 && !scene.objects.is_empty() {
            scene_file::note(scene_file::NOTHING_IN_SIGHT);
        }
        Ok(Self {
            scene,
            interrupt,
            converged: picture,
            unexplored: budget::unexplored(explored, CONVERGED_DEPTH, budget),
            exact: Vec::new(),
        })
    }

    /// The bounces that the converged picture lacks because they take too many rays, in words, if any.
    pub fn unexplored(&self) -> Option<&str> {
        self.unexplored.as_deref()
    }

    /// How far off the picture with these settings is; in words if the scene does not fit the arithmetic or
    /// the tree, or takes too many rays.
    ///
    /// # Errors
    /// [`Error::Interrupted`], or if f64 itself fails.
    pub fn accuracy(
        &mut self,
        setting: &RenderSettings,
    ) -> Result<Result<Accuracy, String>, Error> {
        let renderer = match build(self.scene, setting) {
            Err(Error::Failed(why)) => return Ok(Err(why)),
            other => other?,
        };
        let samples = setting.adaptive.map_or(setting.samples, Adaptive::side);
        let budget = budget::rays(renderer.built().size, samples);
        let picture = match render(&*renderer, setting, &self.interrupt.with_budget(2 * budget)) {
            Err(Error::TooManyRays(rays)) => return Ok(Err(Error::TooManyRays(rays).to_string())),
            other => other?,
        };
        let converged = Difference::between(&self.converged, &picture)?;
        let exact = match self.exact(setting.in_f64(), budget) {
            Err(Error::TooManyRays(rays)) => return Ok(Err(Error::TooManyRays(rays).to_string())),
            other => other?,
        };
        Ok(Ok(Accuracy {
            format: renderer.built().format,
            same: Difference::between(&exact.picture, &picture)?,
            converged,
            sight: sight(&*exact.renderer, &*renderer, setting.samples),
        }))
    }

    /// The picture with these settings, rendered if it has not been yet.
    fn exact(&mut self, setting: RenderSettings, budget: u64) -> Result<&Exact, Error> {
        let known = self.exact.iter().position(|exact| exact.setting == setting);
        let index = match known {
            Some(index) => index,
            None => {
                let renderer = build(self.scene, &setting)?;
                self.exact.push(Exact {
                    setting,
                    picture: render(&*renderer, &setting, &self.interrupt.with_budget(budget))?,
                    renderer,
                });
                self.exact.len() - 1
            }
        };
        Ok(&self.exact[index])
    }
}

/// The scene made ready to be traced.
pub(super) fn build(scene: &Scene, setting: &RenderSettings) -> Result<Box<dyn Renderer>, Error> {
    Ok(renderer::prepare(scene, setting)?)
}

/// The picture.
fn render(
    renderer: &dyn Renderer,
    setting: &RenderSettings,
    interrupt: &Interrupt,
) -> Result<Picture, Error> {
    let work = Schedule::default();
    let rendered = render_prepared(renderer, setting.adaptive, &work, false, &(), interrupt)?;
    Ok(rendered.0)
}

/// What the rays of two pictures with the same settings meet first.
fn sight(exact: &dyn Renderer, renderer: &dyn Renderer, samples: u32) -> Sight {
    let built = renderer.built();
    let interrupt = Interrupt::new();
    let (mut truth, mut seen) = (exact.worker(&interrupt), renderer.worker(&interrupt));
    let (mut blocks, mut others, mut depth) = (0_u64, 0_u64, 0.0_f64);
    let per_block = (samples * samples) as usize;
    for row in (0..built.size.1).step_by(built.block as usize) {
        let (truth, seen) = (truth.first_hits(row), seen.first_hits(row));
        let pairs = truth.chunks(per_block).zip(seen.chunks(per_block));
        for (truth, seen) in pairs {
            blocks += 1;
            let differs = |(a, b): (&Option<FirstHit>, &Option<FirstHit>)| {
                a.map(|hit| hit.object) != b.map(|hit| hit.object)
            };
            others += u64::from(truth.iter().zip(seen).any(differs));
            for pair in truth.iter().zip(seen) {
                if let (Some(truth), Some(seen)) = pair
                    && truth.object == seen.object
                {
                    depth = depth.max((seen.distance / truth.distance - 1.0).abs());
                }
            }
        }
    }
    Sight {
        other: others as f64 / blocks as f64,
        depth,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_lie_above_those_that_differ_least() {
        let differing = |squares| Difference {
            pixels: 256,
            squares,
            largest: u8::from(squares > 0),
            beyond_1: 0,
            beyond_8: 0,
        };
        let [equal, least, more] = [0, 1, 2].map(|squares| decibels(&differing(squares)));
        assert!(equal.is_finite() && equal > least + 3.0 && least > more);
    }
}
