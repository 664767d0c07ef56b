//! Options of `octray render` that change the picture: lights left out, opaque surfaces, pixels per ray.

mod common;

use common::octray;
use octray_render::metric::Difference;
use octray_render::picture::{self, Picture};
use serde_json::Value;
use snapbox::str;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A mirror, glass and a box under three lights.
const SCENE: &str = "v 0 1 6 at 0 0.5 0 up 0 1 0 angle 40 resolution 30 40
b 0.2 0.3 0.5
l -3 5 4 0.5  l 4 3 2 0.4  l 0 9 0 0.3
f 0.1 0.1 0.1  0.6 0.6 0.5  0 0 0  1 0.2 0
p 4  -5 0 -5  5 0 -5  5 0 5  -5 0 5
f 0 0 0  0.2 0.2 0.2  0.5 0.5 0.5  30 0.6 0
s -0.8 0.6 0 0.6
f 0 0 0  0.1 0.1 0.1  0.5 0.5 0.5  50 0.1 0.8 1.5
s 0.7 0.5 0.8 0.5
box 0.3 0.4 -1 0.8 0.8 0.8
";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    folder
}

/// Returns the picture of the scene with these options, and the statistics.
fn render(folder: &Path, options: &str) -> (Picture, Value) {
    let line = format!("render a.scene -o a.ppm --stats json {options}");
    let output = octray(folder, &line).output().unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{line}: {complaint}");
    let stats = serde_json::from_slice(&output.stdout).unwrap();
    (picture::read(&folder.join("a.ppm")).unwrap(), stats)
}

/// Returns the picture of another scene.
fn rendered(text: &str) -> Picture {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), text).unwrap();
    render(folder.path(), "").0
}

#[test]
fn lights_that_are_left_out_are_as_if_they_were_not_in_the_file() {
    let folder = folder();
    let removed = [
        SCENE.replace("l -3 5 4 0.5  l 4 3 2 0.4  l 0 9 0 0.3", ""),
        SCENE.replace("  l 4 3 2 0.4  l 0 9 0 0.3", ""),
        SCENE.replace("  l 0 9 0 0.3", ""),
        SCENE.into(),
    ];
    for (lights, text) in removed.iter().enumerate() {
        let (few, stats) = render(folder.path(), &format!("--lights {lights}"));
        assert_eq!(few, rendered(text), "{lights} lights");
        assert_eq!(stats["lights"], lights);
        assert_eq!(stats["opaque"], false);
        let shadow = stats["rays"]["shadow"].as_u64().unwrap();
        assert_eq!(shadow == 0, lights == 0);
    }
}

#[test]
fn more_lights_than_there_are_is_bad_usage_that_tells_how_many_there_are() {
    octray(folder().path(), "render a.scene --lights 4")
        .assert()
        .code(2)
        .stdout_eq("")
        .stderr_eq(str![[r#"
error: a.scene: the first 4 lights are asked for, but the scene has 3

For more information, try '--help'.

"#]]);
}

#[test]
fn an_opaque_scene_has_only_rays_of_the_camera_and_to_lights() {
    let folder = folder();
    let (opaque, stats) = render(folder.path(), "--opaque");
    let text = SCENE
        .replace("1 0.2 0\n", "1 0 0\n")
        .replace("30 0.6 0\n", "30 0 0\n")
        .replace("50 0.1 0.8 1.5\n", "50 0 0\n");
    assert_eq!(opaque, rendered(&text));
    assert_eq!(stats["opaque"], true);
    let rays = &stats["rays"];
    assert_eq!(
        (&rays["reflected"], &rays["transmitted"]),
        (&0.into(), &0.into())
    );
    let summary = octray(folder.path(), "render a.scene --opaque --lights 1");
    summary.assert().success().stdout_eq(str![[r#"
scene         a.scene: 2 spheres, 1 box, 1 polygon, 3 surfaces, 1 light, all opaque
...
"#]]);
}

#[test]
fn a_ray_colours_any_square_of_pixels_up_to_eight_by_eight() {
    let folder = folder();
    for side in 1..=8_usize {
        for threads in [1, 2] {
            let options = format!("--pixels-per-ray {} --threads {threads}", side * side);
            let (coarse, stats) = render(folder.path(), &options);
            let rows: Vec<_> = coarse.rows().collect();
            for (y, row) in rows.iter().enumerate() {
                assert_eq!(*row, rows[y - y % side], "{side}");
                for (x, level) in row.iter().enumerate() {
                    assert_eq!(*level, row[x - x % side], "{side}");
                }
            }
            // The whole picture shows something, so that each square has a ray.
            let squares = 40_usize.div_ceil(side) * 30_usize.div_ceil(side);
            let rays = stats["rays"]["primary"].as_u64().unwrap() as usize;
            assert!(
                rays <= squares && 2 * rays > squares,
                "{side}: {rays} of {squares}"
            );
        }
    }
    for wrong in ["2", "81", "0", "nine"] {
        let line = format!("render a.scene --pixels-per-ray {wrong}");
        octray(folder.path(), &line).assert().code(2).stdout_eq("");
    }
    let runs = "render a.scene --pixels-per-ray 9 --tile-rows 15 --tile-columns";
    (octray(folder.path(), &format!("{runs} 24")).assert()).success();
    (octray(folder.path(), &format!("{runs} 16")).assert())
        .code(2)
        .stderr_eq(str![[r#"
error: with --pixels-per-ray 9, --tile-columns 16 is not a multiple of 24

For more information, try '--help'.

"#]]);
    octray(
        folder.path(),
        "render a.scene --pixels-per-ray 9 --tile-rows 16",
    )
    .assert()
    .code(2)
    .stderr_eq(str![[r#"
error: with --pixels-per-ray 9, --tile-rows must be a multiple of 3

For more information, try '--help'.

"#]]);
}

#[test]
fn adaptive_samples_do_not_depend_on_tiles_and_threads() {
    let folder = folder();
    let first = render(folder.path(), "--samples adaptive:3 --threads 1");
    for options in [
        "--threads 2",
        "--threads 3 --tile-rows 1",
        "--threads 2 --tile-rows 7 --tile-columns 8 --schedule work-stealing",
        "--threads 2 --schedule cost-ordered --tree plain",
    ] {
        let (picture, stats) = render(folder.path(), &format!("--samples adaptive:3 {options}"));
        assert_eq!(picture, first.0, "{options}");
        assert_eq!(stats["rays"], first.1["rays"], "{options}");
        if !options.contains("--tree") {
            for counted in ["steps", "tests"] {
                assert_eq!(stats[counted], first.1[counted], "{options}");
            }
        }
    }
}

#[test]
fn adaptive_samples_come_as_near_as_uniform_ones_with_far_fewer_rays() {
    let folder = folder();
    let (converged, _) = render(folder.path(), "--samples 16 --arith f64");
    let primary = |stats: &Value| stats["rays"]["primary"].as_u64().unwrap();
    for (levels, samples) in [(1, 2), (2, 4)] {
        let (uniform, all) = render(folder.path(), &format!("--samples {samples}"));
        let (adaptive, few) = render(folder.path(), &format!("--samples adaptive:{levels}:4"));
        let psnr = |picture| Difference::between(&converged, picture).unwrap().psnr();
        let (ours, theirs) = (psnr(&adaptive), psnr(&uniform));
        assert!(ours > theirs - 0.5, "{levels}: {ours} {theirs}");
        assert!(primary(&few) * 5 < primary(&all) * 4, "{levels}");
    }
}

#[test]
fn where_nothing_differs_adaptive_samples_are_the_corners_of_the_pixels() {
    let text = "v 0 0 10 view parallel resolution 6 8 b 0 0 0 f 1 1 1 0 0 0 0 0 0 1 0 0
        p 4 -9 -9 0 9 -9 0 9 9 0 -9 9 0";
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), text).unwrap();
    let (picture, stats) = render(folder.path(), "--samples adaptive:4");
    assert_eq!(stats["rays"]["primary"], 9 * 7);
    assert!(picture.levels().iter().all(|level| *level == [255; 3]));
    // Three fifths of the third column of pixels are white.
    let edge = text.replace(
        "p 4 -9 -9 0 9 -9 0 9 9 0 -9 9 0",
        "p 4 -1.6 -9 0 9 -9 0 9 9 0 -1.6 9 0",
    );
    fs::write(folder.path().join("a.scene"), edge).unwrap();
    for levels in [1, 3] {
        let (picture, _) = render(folder.path(), &format!("--samples adaptive:{levels}"));
        for row in picture.rows() {
            assert!(
                row[2][0].abs_diff(153) <= 128 >> levels,
                "{levels}: {row:?}"
            );
            assert!(row[..2].iter().all(|level| *level == [0; 3]));
            assert!(row[3..].iter().all(|level| *level == [255; 3]));
        }
    }
}

#[test]
fn wrong_samples_are_bad_usage() {
    let folder = folder();
    for options in [
        "--samples adaptive:0",
        "--samples adaptive:7",
        "--samples adaptive:2:256",
        "--samples adaptive --pixels-per-ray 4",
        "--samples 65",
    ] {
        octray(folder.path(), &format!("render a.scene {options}"))
            .assert()
            .code(2)
            .stdout_eq("");
    }
}
