//! Tracing a scene: made ready, cut into tiles, scheduled on threads.

use crate::assembly::Assembly;
use crate::cost::CostMap;
use crate::deal::{Deal, Policy};
use crate::engine::{self, Built, Engine, Octree, Worker};
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::packet::Packet;
use crate::packets::{Part, Shape};
use crate::picture::Picture;
use crate::progress::Progress;
use crate::stats::Work;
use crate::threads::{self, idle, run_packets};
use crate::work::WorkOptions;
use octray_core::observe::Counters;
use octray_core::packet::Region;
use octray_core::scalar;
use octray_prepare::format::Format;
use octray_prepare::settings::RenderSettings;
use octray_scenes::model::Scene;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// The function that all tracing of [`trace`] happens in, as Callgrind names it.
pub const TRACING: &str = "octray_render::trace::trace_packet";

/// What tracing gives: the picture, and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
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
    pub octree: Octree,
    /// Time to convert the scene and to build the tree.
    pub build: Duration,
    /// Time to trace.
    pub render: Duration,
    /// How it was done.
    pub work: Work,
}

/// Traces a scene, with intensities beside levels if they are wanted.
///
/// # Errors
/// [`Error::Failed`] if the scene does not fit the arithmetic, the picture does not fit into memory or the system
/// refuses a thread; [`Error::Interrupted`] if it was.
pub fn trace(
    scene: &Scene,
    settings: &RenderSettings,
    work: &WorkOptions,
    holds_intensities: bool,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<Traced, Error> {
    let begin = Instant::now();
    let engine = engine::build(scene, settings)?;
    let build = begin.elapsed();
    let begin = Instant::now();
    let rendered = render(&*engine, work, holds_intensities, progress, interrupt)?;
    let (picture, counters, work, saturations) = rendered;
    let times = (build, begin.elapsed());
    let built = engine.built();
    Ok(traced(built, picture, counters, saturations, times, work))
}

/// A picture that was traced, and what it cost: counted events, saturations, the time to build and the time
/// to trace.
pub fn traced(
    built: &Built,
    picture: Picture,
    counters: Counters,
    saturations: u64,
    (build, render): (Duration, Duration),
    work: Work,
) -> Traced {
    Traced {
        picture,
        format: built.format,
        scale: built.scale,
        too_fine: built.too_fine.clone(),
        counters,
        saturations,
        octree: built.octree,
        build,
        render,
        work,
    }
}

/// A picture of which nothing is traced yet, with intensities if they are wanted, and the region that is to be.
///
/// # Errors
/// [`Error::Failed`] if it does not fit into memory.
pub fn blank(engine: &dyn Engine, holds_intensities: bool) -> Result<(Picture, Region), Error> {
    let built = engine.built();
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
    engine: &dyn Engine,
    policy: Policy,
    tiles: &[Region],
    interrupt: &Interrupt,
) -> Result<Vec<u32>, Error> {
    match policy {
        Policy::CostOrdered => Ok(CostMap::coarse(engine, interrupt)?.dearest_first(tiles)),
        _ => Ok(Vec::new()),
    }
}

/// Schedules the picture's tiles on threads. Returns it with what they counted (counting costs less than
/// the time of a frame varies), how they worked, and the saturations.
///
/// # Errors
/// [`Error::Failed`] if the picture does not fit into memory or the system refuses a thread;
/// [`Error::Interrupted`] if it was.
pub fn render(
    engine: &dyn Engine,
    job: &WorkOptions,
    holds_intensities: bool,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<(Picture, Counters, Work, u64), Error> {
    let (picture, region) = blank(engine, holds_intensities)?;
    let shape: Shape = job.tile(&region);
    let parts: Vec<_> = shape.cut(&region).collect();
    let order = order(engine, job.policy, &parts, interrupt)?;
    // Those of estimates, or of other pictures, are not this one's.
    let before = scalar::saturations();
    let count = parts.len();
    let assembly = Assembly::new(picture, &region, shape);
    let threads = job.threads.min(at_least_one(count));
    progress.start(count);
    let finished = run_packets(
        &Deal::new(job.policy, count, threads, order),
        interrupt,
        |thread| {
            if job.pin {
                threads::pin(thread)?;
            }
            Ok(engine.worker())
        },
        |worker, index| {
            let mut part = Part::black(parts[index].clone(), holds_intensities);
            trace_packet(&mut **worker, part.packet());
            assembly.put(index, part);
        },
        || progress.step(),
    )?;
    let mut counters = Counters::default();
    for thread in &finished {
        counters.add(thread.state.counters());
    }
    let work = Work {
        threads: finished.len(),
        schedule: job.policy,
        packet: shape,
        packets: count,
        messages: None,
        idle: idle(&finished).map(|idle| idle.as_secs_f64()).collect(),
    };
    let saturations = scalar::saturations().wrapping_sub(before);
    Ok((
        assembly.into_picture(),
        counters,
        work,
        u64::from(saturations),
    ))
}

/// What tracing comes to, without start-up and without the picture's file: [`TRACING`].
#[inline(never)]
fn trace_packet(worker: &mut dyn Worker, packet: Packet<'_>) {
    worker.trace(packet);
}

fn at_least_one(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).unwrap_or(NonZeroUsize::MIN)
}
