//! `octray render --frames`: pictures from viewpoints along a path, as numbered files or as one animation.

use crate::cli::files;
use crate::job::{FrameFiles, FramesJob, RenderJob, StatsFormat, ViewPath};
use crate::render::{self as still, stats};
use crate::summary::duration;
use octray_prepare::RenderSettings;
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::picture::{Animation, Target};
use octray_render::progress::{Bar, Progress};
use octray_render::render::Rendering;
use octray_render::scene_file;
use octray_scenes::model::{Camera, Scene};
use octray_scenes::name;
use octray_scenes::{check, input, parse, point};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// From where one frame is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
struct View {
    camera: Camera,
    /// Degrees by which it is turned about the point looked at.
    orbit: f64,
}

/// Renders all frames. Each numbered picture is written whole once it is there; an animation appears once its last frame is.
///
/// # Errors
/// If the scene or the path is refused, tracing fails or is interrupted, or something cannot be written.
pub fn run(job: &RenderJob, frames: &FramesJob, interrupt: &Interrupt) -> Result<(), Error> {
    let begin = Instant::now();
    let scene = scene_file::read_reduced(&job.scene, job.reduction)?;
    let views = views(&scene, frames)?;
    check_views(&views)?;
    let parse = begin.elapsed();
    let mut sequence = Sequence {
        job,
        scene,
        frames,
        interrupt,
        parse,
        progress: Bar::new("tracing"),
    };
    sequence.progress.start(views.len());
    match frames.files {
        FrameFiles::Numbered => sequence.numbered(&views),
        FrameFiles::Animation { per_second } => sequence.animation(&views, per_second),
    }
}

/// Refuses frames from which nothing can be seen: between two views of a path, the eye may come to the point looked at, or
/// look along `up`.
fn check_views(views: &[View]) -> Result<(), Error> {
    (views.iter().enumerate()).try_for_each(|(i, view)| {
        check::camera(&view.camera)
            .map_err(|why| Error::Failed(format!("frame {} of {}: {why}", i + 1, views.len())))
    })
}

/// What all frames have in common.
struct Sequence<'a> {
    job: &'a RenderJob,
    scene: Scene,
    frames: &'a FramesJob,
    interrupt: &'a Interrupt,
    parse: Duration,
    progress: Bar,
}

impl Sequence<'_> {
    fn numbered(&mut self, views: &[View]) -> Result<(), Error> {
        let names: Vec<_> = (1..=views.len())
            .map(|i| numbered(&self.job.output.path, i))
            .collect();
        self.check_names(&names)?;
        for (i, (view, path)) in (1..).zip(views.iter().zip(names)) {
            let rendering = self.trace(*view)?;
            let format = self.job.output.format;
            let target = Target { path, format };
            let depth = self.job.ras_depth;
            target.write(&rendering.picture, depth, self.interrupt)?;
            self.progress.step();
            let line = (self.line(i, &target.path, &rendering)).map_err(Error::Stdout)?;
            self.print(&target.path, &line)?;
        }
        Ok(())
    }

    fn animation(&mut self, views: &[View], per_second: u16) -> Result<(), Error> {
        let path = &self.job.output.path;
        self.check_names(std::slice::from_ref(path))?;
        let (size, count) = (self.settings(0.0).size_of(&self.scene), views.len() as u32);
        let (mut failure, mut lines) = (None, String::new());
        let written = output::write_file(path, self.interrupt, |out| {
            let mut animation = Animation::begin(out, size, count, per_second)?;
            for (i, view) in (1..).zip(views) {
                let rendering = self.trace(*view).map_err(|error| {
                    failure = Some(error);
                    io::Error::other("no frame")
                })?;
                animation.add(&rendering.picture)?;
                self.progress.step();
                lines += &self.line(i, path, &rendering)?;
            }
            animation.finish()
        });
        // What tracing failed with says more than that nothing was written.
        failure.map_or(written, Err)?;
        self.print(path, &lines)
    }

    /// Refuses results that would replace what is read, and those that cannot be written.
    fn check_names(&self, names: &[PathBuf]) -> Result<(), Error> {
        let inputs = std::iter::once(&self.job.scene).chain(match &self.frames.path {
            ViewPath::File(path) => Some(path),
            ViewPath::Orbit(_) => None,
        });
        files::distinct(inputs, names)?;
        names.iter().try_for_each(|name| output::probe(name))
    }

    fn settings(&self, orbit: f64) -> RenderSettings {
        RenderSettings {
            orbit,
            ..self.job.settings
        }
    }

    fn trace(&mut self, view: View) -> Result<Rendering, Error> {
        self.scene.camera = view.camera;
        let job = RenderJob {
            settings: self.settings(view.orbit),
            ..self.job.clone()
        };
        still::trace(&self.scene, &job, &(), self.interrupt)
    }

    /// A line about a frame, counted from 1, with its end. That nothing is in sight is told in it, or beside it on standard
    /// error.
    fn line(&self, number: usize, path: &Path, rendering: &Rendering) -> io::Result<String> {
        let stats = stats(self.job, &self.scene, path, rendering, self.parse);
        let seen = stats.hits > 0 || self.scene.objects.is_empty();
        if !seen && self.job.stats != StatsFormat::Text {
            scene_file::note(&format!("frame {number}: {}", scene_file::NOTHING_IN_SIGHT));
        }
        Ok(match self.job.stats {
            StatsFormat::None => String::new(),
            StatsFormat::Text => {
                let nothing = (!seen).then_some(scene_file::NOTHING_IN_SIGHT);
                let remarks = [nothing, stats.too_fine.as_deref()];
                let remarks: String = (remarks.into_iter().flatten())
                    .map(|remark| format!("  {remark}\n"))
                    .collect();
                let name = name::line(&stats.picture);
                let rays = thousands(stats.rays.total());
                let time = duration(stats.seconds.build + stats.seconds.render);
                format!(
                    "{name}  {rays} rays, {time}, hash {:016x}\n{remarks}",
                    stats.hash
                )
            }
            StatsFormat::Json => serde_json::to_string(&stats)? + "\n",
        })
    }

    fn print(&self, path: &PathBuf, lines: &str) -> Result<(), Error> {
        output::write_report([path], self.interrupt, |out| write!(out, "{lines}"))
    }
}

/// The name of a frame, counted from 1: `a-0001.png` for `a.png`.
pub fn numbered(path: &Path, number: usize) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number:04}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

/// The views of all frames.
fn views(scene: &Scene, frames: &FramesJob) -> Result<Vec<View>, Error> {
    let camera = scene.camera;
    match &frames.path {
        ViewPath::Orbit(degrees) => {
            let count = frames.count.unwrap_or(1);
            let share = |i: u32| f64::from(i) / f64::from(count);
            let view = |i| View {
                camera,
                orbit: degrees * share(i),
            };
            Ok((0..count).map(view).collect())
        }
        ViewPath::File(path) => {
            let cameras = read_views(path)?;
            let count = frames.count.map_or(cameras.len(), |count| count as usize);
            let view = |camera| View { camera, orbit: 0.0 };
            Ok(along(&cameras, count).map(view).collect())
        }
    }
}

/// So many cameras along a path, from its first to its last, as far from each other in time.
fn along(cameras: &[Camera], count: usize) -> impl Iterator<Item = Camera> {
    let last = cameras.len() - 1;
    (0..count).map(move |i| {
        let place = (i * last) as f64 / (count.max(2) - 1) as f64;
        let before = (place as usize).min(last);
        let share = place - before as f64;
        match cameras.get(before + 1) {
            Some(after) if share > 0.0 => between(cameras[before], *after, share),
            _ => cameras[before],
        }
    })
}

/// The camera between two of the same kind: every number in proportion.
fn between(a: Camera, b: Camera, share: f64) -> Camera {
    let mix = |a: [f64; 3], b| point::add(point::times(a, 1.0 - share), point::times(b, share));
    match (a, b) {
        (
            Camera::Thesis {
                viewpoint,
                projection,
            },
            Camera::Thesis { viewpoint: to, .. },
        ) => Camera::Thesis {
            viewpoint: mix(viewpoint, to),
            projection,
        },
        (
            Camera::Nff {
                from,
                at,
                up,
                angle,
                projection,
            },
            Camera::Nff {
                from: from_to,
                at: at_to,
                up: up_to,
                angle: angle_to,
                ..
            },
        ) => Camera::Nff {
            from: mix(from, from_to),
            at: mix(at, at_to),
            up: mix(up, up_to),
            angle: angle * (1.0 - share) + angle_to * share,
            projection,
        },
        // `read_views` refuses such files.
        _ => a,
    }
}

/// Reads a file of views: on each line what a scene file says of its camera.
fn read_views(path: &Path) -> Result<Vec<Camera>, Error> {
    let text =
        input::read_text(path, input::MOST_SCENE).map_err(|cause| Error::read(path, cause))?;
    let name = path.to_string_lossy();
    let mut cameras: Vec<Camera> = Vec::new();
    for (i, line) in text.lines().enumerate() {
        if line
            .split('#')
            .next()
            .is_none_or(|line| line.trim().is_empty())
        {
            continue;
        }
        // Mistakes are to be told with their line.
        let source = "\n".repeat(i) + line;
        let view =
            parse(&source).map_err(|mistakes| Error::Scene(mistakes.draw(&name, &source)))?;
        if let Some((column, word)) = beside_view(line) {
            return Err(Error::Failed(format!(
                "{}:{}:{column}: '{word}' on a line of a path: expected only 'v x y z', 'at', 'up', 'angle' and 'view'; the \
                 scene has the size and the background",
                name::line(&name),
                i + 1
            )));
        }
        if !(view.lights.is_empty() && view.surfaces.is_empty() && view.objects.is_empty()) {
            return Err(Error::Failed(format!(
                "{}:{}: more than a view: expected only 'v x y z', and for NFF 'at', 'up' and 'angle'",
                name::line(&name),
                i + 1
            )));
        }
        let kind = std::mem::discriminant(&view.camera);
        if cameras
            .first()
            .is_some_and(|first| std::mem::discriminant(first) != kind)
        {
            return Err(Error::Failed(format!(
                "{}:{}: a view of another kind than the first: expected 'v x y z' on all lines, or 'at', 'up' and \
                 'angle' on all",
                name::line(&name),
                i + 1
            )));
        }
        cameras.push(view.camera);
    }
    match cameras.is_empty() {
        true => Err(Error::Failed(format!(
            "{}: no views: expected lines such as 'v 0 1 6 at 0 0 0 up 0 1 0 angle 40'",
            name::line(&name)
        ))),
        false => Ok(cameras),
    }
}

/// The first word of a line, with its column from 1, that says something else of a scene than from where it is seen, and
/// would say it in vain.
fn beside_view(line: &str) -> Option<(usize, &str)> {
    let code = line.split('#').next().unwrap_or_default();
    let word = (code.split_ascii_whitespace()).find(|word| ["resolution", "b"].contains(word))?;
    let before = word.as_ptr() as usize - line.as_ptr() as usize;
    Some((line[..before].chars().count() + 1, word))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(x: f64, angle: f64) -> Camera {
        let text = format!("v {x} 0 9 at 0 0 0 up 0 1 0 angle {angle}");
        parse(&text).unwrap().camera
    }

    #[test]
    fn frames_go_from_the_first_view_to_the_last_through_all_of_them() {
        let views = [camera(0.0, 40.0), camera(4.0, 20.0), camera(0.0, 20.0)];
        let all: Vec<_> = along(&views, 5).collect();
        let expected = [
            (0.0, 40.0),
            (2.0, 30.0),
            (4.0, 20.0),
            (2.0, 20.0),
            (0.0, 20.0),
        ];
        assert_eq!(all, expected.map(|(x, angle)| camera(x, angle)));
        assert_eq!(along(&views, 1).collect::<Vec<_>>(), views[..1]);
        assert_eq!(along(&views[..1], 2).collect::<Vec<_>>(), [views[0]; 2]);
        assert_eq!(along(&views, 3).collect::<Vec<_>>(), views);
    }

    #[test]
    fn frames_are_numbered_before_the_extension() {
        let name = |path: &str, i| numbered(Path::new(path), i);
        assert_eq!(name("a/b.png", 7), Path::new("a/b-0007.png"));
        assert_eq!(name("b.c.ras", 12_345), Path::new("b.c-12345.ras"));
    }
}
