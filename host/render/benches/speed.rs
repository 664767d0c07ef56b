//! How fast pictures are traced; the hash of every picture stands beside its time, and is checked.
//!
//! `cargo bench -p octray-render -- [--rounds N] [--print-hashes] [SCENE...]`, where cargo looks for scenes
//! from this package's folder: name them from the root.
//!
//! Every scene is rendered as by `octray render` with [`OPTIONS`] ([`SETTINGS`]), on one thread and then on two,
//! once in each round; rounds go through all scenes, so that a machine that slows down for a while
//! slows all of them. Without scenes, those of figures 19 to 23 and generated ones are taken, and a
//! second table shows how speed falls as scenes grow. The pictures of these are known: if a hash is
//! another than in [`KNOWN`], or differs between rounds or numbers of threads, the benchmark fails.

mod common {
    pub(crate) mod table;
}

use clap::Parser;
use comfy_table::Table;
use common::table::table;
use octray_prepare::RenderSettings;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::render::{Rendering, render_with};
use octray_render::schedule::Schedule;
use octray_render::stats::Rays;
use octray_scenes::generate::{SceneKind, Spec, generate};
use std::fs::File;
use std::io::BufWriter;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// How every scene is rendered, beside the number of threads.
const OPTIONS: &str = "--arith f32 --size 512x512 --max-depth 4 --cut-off 0";

/// The same.
const SETTINGS: RenderSettings = RenderSettings {
    size: Some((512, 512)),
    max_depth: 4,
    cut_off: 0.0,
    ..RenderSettings::DEFAULT
};

/// The scenes that come with the project.
const FIGURES: [&str; 5] = [
    "figure-19",
    "figure-20",
    "figure-21",
    "figure-22",
    "figure-23",
];

/// The kinds of scene that are generated in each of [`SIZES`].
const GROWING: [SceneKind; 3] = [SceneKind::Flake, SceneKind::Lattice, SceneKind::Soup];
const SIZES: [usize; 5] = [100, 1000, 10_000, 100_000, 1_000_000];

/// Further scenes to generate, and their size.
const OTHERS: [SceneKind; 2] = [SceneKind::Terrain, SceneKind::Tree];
const OTHERS_SIZE: usize = 10_000;

const SEED: u64 = 1;

/// The hash of each built-in scene's picture, as `--print-hashes` prints it. The tests of the whole
/// compare the smaller ones, too.
const KNOWN: &str = include_str!("pictures.csv");

/// Time the tracer, and check what it traces
#[derive(Debug, Parser)]
#[command(name = "speed")]
struct Args {
    /// How often each scene is rendered
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Print the hashes of the pictures as they are, and do not fail for them
    #[arg(long)]
    print_hashes: bool,
    /// Scene files to render instead of the built-in ones
    scenes: Vec<PathBuf>,
    /// Given by cargo
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            match error {
                // Drawn diagnostics bring their own heading.
                Error::Scene(_) => eprintln!("{error}"),
                _ => eprintln!("error: {error}"),
            }
            ExitCode::FAILURE
        }
    }
}

/// Whether every picture is the one that it should be.
fn run(args: &Args) -> Result<bool, Error> {
    let folder = tempfile::tempdir().map_err(|e| Error::Failed(e.to_string()))?;
    let mut subjects = match args.scenes.is_empty() {
        true => built_in(folder.path())?,
        false => args.scenes.iter().map(|path| given(path)).collect(),
    };
    for round in 1..=args.rounds {
        eprintln!("round {round} of {}", args.rounds);
        for subject in &mut subjects {
            subject.measure()?;
        }
    }
    println!(
        "octray render SCENE {OPTIONS} --threads 1\n\n{}",
        speeds(&subjects)
    );
    if args.scenes.is_empty() {
        println!(
            "\nMillion rays/s by number of objects\n\n{}",
            growth(&subjects)
        );
    }
    if args.print_hashes {
        for Subject { name, samples, .. } in &subjects {
            println!("{name},{:016x}", samples[0].hash);
        }
        return Ok(true);
    }
    Ok(subjects.iter().all(Subject::is_right))
}

/// A scene to render, and what that took in each round.
struct Subject {
    name: String,
    path: PathBuf,
    samples: Vec<Sample>,
}

/// One rendering on one thread, and the same on two.
struct Sample {
    /// Seconds to read the scene.
    parse: f64,
    /// Seconds to build the tree, on one thread.
    build: f64,
    /// Seconds to trace on one thread.
    render: f64,
    /// Seconds to trace on two threads.
    render_on_two: f64,
    rays: u64,
    steps: u64,
    tests: u64,
    hash: u64,
    hash_on_two: u64,
}

/// A scene file from the command line.
fn given(path: &Path) -> Subject {
    let name = path.file_stem().unwrap_or(path.as_os_str());
    Subject::new(name.to_string_lossy().into_owned(), path.to_owned())
}

/// The scenes that are rendered if none is given; those that are generated are written to `folder`.
fn built_in(folder: &Path) -> Result<Vec<Subject>, Error> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let figure = |name: &str| Subject::new(name.into(), scenes.join(name).with_extension("scene"));
    let mut subjects: Vec<_> = FIGURES.into_iter().map(figure).collect();
    let growing = GROWING
        .into_iter()
        .flat_map(|kind| SIZES.map(|objects| Spec { kind, objects }));
    let others = OTHERS.map(|kind| Spec {
        kind,
        objects: OTHERS_SIZE,
    });
    for spec in growing.chain(others) {
        let name = name(spec);
        let path = folder.join(&name);
        let write = |path: &Path| {
            let mut out = BufWriter::new(File::create(path)?);
            octray_scenes::write(&generate(spec, SEED), &mut out)
        };
        write(&path).map_err(|cause| Error::write(&path, cause))?;
        subjects.push(Subject::new(name, path));
    }
    Ok(subjects)
}

fn name(spec: Spec) -> String {
    format!("{} {}", spec.kind.name(), spec.objects)
}

impl Subject {
    fn new(name: String, path: PathBuf) -> Self {
        Self {
            name,
            path,
            samples: Vec::new(),
        }
    }

    /// Render once more.
    fn measure(&mut self) -> Result<(), Error> {
        let begin = Instant::now();
        let scene = octray_scenes::read(&self.path)?;
        let parse = begin.elapsed().as_secs_f64();
        let on = |threads: NonZeroUsize| -> Result<Rendering, Error> {
            let work = Schedule {
                threads,
                ..Schedule::default()
            };
            render_with(&scene, &SETTINGS, &work, false, &(), &Interrupt::new())
        };
        let one = on(NonZeroUsize::MIN)?;
        let two = on(const { NonZeroUsize::new(2).unwrap() })?;
        self.samples.push(Sample {
            parse,
            build: one.build.as_secs_f64(),
            render: one.render.as_secs_f64(),
            render_on_two: two.render.as_secs_f64(),
            rays: Rays::of(&one.counters).total(),
            steps: one.counters.steps(),
            tests: one.counters.tests(),
            hash: one.picture.hash(),
            hash_on_two: two.picture.hash(),
        });
        Ok(())
    }

    /// The median over the rounds.
    fn median(&self, value: impl Fn(&Sample) -> f64) -> f64 {
        median(&self.samples, value)
    }

    /// Seconds of the fastest rendering on one thread.
    fn fastest(&self) -> f64 {
        let times = self.samples.iter().map(|sample| sample.render);
        times.fold(f64::INFINITY, f64::min)
    }

    /// Million rays per second of the fastest rendering.
    fn speed(&self) -> f64 {
        self.samples[0].rays as f64 / self.fastest() / 1e6
    }

    /// Whether all pictures are the same, and the known one; tells if not.
    fn is_right(&self) -> bool {
        let mut known = KNOWN.lines().filter_map(|line| line.split_once(','));
        let known = known.find(|(name, _)| *name == self.name);
        let known = known.and_then(|(_, hash)| u64::from_str_radix(hash, 16).ok());
        let expected = known.unwrap_or(self.samples[0].hash);
        let hashes = self.samples.iter().flat_map(|s| [s.hash, s.hash_on_two]);
        let wrong = hashes.into_iter().find(|&hash| hash != expected);
        if let Some(hash) = wrong {
            let name = &self.name;
            eprintln!(
                "error: {name}: a picture's hash is {hash:016x}, and should be {expected:016x}"
            );
        }
        wrong.is_none()
    }
}

/// What every scene took.
fn speeds(subjects: &[Subject]) -> Table {
    let mut table = table(&[
        "scene",
        "min ms",
        "median ms",
        "rays",
        "Mrays/s",
        "steps/ray",
        "tests/ray",
        "parse+build",
        "2 threads",
        "picture",
    ]);
    for subject in subjects {
        let Sample {
            rays,
            steps,
            tests,
            hash,
            ..
        } = subject.samples[0];
        let share = subject.median(|s| (s.parse + s.build) / s.render);
        let gain = subject.median(|s| s.render / s.render_on_two);
        let per_ray = |count: u64| format!("{:.2}", count as f64 / rays.max(1) as f64);
        table.add_row([
            subject.name.clone(),
            format!("{:.1}", subject.fastest() * 1e3),
            format!("{:.1}", subject.median(|s| s.render) * 1e3),
            rays.to_string(),
            format!("{:.2}", subject.speed()),
            per_ray(steps),
            per_ray(tests),
            format!("{:.1} %", share * 100.0),
            format!("{gain:.2} x"),
            format!("{hash:016x}"),
        ]);
    }
    table
}

/// How speed falls with the number of objects, and by which factor in all.
fn growth(subjects: &[Subject]) -> Table {
    let speeds = GROWING.map(|kind| {
        SIZES.map(|objects| {
            let name = name(Spec { kind, objects });
            let subject = subjects.iter().find(|subject| subject.name == name);
            subject.map_or(f64::NAN, Subject::speed)
        })
    });
    let sizes = SIZES.map(|size| size.to_string());
    let mut heading = vec!["scene"];
    heading.extend(sizes.iter().map(String::as_str));
    heading.push("first / last");
    let mut table = table(&heading);
    for (kind, speeds) in GROWING.iter().zip(speeds) {
        let mut row = vec![kind.name().to_owned()];
        row.extend(speeds.map(|speed| format!("{speed:.2}")));
        row.push(format!("{:.2}", speeds[0] / speeds[SIZES.len() - 1]));
        table.add_row(row);
    }
    table
}

/// The median of a value over all samples, of which there is at least one.
fn median<T>(samples: &[T], value: impl Fn(&T) -> f64) -> f64 {
    let mut values: Vec<_> = samples.iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() % 2 {
        1 => values[middle],
        _ => (values[middle - 1] + values[middle]) / 2.0,
    }
}
