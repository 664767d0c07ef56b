//! `octray plan`: plans achieve the accuracy that they promise, are as small as possible, and cost what they predict.
#![cfg(feature = "lab")]

use octray_lab::measure::board::{BOARDS, Board};
use octray_lab::plan::accuracy::fixed_point;
use octray_lab::plan::comb::comb;
use octray_lab::plan::events::Probe;
use octray_lab::plan::job::{Numbers, PlanJob, PlanLimits, memory};
use octray_lab::plan::model::Model;
use octray_lab::plan::record;
use octray_prepare::bake::bake;
use octray_prepare::plan::Plan;
use octray_prepare::{Format, PixelsPerRay};
use octray_render::interrupt::Interrupt;
use octray_render::metric::Difference;
use octray_scenes::generate::{SceneKind, Spec, generate};
use octray_scenes::model::Scene;
use snapbox::cmd::cargo_bin;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SIZE: (u32, u32) = (40, 30);
const MIN_PSNR: f64 = 40.0;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn board(name: &str) -> &'static Board {
    BOARDS.iter().find(|board| board.name == name).unwrap()
}

/// The five figures, and five generated scenes.
fn scenes() -> Vec<(String, Scene)> {
    let figures = (19..=23).map(|number| {
        let name = format!("figure-{number}");
        let path = root().join("scenes").join(&name).with_extension("scene");
        (name, octray_scenes::read(&path).unwrap())
    });
    let generated = SceneKind::ALL.into_iter().map(|kind| {
        let scene = generate(Spec { kind, objects: 30 }, 1);
        (kind.name().to_owned(), scene)
    });
    figures.chain(generated).collect()
}

fn job(board: &'static Board, numbers: Numbers) -> PlanJob {
    let (flash, ram) = memory(board);
    PlanJob {
        scene: "test.scene".into(),
        board,
        limits: PlanLimits {
            flash,
            ram,
            min_psnr: MIN_PSNR,
        },
        numbers,
        size: Some(SIZE),
        measure: false,
        json: false,
        emit: None,
    }
}

fn render(scene: &Scene, plan: &Plan) -> Probe {
    Probe::render(scene, plan, &Interrupt::default()).unwrap()
}

#[test]
fn plans_of_ten_scenes_are_accurate_enough_and_no_larger() {
    for (name, scene) in scenes() {
        let job = job(board("m3"), Numbers::Any);
        let report = octray_lab::plan::plan(&job, &scene, &Interrupt::default()).unwrap();
        assert!(report.failures.is_empty(), "{name}: {:?}", report.failures);
        let plan = report.plan.unwrap();
        let with = |format, pixels_per_ray, max_depth| Plan {
            format,
            pixels_per_ray,
            max_depth,
            ..plan.clone()
        };
        let exact = render(&scene, &with(Format::F64, PixelsPerRay::One, 64)).picture;
        let psnr = |plan: &Plan| {
            let picture = render(&scene, plan).picture;
            Difference::between(&exact, &picture).unwrap().psnr()
        };
        assert!(psnr(&plan) >= MIN_PSNR, "{name}");
        // The depth loses nothing; a smaller depth would.
        let depth =
            |depth| render(&scene, &with(Format::F64, PixelsPerRay::One, depth)).picture == exact;
        assert!(depth(plan.max_depth), "{name}");
        assert!(plan.max_depth == 0 || !depth(plan.max_depth - 1), "{name}");
        // Two bits less are too few, and four pixels per ray too coarse.
        let formats: Vec<_> = fixed_point().collect();
        let at = formats.iter().position(|format| *format == plan.format);
        if let Some(narrower) = at.and_then(|at| formats.get(at.checked_sub(1)?)) {
            let narrower = with(*narrower, plan.pixels_per_ray, plan.max_depth);
            let too_fine = render(&scene, &narrower).too_fine.is_some();
            assert!(
                too_fine || psnr(&narrower) < MIN_PSNR,
                "{name}: {}",
                plan.format
            );
        }
        if plan.pixels_per_ray == PixelsPerRay::One {
            assert!(
                psnr(&with(Format::F64, PixelsPerRay::Four, plan.max_depth)) < MIN_PSNR,
                "{name}"
            );
        }
        // No capacity exceeds what is used: the arena, and the stack of rays.
        let probe = render(&scene, &plan);
        assert_eq!(plan.rays, probe.waiting, "{name}");
        assert_eq!((probe.saturations, probe.too_fine), (0, None), "{name}");
        if let Some(options) = plan.tree {
            assert_eq!(options.depth, probe.depth, "{name}");
        }
    }
}

#[test]
fn the_model_predicts_what_was_measured() {
    let path = root().join("lab/record/plan.csv");
    let lines = record::read(fs::File::open(path).unwrap()).unwrap();
    let model = Model::shipped().unwrap();
    let mut checked = 0;
    for line in lines {
        let sample = line
            .sample(&root().join("scenes"), &Interrupt::default())
            .unwrap();
        let weights = model.of(sample.board.target, sample.family).unwrap();
        let errors = sample.errors(weights);
        let (scene, board, family) = (&sample.line.scene, sample.board, sample.family.name());
        let message = format!("{scene} on {board} in {family}: {errors:.3?}");
        assert!(errors.iter().all(|error| error.abs() < 0.15), "{message}");
        checked += 1;
    }
    // Every target, in fixed point and in f32.
    assert_eq!(checked, 6 * 2 * 33);
}

fn octray(line: &str) -> Output {
    let mut command = Command::new(cargo_bin!("octray"));
    command.current_dir(root()).args(line.split_whitespace());
    command.output().unwrap()
}

#[test]
fn predictions_hold_on_emulated_boards() {
    let folder = tempfile::tempdir().unwrap();
    let soup = folder.path().join("soup.scene");
    let mut file = fs::File::create(&soup).unwrap();
    let (kind, objects) = (SceneKind::Soup, 30);
    octray_scenes::write(&generate(Spec { kind, objects }, 1), &mut file).unwrap();
    let soup = soup.display();
    // Polygons with many edges, a different one than the weights were fitted to.
    let combed = folder.path().join("comb.scene");
    let mut file = fs::File::create(&combed).unwrap();
    octray_scenes::write(&comb(30).unwrap(), &mut file).unwrap();
    let combed = combed.display();
    for line in [
        "scenes/figure-22.scene --target m0 --arith fixed",
        &format!("{soup} --target rv32imac --arith f32"),
        &format!("{combed} --target m3 --arith fixed --min-psnr 20"),
    ] {
        let output = octray(&format!("plan {line} --size 40x30 --measure --json"));
        let stderr = String::from_utf8_lossy(&output.stderr);
        if stderr.contains(" is missing: ") {
            eprintln!("skipped: {stderr}");
            continue;
        }
        assert!(output.status.success(), "{line}: {stderr}");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let errors = report["trial"]["errors"].as_array().unwrap();
        // Instructions, flash, RAM, and the instructions of the dearest strip.
        let strip = &report["trial"]["dearest_error"];
        for error in errors.iter().chain([strip]) {
            assert!(
                error.as_f64().unwrap().abs() < 0.15,
                "{line}: {}",
                report["trial"]
            );
        }
    }
}

#[test]
fn what_is_emitted_is_baked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("figure-22.plan");
    let scene = "scenes/figure-22.scene";
    let output = octray(&format!(
        "plan {scene} --size 24x18 --emit {}",
        path.display()
    ));
    assert!(output.status.success());
    let plan: Plan = fs::read_to_string(&path).unwrap().parse().unwrap();
    let baked = octray(&format!("bake {scene} --plan {}", path.display()));
    let read = octray_scenes::read(root().join(scene)).unwrap();
    let expected = {
        let options = plan.options(&read, "figure-22").unwrap();
        bake(&read, &options).unwrap()
    };
    assert_eq!(String::from_utf8(baked.stdout).unwrap(), expected.source);
    assert_eq!(expected.rays, plan.rays);
    // A plan of another scene, a file that is not a plan, and a plan together with options that it contains.
    let other = octray(&format!(
        "bake scenes/glass.scene --plan {}",
        path.display()
    ));
    let stderr = String::from_utf8_lossy(&other.stderr);
    assert_eq!(other.status.code(), Some(1));
    let message = format!("{}: plan: made for another scene", path.display());
    assert!(stderr.contains(&message), "{stderr}");
    assert!(other.stdout.is_empty());
    let wrong = octray(&format!("bake {scene} --plan {scene}"));
    assert_eq!(wrong.status.code(), Some(1));
    let both = octray(&format!(
        "bake {scene} --plan {} --arith f32",
        path.display()
    ));
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn what_does_not_fit_is_reported_with_what_would() {
    let scene = "scenes/isometric.scene --size 64x48";
    for (bounds, remedies, failures) in [
        ("--ram 1500", 2, ["error: RAM: the nearest plan takes "; 2]),
        ("--flash 9000", 1, ["error: flash: ", "more than 9,000"]),
        ("--flash 9000 --ram 1500", 2, ["flash: ", "RAM: "]),
    ] {
        let output = octray(&format!("plan {scene} {bounds}"));
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{bounds}: {stderr}");
        for failure in failures {
            assert!(stderr.contains(failure), "{bounds}: {stderr}");
        }
        let (_, fits) = stderr.trim_end().split_once("it fits with ").unwrap();
        let fits: Vec<_> = fits.split(", or with ").collect();
        assert_eq!(fits.len(), remedies, "{stderr}");
        for remedy in fits {
            // Each remedy replaces the corresponding option.
            let mut words: Vec<_> = format!("{scene} {bounds}")
                .split(' ')
                .map(String::from)
                .collect();
            for option in remedy.split(' ').collect::<Vec<_>>().chunks(2) {
                match words.iter().position(|word| word == option[0]) {
                    Some(at) => words[at + 1] = option[1].into(),
                    None => words.extend(option.iter().map(|word| (*word).into())),
                }
            }
            let output = octray(&format!("plan {}", words.join(" ")));
            let stderr = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{bounds}: {remedy}: {stderr}");
        }
    }
    for line in [
        "plan",
        "plan a --target m1",
        "plan a --min-psnr -1",
        "plan a --emit a",
    ] {
        assert_eq!(octray(line).status.code(), Some(2), "{line}");
    }
}

#[test]
fn what_no_format_achieves_is_reported_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let head = "v 0 0 9 resolution 8 8 l 5 5 9";
    let ball = "s 0 0 -5 4";
    let heavy = format!("{head} 1 f 0 0 0 1 1 1 0 0 0 0 0.5 1.5 1.5 {ball}");
    let bright = format!("{head} 1e12 f 0 0 0 1 1 1 0 0 0 0 0 0 {ball}");
    for (options, expected) in [
        // No format reproduces its picture exactly.
        (
            "scenes/isometric.scene --size 64x48 --min-psnr 200",
            "error: PSNR: nothing reaches 200 dB; ",
        ),
        (
            &file("heavy.scene", &heavy),
            "takes transmitted shares up to 1, but that of surface 1 is 1.5; f32 might do",
        ),
        (
            &file("bright.scene", &bright),
            "but the brightness of light 1 can reach 1000000000000.000000; f32 might do",
        ),
    ] {
        let output = octray(&format!("plan {options} --arith fixed"));
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{options}: {stderr}");
        assert!(stderr.contains(expected), "{options}: {stderr}");
    }
}

fn planned(folder: &Path, text: &str) -> (serde_json::Value, String) {
    let path = folder.join("a.scene");
    fs::write(&path, text).unwrap();
    let output = octray(&format!("plan {} --json", path.display()));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{text}: {stderr}");
    (serde_json::from_slice(&output.stdout).unwrap(), stderr)
}

#[test]
fn a_view_of_nothing_costs_something_and_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let head = "v 0 0 9 resolution 24 16 b 0.2 0.3 0.4";
    let surface = "f 0.3 0.1 0.1 0.5 0.5 0.5 0 0 0 1 0 0";
    for (text, note) in [
        (head.to_owned(), "note: the scene has no objects"),
        (
            format!("{head} l 1 1 1 1 {surface} s 0 0 40 2"),
            "note: no ray of the camera meets an object",
        ),
        (
            format!("{head} {surface} s 0 0 -40 9"),
            "note: the scene has no lights",
        ),
    ] {
        let (report, stderr) = planned(folder.path(), &text);
        assert!(stderr.starts_with(note), "{text}: {stderr}");
        assert!(report["cost"]["instructions"].as_u64().unwrap() > 0);
        let told = report.to_string();
        assert!(!told.contains("NaN") && !told.contains("inf"), "{told}");
    }
}

/// Without a budget, 2^59 rays would be traced for a pixel.
#[test]
fn a_picture_without_end_is_explored_as_far_as_a_budget_goes() {
    let folder = tempfile::tempdir().unwrap();
    let hall = "v 0 0 4 at 0 0 0 up 0 1 0 angle 60 resolution 8 6 b 0.2 0.3 0.4 l 0 5 5 1
        f 0 0 0 0.1 0.1 0.1 0.1 0.1 0.1 9 0.9 0.9 1.3
        s 0 0 0 9 s 0 0 0 8 s 1 0 0 1.5 s -2 0 0 1 s 0 2 0 1.2";
    let (report, _) = planned(folder.path(), hall);
    let unexplored = report["unexplored"].as_str().unwrap();
    assert!(
        unexplored.contains("bounces were not explored"),
        "{unexplored}"
    );
    let ball = "v 0 0 9 resolution 8 6 l 1 1 9 1 f 0 0 0 1 1 1 0 0 0 1 0.5 0 s 0 0 -9 4";
    assert!(planned(folder.path(), ball).0["unexplored"].is_null());
}
