//! Measures frames and fits the model of `octray plan`.
//!
//! `cargo run --release -p octray-lab --features fit --bin fit-plan` measures frames of shipped and generated scenes on
//! emulated boards, in fixed point and in f32, with a tree and without, and fits the weights of the model. With `--fit`
//! it fits to the existing record, `lab/record/plan.csv`. It writes the record and `lab/src/plan/weights.csv` only with
//! `--write`.

use clap::Parser;
use comfy_table::{CellAlignment, Table, presets};
use octray_lab::measure;
use octray_lab::measure::board::{self, Board};
use octray_lab::measure::job::{FirmwareOptions, Goal, MeasureJob};
use octray_lab::measure::report::MeasureReport;
use octray_lab::measure::row::{COLUMNS, FrameRow};
use octray_lab::plan::comb::comb;
use octray_lab::plan::fit;
use octray_lab::plan::model::Model;
use octray_lab::plan::record::{self, SEED, Sample};
use octray_prepare::{Arith, FirmwareTree, RenderSettings};
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_scenes::generate::{SceneKind, Spec, generate};
use octray_scenes::reduce::Reduction;
use std::error::Error;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// One board per target.
const BOARDS: [&str; 6] = ["m0", "m3", "m4", "m4f", "rv32imac", "rv32imafc"];

/// Scenes that are measured with a tree.
const SCENES: [&str; 13] = [
    "figure-19",
    "figure-20",
    "figure-21",
    "figure-22",
    "figure-23",
    "cones",
    "glass",
    "isometric",
    "lights",
    "parallel",
    "patches",
    "polygons",
    "raystones",
];

/// Those that are also measured without one.
const FEW: [&str; 3] = ["figure-21", "figure-22", "raystones"];

/// Number of objects of generated scenes with a tree.
const MANY: usize = 60;

/// Number of objects of generated scenes with and without a tree.
const TWELVE: usize = 12;

/// Numbers of teeth of combs.
const TEETH: [u32; 2] = [12, 60];

/// Measure, and fit the model of `octray plan`
#[derive(Debug, Parser)]
#[command(name = "fit-plan")]
struct Args {
    /// Fit to the existing record, without measuring
    #[arg(long)]
    fit: bool,
    /// Boards to measure; the record keeps the lines of others
    #[arg(long, value_delimiter = ',', default_values = BOARDS)]
    boards: Vec<String>,
    /// Write the record and the weights into the sources
    #[arg(long)]
    write: bool,
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

fn run(args: &Args) -> Result<(), Box<dyn Error>> {
    let lab = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scenes = lab.join("../scenes");
    let interrupt = Interrupt::new();
    let path = lab.join("record/plan.csv");
    let mut record = fs::read(&path)?;
    if !args.fit {
        let report = measure(&args.boards, &scenes, &interrupt)?;
        let folder = tempfile::tempdir()?;
        let measured = folder.path().join("plan.csv");
        let job = MeasureJob {
            csv: Some(measured.clone()),
            ..job(Vec::new(), FirmwareTree::COMPACT, &[])
        };
        report.write(&COLUMNS, &job, &interrupt)?;
        let mut renewed = Vec::new();
        record::renew(&*record, File::open(&measured)?, &mut renewed)?;
        record = renewed;
        if args.write {
            output::write_file(&path, &interrupt, |out| out.write_all(&record))?;
        }
    }
    let samples: Result<Vec<Sample>, _> = (record::read(&*record)?.into_iter())
        .map(|line| line.sample(&scenes, &interrupt))
        .collect();
    let samples = samples?;
    let model = fit::model(&samples);
    if args.write {
        model.write(File::create(lab.join("src/plan/weights.csv"))?)?;
    }
    println!("{}", errors(&samples, &model));
    Ok(())
}

/// Measures all combinations.
fn measure(
    boards: &[String],
    scenes: &Path,
    interrupt: &Interrupt,
) -> Result<MeasureReport<FrameRow>, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let generated = |objects: usize| -> Result<Vec<PathBuf>, Box<dyn Error>> {
        let write = |kind: SceneKind| -> Result<PathBuf, Box<dyn Error>> {
            let name = format!("{}-{objects}.scene", kind.name());
            let path = folder.path().join(name);
            let scene = generate(Spec { kind, objects }, SEED);
            octray_scenes::write(&scene, &mut File::create(&path)?)?;
            Ok(path)
        };
        SceneKind::ALL.into_iter().map(write).collect()
    };
    let shipped = |names: &[&str]| -> Vec<PathBuf> {
        let path = |name: &&str| scenes.join(name).with_extension("scene");
        names.iter().map(path).collect()
    };
    let twelve = generated(TWELVE)?;
    let combs = TEETH
        .into_iter()
        .map(|teeth| -> Result<PathBuf, Box<dyn Error>> {
            let path = folder.path().join(format!("comb-{teeth}.scene"));
            octray_scenes::write(&comb(teeth)?, &mut File::create(&path)?)?;
            Ok(path)
        });
    let combs = combs.collect::<Result<Vec<_>, _>>()?;
    let with = [shipped(&SCENES), generated(MANY)?, twelve.clone(), combs].concat();
    let without = [shipped(&FEW), twelve].concat();
    let boards: Result<Vec<Vec<&Board>>, _> =
        boards.iter().map(|name| board::named(name)).collect();
    let boards: Vec<&'static Board> = boards?
        .into_iter()
        .filter_map(|named| named.first().copied())
        .collect();
    let mut all: Option<MeasureReport<FrameRow>> = None;
    for (scenes, tree) in [(with, FirmwareTree::COMPACT), (without, FirmwareTree::NONE)] {
        let report = measure::measure(&job(scenes, tree, &boards), interrupt)?;
        match &mut all {
            None => all = Some(report),
            Some(all) => all.rows.extend(report.rows),
        }
    }
    let mut report = all.ok_or("nothing was measured")?;
    if let Some(row) = report.rows.iter().find(|row| row.cost.is_none()) {
        let (scene, board, outcome) = (&row.scene, row.board, &row.outcome);
        return Err(format!("{scene} on {board}: {outcome}").into());
    }
    report.rows.sort_by_key(|row| row.board.name);
    fs::remove_dir_all(folder)?;
    Ok(report)
}

fn job(scenes: Vec<PathBuf>, tree: FirmwareTree, boards: &[&'static Board]) -> MeasureJob {
    MeasureJob {
        kernels: false,
        scenes,
        reduction: Reduction::default(),
        boards: boards.to_vec(),
        ariths: vec![Arith::F32, Arith::Auto],
        settings: RenderSettings {
            size: Some((64, 48)),
            ..RenderSettings::DEFAULT
        },
        build: FirmwareOptions {
            tree,
            optimize: Goal::Speed,
        },
        patience: Duration::from_secs(300),
        functions: 0,
        json: None,
        csv: None,
        chart: None,
    }
}

/// Returns the errors of the predictions.
fn errors(samples: &[Sample], model: &Model) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header([
        "target",
        "numbers",
        "frames",
        "instructions: mean",
        "largest",
        "scene",
        "left out, typically: instructions",
        "flash",
        "RAM",
    ]);
    let percent = |error: f64| format!("{:.1} %", 100.0 * error);
    for weights in &model.0 {
        let of = |s: &&Sample| (s.board.target, s.family) == (&*weights.target, weights.family);
        let errors: Vec<(f64, &str)> = (samples.iter().filter(of))
            .map(|s| (s.errors(weights)[0].abs(), &*s.line.scene))
            .collect();
        let mean = errors.iter().map(|(error, _)| error).sum::<f64>() / errors.len() as f64;
        let largest = errors.iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let (largest, scene) = largest.copied().unwrap_or_default();
        let mut row = vec![
            weights.target.clone(),
            weights.family.name().into(),
            errors.len().to_string(),
            percent(mean),
            percent(largest),
            scene.into(),
        ];
        row.extend(weights.errors.map(percent));
        table.add_row(row);
    }
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
