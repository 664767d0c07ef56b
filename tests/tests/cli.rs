//! `octray render` end to end: the files it writes, its output, and its exit codes.

use octray_render::metric::Difference;
use octray_render::picture::{self, Picture};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// All features: a mirror, glass, a box, a cone and a polygon under two lights.
const SCENE: &str = "v 0 1 6 at 0 0.5 0 up 0 1 0 angle 40 resolution 60 80
b 0.2 0.3 0.5
l -3 5 4 0.8  l 4 3 2 0.4
f 0.1 0.1 0.1  0.6 0.6 0.5  0 0 0  1 0 0
p 4  -5 0 -5  5 0 -5  5 0 5  -5 0 5
f 0 0 0  0.2 0.2 0.2  0.5 0.5 0.5  30 0.6 0
s -0.8 0.6 0 0.6
f 0 0 0  0.1 0.1 0.1  0.5 0.5 0.5  50 0.1 0.8 1.5
s 0.7 0.5 0.8 0.5
f 0.1 0 0  0.7 0.2 0.1  0 0 0  1 0 0
box 0.3 0.4 -1 0.8 0.8 0.8
c 1.6 0 0 0.4  1.6 1.2 0 0
";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    folder
}

fn octray(folder: &Path, line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_octray-command"));
    command.current_dir(folder).args(line.split_whitespace());
    command
}

fn run(folder: &Path, line: &str) -> Output {
    octray(folder, line).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Returns standard output of a command that succeeds and prints no error.
fn done(folder: &Path, line: &str) -> String {
    let output = run(folder, line);
    assert_eq!(text(&output.stderr), "", "{line}");
    assert_eq!(output.status.code(), Some(0), "{line}");
    text(&output.stdout)
}

/// Returns the statistics of a rendering.
fn stats(folder: &Path, line: &str) -> Value {
    serde_json::from_str(&done(
        folder,
        &format!("render a.scene --stats json {line}"),
    ))
    .unwrap()
}

/// Returns standard error of a command that fails with this code and prints nothing.
fn failed(folder: &Path, line: &str, code: i32) -> String {
    let output = run(folder, line);
    assert_eq!(output.status.code(), Some(code), "{line}");
    assert_eq!(text(&output.stdout), "", "{line}");
    text(&output.stderr)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn picture(folder: &Path, name: &str) -> Picture {
    picture::read(&folder.join(name)).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn without_flags_it_writes_a_png_of_the_scenes_name_and_prints_a_summary() {
    let folder = folder();
    let summary = done(folder.path(), "render a.scene");
    assert_eq!(names(folder.path()), ["a.png", "a.scene"]);
    assert_eq!(picture(folder.path(), "a.png").size(), (80, 60));
    for word in ["f32", "2 lights", "bvh8", "80 x 60", "rays"] {
        assert!(summary.contains(word), "no {word:?} in\n{summary}");
    }
    assert_eq!(done(folder.path(), "render a.scene --stats none"), "");
}

#[test]
fn the_json_object_has_the_documented_fields() {
    let folder = folder();
    let stats = stats(folder.path(), "--arith auto --threads 2 --schedule static");
    let fields = [
        "scene",
        "arith",
        "format",
        "lights",
        "opaque",
        "size",
        "rays",
        "steps",
        "tests",
        "hits",
        "saturations",
        "dropped",
        "tree",
        "seconds",
        "threads",
        "schedule",
        "tile",
        "tiles",
        "messages",
        "idle",
        "hash",
    ];
    let mut sorted = fields;
    sorted.sort_unstable();
    let mut found = keys(&stats);
    found.sort_unstable();
    assert_eq!(found, sorted);
    assert_eq!(stats["scene"], "a.scene");
    assert_eq!(
        (&stats["arith"], &stats["format"]),
        (&"auto".into(), &"i4f28".into())
    );
    assert_eq!(stats["size"], serde_json::json!([80, 60]));
    assert_eq!(
        (&stats["threads"], &stats["schedule"]),
        (&2.into(), &"static".into())
    );
    assert_eq!(
        (&stats["saturations"], &stats["tree"]["unsplit"]),
        (&0.into(), &0.into())
    );
    assert_eq!(stats["tree"]["kind"], "bvh8");
    assert_eq!(
        stats["dropped"],
        serde_json::json!({"rays": 0, "nodes": 0, "uncached": 0})
    );
    for field in ["nodes", "links", "depth"] {
        assert!(stats["tree"][field].as_u64().unwrap() > 0, "{field}");
    }
    for field in ["parse", "build", "render"] {
        assert!(stats["seconds"][field].as_f64().unwrap() >= 0.0, "{field}");
    }
    let rays = |kind: &str| stats["rays"][kind].as_u64().unwrap();
    assert!(rays("primary") > 0 && rays("primary") <= 80 * 60);
    assert!(stats["hits"].as_u64().unwrap() <= rays("primary"));
    assert!(rays("blocked") > 0 && rays("blocked") < rays("shadow"));
    assert!(rays("reflected") > 0 && rays("transmitted") > 0);
    let hash = stats["hash"].as_str().unwrap();
    let expected = format!("{:016x}", picture(folder.path(), "a.png").hash());
    assert_eq!(hash, expected);
}

#[test]
fn tiles_are_smaller_for_many_threads() {
    let folder = folder();
    let tile = |line: &str| {
        let tile = stats(folder.path(), line)["tile"].clone();
        (tile["rows"].as_u64().unwrap(), tile["columns"].as_u64())
    };
    assert_eq!(tile("--threads 1"), (16, Some(16)));
    assert_eq!(tile("--threads 2 --size 640x480"), (16, Some(16)));
    assert_eq!(tile("--threads 64"), (4, Some(8)));
    assert_eq!(tile("--threads 2 --tile-rows 4"), (4, None));
}

#[test]
fn threads_schedules_and_tiles_do_not_change_the_picture() {
    let folder = folder();
    let first = stats(folder.path(), "--threads 1 --tile-rows 1 -o first.ppm");
    let bytes = fs::read(folder.path().join("first.ppm")).unwrap();
    for threads in 1..=3 {
        for schedule in [
            "prescheduled",
            "static",
            "dynamic",
            "guided",
            "cost-ordered",
            "work-stealing",
        ] {
            for tile in ["1", "2", "7", "9 --tile-columns 16"] {
                let line = format!(
                    "--threads {threads} --schedule {schedule} --tile-rows {tile} -o b.ppm"
                );
                let stats = stats(folder.path(), &line);
                for field in ["rays", "steps", "tests", "hits"] {
                    assert_eq!(stats[field], first[field], "{line}: {field}");
                }
                assert_eq!(
                    fs::read(folder.path().join("b.ppm")).unwrap(),
                    bytes,
                    "{line}"
                );
            }
        }
    }
}

#[test]
fn every_arithmetic_and_every_tree_shows_the_scene() {
    let folder = folder();
    done(folder.path(), "render a.scene --arith f64 -o f64.png");
    let reference = picture(folder.path(), "f64.png");
    // The lowest PSNR in dB: the coarsest formats show little more than that something is there.
    let ariths = [
        ("f64", 99.0),
        ("f32", 50.0),
        ("approx0", 10.0),
        ("approx1", 20.0),
        ("approx2", 45.0),
        ("i24f8", 10.0),
        ("i20f12", 20.0),
        ("i16f16", 40.0),
        ("i12f20", 40.0),
        ("i8f24", 40.0),
        ("i4f28", 40.0),
        ("i32f32", 40.0),
        ("auto", 40.0),
    ];
    for (arith, least) in ariths {
        let first = stats(
            folder.path(),
            &format!("--arith {arith} --tree none -o none.png"),
        );
        assert_eq!(first["arith"], arith);
        let taken = picture(folder.path(), "none.png");
        let ratio = Difference::between(&reference, &taken).unwrap().psnr();
        assert!(ratio >= least, "{arith}: {ratio:.1} dB");
        for tree in [
            "tight",
            "modified",
            "plain",
            "tight --leaf-size 1 --arena 2",
            "plain --arena 1",
            "plain --tree-depth 2 --link box",
            "modified --link box --leaf-size 5",
            "plain --walk neighbour",
            "plain --walk links --leaf-size 1",
            "modified --walk neighbour --leaf-size 1",
            "modified --walk links",
        ] {
            let same = stats(folder.path(), &format!("--arith {arith} --tree {tree}"));
            assert_eq!(same["hash"], first["hash"], "{arith}, {tree}");
        }
    }
}

#[test]
fn every_format_holds_the_picture() {
    let folder = folder();
    done(folder.path(), "render a.scene -o a.png --stats none");
    let png = picture(folder.path(), "a.png");
    for (line, least) in [
        ("-o a.ppm", f64::INFINITY),
        ("-o a.pfm", f64::INFINITY),
        ("-o b.ras --ras-depth 24", f64::INFINITY),
        ("-o a.ras", 30.0),
    ] {
        done(
            folder.path(),
            &format!("render a.scene --stats none {line}"),
        );
        let name = line.split_whitespace().nth(1).unwrap();
        let same = picture(folder.path(), name);
        let ratio = Difference::between(&png, &same).unwrap().psnr();
        assert!(ratio >= least, "{name}: {ratio:.1} dB");
    }
    assert!(picture(folder.path(), "a.pfm").intensities().is_some());
    // An independent reader.
    let version = Command::new("convert").arg("-version").output();
    if !version.is_ok_and(|output| text(&output.stdout).contains("Version: ImageMagick")) {
        eprintln!("not tested: ImageMagick's convert, which reads the formats too, is missing");
        return;
    }
    let ppm = fs::read(folder.path().join("a.ppm")).unwrap();
    for name in ["a.png", "a.ppm", "b.ras"] {
        let output = Command::new("convert")
            .current_dir(folder.path())
            .args([name, "-depth", "8", "ppm:-"])
            .output()
            .unwrap();
        assert!(output.stdout == ppm, "{name}: {}", text(&output.stderr));
    }
}

#[test]
fn the_settings_determine_the_view() {
    let folder = folder();
    let four = stats(folder.path(), "--pixels-per-ray 4 -o four.ppm");
    let taken = picture(folder.path(), "four.ppm");
    let rows: Vec<_> = taken.rows().collect();
    for (y, row) in rows.iter().enumerate() {
        assert_eq!(row, &rows[y - y % 2]);
        assert!(row.chunks(2).all(|pair| pair[0] == pair[1]));
    }
    let one = stats(folder.path(), "");
    let primary = |stats: &Value| stats["rays"]["primary"].as_u64().unwrap();
    assert!(primary(&four) * 3 < primary(&one));
    let samples = stats(folder.path(), "--samples 3 -o samples.ppm");
    assert_eq!(primary(&samples), 9 * primary(&one));
    let sized = stats(folder.path(), "--size 33x21 -o sized.ppm");
    assert_eq!(sized["size"], serde_json::json!([33, 21]));
    assert_eq!(picture(folder.path(), "sized.ppm").size(), (33, 21));
    for line in ["--max-depth 0", "--cut-off 1"] {
        let stats = stats(folder.path(), line);
        assert_eq!(stats["rays"]["reflected"], 0, "{line}");
        assert_eq!(stats["rays"]["transmitted"], 0, "{line}");
    }
    let reflected = |line: &str| {
        stats(folder.path(), line)["rays"]["reflected"]
            .as_u64()
            .unwrap()
    };
    assert!(reflected("--max-depth 1") < reflected("--max-depth 2"));
    assert!(reflected("--cut-off 1/4") < reflected("--cut-off 0"));
}

#[test]
fn a_scene_that_does_not_fit_is_reported_with_the_value() {
    let folder = folder();
    let bright = SCENE.replace("l -3 5 4 0.8", "l -3 5 4 90");
    fs::write(folder.path().join("bright.scene"), bright).unwrap();
    let complaint = failed(folder.path(), "render bright.scene --arith i4f28", 1);
    assert!(complaint.contains("brightness of light 1"), "{complaint}");
    assert_eq!(names(folder.path()), ["a.scene", "bright.scene"]);
    let line = "render bright.scene --arith auto --stats json";
    let stats: Value = serde_json::from_str(&done(folder.path(), line)).unwrap();
    assert_eq!(stats["saturations"], 0);
}

#[test]
fn mistakes_are_reported_and_leave_no_files() {
    let folder = folder();
    fs::write(
        folder.path().join("bad.scene"),
        format!("{SCENE}ball 1 2 3"),
    )
    .unwrap();
    let complaint = failed(folder.path(), "render bad.scene", 1);
    assert!(
        complaint.starts_with("bad.scene:13:1: error: "),
        "{complaint}"
    );
    let complaint = failed(folder.path(), "render missing.scene", 1);
    assert!(
        complaint.contains("missing.scene: no such file"),
        "{complaint}"
    );
    let complaint = failed(folder.path(), "render a.scene -o no/such/a.png", 1);
    assert!(
        complaint.contains("cannot write no/such/a.png"),
        "{complaint}"
    );
    for line in [
        "render",
        "render a.scene --arith f16",
        "render a.scene --tree oak",
        "render a.scene -o a.bmp",
        "render a.scene --size 0x5",
        "render a.scene --threads 0",
        "render a.scene --samples 2 --pixels-per-ray 4",
        "render a.scene --cut-off 2",
        "render a.scene --stats xml",
        "render a.scene --nonsense",
    ] {
        failed(folder.path(), line, 2);
    }
    assert_eq!(names(folder.path()), ["a.scene", "bad.scene"]);
}

/// Ctrl-C while tracing a picture that would take minutes.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_leaves_no_incomplete_file() {
    use std::process::Stdio;
    use std::time::Duration;

    let folder = folder();
    let child = octray(
        folder.path(),
        "render a.scene --size 8000x6000 --samples 16 -o big.png",
    )
    .stdout(Stdio::piped())
    .stderr(Stdio::piped())
    .spawn()
    .unwrap();
    // Only after it has installed its signal handler.
    let listens = || {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        u64::from_str_radix(caught.unwrap().trim(), 16).unwrap() & 0b10 != 0
    };
    while !listens() {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(300));
    let interrupted = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(interrupted.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(text(&output.stdout), "");
    assert_eq!(names(folder.path()), ["a.scene"]);
}

#[test]
fn a_sweep_over_schedules_is_printed_drawn_and_written() {
    let folder = folder();
    let line =
        "schedule a.scene --processors 1,8 --tile-rows 1..8 --tiles 8 --policy static,dynamic";
    let table = done(
        folder.path(),
        &format!("{line} -o chart.svg --csv runs.csv --hand-out 500 --per-pixel 2"),
    );
    assert!(table.contains("| 8          | tiles  |"), "{table}");
    let chart = fs::read_to_string(folder.path().join("chart.svg")).unwrap();
    assert!(chart.contains("How well a at 80 x 60 is shared"));
    let runs = fs::read_to_string(folder.path().join("runs.csv")).unwrap();
    // Two policies, five tiles, two numbers of processors.
    assert_eq!(runs.lines().count(), 1 + 2 * 5 * 2);
    // Objects are visible in 56 of 60 rows: a tile of 64 rows has no more, and hand-outs cost no more.
    let per_pixel = |flags: &str| {
        let line = "schedule a.scene --processors 1 --tile-rows 64 --policy dynamic --json";
        let json = done(folder.path(), &format!("{line} {flags}"));
        let json: Value = serde_json::from_str(&json).unwrap();
        let run = json["runs"].as_array().unwrap().iter();
        let mut strips = run.filter(|run| run["tile"]["columns"].is_null());
        strips.next().unwrap()["time"].as_f64().unwrap()
    };
    let pixels = per_pixel("--per-pixel 100") - per_pixel("");
    assert!((pixels / 100.0 - 80.0 * 56.0).abs() < 1e-3, "{pixels}");
    // On one processor there are no messages.
    assert_eq!(per_pixel("--per-pixel 100 --messages"), per_pixel(""));
    let fewer = done(
        folder.path(),
        &format!("{line} --pixels-per-ray 4 --samples 1 --json"),
    );
    let fewer: Value = serde_json::from_str(&fewer).unwrap();
    assert_eq!(fewer["runs"].as_array().map(Vec::len), Some(2 * 4 * 2));
    for wrong in [
        "-o a.txt",
        "-o a.scene",
        "-o b.svg --csv b.svg",
        "--pixels-per-ray 4 --tile-rows 1 --tiles 5",
    ] {
        failed(folder.path(), &format!("schedule a.scene {wrong}"), 2);
    }
}
