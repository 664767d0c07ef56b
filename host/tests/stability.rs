//! `octray stability` end to end.
#![cfg(feature = "lab")]

use octray_render::picture;
use serde_json::Value;
use snapbox::cmd::{Command, cargo_bin};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn octray(folder: &Path, line: &str) -> Command {
    Command::new(cargo_bin!("octray"))
        .current_dir(folder)
        .args(line.split_whitespace())
}

#[test]
fn writes_tables_data_and_maps_that_do_not_depend_on_the_threads() {
    let line = "stability sphere power --json a.json --csv a.csv -o maps --threads";
    let folders = [1, 3].map(|threads| {
        let folder = TempDir::new().unwrap();
        let ran = octray(folder.path(), &format!("{line} {threads}")).output();
        let output = ran.unwrap();
        assert!(output.status.success() && output.stderr.is_empty());
        fs::write(folder.path().join("stdout"), output.stdout).unwrap();
        folder
    });
    for name in [
        "stdout",
        "a.json",
        "a.csv",
        "maps/sphere.svg",
        "maps/sphere.png",
        "maps/power.svg",
        "maps/power.png",
    ] {
        let [a, b] = [0, 1].map(|i| fs::read(folders[i].path().join(name)).unwrap());
        assert!(a == b, "{name}");
    }
    let folder = folders[0].path();
    let text = fs::read_to_string(folder.join("stdout")).unwrap();
    assert!(text.contains("| i16f16  |"), "{text}");
    let json: Value = serde_json::from_slice(&fs::read(folder.join("a.json")).unwrap()).unwrap();
    let cells = json[0]["cells"].as_array().unwrap();
    let lines = fs::read_to_string(folder.join("a.csv")).unwrap();
    let power = json[1]["cells"].as_array().unwrap();
    assert_eq!(lines.lines().count(), 1 + cells.len() + power.len());
    assert_eq!(cells[0]["state"], "holds");
    let map = picture::read(&folder.join("maps/sphere.png")).unwrap();
    // Light and dark cells: some cases hold, and some break.
    for level in [[244, 246, 243], [8, 69, 148]] {
        assert!(map.levels().contains(&level), "{level:?}");
    }
}

#[test]
fn prints_the_limits_of_some_arithmetics_and_draws_the_queries_of_polygons() {
    let folder = TempDir::new().unwrap();
    let line = "stability power polygon --limits f32,i16f16 -o maps --json a.json";
    let output = octray(folder.path(), line).output().unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    // A heading, its rule, and the forms of both methods.
    assert_eq!(lines.len(), 2 + 2 + 3, "{text}");
    assert!(lines[0].contains("f32 holds to") && lines[0].contains("i16f16 holds to"));
    assert!(lines[4].contains("polygon") && lines[5].contains("thesis"));
    assert!(lines[6].contains("thesis without remedy"));
    // The last value of polygons is infinite, which JSON cannot represent.
    let json: Value =
        serde_json::from_slice(&fs::read(folder.path().join("a.json")).unwrap()).unwrap();
    let cells = json[1]["cells"].as_array().unwrap();
    assert_eq!(cells.last().unwrap()["value"], "inf");
    assert!(cells.iter().all(|cell| !cell["value"].is_null()));
    let queries = picture::read(&folder.path().join("maps/polygon-queries.png")).unwrap();
    // Points that are wrongly inside, and wrongly outside.
    for level in [[230, 85, 13], [8, 69, 148]] {
        assert!(queries.levels().contains(&level), "{level:?}");
    }
}

#[test]
fn an_unknown_method_is_bad_usage() {
    let folder = TempDir::new().unwrap();
    octray(folder.path(), "stability spheroid")
        .assert()
        .code(2)
        .stderr_eq(snapbox::str![[r#"
error: invalid value 'spheroid' for '[METHOD]...'
  [possible values: [..]]

  tip: a similar value exists: 'sphere'

For more information, try '--help'.

"#]]);
}

#[test]
fn a_folder_that_cannot_be_is_reported_before_any_work() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("maps"), "").unwrap();
    octray(folder.path(), "stability power -o maps")
        .assert()
        .code(1)
        .stdout_eq("")
        .stderr_eq("error: cannot write maps: File exists (os error 17)\n");
}
