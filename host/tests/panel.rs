//! The panel simulator end to end: what it draws, what it writes, and its exit codes.
#![cfg(feature = "lab")]

use clap::Parser;
use octray::cli::{Cli, Command as Subcommand};
use octray_render::interrupt::Interrupt;
use octray_render::picture::{self, Picture};
use octray_render::tile::Level;
use snapbox::cmd::{Command, cargo_bin};
use snapbox::str;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn scene(name: &str) -> PathBuf {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    scenes.join(format!("{name}.scene"))
}

fn panel(folder: &Path, line: &str) -> Command {
    Command::new(cargo_bin!("octray"))
        .arg("panel")
        .current_dir(folder)
        .args(line.split_whitespace())
}

/// The panel's picture of figure 22.
fn drawn(line: &str) -> Picture {
    let folder = TempDir::new().unwrap();
    let run = panel(folder.path(), line).arg(scene("figure-22"));
    run.assert().success().stderr_eq("");
    picture::read(&folder.path().join("figure-22-panel.png")).unwrap()
}

/// The same scene rendered by `octray render`.
fn rendered(line: &str) -> Picture {
    let folder = TempDir::new().unwrap();
    let output = folder.path().join("a.png");
    let (scene, output) = (scene("figure-22"), output.to_str().unwrap());
    let line = format!("octray render --stats none {line} -o {output}");
    let words = line.split_whitespace().chain(scene.to_str());
    let Subcommand::Render(args) = Cli::parse_from(words).command else {
        unreachable!()
    };
    octray::render::run(
        &args.job().unwrap(),
        &Interrupt::new(),
        octray::render::trace,
    )
    .unwrap();
    picture::read(Path::new(output)).unwrap()
}

fn differences(a: &Picture, b: &Picture) -> impl Iterator<Item = [u8; 3]> {
    assert_eq!(a.size(), b.size());
    let pixels = a.levels().iter().zip(b.levels());
    pixels.map(|(a, b): (&Level, &Level)| [0, 1, 2].map(|i| a[i].abs_diff(b[i])))
}

#[test]
fn a_panel_of_full_colours_shows_what_octray_renders() {
    for (arith, size) in [("auto", "64x48"), ("f32", "33x21"), ("i16f16", "7x1")] {
        let panel = drawn(&format!(
            "--color rgb888 --no-overlay --arith {arith} --panel {size}"
        ));
        assert!(panel == rendered(&format!("--arith {arith} --size {size}")));
    }
}

#[test]
fn dithered_565_is_off_by_less_than_a_step_and_right_on_average() {
    let truth = rendered("--arith auto --size 64x48");
    let steps = [255_f64 / 31.0, 255.0 / 63.0, 255.0 / 31.0];
    for options in ["", "--no-dither"] {
        let shown = drawn(&format!("--no-overlay --panel 64x48 {options}"));
        // Plus the step's own rounding to 8 bits.
        let bound = |i: usize| if options.is_empty() { steps[i] } else { steps[i] / 2.0 } + 1.0;
        assert!(differences(&shown, &truth).all(|d| (0..3).all(|i| f64::from(d[i]) < bound(i))));
    }
    let dithered = drawn("--no-overlay --panel 64x48");
    let mean = |picture: &Picture| {
        let levels = picture.levels().as_flattened();
        levels.iter().map(|x| f64::from(*x)).sum::<f64>() / levels.len() as f64
    };
    assert!((mean(&dithered) - mean(&truth)).abs() < 1.0);
}

#[test]
fn a_bw_panel_has_two_colours_and_a_grey_one_only_greys() {
    let colours = |color| {
        let picture = drawn(&format!("--panel 64x48 --color {color}"));
        picture.levels().iter().copied().collect::<BTreeSet<_>>()
    };
    assert_eq!(colours("bw"), BTreeSet::from([[0; 3], [255; 3]]));
    assert!(colours("gray8").iter().all(|[r, g, b]| r == g && g == b));
}

#[test]
fn the_overlay_covers_only_the_bottom() {
    let (with, without) = (drawn("--panel 64x48"), drawn("--panel 64x48 --no-overlay"));
    let above = 64 * 36;
    assert_eq!(with.levels()[..above], without.levels()[..above]);
    let line: BTreeSet<_> = with.levels()[above..].iter().copied().collect();
    assert_eq!(line, BTreeSet::from([[0; 3], [255; 3]]));
}

#[test]
fn a_scaled_picture_repeats_pixels() {
    let (plain, scaled) = (
        drawn("--panel 8x6 --no-overlay"),
        drawn("--panel 8x6 --no-overlay --scale 3"),
    );
    assert_eq!(scaled.size(), (24, 18));
    for (i, level) in scaled.levels().iter().enumerate() {
        let (x, y) = (i % 24 / 3, i / 24 / 3);
        assert_eq!(*level, plain.levels()[8 * y + x]);
    }
}

#[test]
fn frames_show_the_picture_growing_by_a_strip() {
    let folder = TempDir::new().unwrap();
    panel(folder.path(), "--panel 16x10 --frames frames -o a.ppm")
        .arg(scene("figure-22"))
        .assert()
        .success();
    let frame = |number: u32| {
        let name = format!("frames/frame-{number:04}.png");
        picture::read(&folder.path().join(name)).unwrap()
    };
    // Three strips of at most four rows, and the overlay.
    let frames: Vec<_> = (1..=4).map(frame).collect();
    assert_eq!(
        fs::read_dir(folder.path().join("frames")).unwrap().count(),
        4
    );
    for (strips, frame) in (1..=3).zip(&frames) {
        let drawn = (strips * 4).min(10) * 16;
        assert_eq!(frame.levels()[..drawn], frames[2].levels()[..drawn]);
        assert!(frame.levels()[drawn..].iter().all(|level| *level == [0; 3]));
    }
    assert!(frames[3] == picture::read(&folder.path().join("a.ppm")).unwrap());
}

#[test]
fn the_output_has_the_numbers_of_the_overlay() {
    let folder = TempDir::new().unwrap();
    panel(folder.path(), "--panel 16x12 --arith i8f24 -o a.png")
        .arg(scene("figure-22"))
        .assert()
        .success()
        .stdout_eq("a.png: i8f24  [..] rays  [..] ms\n");
}

#[test]
fn mistakes_are_reported_and_nothing_is_written() {
    let folder = TempDir::new().unwrap();
    let fails = |line, code| panel(folder.path(), line).assert().code(code).stdout_eq("");
    fails("missing.scene", 1).stderr_eq(str![[r#"
error: missing.scene: no such file

"#]]);
    fails("a.scene --panel 320", 2).stderr_eq(str![[r#"
error: invalid value '320' for '--panel <WxH>': expected WIDTHxHEIGHT such as 640x480, each from 1 to 65535

For more information, try '--help'.

"#]]);
    fails("a.scene --panel 9999x9999", 2).stderr_eq(str![[r#"
error: a panel of 9999x9999 at --scale 1 is too large: expected at most 67108864 pixels

For more information, try '--help'.

"#]]);
    fails("a.ppm -o ./a.ppm", 2).stderr_eq(str![[r#"
error: the result ./a.ppm would replace a.ppm, which is read: name another file

For more information, try '--help'.

"#]]);
    fails("a.scene --color cmyk", 2).stderr_eq(str![[r#"
error: invalid value 'cmyk' for '--color <KIND>'
  [possible values: rgb565, rgb888, gray8, bw]

For more information, try '--help'.

"#]]);
    fails("a.scene -o missing/a.png", 1).stderr_eq(str![[r#"
error: cannot write missing/a.png: No such file or directory (os error 2)

"#]]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
