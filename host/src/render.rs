//! `octray render`: reads a scene, has it traced, writes the picture, prints statistics.

use crate::job::{RenderJob, StatsFormat};
use crate::stats::{Dropped, Seconds, Stats};
use crate::summary::Summary;
use octray_core::observe::RayKind;
use octray_prepare::Walk;
use octray_render::counts::SceneCounts;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use octray_render::render::{self, Rendering};
use octray_render::renderer;
use octray_render::scene_file;
use octray_render::stats::Rays;
use octray_render::wire;
use octray_scenes::model::Scene;
use std::path::Path;
use std::time::{Duration, Instant};

/// Traces a job on threads.
///
/// # Errors
/// As [`render::render_with`].
pub fn trace(
    scene: &Scene,
    job: &RenderJob,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<Rendering, Error> {
    if job.wire {
        return trace_wire(scene, job, progress, interrupt);
    }
    let intensities = job.output.holds_intensities();
    render::render_with(
        scene,
        &job.settings,
        &job.work,
        intensities,
        progress,
        interrupt,
    )
}

/// Draws a job as lines.
fn trace_wire(
    scene: &Scene,
    job: &RenderJob,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<Rendering, Error> {
    let begin = Instant::now();
    let renderer = renderer::prepare(scene, &job.settings)?;
    let build = begin.elapsed();
    let begin = Instant::now();
    let drawn = wire::render(&*renderer, &job.work, progress, interrupt)?;
    let (picture, counters, work, saturations) = drawn;
    let times = (build, begin.elapsed());
    let built = renderer.built();
    Ok(render::rendering(
        built,
        picture,
        counters,
        saturations,
        times,
        work,
    ))
}

/// Runs `job`; `trace` does the tracing.
///
/// # Errors
/// If the scene is refused, tracing fails or is interrupted, or something cannot be written. Whether the picture can be
/// written is tested before tracing.
pub fn run(
    job: &RenderJob,
    interrupt: &Interrupt,
    trace: impl FnOnce(&Scene, &RenderJob, &dyn Progress, &Interrupt) -> Result<Rendering, Error>,
) -> Result<(), Error> {
    output::probe(&job.output.path)?;
    let begin = Instant::now();
    let scene = scene_file::read_reduced(&job.scene, job.reduction)?;
    let parse = begin.elapsed();
    interrupt.check()?;
    let progress = Bar::new("tracing");
    let traced = trace(&scene, job, &progress, interrupt)?;
    drop(progress);
    interrupt.check()?;
    if !scene.objects.is_empty() && traced.counters.hits[RayKind::Primary as usize] == 0 {
        scene_file::note(scene_file::NOTHING_IN_SIGHT);
    }
    job.output
        .write(&traced.picture, job.ras_depth, interrupt)?;
    let stats = stats(job, &scene, &job.output.path, &traced, parse);
    output::write_report([&job.output.path], interrupt, |out| match job.stats {
        StatsFormat::None => Ok(()),
        StatsFormat::Text => write!(out, "{}", Summary(&stats)),
        StatsFormat::Json => {
            serde_json::to_writer(&mut *out, &stats)?;
            writeln!(out)
        }
    })
}

/// Returns the statistics of a rendering into the picture `path`.
pub(crate) fn stats(
    job: &RenderJob,
    scene: &Scene,
    path: &Path,
    traced: &Rendering,
    parse: Duration,
) -> Stats {
    Stats {
        scene: job.scene.display().to_string(),
        facts: SceneCounts::of(scene),
        lights: scene.lights.len(),
        opaque: job.reduction.opaque,
        picture: path.display().to_string(),
        arith: job.settings.arith,
        format: traced.format,
        scale: traced.scale,
        too_fine: traced.too_fine.clone(),
        size: traced.picture.size(),
        rays: Rays::of(&traced.counters),
        steps: traced.counters.steps(),
        voxels: (job.settings.tree.walk != Walk::Ordered).then(|| traced.counters.voxels()),
        tests: traced.counters.tests(),
        hits: traced.counters.hits[RayKind::Primary as usize],
        saturations: traced.saturations,
        dropped: Dropped::of(&traced.counters),
        tree: traced.tree,
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
    use octray_core::observe::Counters;
    use octray_prepare::{Format, RenderSettings, TreeKind, TreeSettings};
    use octray_render::picture::Picture;
    use octray_render::picture::{self, RasDepth, Target};
    use octray_render::renderer::TreeStats;
    use octray_render::schedule::Schedule;
    use octray_render::scheduler::Policy;
    use octray_render::stats::Work;
    use octray_scenes::reduce::Reduction;
    use std::fs;

    fn job(folder: &Path, scene: &str, output: &str) -> RenderJob {
        let path = folder.join("a.scene");
        fs::write(&path, scene).unwrap();
        RenderJob {
            scene: path,
            reduction: Reduction::default(),
            output: Target::new(folder.join(output)).unwrap(),
            ras_depth: RasDepth::Eight,
            settings: RenderSettings {
                tree: TreeSettings::of(TreeKind::None),
                cut_off: 0.0,
                ..RenderSettings::DEFAULT
            },
            work: Schedule::default(),
            mpi: false,
            wire: false,
            frames: None,
            stats: StatsFormat::None,
        }
    }

    const SCENE: &str = "v 0 0 -9 resolution 2 3 f 1 1 1 0 0 0 0 0 0 0 0 0 s 0 0 5 1";

    /// A tracer that sees red everywhere.
    fn red(scene: &Scene) -> Result<Rendering, Error> {
        let pixels = (scene.width * scene.height) as usize;
        let levels = vec![[255, 0, 0]; pixels];
        Ok(Rendering {
            picture: Picture::from_levels(scene.width, scene.height, levels).unwrap(),
            format: Format::F32,
            scale: 0,
            too_fine: None,
            counters: Counters::default(),
            saturations: 0,
            tree: TreeStats {
                kind: TreeKind::None,
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
                tile: Schedule::TILE,
                tiles: 1,
                messages: None,
                idle: vec![0.0],
            },
        })
    }

    #[test]
    fn the_file_holds_the_traced_picture() {
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
