//! Rendering a scene: prepared, cut into tiles, scheduled on threads.

use crate::adaptive;
use crate::cost::CostMap;
use crate::error::Error;
use crate::framebuffer::Framebuffer;
use crate::interrupt::Interrupt;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::renderer::{self, Built, Renderer, TreeStats, Worker};
use crate::schedule::Schedule;
use crate::scheduler::{Policy, Scheduler};
use crate::stats::Work;
use crate::threads::{self, idle, run_tiles};
use crate::tile::Tile;
use crate::tile::{TileBuffer, TileSize};
use octray_core::frame::Region;
use octray_core::observe::Counters;
use octray_prepare::format::Format;
use octray_prepare::{Adaptive, RenderSettings};
use octray_scenes::check;
use octray_scenes::model::Scene;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::{Duration, Instant};

/// The function that all tracing happens in, as Callgrind names it.
pub const TRACING: &str = "octray_render::render::trace_tile";

/// What tracing gives: the picture, and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendering {
    /// The picture, with intensities if they were asked for.
    pub picture: Picture,
    /// The number format that was used.
    pub format: Format,
    /// The scene was scaled by 2 to this power.
    pub scale: i32,
    /// What the format is too coarse for, if anything.
    pub too_fine: Option<String>,
    /// Rays, steps, tests and hits.
    pub counters: Counters,
    /// Fixed-point results that had to be clamped.
    pub saturations: u64,
    /// The tree.
    pub tree: TreeStats,
    /// Time to convert the scene and to build the tree.
    pub build: Duration,
    /// Time to trace.
    pub render: Duration,
    /// How it was done.
    pub work: Work,
}

impl Rendering {
    /// Writes the picture: as [`Picture::save`] does.
    ///
    /// # Errors
    /// Those of [`Picture::save`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        self.picture.save(path)
    }
}

/// Renders a scene on all cores: one that was parsed, made by a [`SceneBuilder`](octray_scenes::SceneBuilder), or any
/// other.
///
/// # Errors
/// [`Error::Scene`] if the scene breaks a rule of [`check::scene`]; [`Error::Usage`] if a setting is not in its range;
/// [`Error::Failed`] if the scene does not fit the arithmetic or the picture does not fit into memory.
pub fn render(scene: &Scene, settings: &RenderSettings) -> Result<Rendering, Error> {
    check::scene(scene)?;
    render_with(
        scene,
        settings,
        &Schedule::default(),
        false,
        &(),
        &Interrupt::new(),
    )
}

/// Renders a scene as scheduled, with intensities beside levels if they are wanted. The scene must pass
/// [`check::scene`], as every parsed one does.
///
/// # Errors
/// [`Error::Usage`] if a setting is not in its range; [`Error::Failed`] if the scene does not fit the arithmetic, the picture does not fit into memory or the system
/// refuses a thread; [`Error::Interrupted`] if it was; [`Error::TooManyRays`] if it took more than the budget.
pub fn render_with(
    scene: &Scene,
    settings: &RenderSettings,
    schedule: &Schedule,
    holds_intensities: bool,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<Rendering, Error> {
    settings.check()?;
    let begin = Instant::now();
    let renderer = renderer::prepare(scene, settings)?;
    let build = begin.elapsed();
    let begin = Instant::now();
    let rendered = render_prepared(
        &*renderer,
        settings.adaptive,
        schedule,
        holds_intensities,
        progress,
        interrupt,
    )?;
    let (picture, counters, work, saturations) = rendered;
    let times = (build, begin.elapsed());
    Ok(rendering(
        renderer.built(),
        picture,
        counters,
        saturations,
        times,
        work,
    ))
}

/// Renders what is ready to be traced, with adaptive samples if they are wanted: as [`render_tiles`] does.
///
/// # Errors
/// Those of [`render_tiles`].
pub fn render_prepared(
    renderer: &dyn Renderer,
    adaptive: Option<Adaptive>,
    schedule: &Schedule,
    holds_intensities: bool,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<(Picture, Counters, Work, u64), Error> {
    match adaptive {
        None => render_tiles(renderer, schedule, holds_intensities, progress, interrupt),
        Some(how) => adaptive::render(
            renderer,
            how,
            schedule,
            holds_intensities,
            progress,
            interrupt,
        ),
    }
}

/// A picture that was traced, and what it cost: counted events, saturations, the time to build and the time
/// to trace.
pub fn rendering(
    built: &Built,
    picture: Picture,
    counters: Counters,
    saturations: u64,
    (build, render): (Duration, Duration),
    work: Work,
) -> Rendering {
    Rendering {
        picture,
        format: built.format,
        scale: built.scale,
        too_fine: built.too_fine.clone(),
        counters,
        saturations,
        tree: built.tree,
        build,
        render,
        work,
    }
}

/// A picture of which nothing is traced yet, with intensities if they are wanted, and the region that is to be.
///
/// # Errors
/// [`Error::Failed`] if it does not fit into memory.
pub fn blank(renderer: &dyn Renderer, holds_intensities: bool) -> Result<(Picture, Region), Error> {
    let built = renderer.built();
    let (width, height) = built.size;
    let mut picture = Picture::black(width, height, holds_intensities)
        .ok_or_else(|| Error::Failed("the picture does not fit into memory".into()))?;
    let region = built.region();
    picture.fill_outside(region.rows.clone(), built.background);
    Ok((picture, region))
}

/// The order in which a policy hands out tiles: by estimated cost if it goes by that, else nothing.
///
/// # Errors
/// [`Error::Interrupted`] if it was.
pub fn order(
    renderer: &dyn Renderer,
    policy: Policy,
    tiles: &[Region],
    interrupt: &Interrupt,
) -> Result<Vec<u32>, Error> {
    match policy {
        Policy::CostOrdered => {
            Ok(CostMap::coarse(renderer, interrupt)?.most_expensive_first(tiles))
        }
        _ => Ok(Vec::new()),
    }
}

/// Schedules the picture's tiles on threads. Returns it with what they counted (counting costs less than
/// the time of a frame varies), how they worked, and the saturations.
///
/// # Errors
/// [`Error::Failed`] if the picture does not fit into memory or the system refuses a thread;
/// [`Error::Interrupted`] if it was; [`Error::TooManyRays`] if it took more than the budget.
pub fn render_tiles(
    renderer: &dyn Renderer,
    schedule: &Schedule,
    holds_intensities: bool,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<(Picture, Counters, Work, u64), Error> {
    let (picture, region) = blank(renderer, holds_intensities)?;
    let shape: TileSize = schedule.tile(&region, renderer.built().block);
    let parts: Vec<_> = shape.cut(&region).collect();
    let order = order(renderer, schedule.policy, &parts, interrupt)?;
    let count = parts.len();
    let assembly = Framebuffer::new(picture, &region, shape);
    let threads = schedule.threads.min(at_least_one(count));
    progress.start(count);
    let finished = run_tiles(
        &Scheduler::new(schedule.policy, count, threads, order),
        interrupt,
        |thread| {
            if schedule.pin {
                threads::pin(thread)?;
            }
            Ok(renderer.worker(interrupt))
        },
        |worker, index| {
            let mut part = TileBuffer::black(parts[index].clone(), holds_intensities);
            trace_tile(&mut **worker, part.tile());
            assembly.put(index, part);
        },
        || progress.step(),
    )?;
    let (mut counters, mut saturations) = (Counters::default(), 0);
    for thread in &finished {
        counters.add(thread.state.counters());
        saturations += thread.state.saturations();
    }
    let work = Work {
        threads: finished.len(),
        schedule: schedule.policy,
        tile: shape,
        tiles: count,
        messages: None,
        idle: idle(&finished).map(|idle| idle.as_secs_f64()).collect(),
    };
    // Every ray is off the budget now.
    drop(finished);
    interrupt.check()?;
    Ok((assembly.into_picture(), counters, work, saturations))
}

/// What tracing comes to, without start-up and without the picture's file: [`TRACING`].
#[inline(never)]
fn trace_tile(worker: &mut dyn Worker, tile: Tile<'_>) {
    worker.trace(tile);
}

fn at_least_one(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).unwrap_or(NonZeroUsize::MIN)
}
