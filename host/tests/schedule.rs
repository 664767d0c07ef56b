//! `octray schedule` end to end.
#![cfg(feature = "lab")]

mod common;

use common::octray;
use snapbox::str;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A ball in the upper half of the picture, under a light.
const SCENE: &str = "v 0 0 -9 resolution 64 64 l 0 99 -99 1\n\
    f 1 1 1 0 0 0 0 0 0 0 0.5 0\ns 0 16 5 12\n";

#[test]
fn the_best_tiles_are_printed_for_each_number_of_processors() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    octray(
        folder.path(),
        "schedule a.scene --processors 1,2 --tile-rows 1..4 --tiles 4 --policy static,dynamic",
    )
    .assert()
    .success()
    .stdout_eq(str![[r#"
| processors | tiles  |              static |             dynamic |
|------------|--------|---------------------|---------------------|
| 1          | strips |        1.00 (1 row) |        1.00 (1 row) |
| 1          | tiles  | 1.00 (4 x 4 pixels) | 1.00 (4 x 4 pixels) |
| 2          | strips |        1.94 (1 row) |        1.97 (1 row) |
| 2          | tiles  | 2.00 (4 x 4 pixels) | 2.00 (4 x 4 pixels) |
worth it: 2 processors, 2.00 times as fast as one ([..], 4 x 4 pixels); more were not tried

"#]]);
}

#[test]
fn how_many_processors_are_worth_it_is_answered() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    let line = "schedule a.scene --processors 1..64 --tile-rows 1 --tiles 4 --coherence 0.001";
    let output = octray(folder.path(), line).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let answer: Vec<&str> = text.lines().rev().take(2).collect();
    // n / (1 + 0.001 n (n - 1)): from 16 to 32 processors it grows by 3.0, and then it falls.
    assert!(
        answer[1].starts_with("worth it: 16 processors, 12."),
        "{text}"
    );
    assert!(
        answer[0].starts_with("fastest:  32 processors, 1"),
        "{text}"
    );
    let object = octray(folder.path(), &format!("{line} --json"))
        .output()
        .unwrap();
    let object: serde_json::Value = serde_json::from_slice(&object.stdout).unwrap();
    assert_eq!(object["worth"]["processors"], 16);
    assert_eq!(object["peak"]["processors"], 32);
}

#[test]
fn every_combination_is_in_the_json_object() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    let line = "schedule a.scene --processors 1..4 --tile-rows 2,8 --tiles 8 --json";
    let output = octray(folder.path(), line).output().unwrap();
    let object: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let runs = object["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 3 * 3 * 6);
    for run in runs {
        let speed_up = run["speed_up"].as_f64().unwrap();
        let processors = run["processors"].as_f64().unwrap();
        assert!(speed_up > 0.99 && speed_up < processors * 1.001, "{run}");
    }
}

#[test]
fn an_unknown_format_of_charts_is_told_with_the_known_ones() {
    let folder = TempDir::new().unwrap();
    for (name, message) in [
        (
            "x.jpg",
            "'.jpg' is no format of charts; expected one of .svg, .png, .ppm, .ras",
        ),
        (
            "x.pfm",
            "'.pfm' is no format of charts; expected one of .svg, .png, .ppm, .ras",
        ),
        ("x", "a chart's name ends in one of .svg, .png, .ppm, .ras"),
    ] {
        octray(folder.path(), &format!("schedule a.scene -o {name}"))
            .assert()
            .code(2)
            .stderr_eq(format!(
                "error: {message}\n\nFor more information, try '--help'.\n"
            ));
    }
}

#[test]
fn wrong_values_are_bad_usage() {
    for flags in [
        "--processors 0",
        "--tile-rows 4..1",
        "--policy luck",
        "--contention -1",
    ] {
        octray(Path::new("."), &format!("schedule a.scene {flags}"))
            .assert()
            .code(2);
    }
}
