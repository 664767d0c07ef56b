//! How well two threads share a picture: measured, beside what the simulation expects of this machine.
//!
//! `cargo bench -p octray --bench threads -- [--rounds N]` renders the scenes of figures 19 to 23 at
//! 512 × 512 in f32. Every round takes each scene in turn: on the first core, on the second, on both at once
//! by threads that have nothing to do with each other, and by two threads that share the picture in each of
//! [`PACKINGS`]. What two cores lose against one where nothing is shared is the contention that the
//! simulation is given, and 2 / (1 + contention) is all that this machine allows. Figures are medians over the
//! rounds. It fails if a picture is another than on one thread.

use clap::Parser;
use comfy_table::{CellAlignment, Table, presets};
use octray::cli::{Cli, Command};
use octray::cost::{CostMap, dearest_first};
use octray::deal::Deal;
use octray::error::Error;
use octray::interrupt::Interrupt;
use octray::job::RenderJob;
use octray::packing::{HAND_OUT, PER_PACKET};
use octray::progress::Progress;
use octray::render::Traced;
use octray::simulate::{Machine, simulate};
use octray::{check, threads, trace};
use octray_engine as engine;
use octray_scenes::model::Scene;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::Path;
use std::process::ExitCode;
use std::thread;

const FIGURES: [u32; 5] = [19, 20, 21, 22, 23];

/// Ways to share a picture: an uneven one, a coarse one, and the one that is chosen.
const PACKINGS: [(&str, &str); 3] = [
    ("two halves", "--schedule prescheduled --packet-rows 4"),
    ("8 strips", "--schedule dynamic --packet-rows 64"),
    ("chosen", ""),
];

/// Compare the speed-up of two threads with what the simulation expects
#[derive(Debug, Parser)]
#[command(name = "threads")]
struct Args {
    /// How often each scene is rendered in each way
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Given by cargo
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
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header([
        "scene",
        "one thread, ms",
        "machine allows",
        "shared by two threads",
        "measured",
        "expected",
        "difference",
        "picture",
    ]);
    for subject in &subjects {
        for row in subject.rows()? {
            table.add_row(row);
        }
    }
    for column in [1, 2, 4, 5, 6] {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    println!("{table}");
    Ok(())
}

/// A scene, and what it took in each round.
struct Subject {
    name: String,
    scene: Scene,
    alone: RenderJob,
    shared: Vec<RenderJob>,
    samples: Vec<Sample>,
}

/// One round.
struct Sample {
    /// Seconds on one core, the mean of both.
    alone: f64,
    /// Seconds on both at once, each for a picture of its own.
    beside: f64,
    /// What came of each packing.
    shared: Vec<Traced>,
}

impl Subject {
    fn new(figure: u32) -> Result<Self, Error> {
        let name = format!("figure-{figure}");
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let path = folder.join(&name).with_extension("scene");
        let shared =
            PACKINGS.map(|(_, packing)| job(&path, &format!("--threads 2 --pin {packing}")));
        Ok(Self {
            name,
            scene: check::read(&path)?,
            alone: job(&path, "--threads 1 --packet-rows 16 --packet-columns 16")?,
            shared: shared.into_iter().collect::<Result<_, _>>()?,
            samples: Vec::new(),
        })
    }

    fn measure(&self) -> Result<Sample, Error> {
        let on = |core: usize| -> Result<Traced, Error> {
            threads::pin(core)?;
            self.trace(&self.alone)
        };
        // Threads of their own, since pinning lasts.
        let one = |core| thread::scope(|scope| joined(scope.spawn(move || on(core))));
        let (first, second) = (one(0)?, one(1)?);
        let (left, right) = thread::scope(|scope| {
            let (left, right) = (scope.spawn(|| on(0)), scope.spawn(|| on(1)));
            (joined(left), joined(right))
        });
        let mean = |a: &Traced, b: &Traced| (a.render + b.render).as_secs_f64() / 2.0;
        let shared = self.shared.iter().map(|job| {
            // On a thread of its own for the same reason.
            let traced = thread::scope(|scope| joined(scope.spawn(|| self.trace(job))))?;
            match traced.picture == first.picture {
                true => Ok(traced),
                false => Err(Error::Failed(format!("{}: another picture", self.name))),
            }
        });
        Ok(Sample {
            alone: mean(&first, &second),
            beside: mean(&left?, &right?),
            shared: shared.collect::<Result<_, _>>()?,
        })
    }

    fn trace(&self, job: &RenderJob) -> Result<Traced, Error> {
        trace::trace(&self.scene, job, &Progress::hidden(), &Interrupt::new())
    }

    /// What was measured of each packing, and what the simulation expects of it.
    fn rows(&self) -> Result<Vec<[String; 8]>, Error> {
        let contention = self.median(|sample| sample.beside / sample.alone) - 1.0;
        let alone = self.median(|sample| sample.alone);
        let row = |(i, (name, _)): (usize, &(&str, &str))| {
            let measured = self.median(|s| s.alone / s.shared[i].render.as_secs_f64());
            let traced = &self.samples[0].shared[i];
            let expected = self.expected(traced, contention.max(0.0))?;
            let work = &traced.work;
            Ok([
                self.name.clone(),
                format!("{:.1}", alone * 1e3),
                format!("{:.3}", 2.0 / (1.0 + contention)),
                format!("{name}: {}, {}", work.packet, work.schedule.name()),
                format!("{measured:.3}"),
                format!("{expected:.3}"),
                format!("{:+.1} %", 100.0 * (expected / measured - 1.0)),
                format!("{:016x}", traced.picture.hash()),
            ])
        };
        PACKINGS.iter().enumerate().map(row).collect()
    }

    /// The speed-up that the simulation expects, knowing what each pixel costs.
    fn expected(&self, traced: &Traced, contention: f64) -> Result<f64, Error> {
        let job = &self.alone;
        let engine = engine::build(&self.scene, job.arith, &job.tree, &job.view)?;
        let map = CostMap::probe(&*engine, NonZeroU32::MIN, &Interrupt::new())?;
        let work = &traced.work;
        let region = engine.built().region();
        let parts = work.packet.cut(&region);
        let costs: Vec<_> = parts.map(|part| map.cost(&part) + PER_PACKET).collect();
        let two = const { NonZeroUsize::new(2).unwrap() };
        let order = dearest_first(&costs);
        let deal = Deal::new(work.schedule, costs.len(), two, order);
        let machine = Machine {
            hand_out: HAND_OUT,
            contention,
            ..Machine::default()
        };
        Ok(simulate(&costs, &deal, &machine).speed_up)
    }

    fn median(&self, value: impl Fn(&Sample) -> f64) -> f64 {
        let mut values: Vec<_> = self.samples.iter().map(value).collect();
        values.sort_by(f64::total_cmp);
        let middle = values.len() / 2;
        match values.len() % 2 {
            1 => values[middle],
            _ => (values[middle - 1] + values[middle]) / 2.0,
        }
    }
}

fn joined<T>(handle: thread::ScopedJoinHandle<'_, T>) -> T {
    match handle.join() {
        Ok(value) => value,
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// What `octray render` makes of a scene and options.
fn job(scene: &Path, options: &str) -> Result<RenderJob, Error> {
    let line = [
        "octray".as_ref(),
        "render".as_ref(),
        scene.as_os_str(),
        "--size=512x512".as_ref(),
    ];
    let options = options.split_whitespace().map(AsRef::as_ref);
    match Cli::try_parse_from(line.into_iter().chain(options)).map(|cli| cli.command) {
        Ok(Command::Render(args)) => args.job(),
        Ok(other) => Err(Error::Usage(format!("{other:?} does not render"))),
        Err(error) => Err(Error::Usage(error.to_string())),
    }
}
