//! `octray chart` end to end.
#![cfg(feature = "lab")]

use serde_json::Value;
use snapbox::cmd::cargo_bin;
use snapbox::{assert_data_eq, str};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A mirror and glass on a floor.
const SCENE: &str = "v 0 1 6 at 0 0.5 0 up 0 1 0 angle 40 resolution 60 80
b 0.2 0.3 0.5
l -3 5 4 0.8
f 0.1 0.1 0.1  0.6 0.6 0.5  0 0 0  1 0 0
p 4  -5 0 -5  5 0 -5  5 0 5  -5 0 5
f 0 0 0  0.2 0.2 0.2  0.5 0.5 0.5  30 0.6 0
s -0.8 0.6 0 0.6
f 0 0 0  0.1 0.1 0.1  0.5 0.5 0.5  50 0.1 0.8 1.5
s 0.7 0.5 0.8 0.5
";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    folder
}

fn chart(folder: &Path, line: &str) -> Command {
    let mut command = Command::new(cargo_bin!("octray"));
    command
        .current_dir(folder)
        .arg("chart")
        .args(line.split_whitespace());
    command
}

/// Returns the output, or `None` if a tool is missing on this machine.
fn run(folder: &Path, line: &str) -> Option<Output> {
    let output = chart(folder, line).output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    if stderr.contains(" is missing") {
        eprintln!("skipped: {stderr}");
        return None;
    }
    assert!(output.status.success(), "{stderr}");
    Some(output)
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

/// The points of the first panel.
fn points(folder: &Path, name: &str) -> Vec<Value> {
    let panels: Value = serde_json::from_str(&read(folder, name)).unwrap();
    panels[0]["points"].as_array().unwrap().clone()
}

#[test]
fn a_run_that_needs_no_tool_gives_the_same_points_everywhere() {
    let folder = folder();
    let line = "a.scene --cost events --size 16x12 --arith f64,f32 --max-depth 0,3 --converged-samples 4 \
                --min-psnr 20 --csv a.csv --json a.json -o a.svg";
    let text = run(folder.path(), line).unwrap().stdout;
    assert_data_eq!(
        read(folder.path(), "a.csv"),
        str![[r#"
scene,width,height,label,arith,format,tree,max_depth,cut_off,pixels_per_ray,samples,cost_kind,unit,cost,cost_per_pixel,psnr,rmse,psnr_converged,rmse_converged,other_object_share,worst_depth_error,on_frontier,chosen_as,outcome,command
a,16,12,f64 d0,f64,f64,bvh8,0,0.001953125,1,1,events,instructions,194[..].0,101[..],,0.0,22.6[..],18.7[..],0.0,0.0,true,[..],ok,octray render a.scene --arith=f64 --size=16x12 --tree=bvh8 --max-depth=0 --cut-off=1/512 --pixels-per-ray=1 --samples=1 --threads=1
a,16,12,f32 d0,f32,f32,bvh8,0,0.001953125,1,1,events,instructions,19[..].0,10[..],[..],[..],22.6[..],18.7[..],0.0,[..],[..],[..],ok,octray render a.scene --arith=f32 --size=16x12 --tree=bvh8 --max-depth=0 --cut-off=1/512 --pixels-per-ray=1 --samples=1 --threads=1
a,16,12,f64 d3,f64,f64,bvh8,3,0.001953125,1,1,events,instructions,236[..].0,123[..],,0.0,31.6[..],6.6[..],0.0,0.0,true,[..],ok,octray render a.scene --arith=f64 --size=16x12 --tree=bvh8 --max-depth=3 --cut-off=1/512 --pixels-per-ray=1 --samples=1 --threads=1
a,16,12,f32 d3,f32,f32,bvh8,3,0.001953125,1,1,events,instructions,2[..].0,1[..],[..],[..],31.6[..],6.6[..],0.0,[..],[..],[..],ok,octray render a.scene --arith=f32 --size=16x12 --tree=bvh8 --max-depth=3 --cut-off=1/512 --pixels-per-ray=1 --samples=1 --threads=1

"#]]
    );
    assert_data_eq!(
        String::from_utf8(text).unwrap(),
        str![[r#"
a: instructions per frame, estimated from counted events
16 x 12 pixels, bvh8 tree, cut-off 1/512, 1 ray per pixel

| frontier | setting | instructions | PSNR, dB | RMSE, levels | PSNR, converged | RMSE, converged | other object first, % | worst depth error |
|----------|---------|--------------|----------|--------------|-----------------|-----------------|-----------------------|-------------------|
...
| *        | f64 d3  |      236,[..] |    equal |       0.0000 |           31.6[..] |          6.[..] |                 0.000 |             0.0e0 |
...
fastest with at least 20 dB: [..]
    octray render a.scene --arith=[..] --size=16x12 --tree=bvh8 --max-depth=0 --cut-off=1/512 --pixels-per-ray=1 --samples=1 --threads=1
...
"#]]
    );
    let files = ["a.csv", "a.json", "a.svg"];
    let before = files.map(|name| read(folder.path(), name));
    run(folder.path(), line).unwrap();
    assert_eq!(before, files.map(|name| read(folder.path(), name)));
    assert_eq!(points(folder.path(), "a.json").len(), 4);
}

#[test]
fn the_command_of_a_point_renders_its_picture() {
    let folder = folder();
    let line =
        "a.scene --cost events --size 16x12 --arith f64,i16f16 --converged-samples 1 --json a.json";
    run(folder.path(), line).unwrap();
    let pictures: Vec<_> = (points(folder.path(), "a.json").iter())
        .map(|point| {
            let command = point["command"].as_str().unwrap();
            let words = command.strip_prefix("octray ").unwrap();
            let status = Command::new(cargo_bin!("octray"))
                .current_dir(folder.path())
                .args(words.split(' '))
                .args(["--stats=none", "--output=a.ppm"])
                .status();
            assert!(status.unwrap().success(), "{command}");
            octray_render::picture::read(&folder.path().join("a.ppm")).unwrap()
        })
        .collect();
    let difference =
        octray_render::metric::Difference::between(&pictures[0], &pictures[1]).unwrap();
    let point = &points(folder.path(), "a.json")[1];
    assert_eq!(point["psnr"].as_f64(), Some(difference.psnr()));
}

#[test]
fn instructions_of_this_machine_are_the_same_twice_and_differ_by_arithmetic() {
    let folder = folder();
    let line = "a.scene --cost host-instructions --size 16x12 --arith f64,i16f16 --tree packed,none \
                --converged-samples 1 --json";
    let mut counts = Vec::new();
    for name in ["a.json", "b.json"] {
        if run(folder.path(), &format!("{line} {name}")).is_none() {
            return;
        }
        let points = points(folder.path(), name);
        counts.push(
            (points.iter())
                .map(|point| point["cost"].as_f64().unwrap())
                .collect::<Vec<_>>(),
        );
    }
    assert_eq!(counts[0], counts[1]);
    for (i, cost) in counts[0].iter().enumerate() {
        assert!(*cost > 192.0 * 100.0 && !counts[0][i + 1..].contains(cost));
    }
}

#[test]
fn a_board_counts_for_a_chart_what_it_counts_for_measure() {
    let folder = folder();
    let line = "a.scene --cost m3 --size 16x12 --arith i16f16 --pixels-per-ray 1,4 --cut-off 1/512,0.5 \
                --converged-samples 1 --json a.json";
    if run(folder.path(), line).is_none() {
        return;
    }
    let points = points(folder.path(), "a.json");
    // The second differs from the first in the cut-off, the last two in pixels per ray.
    for point in &points[1..3] {
        let command = point["command"].as_str().unwrap();
        let words = command.strip_prefix("octray ").unwrap();
        let output = Command::new(cargo_bin!("octray"))
            .current_dir(folder.path())
            .args(words.split(' '))
            .arg("--json=measured.json")
            .output();
        assert!(output.unwrap().status.success(), "{words}");
        let measured: Value = serde_json::from_str(&read(folder.path(), "measured.json")).unwrap();
        let row = &measured["rows"][0];
        assert_eq!(row["instructions"].as_f64(), point["cost"].as_f64());
        assert_eq!(row["pixels_per_ray"], point["pixels_per_ray"]);
        assert_eq!(row["cut_off"], point["cut_off"]);
        assert_eq!(row["psnr"], point["psnr"]);
    }
    let cost = |i: usize| points[i]["cost"].as_f64().unwrap();
    assert!(cost(1) < cost(0) && cost(3) < cost(2));
    let ratio = cost(2) / cost(0);
    assert!((0.2..0.35).contains(&ratio), "{ratio}");
}

#[test]
fn a_missing_tool_is_reported_with_the_command_that_installs_it() {
    let folder = folder();
    for (cost, expected) in [
        (
            "host-instructions",
            "valgrind is missing, which counts instructions: apt-get install valgrind",
        ),
        (
            "m0",
            "qemu-system-arm is missing: apt-get install qemu-system-arm",
        ),
    ] {
        let line = format!("a.scene --cost {cost} --csv a.csv");
        let output = chart(folder.path(), &line)
            .env("PATH", "")
            .output()
            .unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{stderr}");
        assert!(stderr.contains(expected), "{stderr}");
    }
    assert!(!folder.path().join("a.csv").exists());
}

#[test]
fn what_does_not_fit_is_reported_and_an_empty_chart_is_refused() {
    let folder = TempDir::new().unwrap();
    let large = SCENE.replace("p 4  -5 0 -5  5 0 -5", "p 4  -5000 0 -5  5 0 -5");
    fs::write(
        folder.path().join("a.scene"),
        large.replace("0.8 1.5", "0.8 90"),
    )
    .unwrap();
    let line = "a.scene --cost events --size 16x12 --converged-samples 1";
    let output = run(folder.path(), &format!("{line} --arith f64,i4f28")).unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("no point: i4f28: "), "{text}");
    let nothing = format!("{line} --arith i4f28 -o a.svg");
    let output = chart(folder.path(), &nothing).output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    assert!(stderr.contains("there is no point to draw: "), "{stderr}");
    assert!(!folder.path().join("a.svg").exists());
}

#[test]
fn bad_usage_is_refused() {
    let folder = folder();
    for (line, expected) in [
        (
            "a.scene --cost money",
            "expected one of host-time, host-instructions, events, m0, m3",
        ),
        (
            "a.scene --samples 2 --pixels-per-ray 4",
            "contradict each other",
        ),
        (
            "a.scene --max-depth 0,1,2,3,4,5,6,7 --cut-off 0,1/2,1/3",
            "at most 256",
        ),
        (
            "a.scene --cost m3 --tree tight",
            "m3 has no bvh8 tree: expected compact-bvh8 or none",
        ),
    ] {
        let output = chart(folder.path(), line).output().unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {stderr}");
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
}
