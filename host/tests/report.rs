//! `octray report` end to end, with costs that need no tool.
#![cfg(feature = "lab")]

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use octray_render::picture;
use snapbox::cmd::cargo_bin;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The page of two scenes of the same name, in a folder of its own.
fn report(folder: &Path, name: &str) -> String {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    fs::create_dir_all(folder.join("deep")).unwrap();
    for copy in ["a b.scene", "deep/a b.scene"] {
        fs::copy(scenes.join("patches.scene"), folder.join(copy)).unwrap();
    }
    let output = octray(folder, &["report", "a b.scene", "deep/a b.scene"])
        .args(["--arith", "i16f16,f32", "--cost", "events"])
        .args(["--size", "32x24", "--chart-size", "16x12", "-o", name])
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    fs::read_to_string(folder.join(name)).unwrap()
}

fn octray(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(cargo_bin!("octray"));
    command.current_dir(folder).args(arguments);
    command
}

/// Returns the texts between two texts.
fn between<'a>(page: &'a str, before: &'a str, after: &'a str) -> impl Iterator<Item = &'a str> {
    let parts = page.split(before).skip(1);
    parts.filter_map(move |part| Some(part.split_once(after)?.0))
}

/// The commands below the pictures of the first scene.
fn commands(page: &str) -> &str {
    let section = between(page, "id=\"pictures-0\"", "</section>").next();
    between(section.unwrap(), "<code>", "</code>")
        .next()
        .unwrap()
}

#[test]
fn one_page_shows_everything_and_is_the_same_twice() {
    let folder = tempfile::tempdir().unwrap();
    let page = report(folder.path(), "a.html");
    for expected in [
        "<strong>i16f16</strong>",
        "octray chart 'a b.scene' --arith i16f16,f32 --tree compact-bvh8 --cost events --size 16x12 -o 'a b-events.svg'",
        "octray chart 'deep/a b.scene' --arith",
        "Table III",
        "Where methods fail",
        "Holds: at most 0 % wrong decisions",
        "prefers-color-scheme: dark",
    ] {
        assert!(page.contains(expected), "{expected}");
    }
    nothing_comes_from_elsewhere(&page);
    every_part_is_found(&page);
    if cfg!(unix) {
        the_commands_give_the_pictures(&page, folder.path());
        the_command_gives_the_chart(&page, folder.path());
    }
    assert!(page == report(folder.path(), "b.html"));
}

fn nothing_comes_from_elsewhere(page: &str) {
    for foreign in ["<script", "<link", "<iframe", "@import", "url("] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    for source in between(page, "src=\"", "\"") {
        assert!(source.starts_with("data:image/png;base64,"), "{source}");
    }
}

fn every_part_is_found(page: &str) {
    let ids: Vec<_> = between(page, "<section id=\"", "\"").collect();
    let expected = [
        "pictures-0",
        "pictures-1",
        "costs",
        "units",
        "sizes",
        "limits",
    ];
    assert_eq!(ids, expected);
    let links: Vec<_> = between(page, "href=\"", "\"").collect();
    assert_eq!(links, expected.map(|id| format!("#{id}")));
}

/// Runs commands in a shell that finds octray.
fn sh(folder: &Path, commands: &str) {
    let program = cargo_bin!("octray").parent().unwrap().to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let paths = std::iter::once(program).chain(std::env::split_paths(&path));
    let ran = Command::new("sh")
        .current_dir(folder)
        .env("PATH", std::env::join_paths(paths).unwrap())
        .args(["-e", "-c", commands])
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{stderr}\n{commands}");
}

/// Runs the page's commands in a shell; the page shows the pictures that they write, pixel for pixel.
fn the_commands_give_the_pictures(page: &str, folder: &Path) {
    sh(folder, commands(page));
    let shown: Vec<_> = between(page, "src=\"data:image/png;base64,", "\"")
        .map(|data| picture::decode(&mut &*BASE64_STANDARD.decode(data).unwrap()).unwrap())
        .collect();
    for name in ["i16f16", "f32", "i16f16-difference", "f32-difference"] {
        let written = picture::read(&folder.join(format!("a b-{name}.png"))).unwrap();
        assert!(shown.contains(&written), "{name}");
    }
}

/// Runs the first scene's chart command; the page shows the chart that it draws.
fn the_command_gives_the_chart(page: &str, folder: &Path) {
    let section = between(page, "id=\"costs\"", "</section>").next().unwrap();
    let command = (between(section, "<code>", "</code>"))
        .find(|command| command.starts_with("octray chart"))
        .unwrap();
    sh(folder, command);
    let svg = fs::read_to_string(folder.join("a b-events.svg")).unwrap();
    assert!(section.contains(&svg), "{command}");
}

#[test]
fn the_page_reports_a_missing_tool() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let output = octray(folder.path(), &["report"])
        .env("PATH", "")
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
