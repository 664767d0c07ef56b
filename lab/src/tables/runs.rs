//! Traces scenes for the tables, each variant once.

use super::subject::SceneVariant;
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

/// Traces variants, and caches the counts.
#[derive(Debug)]
pub struct Runs<'a> {
    /// Columns and rows; the scenes' own if `None`.
    pub size: Option<(u32, u32)>,
    /// Whether time is measured; then one thread is used.
    pub time: bool,
    /// Requests a stop.
    pub interrupt: &'a Interrupt,
    seen: RefCell<Vec<(SceneVariant, TraceCounts)>>,
}

/// The counts of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TraceCounts {
    /// Pixels of the picture.
    pub pixels: u64,
    /// Lights of the scene.
    pub lights: u64,
    /// Rays by kind.
    pub rays: Rays,
    /// Node visits of rays.
    pub steps: u64,
    /// Cells of an octree that rays cross from cell to cell, "voxel tests" in the thesis.
    pub voxels: u64,
    /// Nodes of the tree.
    pub nodes: u64,
    /// Tests of a ray against a surface.
    pub tests: u64,
    /// Instructions, by [`cost::cost`].
    pub instructions: f64,
    /// Tracing time in seconds.
    pub seconds: f64,
}

impl<'a> Runs<'a> {
    /// Returns an empty cache.
    pub fn new(size: Option<(u32, u32)>, time: bool, interrupt: &'a Interrupt) -> Self {
        Self {
            size,
            time,
            interrupt,
            seen: RefCell::default(),
        }
    }

    /// Returns the counts of tracing a scene in f32.
    ///
    /// # Errors
    /// Those of [`render_with`].
    pub fn count(&self, scene_variant: SceneVariant) -> Result<TraceCounts, Error> {
        let known = |seen: &Vec<(SceneVariant, TraceCounts)>| {
            let found = seen.iter().find(|(other, _)| *other == scene_variant);
            found.map(|(_, counts)| *counts)
        };
        if let Some(counts) = known(&self.seen.borrow()) {
            return Ok(counts);
        }
        let mut work = Schedule {
            policy: Policy::Dynamic,
            tile: Some(TileSize::strip(const { NonZeroU32::new(4).unwrap() })),
            ..Schedule::default()
        };
        if self.time {
            work.threads = NonZeroUsize::MIN;
        }
        let (scene, settings) = (scene_variant.scene()?, self.settings(&scene_variant));
        let traced = render_with(&scene, &settings, &work, false, &(), self.interrupt)?;
        let counts = TraceCounts::of(&traced, scene.lights.len());
        self.seen.borrow_mut().push((scene_variant, counts));
        Ok(counts)
    }

    /// Returns the number of traced variants.
    #[cfg(test)]
    pub(super) fn traced(&self) -> usize {
        self.seen.borrow().len()
    }

    /// Returns the cost of each pixel of a scene, and the region that costs anything.
    ///
    /// # Errors
    /// Those of [`renderer::prepare`] and [`CostMap::probe`].
    pub fn map(&self, scene_variant: SceneVariant) -> Result<(CostMap, Region), Error> {
        let renderer = renderer::prepare(&scene_variant.scene()?, &self.settings(&scene_variant))?;
        let map = CostMap::probe(&*renderer, NonZeroU32::MIN, self.interrupt)?;
        Ok((map, renderer.built().region()))
    }

    /// Returns the defaults of `octray render` for a variant.
    fn settings(&self, scene_variant: &SceneVariant) -> RenderSettings {
        RenderSettings {
            tree: TreeSettings {
                walk: scene_variant.walk,
                ..TreeSettings::of(scene_variant.tree)
            },
            size: self.size.map(|size| scene_variant.resized(size)),
            pixels_per_ray: scene_variant.pixels_per_ray,
            ..RenderSettings::DEFAULT
        }
    }
}

impl TraceCounts {
    fn of(traced: &Rendering, lights: usize) -> Self {
        let counters = &traced.counters;
        Self {
            pixels: traced.picture.levels().len() as u64,
            lights: lights as u64,
            rays: Rays::of(counters),
            steps: counters.steps(),
            voxels: counters.voxels(),
            nodes: traced.tree.nodes,
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
    fn the_cost_of_a_run_is_that_of_its_map() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((48, 32)), false, &interrupt);
        let counts = runs.count(SceneVariant::of(FIGURES[2])).unwrap();
        let (map, _) = runs.map(SceneVariant::of(FIGURES[2])).unwrap();
        // The map is made of strips of some rows, and what begins in each costs a little.
        let beyond = map.total() / counts.instructions - 1.0;
        assert!(beyond.abs() < 0.05, "{beyond}");
        assert_eq!(counts.pixels, 48 * 32);
        let larger = SceneVariant {
            larger: true,
            ..SceneVariant::of(FIGURES[2])
        };
        assert_eq!(runs.count(larger).unwrap().pixels, 60 * 40);
        assert_eq!(runs.traced(), 2);
    }
}
