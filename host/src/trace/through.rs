//! All surfaces along the rays of a pixel: the scene is traced as if of glass that does not bend light.

use super::node::{Node, Object};
use super::{Report, TraceFormat, TraceJob};
use octray_prepare::RenderSettings;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_scenes::model::Surface;
use octray_scenes::name;
use serde::Serialize;
use std::io::{self, Write};

/// What every surface is made of: all light goes through, straight on.
pub(super) const GLASS: Surface = Surface {
    ambient: [0.0; 3],
    diffuse: [0.0; 3],
    specular: [0.0; 3],
    shine: 0.0,
    reflect: 0.0,
    refract: 1.0,
    ior: 1.0,
    checker: None,
};

/// As deep as rays go.
pub(super) fn settings(settings: RenderSettings) -> RenderSettings {
    RenderSettings {
        max_depth: RenderSettings::DEEPEST,
        cut_off: 0.0,
        ..settings
    }
}

/// A surface along a ray.
#[derive(Serialize)]
struct Pierced {
    object: Object,
    /// From the start of the ray, in units of the scene file.
    distance: f64,
}

/// The surfaces along a ray from the camera.
#[derive(Serialize)]
struct Along {
    surfaces: Vec<Pierced>,
    /// Whether there may be more behind them.
    cut_short: bool,
}

/// What JSON has of an arithmetic.
#[derive(Serialize)]
struct Told<'a> {
    scene: &'a str,
    pixel: (u32, u32),
    size: (u32, u32),
    format: octray_prepare::Format,
    /// One for each ray of the camera.
    rays: Vec<Along>,
}

fn along(ray: &Node) -> Along {
    let (mut surfaces, mut distance) = (Vec::new(), 0.0);
    let mut here = ray;
    loop {
        if let (Some(object), Some(further)) = (here.object, here.distance) {
            distance += further;
            surfaces.push(Pierced { object, distance });
        }
        match here.rays.first() {
            Some(next) => here = next,
            None => break,
        }
    }
    Along {
        cut_short: !here.not_traced.is_empty(),
        surfaces,
    }
}

/// Writes the surfaces as text or JSON.
pub(super) fn write(job: &TraceJob, report: &Report, interrupt: &Interrupt) -> Result<(), Error> {
    let told: Vec<_> = (report.traces.iter())
        .map(|trace| Told {
            scene: &report.scene,
            pixel: report.pixel,
            size: report.size,
            format: trace.format,
            rays: trace.rays.iter().map(along).collect(),
        })
        .collect();
    let write = |out: &mut dyn Write| match job.format {
        TraceFormat::Json => told.iter().try_for_each(|told| {
            serde_json::to_writer(&mut *out, told)?;
            writeln!(out)
        }),
        TraceFormat::Text | TraceFormat::Svg => {
            told.iter().try_for_each(|told| write_text(told, out))
        }
    };
    match &job.output {
        Some(path) => output::write_file(path, interrupt, write),
        None => output::write_stdout(interrupt, write),
    }
}

fn write_text(told: &Told<'_>, out: &mut dyn Write) -> io::Result<()> {
    let scene = name::line(told.scene);
    let ((column, row), (width, height)) = (told.pixel, told.size);
    writeln!(
        out,
        "{scene}, pixel {column},{row} of {width} x {height}, {}",
        told.format.name()
    )?;
    for (i, ray) in told.rays.iter().enumerate() {
        if told.rays.len() > 1 {
            writeln!(out, "ray {} of {}", i + 1, told.rays.len())?;
        }
        for surface in &ray.surfaces {
            writeln!(out, "{:>12.3}  {}", surface.distance, surface.object)?;
        }
        if ray.cut_short {
            writeln!(out, "              and perhaps more")?;
        }
    }
    if told.rays.iter().all(|ray| ray.surfaces.is_empty()) {
        writeln!(out, "no surface")?;
    }
    Ok(())
}
