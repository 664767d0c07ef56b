//! `octray render`: read a scene, have it traced, write the picture, tell the cost.

use crate::check;
use crate::error::Error;
use crate::facts::Facts;
use crate::interrupt::Interrupt;
use crate::job::{RenderJob, StatsFormat};
use crate::output;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::stats::{Dropped, Rays, Seconds, Stats, Work};
use crate::summary::Summary;
use octray_core::observe::{Counters, RayKind};
use octray_engine::Octree;
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
    /// What the format is too coarse for, if anything.
    pub too_fine: Option<String>,
    /// Rays, steps, tests and hits.
    pub counters: Counters,
    /// Fixed-point results that had to be clamped.
    pub saturations: u64,
    /// The octree.
    pub octree: Octree,
    /// Time to convert the scene and to build the octree.
    pub build: Duration,
    /// Time to trace.
    pub render: Duration,
    /// How it was done.
    pub work: Work,
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
        too_fine: traced.too_fine.clone(),
        size: traced.picture.size(),
        rays: Rays::of(&traced.counters),
        steps: traced.counters.steps(),
        tests: traced.counters.tests(),
        hits: traced.counters.hits[RayKind::Primary as usize],
        saturations: traced.saturations,
        dropped: Dropped::of(&traced.counters),
        octree: traced.octree,
        seconds: Seconds {
            parse: parse.as_secs_f64(),
            build: traced.build.as_secs_f64(),
            render: traced.render.as_secs_f64(),
        },
        work: traced.work.clone(),
        hash: traced.picture.hash(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deal::Policy;
    use crate::job::WorkOptions;
    use crate::picture::{self, RasDepth, Target};
    use octray_engine::options::{Arith, PixelsPerRay, Tree, TreeOptions, ViewOptions};
    use std::fs;
    use std::path::Path;

    fn job(folder: &Path, scene: &str, output: &str) -> RenderJob {
        let path = folder.join("a.scene");
        fs::write(&path, scene).unwrap();
        RenderJob {
            scene: path,
            output: Target::new(folder.join(output)).unwrap(),
            ras_depth: RasDepth::Eight,
            arith: Arith::F32,
            tree: TreeOptions::of(Tree::None),
            view: ViewOptions {
                size: None,
                pixels_per_ray: PixelsPerRay::One,
                samples: 1,
                max_depth: 8,
                cut_off: 0.0,
            },
            work: WorkOptions::default(),
            stats: StatsFormat::None,
        }
    }

    const SCENE: &str = "v 0 0 -9 resolution 2 3 f 1 1 1 0 0 0 0 0 0 0 0 0 s 0 0 5 1";

    /// A tracer that sees red everywhere.
    fn red(scene: &Scene) -> Result<Traced, Error> {
        let pixels = (scene.width * scene.height) as usize;
        let levels = vec![[255, 0, 0]; pixels];
        Ok(Traced {
            picture: Picture::from_levels(scene.width, scene.height, levels).unwrap(),
            format: "f32".into(),
            scale: 0,
            too_fine: None,
            counters: Counters::default(),
            saturations: 0,
            octree: Octree {
                kind: Tree::None,
                nodes: 0,
                links: 0,
                depth: 0,
                unsplit: 0,
            },
            build: Duration::ZERO,
            render: Duration::ZERO,
            work: Work {
                threads: 1,
                schedule: Policy::Dynamic,
                packet: crate::packing::FIXED.1,
                packets: 1,
                forecast: None,
                messages: None,
                idle: vec![0.0],
            },
        })
    }

    #[test]
    fn what_the_tracer_sees_is_in_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let job = job(folder.path(), SCENE, "a.png");
        run(&job, &Interrupt::new(), |scene, _, _, _| red(scene)).unwrap();
        let written = picture::read(&job.output.path).unwrap();
        assert_eq!(written.size(), (3, 2));
        assert_eq!(written.levels(), [[255, 0, 0]; 6]);
    }

    #[test]
    fn an_interrupt_while_tracing_leaves_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let (job, interrupt) = (job(folder.path(), SCENE, "a.png"), Interrupt::new());
        let result = run(&job, &interrupt, |scene, _, _, interrupt| {
            interrupt.request();
            red(scene)
        });
        assert!(matches!(result, Err(Error::Interrupted)));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn nothing_is_traced_for_a_picture_that_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let job = job(folder.path(), SCENE, "missing/a.png");
        let result = run(&job, &Interrupt::new(), |_, _, _, _| {
            unreachable!("traced in vain")
        });
        assert!(matches!(result, Err(Error::Write { .. })));
    }

    #[test]
    fn a_scene_with_mistakes_is_refused_with_them_drawn() {
        let folder = tempfile::tempdir().unwrap();
        let job = job(folder.path(), "v 0 0 -9 blob 1", "a.png");
        let result = run(&job, &Interrupt::new(), |scene, _, _, _| red(scene));
        let text = result.unwrap_err().to_string();
        assert!(text.contains("a.scene:1:10"), "{text}");
    }
}
