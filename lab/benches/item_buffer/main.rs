//! Asks what an item buffer would save: knowing, for each pixel, what a primary ray may meet (Weghorst, Hooper and
//! Greenberg, "Improved Computational Methods for Ray Tracing", 1984).
//!
//! `cargo bench -p octray-lab --bench item_buffer` traces the scenes of figures 19 to 23 at 128 × 128, with bvh8 in f32
//! and with compact-bvh8 in i16f16, the tree of small boards, and with each [`Help`]. Callgrind counts the instructions of
//! this machine; those of boards are predicted from counted events, by the model of `octray plan`, which knows no lists: so
//! there lists are free. The benchmark fails if a picture differs from that of the tree alone.

mod lists;
#[path = "../common/table.rs"]
mod table;

use clap::Parser;
use lists::Lists;
use octray_core::accel::{Accelerator, Hit};
use octray_core::features::ALL_FEATURES;
use octray_core::object::ObjectRef;
use octray_core::observe::{Counters, Observer};
use octray_core::quantize::Quantize;
use octray_core::ray::{Departure, Ray};
use octray_core::scene::{Light, Scene};
use octray_core::trace::{QueuedRay, Tracer, required_rays};
use octray_core::vec3::Vec3;
use octray_lab::plan::events::Events;
use octray_lab::plan::model::{Family, Model};
use octray_prepare::format::Format;
use octray_prepare::prepare::Prepare;
use octray_prepare::quantise::Prepared;
use octray_prepare::saturation::PerThread;
use octray_prepare::tree::Growth;
use octray_prepare::{RenderSettings, TreeKind, TreeSettings};
use octray_render::error::Error;
use octray_scenes::model;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use table::table;

const FIGURES: [u32; 5] = [19, 20, 21, 22, 23];

/// The boards of the prediction: a Cortex-M3 and an RV32 without floating-point units.
const TARGETS: [&str; 2] = ["thumbv7m-none-eabi", "riscv32imac-unknown-none-elf"];

/// What a primary ray is told before it searches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Help {
    /// Nothing.
    Tree,
    /// Nothing, in the way in which [`Help::Known`] and [`Help::Previous`] are told: what telling takes is no loss of
    /// theirs.
    Unbounded,
    /// The distance of its first hit, which bounds the search of the tree.
    Known,
    /// What the ray before it met: that is tested first, and bounds the search.
    Previous,
    /// No tree: the objects whose boxes it meets, by distance, for nothing. They are tested up to the first hit.
    Boxes,
    /// No tree: the objects whose boxes' rectangles in the picture its pixel is in. Filling the buffer counts.
    Rectangles,
}

/// In words, and what each is compared with.
const HELPS: [(Help, &str, Help); 5] = [
    (Help::Tree, "tree alone", Help::Tree),
    (Help::Known, "first hit known", Help::Unbounded),
    (Help::Previous, "hit of the pixel before", Help::Unbounded),
    (Help::Boxes, "list of boxes met, free", Help::Tree),
    (Help::Rectangles, "list of rectangles", Help::Tree),
];

/// The number formats, each with its tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Numbers {
    /// f32 with bvh8.
    Float,
    /// i16f16 with compact-bvh8.
    Fixed,
}

/// Compare what an item buffer could save
#[derive(Debug, Parser)]
#[command(name = "item_buffer")]
struct Args {
    /// Trace one frame only, for Callgrind
    #[arg(long, hide = true, num_args = 3, value_names = ["FIGURE", "NUMBERS", "HELP"])]
    frame: Vec<String>,
    /// Passed by cargo
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> ExitCode {
    let args = Args::parse();
    let done = match &args.frame[..] {
        [figure, numbers, help] => one(figure, numbers, help),
        _ => all(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Traces one frame.
fn one(figure: &str, numbers: &str, help: &str) -> Result<(), Error> {
    let word = |why: String| Error::Usage(why);
    let figure = figure.parse().map_err(|_| word("a figure".into()))?;
    let numbers = clap::ValueEnum::from_str(numbers, true).map_err(word)?;
    let help = clap::ValueEnum::from_str(help, true).map_err(word)?;
    measure(figure, numbers, help).map(drop)
}

/// Prints a table for each number format.
fn all() -> Result<(), Error> {
    let model = Model::shipped()?;
    for (numbers, name) in [
        (Numbers::Float, "f32, bvh8"),
        (Numbers::Fixed, "i16f16, compact-bvh8"),
    ] {
        let mut table = table(&[
            "primary rays are told",
            "scene",
            "nodes per primary ray",
            "tests per primary ray",
            "entries per pixel",
            "instructions of the frame",
            "saved",
            "saved, Cortex-M3",
            "saved, RV32IMAC",
        ]);
        for figure in FIGURES {
            let plain = measure(figure, numbers, Help::Tree)?;
            for (help, words, base) in HELPS {
                let frame = measure(figure, numbers, help)?;
                if frame.colours != plain.colours {
                    return Err(Error::Failed(format!(
                        "figure-{figure}, {words}: another picture"
                    )));
                }
                let instructions = callgrind(figure, numbers, help)?;
                let before = callgrind(figure, numbers, base)?;
                let share =
                    |before: f64, after: f64| format!("{:+.1} %", 100.0 * (1.0 - after / before));
                let boards = TARGETS.map(|target| {
                    let family = match numbers {
                        Numbers::Float => Family::F32,
                        Numbers::Fixed => Family::Fixed,
                    };
                    let cost = |frame: &Frame| -> f64 {
                        let weights = model.of(target, family);
                        weights.map_or(f64::NAN, |weights| {
                            weights.instructions(&frame.events).iter().sum()
                        })
                    };
                    share(cost(&plain), cost(&frame))
                });
                let per_ray = |count: u64| format!("{:.2}", count as f64 / frame.rays as f64);
                let [m3, rv32] = boards;
                table.add_row([
                    words.into(),
                    format!("figure-{figure}"),
                    per_ray(frame.primary.steps()),
                    per_ray(frame.primary.tests()),
                    per_ray(frame.entries as u64),
                    format!("{instructions}"),
                    share(before, instructions),
                    m3,
                    rv32,
                ]);
            }
        }
        println!("{name}\n\n{table}\n");
    }
    Ok(())
}

/// Counts the instructions of a frame.
fn callgrind(figure: u32, numbers: Numbers, help: Help) -> Result<f64, Error> {
    let failed = |why: String| Error::Failed(format!("valgrind: {why}"));
    let io = |cause: std::io::Error| failed(cause.to_string());
    let folder = tempfile::tempdir().map_err(io)?;
    let file = folder.path().join("count");
    let (numbers, help) = (format!("{numbers:?}"), format!("{help:?}"));
    let status = Command::new("valgrind")
        .args(["--tool=callgrind", "--toggle-collect=item_buffer::counted"])
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(std::env::current_exe().map_err(io)?)
        .args(["--frame", &figure.to_string(), &numbers, &help])
        .stderr(Stdio::null())
        .status()
        .map_err(io)?;
    let report = fs::read_to_string(&file).map_err(io)?;
    let total =
        (report.lines()).find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok());
    total.ok_or_else(|| failed(status.to_string()))
}

/// What a frame took, and what it looks like.
struct Frame {
    colours: Vec<[f64; 3]>,
    events: Events,
    /// Of the searches of primary rays only.
    primary: Counters,
    rays: u64,
    /// Entries of all lists.
    entries: usize,
}

/// Calls `work` where Callgrind counts.
#[inline(never)]
fn counted(work: &mut dyn FnMut()) {
    work();
}

fn measure(figure: u32, numbers: Numbers, help: Help) -> Result<Frame, Error> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let scene = octray_scenes::read(folder.join(format!("figure-{figure}.scene")))?;
    let settings = |kind| RenderSettings {
        size: Some((128, 128)),
        tree: TreeSettings::of(kind),
        ..RenderSettings::DEFAULT
    };
    let growth = |settings: &RenderSettings, format| Growth {
        options: settings.tree.build_options(format, None),
        arena: None,
    };
    let failed = |why: String| Error::Failed(format!("figure-{figure}: {why}"));
    match numbers {
        Numbers::Float => {
            let settings = settings(TreeKind::Bvh8);
            let mut prepared =
                f32::quantised(&scene, &settings).map_err(|why| failed(why.to_string()))?;
            let growth = growth(&settings, Format::F32);
            let (tree, _) = f32::bvh8(&mut prepared.scene, &growth);
            Ok(trace(&scene, &settings, &prepared, &tree.tree(), help))
        }
        Numbers::Fixed => {
            type Fixed = octray_core::scalar::Fixed<16, PerThread>;
            let settings = settings(TreeKind::CompactBvh8);
            let mut prepared =
                Fixed::quantised(&scene, &settings).map_err(|why| failed(why.to_string()))?;
            let growth = growth(&settings, Format::I16F16);
            let (tree, _) = Fixed::compact_bvh8(&mut prepared.scene, &growth)
                .map_err(|why| failed(why.to_string()))?;
            Ok(trace(&scene, &settings, &prepared, &tree.tree(), help))
        }
    }
}

fn trace<S: Quantize, A: Accelerator<S>>(
    file: &model::Scene,
    settings: &RenderSettings,
    prepared: &Prepared<S>,
    tree: &A,
    help: Help,
) -> Frame {
    let scene = prepared.scene.scene();
    let frame = &prepared.frame;
    let active = frame.active();
    let rays: Vec<Ray<S>> = active
        .rows
        .clone()
        .flat_map(|row| active.columns.clone().map(move |column| (column, row)))
        .map(|(column, row)| {
            let (x, y) = frame.sample_position(column, row, 0, 0);
            frame.camera().row(y).ray(x)
        })
        .collect();
    let mut stack = A::Stack::default();
    let known: Vec<_> = (rays.iter())
        .map(|ray| tree.nearest(&scene, ray, &mut stack, &mut ()))
        .collect();
    let free = match help {
        Help::Boxes => Lists::of_boxes(&scene, &rays),
        _ => Lists::default(),
    };
    let mut colours = vec![[0.0; 3]; rays.len()];
    let mut queue = vec![QueuedRay::EMPTY; required_rays(settings.max_depth, ALL_FEATURES)];
    let mut shadow_cache = vec![None; scene.lights.len()];
    // What is counted by events and by Callgrind are two frames: counting events takes instructions.
    let (mut primary, mut events, mut entries) = (Counters::default(), Counters::default(), 0);
    let mut frame = |observe: bool| {
        let filled = match help {
            Help::Rectangles => &Lists::of_rectangles(&scene, frame),
            _ => &free,
        };
        let helped = Helped {
            tree,
            help,
            known: &known,
            lists: filled,
        };
        let tracer = Tracer {
            scene: &scene,
            accelerator: &helped,
            max_depth: settings.max_depth,
            cut_off: S::from_f64(settings.cut_off),
        };
        let mut stack = HelpedStack::default();
        let Ok(mut workspace) = tracer.workspace(&mut queue, &mut stack, &mut shadow_cache) else {
            return;
        };
        let rows = active.rows.clone();
        let width = active.columns.len();
        let mut put = |x: u32, y: u32, colour: Vec3<S>| {
            let (x, y) = (x - active.columns.start, y - active.rows.start);
            colours[y as usize * width + x as usize] =
                [colour.x.to_f64(), colour.y.to_f64(), colour.z.to_f64()];
        };
        if !observe {
            frame.render(rows, &tracer, &mut workspace, &mut (), &mut put);
            return;
        }
        frame.render(rows, &tracer, &mut workspace, &mut events, &mut put);
        let mut stack = HelpedStack::default();
        for ray in &rays {
            helped.nearest(&scene, ray, &mut stack, &mut primary);
        }
        entries = filled.entries.len();
    };
    frame(true);
    counted(&mut || frame(false));
    Frame {
        colours,
        events: Events::new(&events, file.lights.len()),
        primary,
        rays: rays.len() as u64,
        entries,
    }
}

/// A tree whose primary rays are helped.
struct Helped<'a, S, A> {
    tree: &'a A,
    help: Help,
    /// What each primary ray meets first, in the order of tracing.
    known: &'a [Option<Hit<S>>],
    lists: &'a Lists<S>,
}

/// What the tree's walk takes, and where the rays are.
#[derive(Default)]
struct HelpedStack<K> {
    tree: K,
    /// The next primary ray.
    next: usize,
    /// What the last one met.
    previous: Option<ObjectRef>,
}

impl<S: Quantize, A: Accelerator<S>> Accelerator<S> for Helped<'_, S, A> {
    type Stack = HelpedStack<A::Stack>;

    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S>,
        ray: &Ray<S>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        if ray.from != Departure::NOWHERE {
            return self.tree.nearest(scene, ray, &mut stack.tree, observer);
        }
        let number = stack.next;
        stack.next += 1;
        let mut limit = scene.diameter;
        match self.help {
            Help::Tree => return self.tree.nearest(scene, ray, &mut stack.tree, observer),
            Help::Boxes | Help::Rectangles => {
                return self.lists.first(number, scene, ray, observer);
            }
            Help::Unbounded => {}
            Help::Known => limit = self.known[number].map_or(limit, |hit| hit.t),
            Help::Previous => {
                if let Some(object) = stack.previous {
                    let hit = scene.shapes.hit(object, ray, limit, observer);
                    observer.test(object.kind(), hit.is_some());
                    limit = hit.unwrap_or(limit);
                }
            }
        }
        // What is met at the limit counts, so that ties are broken as they would be without it.
        let bounded = Scene {
            diameter: limit,
            ..*scene
        };
        let hit = self.tree.nearest(&bounded, ray, &mut stack.tree, observer);
        stack.previous = hit.map(|hit| hit.object);
        hit
    }

    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S>,
        ray: &Ray<S>,
        limit: S,
        light: Option<&Light<S>>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<ObjectRef> {
        (self.tree).any_hit(scene, ray, limit, light, &mut stack.tree, observer)
    }
}
