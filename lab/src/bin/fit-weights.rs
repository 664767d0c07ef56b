//! Fits the weights of [`octray_render::cost`], the costs of counted events, to instructions that Valgrind's Callgrind
//! counts.
//!
//! `cargo run --release -p octray-lab --features fit --bin fit-weights` runs itself under Callgrind. It traces strips
//! of rows of the scenes of figures 19 to 23 and of generated ones, in f32 with the default tree, and Callgrind dumps
//! the instructions of each strip. The weights are the non-negative ones with the least squared relative error. The
//! result does not depend on the speed or load of the machine.

use clap::Parser;
use comfy_table::{CellAlignment, Table, presets};
use octray_prepare::RenderSettings;
use octray_render::cost::{self, EVENTS, NAMES, WEIGHTS};
use octray_render::interrupt::Interrupt;
use octray_render::renderer::{self, Worker};
use octray_render::tile::Tile;
use octray_render::tile::{TileBuffer, TileSize};
use octray_scenes::generate::{SceneKind, Spec, generate};
use octray_scenes::model::Scene;
use std::error::Error;
use std::fs;
use std::hint::black_box;
use std::num::NonZeroU32;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};

/// Side of the pictures.
const SIZE: u32 = 128;

/// Rows of a strip.
const ROWS: NonZeroU32 = NonZeroU32::new(8).unwrap();

/// Fit the weights of counted events to counted instructions
#[derive(Debug, Parser)]
#[command(name = "fit-weights")]
struct Args {
    /// Only trace, under Callgrind
    #[arg(long, hide = true)]
    inside: bool,
}

fn main() -> ExitCode {
    let args = Args::parse();
    let done = match args.inside {
        true => trace(),
        false => fit(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Traces all strips, each in a call of its own, and prints the counts of each.
fn trace() -> Result<(), Box<dyn Error>> {
    let settings = RenderSettings {
        size: Some((SIZE, SIZE)),
        ..RenderSettings::DEFAULT
    };
    for (name, scene) in scenes()? {
        let renderer = renderer::prepare(&scene, &settings)?;
        let region = renderer.built().region();
        for strip in TileSize::strip(ROWS).cut(&region) {
            let mut part = TileBuffer::black(strip, false);
            let mut worker = renderer.worker(&Interrupt::new());
            trace_a_strip(&mut *worker, part.tile());
            let events = cost::events(worker.counters()).map(|count| count.to_string());
            println!("{name} {}", events.join(" "));
        }
    }
    Ok(())
}

/// The function in which Callgrind counts; it dumps the count on return.
#[inline(never)]
fn trace_a_strip(worker: &mut dyn Worker, tile: Tile<'_>) {
    black_box(worker).trace(black_box(tile));
}

/// Returns the scenes to fit to, by name.
fn scenes() -> Result<Vec<(String, Scene)>, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let mut scenes = Vec::new();
    for number in 19..=23 {
        let name = format!("figure-{number}");
        let path = folder.join(&name).with_extension("scene");
        scenes.push((name, octray_scenes::read(&path)?));
    }
    for kind in SceneKind::ALL {
        let objects = 1000;
        let scene = generate(Spec { kind, objects }, 1);
        scenes.push((format!("{}-{objects}", kind.name()), scene));
    }
    Ok(scenes)
}

/// A strip of a picture: its counted events, and its instructions.
struct Sample {
    scene: String,
    events: [f64; EVENTS],
    instructions: f64,
}

impl Sample {
    /// Returns the relative error of the cost with these weights; positive if the cost is too large.
    fn error(&self, weights: &[f64; EVENTS]) -> f64 {
        sum(&self.events, weights) / self.instructions - 1.0
    }
}

fn sum(events: &[f64; EVENTS], weights: &[f64; EVENTS]) -> f64 {
    events.iter().zip(weights).map(|(e, w)| e * w).sum()
}

/// Runs itself under Callgrind, fits weights to the counts, and prints them beside the present ones.
fn fit() -> Result<(), Box<dyn Error>> {
    let samples = measure()?;
    let weights = least_squares(&samples);
    let mut table = table(&["event", "instructions", "in octray_render::cost"]);
    for ((name, fitted), present) in NAMES.iter().zip(weights).zip(WEIGHTS) {
        table.add_row([
            (*name).to_owned(),
            format!("{fitted:.0}"),
            format!("{present:.0}"),
        ]);
    }
    println!("{table}\n\nHow far the cost of a strip of {ROWS} rows is from its instructions\n");
    println!("{}", errors(&samples, &weights));
    Ok(())
}

fn measure() -> Result<Vec<Sample>, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("count");
    let output = Command::new("valgrind")
        .arg("--tool=callgrind")
        .arg("--toggle-collect=fit_weights::trace_a_strip")
        .arg("--dump-after=fit_weights::trace_a_strip")
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(std::env::current_exe()?)
        .arg("--inside")
        .stderr(Stdio::piped())
        .output()
        .map_err(|e| format!("cannot start valgrind, which counts instructions: {e}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    let lines = String::from_utf8(output.stdout)?;
    let sample = |(index, line): (usize, &str)| -> Result<_, Box<dyn Error>> {
        let dump = fs::read_to_string(file.with_extension((index + 1).to_string()))?;
        let total = |line: &str| line.strip_prefix("totals: ")?.trim().parse().ok();
        let (scene, counts) = line.split_once(' ').ok_or("a line without counts")?;
        let counts: Result<Vec<f64>, _> = counts.split(' ').map(str::parse).collect();
        Ok(Sample {
            scene: scene.to_owned(),
            events: counts?.try_into().map_err(|_| "a count is missing")?,
            instructions: dump
                .lines()
                .find_map(total)
                .ok_or("a dump without totals")?,
        })
    };
    lines.lines().enumerate().map(sample).collect()
}

/// Returns the non-negative weights with the least sum of squared relative errors, found by coordinate descent.
fn least_squares(samples: &[Sample]) -> [f64; EVENTS] {
    let mut weights = [0.0; EVENTS];
    for _ in 0..100_000 {
        for event in 0..EVENTS {
            let (mut slope, mut curvature) = (0.0, 0.0);
            for sample in samples {
                let share = sample.events[event] / sample.instructions;
                slope += sample.error(&weights) * share;
                curvature += share * share;
            }
            weights[event] = (weights[event] - slope / curvature).max(0.0);
        }
    }
    weights
}

/// Returns the errors of the strips of each scene, with the fitted weights and with the present ones.
fn errors(samples: &[Sample], fitted: &[f64; EVENTS]) -> Table {
    let mut table = table(&[
        "scene",
        "strips",
        "mean",
        "deviation",
        "largest",
        "present: mean",
        "deviation",
    ]);
    for strips in samples.chunk_by(|a, b| a.scene == b.scene) {
        let mean_of =
            |of: &dyn Fn(&Sample) -> f64| strips.iter().map(of).sum::<f64>() / strips.len() as f64;
        let mean = |weights| mean_of(&|strip| strip.error(weights));
        let deviation = |weights| {
            let mean = mean(weights);
            mean_of(&|strip| (strip.error(weights) - mean).powi(2)).sqrt()
        };
        let largest = strips
            .iter()
            .map(|s| s.error(fitted).abs())
            .fold(0.0, f64::max);
        table.add_row([
            strips[0].scene.clone(),
            strips.len().to_string(),
            format!("{:+.1} %", 100.0 * mean(fitted)),
            format!("{:.1} %", 100.0 * deviation(fitted)),
            format!("{:.1} %", 100.0 * largest),
            format!("{:+.1} %", 100.0 * mean(&WEIGHTS)),
            format!("{:.1} %", 100.0 * deviation(&WEIGHTS)),
        ]);
    }
    table
}

/// Returns a Markdown table whose columns are aligned right, except the first.
fn table(heading: &[&str]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::ASCII_MARKDOWN)
        .set_header(heading);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
