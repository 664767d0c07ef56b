//! `octray convert`: pictures go through all formats, files and pipes.

mod common;

use common::octray;
use octray_render::picture::{self, Picture};
use snapbox::str;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const SCENE: &str = "v 0 1 6 at 0 0.5 0 up 0 1 0 angle 40 resolution 12 17
b 0.2 0.3 0.5  l -3 5 4 0.5  f 0.1 0.1 0.1  0.6 0.6 0.5  0 0 0  1 0.2 0  s 0 0.6 0 1.3";

/// A folder with a rendered picture in every format.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    for name in ["a.png", "a.ppm", "a.pfm", "a.int"] {
        done(
            folder.path(),
            &format!("render a.scene --stats none -o {name}"),
        );
    }
    done(
        folder.path(),
        "render a.scene --stats none -o a.ras --ras-depth 24",
    );
    folder
}

fn done(folder: &Path, line: &str) -> Vec<u8> {
    let output = octray(folder, line).output().unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && complaint.is_empty(),
        "{line}: {complaint}"
    );
    output.stdout
}

fn read(folder: &Path, name: &str) -> Picture {
    picture::read(&folder.join(name)).unwrap()
}

#[test]
fn every_format_is_converted_to_every_other_with_all_it_can_hold() {
    let folder = folder();
    let folder = folder.path();
    for from in ["png", "ppm", "pfm", "ras", "int"] {
        let before = read(folder, &format!("a.{from}"));
        for to in [
            "png",
            "ppm",
            "pfm",
            "ras --depth 24",
            "ras --depth 32",
            "int",
        ] {
            done(folder, &format!("convert a.{from} b.{to}"));
            let name = format!("b.{}", &to[..3]);
            let after = read(folder, &name);
            assert_eq!(after.levels(), before.levels(), "{from} to {to}");
            if matches!((from, to), ("pfm" | "int", "pfm" | "int")) {
                assert_eq!(after.intensities(), before.intensities());
                // Rendered and converted files are the same to the byte.
                let rendered = fs::read(folder.join(format!("a.{to}"))).unwrap();
                assert_eq!(fs::read(folder.join(&name)).unwrap(), rendered);
            }
        }
    }
    assert!(read(folder, "a.int").intensities().is_some());
}

#[test]
fn a_rendered_intensity_file_has_a_line_for_every_pixel() {
    let folder = folder();
    let text = fs::read_to_string(folder.path().join("a.int")).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("intensity 17 12"));
    let places = (0..12).flat_map(|y| (0..17).map(move |x| format!("{x} {y} ")));
    assert!(
        lines
            .clone()
            .zip(places)
            .all(|(line, place)| line.starts_with(&place))
    );
    assert_eq!(lines.count(), 12 * 17);
}

#[test]
fn one_bit_is_dithered_either_way() {
    let folder = folder();
    let folder = folder.path();
    for (options, other) in [
        ("", "--dither ordered"),
        ("--dither diffusion", "--dither ordered"),
    ] {
        done(
            folder,
            &format!("convert a.png one.ras --depth 1 {options}"),
        );
        done(folder, &format!("convert a.png two.ras --depth 1 {other}"));
        let (one, two) = (read(folder, "one.ras"), read(folder, "two.ras"));
        assert_ne!(one, two);
        for picture in [one, two] {
            let levels = picture.levels().iter();
            assert!(
                levels
                    .clone()
                    .all(|level| [[0; 3], [255; 3]].contains(level))
            );
        }
        // Eight words, and 12 rows of 17 bits in 4 bytes.
        assert_eq!(
            fs::metadata(folder.join("one.ras")).unwrap().len(),
            32 + 12 * 4
        );
    }
}

#[test]
fn pictures_go_through_pipes() {
    let folder = folder();
    let input = fs::read(folder.path().join("a.pfm")).unwrap();
    let piped = |options: &str| {
        let line = format!("convert - - {options}");
        let output = octray(folder.path(), &line)
            .stdin(input.clone())
            .output()
            .unwrap();
        assert!(output.status.success());
        output.stdout
    };
    assert!(piped("").starts_with(b"\x89PNG"));
    let ppm = fs::read(folder.path().join("a.ppm")).unwrap();
    assert_eq!(piped("--format ppm"), ppm);
    assert_eq!(piped("--format pfm"), input);
    done(folder.path(), "convert a.png picture --format ppm");
    assert_eq!(fs::read(folder.path().join("picture")).unwrap(), ppm);
}

#[test]
fn wrong_use_and_damaged_pictures_are_told() {
    let folder = folder();
    let told = |line: &str, code: i32, message: &str| {
        octray(folder.path(), line)
            .assert()
            .code(code)
            .stdout_eq("")
            .stderr_eq(message);
    };
    let usage = "\n\nFor more information, try '--help'.\n";
    told(
        "convert a.png b.ppm --depth 8",
        2,
        &format!("error: --depth is for Sun rasterfiles (.ras){usage}"),
    );
    told(
        "convert a.png b.ras --dither ordered",
        2,
        &format!("error: --dither is for Sun rasterfiles of --depth 1{usage}"),
    );
    told(
        "convert a.png b",
        2,
        &format!(
            "error: a picture's name ends in one of .png, .apng, .ppm, .pfm, .ras, .int{usage}"
        ),
    );
    told(
        "convert a.png ./a.png",
        2,
        &format!(
            "error: the result ./a.png would replace a.png, which is read: name another file{usage}"
        ),
    );
    fs::write(
        folder.path().join("bad.int"),
        "intensity 2 1\n0 0 1 1 1\n1 0 1 red 1\n",
    )
    .unwrap();
    octray(folder.path(), "convert bad.int b.png")
        .assert()
        .code(1)
        .stderr_eq(str![[r#"
error: cannot read bad.int: line 3: expected '1 0 RED GREEN BLUE', found '1 0 1 red 1'

"#]]);
    told(
        "convert missing.png b.png",
        1,
        "error: cannot read missing.png: No such file or directory (os error 2)\n",
    );
    assert!(!folder.path().join("b.png").exists());
}

#[test]
fn that_only_the_first_picture_of_an_animation_is_converted_is_told() {
    let folder = folder();
    let folder = folder.path();
    done(
        folder,
        "render a.scene --stats none --frames 3 --orbit 90 -o a.apng",
    );
    octray(folder, "convert a.apng b.ppm")
        .assert()
        .success()
        .stderr_eq("note: a.apng is an animation: this is the first of its 3 pictures\n");
    assert_eq!(read(folder, "b.ppm"), read(folder, "a.ppm"));
    octray(folder, "diff a.ppm a.apng")
        .assert()
        .success()
        .stderr_eq("note: a.apng is an animation: this is the first of its 3 pictures\n");
}

#[test]
fn a_pixel_that_is_no_number_is_refused_with_its_place() {
    let folder = TempDir::new().unwrap();
    let folder = folder.path();
    let mut bytes = b"PF\n2 3\n-1.0\n".to_vec();
    let numbers = (0..18).map(|i| if i == 10 { f32::NAN } else { 0.5 });
    bytes.extend(numbers.flat_map(f32::to_le_bytes));
    fs::write(folder.join("a.pfm"), bytes).unwrap();
    // The bottom row comes first: it is the fourth pixel, on the right of the middle row.
    octray(folder, "convert a.pfm b.png")
        .assert()
        .code(1)
        .stderr_eq("error: cannot read a.pfm: the pixel in column 1, row 1 (from 0) is not a number (NaN)\n");
    fs::write(folder.join("a.int"), "intensity 1 1\n0 0 0.5 nan 1\n").unwrap();
    octray(folder, "convert a.int b.png")
        .assert()
        .code(1)
        .stderr_eq("error: cannot read a.int: line 2: expected '0 0 RED GREEN BLUE', found '0 0 0.5 nan 1'\n");
    assert!(!folder.join("b.png").exists());
}
