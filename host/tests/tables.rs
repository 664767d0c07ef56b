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
fn another_file_of_the_thesis_s_numbers_is_compared() {
    let folder = tempfile::tempdir().unwrap();
    let lines = "table,scene,variant,quantity,machine,value,unit,page\n\
                 IV,figure-22,opaque,time,Balance 8000,10,minutes,75\n\
                 IV,figure-22,reflective,time,Balance 8000,30,minutes,75\n\
                 IV,figure-22,reflective,reflected rays,,1,,75\n\
                 IV,figure-22,glassy,reflected rays,,1,,75\n";
    fs::write(folder.path().join("more.csv"), lines).unwrap();
    tables(
        folder.path(),
        "iv --size 32x32 --thesis more.csv --json -o iv.json",
    )
    .assert()
    .success()
    .stdout_eq("");
    let text = fs::read_to_string(folder.path().join("iv.json")).unwrap();
    let tables: serde_json::Value = serde_json::from_str(&text).unwrap();
    let lines = tables[0]["lines"].as_array().unwrap();
    assert_eq!(lines[1]["variant"], "reflective");
    let time = &lines[1]["values"][2];
    assert_eq!(time["thesis"][0]["ratio"], 3.0);
    let ours = time["ratio"].as_f64().unwrap();
    assert_eq!(
        time["thesis"][0]["ours_over_thesis"].as_f64(),
        Some(ours / 3.0)
    );
    // At this size counts are not compared.
    let rays = &lines[1]["values"][0]["thesis"][0];
    assert_eq!(rays["value"], 1.0);
    assert!(rays["ours_over_thesis"].is_null());
    assert_eq!(tables[0]["also"][0]["variant"], "glassy");
}

/// Every count of rays that the thesis has, at its size.
#[test]
fn ray_counts_agree_with_the_thesis() {
    let folder = tempfile::tempdir().unwrap();
    let output = tables(folder.path(), "--json").output().unwrap();
    let tables: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut compared = 0;
    for table in tables.as_array().unwrap() {
        assert_eq!(
            table["also"].as_array().unwrap().len(),
            0,
            "{}",
            table["also"]
        );
        for line in table["lines"].as_array().unwrap() {
            for value in line["values"].as_array().unwrap() {
                let within = match value["quantity"].as_str().unwrap() {
                    "reflected rays" | "speed-up, dynamic" => 0.05,
                    "blocked light tests" => 0.15,
                    "lights" | "pixels" | "primary rays" => 0.0,
                    _ => continue,
                };
                for share in value["thesis"].as_array().unwrap() {
                    let Some(share) = share["ours_over_thesis"].as_f64() else {
                        continue;
                    };
                    // Where the thesis contradicts itself.
                    let odd = table["table"] == "IX" && line["scene"] == "figure-20";
                    let agrees = (share - 1.0).abs() <= within;
                    assert!(agrees || odd, "{} {line}", table["table"]);
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 54);
}

#[test]
fn conditions_and_agreement_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    tables(folder.path(), "III VII IX --size 64x64")
        .assert()
        .success()
        .stdout_eq(file!["tables/III-VII-IX.txt"].raw());
}

#[test]
fn a_page_holds_each_table_with_its_remarks_its_chart_and_its_command() {
    let folder = tempfile::tempdir().unwrap();
    let line = "I II III IV V VI VII VIII IX --size 32x32 --contention 0.01";
    tables(folder.path(), &format!("{line} -o tables.html"))
        .assert()
        .success()
        .stdout_eq("");
    let page = fs::read_to_string(folder.path().join("tables.html")).unwrap();
    let text = tables(folder.path(), line).output().unwrap().stdout;
    let text = String::from_utf8(text).unwrap();
    let escaped = |text: &str| {
        (text.replace('&', "&amp;").replace('"', "&quot;"))
            .replace('<', "&lt;")
            .replace('>', "&gt;")
    };
    let sections: Vec<&str> = page.split("<section ").skip(1).collect();
    let printed: Vec<&str> = text.split("Table ").skip(1).collect();
    assert_eq!((sections.len(), printed.len()), (9, 9));
    for (section, printed) in sections.into_iter().zip(printed) {
        let title = printed.lines().next().unwrap();
        assert!(
            section.contains(&format!("<h2>Table {}</h2>", escaped(title))),
            "{title}"
        );
        // Every cell and every remark that is printed.
        let lines = printed.lines().filter(|line| !line.starts_with("|--"));
        for line in lines.skip(1).filter(|line| !line.is_empty()) {
            let words: Vec<&str> = match line.strip_prefix("- ") {
                Some(remark) => vec![remark],
                None => line.trim_matches('|').split('|').map(str::trim).collect(),
            };
            for word in words {
                assert!(
                    section.contains(&format!(">{}<", escaped(word))),
                    "{title}: {word}"
                );
            }
        }
        let name = title.split_once(':').unwrap().0;
        let simulated = matches!(name, "VIII" | "IX");
        assert_eq!(section.contains("<svg"), simulated, "{title}");
        let more = match simulated {
            true => " --contention 0.01 --charts charts",
            false => "",
        };
        let command = format!("<code>octray tables {name} --size 32x32{more}</code>");
        assert!(section.contains(&command), "{title}: {command}");
    }
    assert!(!page.contains("http-equiv") && !page.contains("<script") && !page.contains("<link"));
    tables(folder.path(), "I --json -o tables.html")
        .assert()
        .code(2)
        .stderr_eq(str![[r#"
error: a page is no JSON: name another file, or leave out --json

For more information, try '--help'.

"#]]);
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
    for (name, title, scenes) in [
        ("figure-24", "Figure 24: time against H", &[20, 22][..]),
        (
            "figure-25",
            "Figure 25: speed-up rises, peaks and falls",
            &[19, 20, 21, 22, 23],
        ),
    ] {
        let path = folder.path().join("charts").join(name);
        let svg = fs::read_to_string(path.with_extension("svg")).unwrap();
        for text in [title, "static", "dynamic"] {
            assert!(svg.contains(text), "{name}: {text}");
        }
        // A panel per scene, and in each a curve per policy at least.
        for scene in scenes {
            assert!(svg.contains(&format!("figure-{scene}")), "{name}: {scene}");
        }
        assert!(
            svg.matches("<polyline").count() >= 2 * scenes.len(),
            "{name}"
        );
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
            "error: wrong.csv is no record of `octray measure --csv` for table III: [..]\n",
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
