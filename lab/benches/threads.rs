//! Measures how well two threads share a picture, and compares it with the simulation of this machine.
//!
//! `cargo bench -p octray-lab --bench threads -- [--rounds N]` renders the scenes of figures 19 to 23 at 512 × 512 in
//! f32. Every round renders each scene on the first core, on the second, on both at once by independent threads, and in
//! each of [`TILINGS`] by two threads that share the picture and by one alone. The slowdown of two independent threads
//! is the contention of the simulation; 2 / (1 + contention) is the upper bound on this machine. Speed-ups are relative
//! to one thread that renders the same tiles, because some tile sizes need fewer instructions than others; the last
//! column but one is relative to the fastest thread with any tiles. Numbers are medians over the rounds. The benchmark
//! fails if a picture differs from that of one thread.

mod common {
    pub(crate) mod table;
}

use clap::Parser;
use comfy_table::CellAlignment;
use common::table::table;
use octray_lab::simulate::{HAND_OUT, PER_TILE};
use octray_lab::simulate::{Machine, simulate};
use octray_prepare::RenderSettings;
use octray_render::cost::{CostMap, most_expensive_first};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::render::{self, Rendering};
use octray_render::schedule::Schedule;
use octray_render::scheduler::{Policy, Scheduler};
use octray_render::tile::TileSize;
use octray_render::{renderer, threads};
use octray_scenes::model::Scene;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::Path;
use std::process::ExitCode;
use std::thread;

/// The settings of every picture.
const SETTINGS: RenderSettings = RenderSettings {
    size: Some((512, 512)),
    ..RenderSettings::DEFAULT
};

const FIGURES: [u32; 5] = [19, 20, 21, 22, 23];

/// Ways to share a picture: an uneven one, a coarse one, and the default.
const TILINGS: [(&str, Policy, TileSize); 3] = [
    ("two halves", Policy::Prescheduled, strip(4)),
    ("8 strips", Policy::Dynamic, strip(64)),
    ("tiles", Policy::Dynamic, Schedule::TILE),
];

const fn strip(rows: u32) -> TileSize {
    TileSize::strip(NonZeroU32::new(rows).unwrap())
}

/// Compare the speed-up of two threads with the simulation
#[derive(Debug, Parser)]
#[command(name = "threads")]
struct Args {
    /// Number of rounds
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Passed by cargo
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<(), Error> {
    let mut subjects = FIGURES
        .into_iter()
        .map(Subject::new)
        .collect::<Result<Vec<_>, _>>()?;
    for round in 1..=args.rounds {
        eprintln!("round {round} of {}", args.rounds);
        for subject in &mut subjects {
            let sample = subject.measure()?;
            subject.samples.push(sample);
        }
    }
    let mut table = table(&[
        "scene",
        "machine allows",
        "one thread, ms",
        "measured",
        "expected",
        "difference",
        "over the fastest thread",
        "shared by two threads",
        "picture",
    ]);
    for subject in &subjects {
        for row in subject.rows()? {
            table.add_row(row);
        }
    }
    for column in table.column_iter_mut().skip(7) {
        column.set_cell_alignment(CellAlignment::Left);
    }
    println!("{table}");
    Ok(())
}

/// A scene, and its measurements in each round.
struct Subject {
    name: String,
    scene: Scene,
    samples: Vec<Sample>,
}

/// One round; seconds on one core are the mean of both cores.
struct Sample {
    /// Seconds on one core, in the tiles of one thread.
    fixed: f64,
    /// Seconds on both cores at once, each with its own picture.
    beside: f64,
    /// The result of each of [`TILINGS`], and its seconds on one core.
    tiled: Vec<(Rendering, f64)>,
}

impl Subject {
    fn new(figure: u32) -> Result<Self, Error> {
        let name = format!("figure-{figure}");
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let path = folder.join(&name).with_extension("scene");
        Ok(Self {
            name,
            scene: octray_scenes::read(&path)?,
            samples: Vec::new(),
        })
    }

    fn measure(&self) -> Result<Sample, Error> {
        let on = |core: usize, work: &Schedule| -> Result<Rendering, Error> {
            threads::pin(core)?;
            trace(&self.scene, work)
        };
        let mean = |a: &Rendering, b: &Rendering| (a.render + b.render).as_secs_f64() / 2.0;
        let each = |work: &Schedule| -> Result<(Rendering, f64), Error> {
            let first = on_its_own(|| on(0, work))?;
            let second = on_its_own(|| on(1, work))?;
            let seconds = mean(&first, &second);
            Ok((first, seconds))
        };
        let alone = Schedule {
            threads: NonZeroUsize::MIN,
            ..Schedule::default()
        };
        let (first, fixed) = each(&alone)?;
        let (left, right) = thread::scope(|scope| {
            let left = scope.spawn(|| on(0, &alone));
            let right = scope.spawn(|| on(1, &alone));
            (joined(left), joined(right))
        });
        let tiled = TILINGS.map(|(_, policy, shape)| {
            let alone = Schedule {
                policy,
                tile: Some(shape),
                ..alone
            };
            let shared = Schedule {
                threads: const { NonZeroUsize::new(2).unwrap() },
                pin: true,
                ..alone
            };
            let (_, seconds) = each(&alone)?;
            let traced = on_its_own(|| trace(&self.scene, &shared))?;
            match traced.picture == first.picture {
                true => Ok((traced, seconds)),
                false => Err(Error::Failed(format!("{}: another picture", self.name))),
            }
        });
        Ok(Sample {
            fixed,
            beside: mean(&left?, &right?),
            tiled: tiled.into_iter().collect::<Result<_, _>>()?,
        })
    }

    /// Returns the measurements of each tiling, and the simulation's predictions.
    fn rows(&self) -> Result<Vec<[String; 9]>, Error> {
        let samples = &self.samples;
        let contention = median(samples, |s| s.beside / s.fixed) - 1.0;
        let alone = |i: usize| median(samples, |s| s.tiled[i].1);
        let fastest = (0..TILINGS.len())
            .map(alone)
            .fold(median(samples, |s| s.fixed), f64::min);
        let row = |(i, (name, ..)): (usize, &(&str, Policy, TileSize))| {
            let seconds = |s: &Sample| s.tiled[i].0.render.as_secs_f64();
            let measured = median(samples, |s| s.tiled[i].1 / seconds(s));
            let traced = &samples[0].tiled[i].0;
            let expected = self.expected(traced, contention.max(0.0))?;
            let work = &traced.work;
            Ok([
                self.name.clone(),
                format!("{:.3}", 2.0 / (1.0 + contention)),
                format!("{:.1}", alone(i) * 1e3),
                format!("{measured:.3}"),
                format!("{expected:.3}"),
                format!("{:+.1} %", 100.0 * (expected / measured - 1.0)),
                format!("{:.3}", fastest / median(samples, seconds)),
                format!("{}: {}, {}", name, work.tile, work.schedule.name()),
                format!("{:016x}", traced.picture.hash()),
            ])
        };
        TILINGS.iter().enumerate().map(row).collect()
    }

    /// Returns the speed-up that the simulation predicts from the cost of each pixel.
    fn expected(&self, traced: &Rendering, contention: f64) -> Result<f64, Error> {
        let renderer = renderer::prepare(&self.scene, &SETTINGS)?;
        let map = CostMap::probe(&*renderer, NonZeroU32::MIN, &Interrupt::new())?;
        let work = &traced.work;
        let region = renderer.built().region();
        let parts = work.tile.cut(&region);
        let costs: Vec<_> = parts.map(|part| map.cost(&part) + PER_TILE).collect();
        let two = const { NonZeroUsize::new(2).unwrap() };
        let order = most_expensive_first(&costs);
        let deal = Scheduler::new(work.schedule, costs.len(), two, order);
        let machine = Machine {
            hand_out: HAND_OUT,
            contention,
            coherence: 0.0,
            ..Machine::default()
        };
        Ok(simulate(&costs, &deal, &machine).speed_up)
    }
}

fn trace(scene: &Scene, work: &Schedule) -> Result<Rendering, Error> {
    render::render_with(scene, &SETTINGS, work, false, &(), &Interrupt::new())
}

/// Runs `work` on a thread of its own, because pinning a thread is permanent.
fn on_its_own<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    thread::scope(|scope| joined(scope.spawn(work)))
}

fn joined<T>(handle: thread::ScopedJoinHandle<'_, T>) -> T {
    match handle.join() {
        Ok(value) => value,
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// Returns the median of a value over all samples, of which there is at least one.
fn median<T>(samples: &[T], value: impl Fn(&T) -> f64) -> f64 {
    let mut values: Vec<_> = samples.iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() % 2 {
        1 => values[middle],
        _ => (values[middle - 1] + values[middle]) / 2.0,
    }
}
