//! `octray measure` end to end: measurements on two boards if their emulators are installed, and the messages if they
//! are not.
#![cfg(feature = "lab")]

use snapbox::cmd::cargo_bin;
use std::path::Path;
use std::process::{Command, Output};
use std::{env, fs};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn measure(line: &str) -> Command {
    let mut command = Command::new(cargo_bin!("octray"));
    command
        .current_dir(root())
        .arg("measure")
        .args(line.split_whitespace());
    command
}

/// Returns the output, or `None` if a target or an emulator is missing on this machine.
fn run(line: &str) -> Option<Output> {
    let output = measure(line).output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    if stderr.contains(" is missing: ") {
        eprintln!("skipped: {stderr}");
        return None;
    }
    Some(output)
}

/// Returns the JSON of two identical runs; `None` as [`run`].
fn twice(line: &str) -> Option<serde_json::Value> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    let mut results = Vec::new();
    for _ in 0..2 {
        let output = run(&format!("{line} --json {}", path.display()))?;
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{stderr}");
        results.push((output.stdout, fs::read(&path).unwrap()));
    }
    assert_eq!(results[0], results[1]);
    Some(serde_json::from_slice(&results[0].1).unwrap())
}

#[test]
fn bad_usage_is_refused() {
    for (line, expected) in [
        ("--targets m1", "expected one of m0, m3, m4"),
        ("--arith half", "invalid value 'half'"),
        ("--size 64", "expected WIDTHxHEIGHT"),
        ("--json a --csv a", "the results a and a are one file"),
    ] {
        let output = measure(line).output().unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {stderr}");
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
}

#[test]
fn a_missing_emulator_is_reported_with_the_command_that_installs_it() {
    let output = measure("--targets m0,rv32imac")
        .env("PATH", "")
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    for line in [
        "qemu-system-arm is missing: apt-get install qemu-system-arm",
        "qemu-system-riscv32 is missing: apt-get install qemu-system-misc",
    ] {
        assert!(stderr.contains(line), "{stderr}");
    }
}

#[test]
fn a_missing_scene_is_reported_before_anything_is_built() {
    let output = measure("no.scene").env("PATH", "").output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr.contains("no.scene: no such file"), "{stderr}");
}

#[test]
fn two_boards_are_measured_and_the_same_twice() {
    let line = "scenes/glass.scene --targets m3,rv32imafc --arith f32 --size 16x12";
    let Some(report) = twice(line) else { return };
    let [soft, hard] = [0, 1].map(|i| &report["rows"][i]);
    let count = |row: &serde_json::Value, name| row[name].as_u64().unwrap();
    assert_eq!(
        (&soft["board"], &hard["board"]),
        (&"m3".into(), &"rv32imafc".into())
    );
    // The same picture with and without a unit for floats, and where the work goes.
    assert_eq!(soft["hash"], hard["hash"]);
    assert_eq!((count(soft, "float"), count(hard, "float_library")), (0, 0));
    assert!(count(soft, "float_library") > count(soft, "instructions") / 2);
    assert!(count(soft, "instructions") > 3 * count(hard, "instructions"));
    for row in [soft, hard] {
        let classes = [
            "load_store",
            "branch",
            "multiply",
            "divide",
            "float",
            "other",
        ];
        let sum: u64 = classes.iter().map(|name| count(row, name)).sum();
        assert_eq!(sum, count(row, "instructions"));
        let closest = row["per_closest_ray"].as_f64().unwrap();
        assert!(closest > 100.0, "{closest}");
        assert!(count(row, "stack") > 500 && count(row, "flash") > 5000);
    }
}

#[test]
fn a_run_that_fails_is_never_a_number() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("a.csv");
    // The strip of a wide picture is larger than the board's memory, or leaves too little of it; a second is too short
    // for so large a picture.
    for (size, targets, outcome) in [
        ("2000x8", "m3,rv32imac", "stack overflow"),
        ("1344x8", "rv32imafc", "stack overflow"),
        ("320x960", "m3", "no end within 1 s"),
    ] {
        let line = format!(
            "scenes/figure-19.scene --targets {targets} --arith f32 --patience 1 --size {size} --csv {}",
            csv.display()
        );
        let Some(output) = run(&line) else { return };
        assert_eq!(output.status.code(), Some(1), "{size}");
        let rows = fs::read_to_string(&csv).unwrap();
        assert_eq!(
            rows.lines().count(),
            1 + targets.split(',').count(),
            "{rows}"
        );
        for row in rows.lines().skip(1) {
            assert!(row.contains(&format!(",speed,{outcome}")), "{size}: {row}");
            assert!(row.contains(",,,,,,,"), "{size}: {row}");
        }
    }
}

#[test]
fn kernels_are_measured_and_the_same_twice() {
    let line = "--kernels --targets m3 --arith f32,auto";
    let Some(report) = twice(line) else { return };
    let rows = report["rows"].as_array().unwrap();
    let row = |arith: &str, kernel: &str| {
        let found = |row: &&serde_json::Value| row["arith"] == arith && row["kernel"] == kernel;
        rows.iter().find(found).unwrap()
    };
    let cost = |arith, kernel| row(arith, kernel)["per_call"].as_f64().unwrap();
    // One instruction of the core, without the call.
    assert_eq!(cost("auto", "add"), 1.0);
    for arith in ["f32", "auto"] {
        assert!(cost(arith, "add") < cost(arith, "div"));
        assert!(cost(arith, "mul") < cost(arith, "dot"));
        assert!(cost(arith, "dot") < cost(arith, "normalise"));
        assert!(cost(arith, "hit sphere") < cost(arith, "hit cone"));
        assert!(cost(arith, "normalise") < cost(arith, "shaded light"));
        assert!(cost(arith, "voxel step") > 50.0);
        // The inputs serve their purpose: in either arithmetic some rays hit and some miss.
        for shape in ["sphere", "triangle", "polygon", "cone", "box"] {
            let row = row(arith, &format!("hit {shape}"));
            let [hits, calls] = ["hits", "calls"].map(|name| row[name].as_u64().unwrap());
            assert!(hits > calls / 5 && hits < calls * 4 / 5, "{shape}: {hits}");
        }
    }
    for kernel in ["add", "dot", "hit sphere", "hit box", "shaded light"] {
        assert!(cost("auto", kernel) < cost("f32", kernel), "{kernel}");
    }
}
