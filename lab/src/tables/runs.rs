//! Where scenes are traced for the tables, each variant once.

use super::subject::{Subject, Trial};
use octray_core::frame::Region;
use octray_prepare::{RenderSettings, TreeSettings};
use octray_render::cost::{self, CostMap};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::render::Rendering;
use octray_render::render::render_with;
use octray_render::renderer;
use octray_render::schedule::Schedule;
use octray_render::scheduler::Policy;
use octray_render::stats::Rays;
use octray_render::tile::TileSize;
use std::cell::RefCell;
use std::num::{NonZeroU32, NonZeroUsize};

/// Traces, and remembers what came out.
#[derive(Debug)]
pub struct Runs<'a> {
    /// Columns and rows; the scenes' own if `None`.
    pub size: Option<(u32, u32)>,
    /// Whether time is taken, for which one thread works.
    pub time: bool,
    /// Ctrl-C.
    pub interrupt: &'a Interrupt,
    seen: RefCell<Vec<(Trial, Tally)>>,
}

/// What was counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tally {
    /// Pixels of the picture.
    pub pixels: u64,
    /// Rays by kind.
    pub rays: Rays,
    /// Voxels that rays went through.
    pub steps: u64,
    /// Surfaces that rays were tested against.
    pub tests: u64,
    /// Instructions, by [`cost::cost`].
    pub instructions: f64,
    /// Time to trace, in seconds.
    pub seconds: f64,
}

impl<'a> Runs<'a> {
    /// Nothing is traced yet.
    pub fn new(size: Option<(u32, u32)>, time: bool, interrupt: &'a Interrupt) -> Self {
        Self {
            size,
            time,
            interrupt,
            seen: RefCell::default(),
        }
    }

    /// What tracing a scene takes, in f32.
    ///
    /// # Errors
    /// As [`render_with`].
    pub fn tally(&self, trial: Trial) -> Result<Tally, Error> {
        let known = |seen: &Vec<(Trial, Tally)>| {
            let found = seen.iter().find(|(other, _)| *other == trial);
            found.map(|(_, tally)| *tally)
        };
        if let Some(tally) = known(&self.seen.borrow()) {
            return Ok(tally);
        }
        let mut work = Schedule {
            policy: Policy::Dynamic,
            tile: Some(TileSize::strip(const { NonZeroU32::new(4).unwrap() })),
            ..Schedule::default()
        };
        if self.time {
            work.threads = NonZeroUsize::MIN;
        }
        let (scene, settings) = (trial.scene()?, self.settings(&trial));
        let traced = render_with(&scene, &settings, &work, false, &(), self.interrupt)?;
        let tally = Tally::of(&traced);
        self.seen.borrow_mut().push((trial, tally));
        Ok(tally)
    }

    /// How many trials have been traced.
    #[cfg(test)]
    pub(super) fn traced(&self) -> usize {
        self.seen.borrow().len()
    }

    /// What each pixel of a scene costs, and the rows that cost anything.
    ///
    /// # Errors
    /// As [`renderer::prepare`] and [`CostMap::probe`].
    pub fn map(&self, subject: Subject) -> Result<(CostMap, Region), Error> {
        let trial = Trial::of(subject);
        let renderer = renderer::prepare(&trial.scene()?, &self.settings(&trial))?;
        let map = CostMap::probe(&*renderer, NonZeroU32::MIN, self.interrupt)?;
        Ok((map, renderer.built().region()))
    }

    /// The defaults of `octray render`.
    fn settings(&self, trial: &Trial) -> RenderSettings {
        RenderSettings {
            tree: TreeSettings::of(trial.tree),
            size: self.size.map(|size| trial.resized(size)),
            pixels_per_ray: trial.pixels_per_ray,
            ..RenderSettings::DEFAULT
        }
    }
}

impl Tally {
    fn of(traced: &Rendering) -> Self {
        let counters = &traced.counters;
        Self {
            pixels: traced.picture.levels().len() as u64,
            rays: Rays::of(counters),
            steps: counters.steps(),
            tests: counters.tests(),
            instructions: cost::cost(counters),
            seconds: traced.render.as_secs_f64(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::subject::FIGURES;
    use super::*;

    #[test]
    fn the_cost_of_a_trial_is_that_of_its_map() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((48, 32)), false, &interrupt);
        let tally = runs.tally(Trial::of(FIGURES[2])).unwrap();
        let (map, _) = runs.map(FIGURES[2]).unwrap();
        // What blocked a light last is forgotten between tiles, and tests of boxes are dear: 4 % in so small a
        // picture.
        let beyond = map.total() / tally.instructions - 1.0;
        assert!(beyond.abs() < 0.05, "{beyond}");
        assert_eq!(tally.pixels, 48 * 32);
        let larger = Trial {
            larger: true,
            ..Trial::of(FIGURES[2])
        };
        assert_eq!(runs.tally(larger).unwrap().pixels, 60 * 40);
        assert_eq!(runs.traced(), 2);
    }
}
