//! Counts, on the host, the events of tracing a frame; instructions are predicted from them.

use octray_core::frame::Region;
use octray_core::observe::{Counters, QueryCounts, RayKind};
use octray_prepare::plan::Plan;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::picture::Picture;
use octray_render::render;
use octray_render::renderer::{self, Renderer};
use octray_render::schedule::Schedule;
use octray_render::scheduler::Policy;
use octray_render::tile::TileSize;
use octray_scenes::model::Scene;
use std::num::NonZeroU32;

/// Rows of the strip that firmware renders at a time.
pub const ROWS: usize = 4;

/// The number of events of a search.
pub const OF_SEARCH: usize = 17;

/// The number of other events.
pub const OF_REST: usize = 7;

/// Their names, in the order of [`Events::search`] and [`Events::rest`].
pub const NAMES: [&str; OF_SEARCH + OF_REST] = [
    "ray that looks for the closest hit",
    "shadow ray",
    "step",
    "child of a step",
    "sphere tested",
    "triangle tested",
    "polygon tested",
    "cone tested",
    "box tested",
    "sphere met",
    "triangle met",
    "polygon met",
    "cone met",
    "box met",
    "outline of a polygon",
    "edge of an outline",
    "side of a cone",
    "primary ray",
    "reflected or transmitted ray",
    "hit",
    "hit on a cone",
    "light offered to a hit",
    "light before a hit",
    "light in sight",
];

/// Counts of events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Events {
    /// In searches for the closest hit, and in searches along shadow rays.
    pub search: [[f64; OF_SEARCH]; 2],
    /// Outside of searches.
    pub rest: [f64; OF_REST],
}

impl Events {
    /// Returns the events of a frame with this many lights. Pixels without a ray are not an event: they are almost
    /// free, and measured frames have about as many pixels as primary rays, so the cost of a pixel could not be
    /// separated.
    pub fn new(counters: &Counters, lights: usize) -> Self {
        let rays = |kind| counters.rays_of(kind) as f64;
        let shadow = rays(RayKind::Shadow);
        let [primary, reflected, transmitted] =
            [RayKind::Primary, RayKind::Reflected, RayKind::Transmitted].map(rays);
        let search = |search: &QueryCounts, closest: f64, shadow: f64| {
            let mut events = [0.0; OF_SEARCH];
            events[..4].copy_from_slice(&[
                closest,
                shadow,
                search.steps as f64,
                search.children as f64,
            ]);
            let reached = [search.outlines, search.edges, search.sides];
            let detail = (search.tests.iter()).chain(&search.met).chain(&reached);
            for (event, count) in events[4..].iter_mut().zip(detail) {
                *event = *count as f64;
            }
            events
        };
        let [closest, blocking] = &counters.queries;
        let hits = counters.hits.iter().sum::<u64>() as f64;
        // It is not counted which of the hit objects was the closest: each kind gets its share.
        let met = closest.met.iter().sum::<u64>().max(1) as f64;
        let cones = hits * closest.met[3] as f64 / met;
        Self {
            search: [
                search(closest, primary + reflected + transmitted, 0.0),
                search(blocking, 0.0, shadow),
            ],
            rest: [
                primary,
                reflected + transmitted,
                hits,
                cones,
                hits * lights as f64,
                shadow,
                shadow - counters.blocked as f64,
            ],
        }
    }

    /// Returns the hits of all rays that look for the closest one.
    pub fn hits(&self) -> f64 {
        self.rest[2]
    }

    /// Returns steps and tests per ray.
    pub fn per_ray(&self) -> [f64; 2] {
        let [closest, shadow] = &self.search;
        let sum = |events: std::ops::Range<usize>| -> f64 {
            closest[events.clone()].iter().chain(&shadow[events]).sum()
        };
        let rays = sum(0..2).max(1.0);
        [sum(2..3) / rays, sum(4..9) / rays]
    }
}

/// A picture, and the events of tracing it.
#[derive(Clone, Debug)]
pub struct Probe {
    /// The picture.
    pub picture: Picture,
    /// The events.
    pub events: Events,
    /// The largest number of rays in the queue.
    pub waiting: usize,
    /// Fixed-point results that were clamped.
    pub saturations: u64,
    /// What is too fine for the format, if anything.
    pub too_fine: Option<String>,
    /// Nodes of the tree.
    pub nodes: u64,
    /// The deepest level of the tree, where the root is level 1; 0 without a tree.
    pub depth: u32,
    /// The power of two by which the scene was scaled.
    pub scale: i32,
}

impl Probe {
    /// Traces a plan in its own arithmetic and with its own tree, on all cores.
    ///
    /// # Errors
    /// [`Error::Failed`] if the scene does not fit the format or the tree; [`Error::Interrupted`];
    /// [`Error::TooManyRays`] if it takes more than the budget of `interrupt`.
    pub fn render(scene: &Scene, plan: &Plan, interrupt: &Interrupt) -> Result<Self, Error> {
        let renderer = renderer::prepare(scene, &plan.settings())?;
        Self::trace(&*renderer, scene, interrupt)
    }

    /// Returns the events of each strip that firmware renders of a plan, from top to bottom; strips in which nothing can be
    /// seen are left out.
    ///
    /// # Errors
    /// Those of [`Probe::render`].
    pub fn strips(scene: &Scene, plan: &Plan, interrupt: &Interrupt) -> Result<Vec<Events>, Error> {
        let renderer = renderer::prepare(scene, &plan.settings())?;
        let built = renderer.built();
        let active = &built.active;
        let rows = (0..built.size.1).step_by(ROWS);
        let strips = rows.map(|top| Region {
            columns: active.columns.clone(),
            rows: top.max(active.rows.start)..(top + ROWS as u32).min(active.rows.end),
        });
        strips
            .filter(|strip| !strip.rows.is_empty() && !strip.columns.is_empty())
            .map(|strip| {
                interrupt.check()?;
                let mut worker = renderer.worker(interrupt);
                worker.probe(&strip);
                Ok(Events::new(worker.counters(), scene.lights.len()))
            })
            .collect()
    }

    fn trace(renderer: &dyn Renderer, scene: &Scene, interrupt: &Interrupt) -> Result<Self, Error> {
        // As the firmware divides the picture.
        let work = Schedule {
            policy: Policy::Dynamic,
            tile: Some(TileSize::strip(
                const { NonZeroU32::new(ROWS as u32).unwrap() },
            )),
            ..Schedule::default()
        };
        let traced = render::render_tiles(renderer, &work, false, &(), interrupt)?;
        let (picture, counters, _, saturations) = traced;
        let built = renderer.built();
        Ok(Self {
            picture,
            events: Events::new(&counters, scene.lights.len()),
            waiting: counters.deepest as usize,
            saturations,
            too_fine: built.too_fine.clone(),
            nodes: built.tree.nodes,
            depth: built.tree.depth,
            scale: built.scale,
        })
    }
}
