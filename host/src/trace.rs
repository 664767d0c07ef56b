//! Tracing a scene: made ready, cut into packets, dealt to threads.

use crate::assembly::Assembly;
use crate::deal::Deal;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::job::{RenderJob, WorkOptions};
use crate::packets::Part;
use crate::packing;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::render::Traced;
use crate::stats::Work;
use crate::threads::{self, idle, run_packets};
use octray_core::frame::Region;
use octray_core::observe::Counters;
use octray_engine::packet::Packet;
use octray_engine::{self as engine, Built, Engine, Worker};
use octray_scenes::model::Scene;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// The function that all tracing of [`trace`] happens in, as Callgrind names it.
pub const TRACING: &str = "octray::trace::trace_packet";

/// Trace what the job asks for.
///
/// # Errors
/// [`Error::Failed`] if the scene does not fit the arithmetic, the picture does not fit into
/// memory or the system refuses a thread; [`Error::Interrupted`] if it was.
pub fn trace(
    scene: &Scene,
    job: &RenderJob,
    progress: &Progress,
    interrupt: &Interrupt,
) -> Result<Traced, Error> {
    let begin = Instant::now();
    let engine = engine::build(scene, job.arith, &job.tree, &job.view)?;
    let build = begin.elapsed();
    let begin = Instant::now();
    let holds_intensities = job.output.holds_intensities();
    let rendered = render(&*engine, &job.work, holds_intensities, progress, interrupt)?;
    let (picture, counters, work, saturations) = rendered;
    let times = (build, begin.elapsed());
    let built = engine.built();
    Ok(traced(built, picture, counters, saturations, times, work))
}

/// A picture that was traced, and what it cost: counted events, saturations, the time to build and the time
/// to trace.
pub(crate) fn traced(
    built: &Built,
    picture: Picture,
    counters: Counters,
    saturations: u64,
    (build, render): (Duration, Duration),
    work: Work,
) -> Traced {
    Traced {
        picture,
        format: built.format.into(),
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
pub(crate) fn blank(
    engine: &dyn Engine,
    holds_intensities: bool,
) -> Result<(Picture, Region), Error> {
    let built = engine.built();
    let (width, height) = built.size;
    let mut picture = Picture::black(width, height, holds_intensities)
        .ok_or_else(|| Error::Failed("the picture does not fit into memory".into()))?;
    let region = built.region();
    picture.fill_outside(region.rows.clone(), built.background);
    Ok((picture, region))
}

/// Deals the picture's packets to threads. Returns it with what they counted (counting costs less than
/// the time of a frame varies), how they worked, and the saturations.
///
/// # Errors
/// [`Error::Failed`] if the picture does not fit into memory or the system refuses a thread;
/// [`Error::Interrupted`] if it was.
pub fn render(
    engine: &dyn Engine,
    job: &WorkOptions,
    holds_intensities: bool,
    progress: &Progress,
    interrupt: &Interrupt,
) -> Result<(Picture, Counters, Work, u64), Error> {
    let (picture, region) = blank(engine, holds_intensities)?;
    let packing = packing::choose(engine, &region, job, interrupt)?;
    let parts: Vec<_> = packing.shape.cut(&region).collect();
    let count = parts.len();
    let assembly = Assembly::new(picture, &region, packing.shape);
    let threads = job.threads.min(at_least_one(count));
    progress.start(count);
    let finished = run_packets(
        &Deal::new(packing.policy, count, threads, packing.order),
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
    let (mut counters, mut saturations) = (Counters::default(), 0);
    for thread in &finished {
        counters.add(thread.state.counters());
        saturations += thread.state.saturations();
    }
    let work = Work {
        threads: finished.len(),
        schedule: packing.policy,
        packet: packing.shape,
        packets: count,
        forecast: packing.forecast,
        messages: None,
        idle: idle(&finished).map(|idle| idle.as_secs_f64()).collect(),
    };
    Ok((assembly.into_picture(), counters, work, saturations))
}

/// What tracing comes to, without start-up and without the picture's file: [`TRACING`].
#[inline(never)]
fn trace_packet(worker: &mut dyn Worker, packet: Packet<'_>) {
    worker.trace(packet);
}

fn at_least_one(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).unwrap_or(NonZeroUsize::MIN)
}
