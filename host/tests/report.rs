//! `octray report` end to end, with costs that need no tool.

use snapbox::cmd::cargo_bin;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn report(folder: &Path, line: &str) -> Output {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    fs::copy(scenes.join("patches.scene"), folder.join("a b.scene")).unwrap();
    Command::new(cargo_bin!("octray"))
        .current_dir(folder)
        .args(["report", "a b.scene"])
        .args(line.split_whitespace())
        .output()
        .unwrap()
}

#[test]
fn one_page_shows_everything_and_is_the_same_twice() {
    let folder = tempfile::tempdir().unwrap();
    let page = |name: &str| {
        let line =
            format!("--arith f64,i16f16 --cost events --size 32x24 --chart-size 16x12 -o {name}");
        let output = report(folder.path(), &line);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{told}");
        fs::read_to_string(folder.path().join(name)).unwrap()
    };
    let first = page("a.html");
    for expected in [
        "data:image/png;base64,",
        "<strong>i16f16</strong>",
        "equal to f64",
        "octray render &apos;a b.scene&apos;",
        "octray chart 'a b.scene'",
        "Table III",
        "Where methods fail",
        "prefers-color-scheme: dark",
    ] {
        let expected = expected.replace("&apos;", "'");
        assert!(first.contains(&expected), "{expected}");
    }
    for foreign in ["<script", "src=\"http", "href=\"http"] {
        assert!(!first.contains(foreign), "{foreign}");
    }
    assert!(first == page("b.html"));
}

#[test]
fn a_tool_that_is_missing_is_told_in_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let output = Command::new(cargo_bin!("octray"))
        .env("PATH", "")
        .arg("report")
        .arg(scenes.join("patches.scene"))
        .args(["--arith", "f32", "--cost", "m3", "--size", "16x12", "-o"])
        .arg(folder.path().join("a.html"))
        .output()
        .unwrap();
    assert!(output.status.success());
    let page = fs::read_to_string(folder.path().join("a.html")).unwrap();
    assert!(page.contains("Not measured: "), "no reason");
    assert!(page.contains("apt-get install qemu-system-arm"));
}
