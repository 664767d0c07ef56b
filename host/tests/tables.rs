//! `octray tables` end to end: what it prints, what it writes, and its exit codes.
#![cfg(feature = "lab")]

use snapbox::cmd::{Command, cargo_bin};
use snapbox::{assert_data_eq, file, str};
use std::fs;
use std::path::Path;

fn tables(folder: &Path, line: &str) -> Command {
    Command::new(cargo_bin!("octray"))
        .current_dir(folder)
        .arg("tables")
        .args(line.split_whitespace())
}

#[test]
fn tables_are_the_same_in_every_run() {
    let folder = tempfile::tempdir().unwrap();
    tables(folder.path(), "I VI VIII --size 64x64")
        .assert()
        .success()
        .stderr_eq("")
        .stdout_eq(file!["tables/I-VI-VIII.txt"].raw());
}

#[test]
fn an_unknown_table_is_refused_with_a_list_of_names() {
    let folder = tempfile::tempdir().unwrap();
    tables(folder.path(), "X")
        .assert()
        .code(2)
        .stdout_eq("")
        .stderr_eq(str![[r#"
error: invalid value 'X' for '[TABLE]...'
  [possible values: I, II, III, IV, V, VI, VII, VIII, IX]

For more information, try '--help'.

"#]]);
}

#[test]
fn a_file_with_more_numbers_of_the_thesis_is_compared() {
    let folder = tempfile::tempdir().unwrap();
    let lines = "table,scene,variant,quantity,machine,value,unit,page\n\
                 V,figure-21,5,time,Balance 8000,30,minutes,75\n\
                 V,figure-21,1,time,Balance 8000,10,minutes,75\n\
                 V,figure-21,5,reflected rays,,1,,75\n";
    fs::write(folder.path().join("more.csv"), lines).unwrap();
    tables(
        folder.path(),
        "v --size 32x32 --thesis more.csv --json -o v.json",
    )
    .assert()
    .success()
    .stdout_eq("");
    let text = fs::read_to_string(folder.path().join("v.json")).unwrap();
    let tables: serde_json::Value = serde_json::from_str(&text).unwrap();
    let lines = tables[0]["lines"].as_array().unwrap();
    let line = |variant: &str| {
        let here =
            |line: &&serde_json::Value| line["scene"] == "figure-21" && line["variant"] == variant;
        &lines.iter().find(here).unwrap()["values"]
    };
    let time = &line("5")[2];
    assert_eq!(time["thesis"][0]["ratio"], 3.0);
    let ours = time["ratio"].as_f64().unwrap();
    assert_eq!(
        time["thesis"][0]["ours_over_thesis"].as_f64(),
        Some(ours / 3.0)
    );
    let rays = &line("5")[0];
    assert_eq!(rays["thesis"][0]["ours_over_thesis"], rays["ours"]);
    let note = tables[0]["notes"].as_array().unwrap().last().unwrap();
    assert_eq!(
        note,
        "reflected rays: 0 of 1 are within 5 % of the thesis's."
    );
}

/// Numbers of the thesis as a user might fill them in; they are made up.
const MORE: &str = "\
table,scene,variant,quantity,machine,value,unit,page
II,figure-19,10,time,Balance 8000,61.5,minutes,70
II,figure-19,2,reflected rays,,2050,,70
II,figure-20,10,time,Balance 8000,200,minutes,70
II,figure-20,10,blocked light tests,,2000,,70
VII,figure-21,4,time,,0.26,ratio,
VII,,4,time,,0.27,ratio,
";

#[test]
fn known_numbers_of_the_thesis_stand_beside_ours() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("more.csv"), MORE).unwrap();
    tables(folder.path(), "II VII --size 64x64 --thesis more.csv")
        .assert()
        .success()
        .stdout_eq(file!["tables/II-VII-thesis.txt"].raw());
}

/// Returns the first text between two texts.
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    let rest = text.split_once(before).unwrap().1;
    rest.split_once(after).unwrap().0
}

#[test]
fn charts_are_drawn_with_their_tables() {
    let folder = tempfile::tempdir().unwrap();
    let quick = "--size 32x32 --charts charts";
    tables(folder.path(), &format!("VIII IX {quick}"))
        .assert()
        .success();
    for (name, title) in [
        ("figure-24", "Figure 24: time against H"),
        ("figure-25", "Figure 25: speed-up against processors"),
    ] {
        let path = folder.path().join("charts").join(name);
        let svg = fs::read_to_string(path.with_extension("svg")).unwrap();
        for text in [title, "static", "dynamic"] {
            assert!(svg.contains(text), "{name}: {text}");
        }
        // A panel per scene, and in each a curve per policy at least.
        for scene in 19..=23 {
            assert!(svg.contains(&format!("figure-{scene}")), "{name}: {scene}");
        }
        assert!(svg.matches("<polyline").count() >= 2 * 5, "{name}");
        let sides =
            |name: &str| -> u32 { between(&svg, &format!("{name}=\""), "\"").parse().unwrap() };
        let picture = octray_render::picture::read(&path.with_extension("png")).unwrap();
        assert_eq!(picture.size(), (sides("width"), sides("height")), "{name}");
    }
    tables(folder.path(), &format!("I {quick}"))
        .assert()
        .code(2)
        .stderr_eq(str![[r#"
error: --charts draws figure 24 with table VIII and figure 25 with table IX: name one of them

For more information, try '--help'.

"#]]);
}

#[test]
fn mistakes_in_files_are_reported_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = "table,scene,variant,quantity,machine,value,unit,page\nI,flat,plain,x,,many,,\n";
    fs::write(folder.path().join("wrong.csv"), wrong).unwrap();
    for (line, expected) in [
        (
            "I --thesis wrong.csv -o a.txt",
            "error: wrong.csv: [..]invalid float literal\n",
        ),
        (
            "III --record wrong.csv -o a.txt",
            "error: wrong.csv is no record of `octray measure --csv`: [..]\n",
        ),
        (
            "III --record none.csv -o a.txt",
            "error: cannot read none.csv: [..]\n",
        ),
        (
            "III -o none/a.txt",
            "error: cannot write none/a.txt: [..]\n",
        ),
    ] {
        let output = tables(folder.path(), line).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{line}");
        assert_data_eq!(
            String::from_utf8_lossy(&output.stderr).into_owned(),
            expected
        );
        assert!(!folder.path().join("a.txt").exists(), "{line}");
    }
}
