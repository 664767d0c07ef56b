//! `octray render`: read a scene, have it traced, write the picture, tell the cost.

use crate::check;
use crate::error::Error;
use crate::facts::Facts;
use crate::interrupt::Interrupt;
use crate::job::{RenderJob, StatsFormat};
use crate::output;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::stats::{Octree, Rays, Seconds, Stats};
use crate::summary::Summary;
use octray_scenes::model::Scene;
use std::time::{Duration, Instant};

/// What tracing gives: the picture, and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// The picture, with intensities if [`crate::picture::Target::holds_intensities`].
    pub picture: Picture,
    /// The number format that was used, e.g. `i16f16`.
    pub format: String,
    /// The scene was scaled by 2 to this power.
    pub scale: i32,
    /// Rays by kind.
    pub rays: Rays,
    /// Voxels or nodes that rays went through.
    pub steps: u64,
    /// Objects that rays were tested against.
    pub tests: u64,
    /// Tests that found a hit.
    pub hits: u64,
    /// Fixed-point results that had to be clamped.
    pub saturations: u64,
    /// The octree.
    pub octree: Octree,
    /// Time to convert the scene and to build the octree.
    pub build: Duration,
    /// Time to trace.
    pub render: Duration,
    /// Threads that traced.
    pub threads: usize,
    /// Packets they were dealt.
    pub packets: usize,
}

/// Do `job`, the tracing itself being done by `trace`.
///
/// # Errors
/// When the scene is refused, tracing fails or is interrupted, or something cannot be written. Whether the
/// picture can be written at all is found out first.
pub fn run(
    job: &RenderJob,
    interrupt: &Interrupt,
    trace: impl FnOnce(&Scene, &RenderJob, &Progress, &Interrupt) -> Result<Traced, Error>,
) -> Result<(), Error> {
    output::probe(&job.output.path)?;
    let begin = Instant::now();
    let scene = check::read(&job.scene)?;
    let parse = begin.elapsed();
    interrupt.check()?;
    let progress = Progress::new("tracing");
    let traced = trace(&scene, job, &progress, interrupt)?;
    drop(progress);
    interrupt.check()?;
    job.output
        .write(&traced.picture, job.ras_depth, interrupt)?;
    let stats = stats(job, &scene, &traced, parse);
    output::write_stdout(interrupt, |out| match job.stats {
        StatsFormat::None => Ok(()),
        StatsFormat::Text => write!(out, "{}", Summary(&stats)),
        StatsFormat::Json => {
            serde_json::to_writer(&mut *out, &stats)?;
            writeln!(out)
        }
    })
}

fn stats(job: &RenderJob, scene: &Scene, traced: &Traced, parse: Duration) -> Stats {
    Stats {
        scene: job.scene.display().to_string(),
        facts: Facts::of(scene),
        picture: job.output.path.display().to_string(),
        arith: job.arith,
        format: traced.format.clone(),
        scale: traced.scale,
        size: traced.picture.size(),
        rays: traced.rays,
        steps: traced.steps,
        tests: traced.tests,
        hits: traced.hits,
        saturations: traced.saturations,
        octree: traced.octree,
        seconds: Seconds {
            parse: parse.as_secs_f64(),
            build: traced.build.as_secs_f64(),
            render: traced.render.as_secs_f64(),
        },
        threads: traced.threads,
        schedule: job.work.schedule,
        packets: traced.packets,
        hash: traced.picture.hash(),
    }
}
