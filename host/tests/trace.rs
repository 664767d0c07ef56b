//! `octray trace`: the tree of a pixel is that of its picture.

mod common;

use common::octray;
use serde_json::Value;
use snapbox::str;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A glass ball before a mirror wall, one of two lights hidden by a box.
const SCENE: &str = "v 0 0 6 at 0 0 0 up 0 1 0 angle 40 resolution 30 40
b 0.2 0.3 0.5
l -3 5 4 0.5
l 4 0 2 0.4
f 0.1 0.1 0.1  0.6 0.6 0.5  0 0 0  1 0.5 0
p 4  -5 -5 -2  5 -5 -2  5 5 -2  -5 5 -2
f 0 0 0  0.1 0.1 0.1  0.5 0.5 0.5  50 0.1 0.8 1.5
s 0 0 0 1
box 2.5 0 1 0.2 4 4
";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    folder
}

fn done(folder: &Path, line: &str) -> Vec<u8> {
    let output = octray(folder, line).output().unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{line}: {complaint}");
    output.stdout
}

fn json(folder: &Path, line: &str) -> Value {
    let bytes = done(folder, &format!("trace a.scene --format json {line}"));
    serde_json::from_slice(&bytes).unwrap()
}

/// Adds up a ray's kinds, nodes and tests, with those of its lights and of all that follows.
fn add(ray: &Value, sums: &mut [u64; 7]) {
    let kinds = ["primary", "transmitted", "reflected"];
    let kind = kinds.iter().position(|kind| ray["kind"] == *kind).unwrap();
    sums[kind] += 1;
    let mut cost = |value: &Value| {
        sums[3] += value["nodes"].as_u64().unwrap();
        sums[4] += value["tests"].as_u64().unwrap();
    };
    cost(ray);
    for light in ray["lights"].as_array().unwrap() {
        cost(light);
    }
    for light in ray["lights"].as_array().unwrap() {
        sums[5] += 1;
        sums[6] += u64::from(!light["blocked_by"].is_null());
    }
    for ray in ray["rays"].as_array().unwrap() {
        add(ray, sums);
    }
}

/// Adds up the light of a ray and of what follows, weighted.
fn light(ray: &Value) -> f64 {
    let own = ray["weight"].as_f64().unwrap() * ray["light"][0].as_f64().unwrap();
    let rays = ray["rays"].as_array().unwrap().iter();
    own + rays.map(light).sum::<f64>()
}

#[test]
fn every_pixel_has_the_colour_and_the_rays_of_the_picture() {
    let folder = folder();
    for options in [
        "",
        "--samples 2",
        "--pixels-per-ray 9",
        "--arith i16f16 --tree plain",
    ] {
        let line =
            format!("render a.scene -o a.pfm --size 12x9 --stats json --threads 1 {options}");
        let stats: Value = serde_json::from_slice(&done(folder.path(), &line)).unwrap();
        let pfm = fs::read(folder.path().join("a.pfm")).unwrap();
        let floats: Vec<_> = pfm[pfm.len() - 12 * 9 * 12..]
            .as_chunks::<4>()
            .0
            .iter()
            .map(|bytes| f32::from_le_bytes(*bytes))
            .collect();
        let mut sums = [0; 7];
        for y in 0..9 {
            for x in 0..12 {
                let tree = json(folder.path(), &format!("-p {x},{y} --size 12x9 {options}"));
                let trace = &tree["traces"][0];
                for channel in 0..3 {
                    let expected = floats[((8 - y) * 12 + x) * 3 + channel];
                    let found = trace["intensity"][channel].as_f64().unwrap();
                    assert_eq!(found as f32, expected, "{x},{y} {options}");
                }
                for ray in trace["rays"].as_array().unwrap() {
                    add(ray, &mut sums);
                }
                if options.is_empty() {
                    let rays = trace["rays"].as_array().unwrap();
                    let sum: f64 = rays.iter().map(light).sum();
                    let found = trace["intensity"][0].as_f64().unwrap();
                    assert!(
                        (sum.min(1.0) - found).abs() < 1e-6,
                        "{x},{y}: {sum} {found}"
                    );
                }
            }
        }
        let repeats = if options.contains("pixels-per-ray") {
            9
        } else {
            1
        };
        let rays = &stats["rays"];
        let expected = ["primary", "transmitted", "reflected", "shadow", "blocked"]
            .map(|kind| repeats * rays[kind].as_u64().unwrap());
        let found = [sums[0], sums[1], sums[2], sums[5], sums[6]];
        assert_eq!(found, expected, "{options}");
        if options.is_empty() {
            // The lights' last blockers are not known from the pixel before.
            let nodes = stats["steps"].as_u64().unwrap();
            assert!(
                sums[3] >= nodes && sums[3] < 2 * nodes,
                "{} {nodes}",
                sums[3]
            );
        }
    }
}

#[test]
fn the_tree_names_objects_lines_and_what_blocks_a_light() {
    octray(folder().path(), "trace a.scene -p 25,12")
        .assert()
        .success()
        .stderr_eq("")
        .stdout_eq(str![[r#"
a.scene, pixel 25,12 of 40 x 30
f32: colour 83 94 109 (0.3260 0.3688 0.4267)

ray                      meets                        distance  weight  nodes  tests
primary                  sphere 2, line 8               5.4955  1.0000      1      2
├ light 1                lit                                                1      1
├ light 2                blocked by box 3, line 9                           1      1
├ transmitted            sphere 2, line 8               1.6004  0.8000      1      1
│ ├ light 1              blocked by sphere 2, line 8                        1      0
│ ├ light 2              blocked by sphere 2, line 8                        1      0
│ ├ transmitted          polygon 1, line 6              1.5087  0.6400      1      2
│ │ ├ light 1            lit                                                1      1
│ │ ├ light 2            blocked by box 3, line 9                           1      3
│ │ └ reflected          background                             0.3200      1      0
│ └ reflected            sphere 2, line 8               1.6004  0.0800      1      1
│   ├ light 1            blocked by sphere 2, line 8                        0      0
│   ├ light 2            blocked by sphere 2, line 8                        0      0
│   ├ transmitted        background                             0.0640      1      1
│   └ reflected          sphere 2, line 8               1.6004  0.0080      1      1
│     ├ transmitted      box 3, line 9                  2.4371  0.0064      1      1
│     │ ├ light 1        lit                                                1      2
│     │ ├ transmitted    box 3, line 9                  0.2097  0.0051      1      1
│     │ │ ├ light 1      blocked by box 3, line 9                           1      1
│     │ │ ├ transmitted  background                             0.0041      1      1
│     │ │ └ reflected    not traced: its weight 0.0005 is below the cut-off
│     │ └ reflected      not traced: its weight 0.0006 is below the cut-off
│     └ reflected        not traced: its weight 0.0008 is below the cut-off
└ reflected              box 3, line 9                  2.0842  0.1000      1      1
  ├ light 1              lit                                                1      1
  ├ transmitted          box 3, line 9                  0.2190  0.0800      1      1
  │ ├ light 1            blocked by box 3, line 9                           1      1
  │ ├ transmitted        polygon 1, line 6              2.9672  0.0640      1      2
  │ │ ├ light 1          lit                                                1      0
  │ │ ├ light 2          lit                                                1      1
  │ │ └ reflected        background                             0.0320      1      0
  │ └ reflected          box 3, line 9                  0.2190  0.0080      1      1
  │   ├ light 2          blocked by box 3, line 9                           0      0
  │   ├ transmitted      polygon 1, line 6              2.8212  0.0064      1      2
  │   │ ├ light 1        lit                                                1      1
  │   │ ├ light 2        blocked by box 3, line 9                           0      1
  │   │ └ reflected      background                             0.0032      1      0
  │   └ reflected        not traced: its weight 0.0008 is below the cut-off
  └ reflected            polygon 1, line 6              3.1132  0.0100      1      2
    ├ light 1            lit                                                1      0
    ├ light 2            blocked by box 3, line 9                           0      1
    └ reflected          background                             0.0050      1      0

"#]]);
}

#[test]
fn two_arithmetics_stand_beside_each_other() {
    octray(folder().path(), "trace a.scene -p 25,12 --arith f64,i24f8")
        .assert()
        .success()
        .stderr_eq("")
        .stdout_eq(str![[r#"
a.scene, pixel 25,12 of 40 x 30
f64: colour 83 94 109 (0.3260 0.3688 0.4267)
i24f8: colour 84 98 113 (0.3281 0.3828 0.4414)

  ray                      f64                          i24f8
  primary                  sphere 2, line 8 at 5.4955   sphere 2, line 8 at 5.5196
  ├ light 1                lit                          lit
  ├ light 2                blocked by box 3, line 9     blocked by box 3, line 9
  ├ transmitted            sphere 2, line 8 at 1.6004   sphere 2, line 8 at 1.5601
  │ ├ light 1              blocked by sphere 2, line 8  blocked by sphere 2, line 8
  │ ├ light 2              blocked by sphere 2, line 8  blocked by sphere 2, line 8
  │ ├ transmitted          polygon 1, line 6 at 1.5087  polygon 1, line 6 at 1.5632
  │ │ ├ light 1            lit                          lit
  │ │ ├ light 2            blocked by box 3, line 9     blocked by box 3, line 9
  │ │ └ reflected          background                   background
  │ └ reflected            sphere 2, line 8 at 1.6004   sphere 2, line 8 at 1.5694
  │   ├ light 1            blocked by sphere 2, line 8  blocked by sphere 2, line 8
  │   ├ light 2            blocked by sphere 2, line 8  blocked by sphere 2, line 8
  │   ├ transmitted        background                   background
  │   └ reflected          sphere 2, line 8 at 1.6004   sphere 2, line 8 at 1.5695
  │     └ transmitted      box 3, line 9 at 2.4371      box 3, line 9 at 2.4959
  │       ├ light 1        lit                          lit
  │       └ transmitted    box 3, line 9 at 0.2097      box 3, line 9 at 0.2107
  │         ├ light 1      blocked by box 3, line 9     blocked by box 3, line 9
  │         └ transmitted  background                   background
  └ reflected              box 3, line 9 at 2.0842      box 3, line 9 at 2.1678
    ├ light 1              lit                          lit
    ├ transmitted          box 3, line 9 at 0.2190      box 3, line 9 at 0.2226
    │ ├ light 1            blocked by box 3, line 9     blocked by box 3, line 9
    │ ├ transmitted        polygon 1, line 6 at 2.9672  polygon 1, line 6 at 2.3823
    │ │ ├ light 1          lit                          lit
    │ │ ├ light 2          lit                          lit
    │ │ └ reflected        background                   background
    │ └ reflected          box 3, line 9 at 0.2190      box 3, line 9 at 0.2226
    │   ├ light 2          blocked by box 3, line 9     blocked by box 3, line 9
    │   └ transmitted      polygon 1, line 6 at 2.8212  polygon 1, line 6 at 2.2334
    │     ├ light 1        lit                          lit
    │     ├ light 2        blocked by box 3, line 9     blocked by box 3, line 9
    │     └ reflected      background                   background
    └ reflected            polygon 1, line 6 at 3.1132  polygon 1, line 6 at 2.5313
      ├ light 1            lit                          lit
      ├ light 2            blocked by box 3, line 9     blocked by box 3, line 9
      └ reflected          background                   background

the same objects and lights in both

"#]]);
}

#[test]
fn the_drawing_has_a_box_for_each_ray_and_a_circle_for_each_light() {
    let folder = folder();
    done(folder.path(), "trace a.scene -p 25,12 -o a.svg");
    let drawing = fs::read_to_string(folder.path().join("a.svg")).unwrap();
    let mut sums = [0; 7];
    let tree = json(folder.path(), "-p 25,12");
    add(&tree["traces"][0]["rays"][0], &mut sums);
    let count = |part: &str| drawing.matches(part).count() as u64;
    assert_eq!(count("rx=\"4\""), sums[0] + sums[1] + sums[2]);
    assert_eq!(count("<circle"), sums[5]);
    assert_eq!(count("#3d4654"), sums[6]);
    let left_out = left_out(&tree["traces"][0]["rays"][0]);
    assert!(left_out > 0);
    assert_eq!(count("<line"), sums[1] + sums[2] + left_out);
    assert_eq!(count(": not traced</text>"), left_out);
    assert_eq!(count("is below the cut-off</title>"), left_out);
    assert!(drawing.ends_with("</svg>\n"));
}

/// How many rays were not traced.
fn left_out(ray: &Value) -> u64 {
    let rays = ray["rays"].as_array().unwrap();
    ray["not_traced"].as_array().unwrap().len() as u64 + rays.iter().map(left_out).sum::<u64>()
}

#[test]
fn background_has_no_ray_but_a_colour() {
    let folder = folder();
    fs::write(
        folder.path().join("b.scene"),
        "v 0 0 500 b 0 0 1 f 1 1 1 1 0 0 0 0 s 0 0 0 9",
    )
    .unwrap();
    octray(folder.path(), "trace b.scene -p 0,0")
        .assert()
        .success()
        .stdout_eq(str![[r#"
b.scene, pixel 0,0 of 512 x 512
f32: colour 0 0 255 (0.0000 0.0000 1.0000)
no ray is traced: nothing but background is there

"#]]);
}

#[test]
fn wrong_pixels_and_arithmetics_are_bad_usage() {
    let folder = folder();
    octray(folder.path(), "trace a.scene -p 40,3")
        .assert()
        .code(2)
        .stdout_eq("")
        .stderr_eq(str![[r#"
error: pixel 40,3 is outside of the picture, whose last one is 39,29

For more information, try '--help'.

"#]]);
    for line in [
        "trace a.scene",
        "trace a.scene -p 3",
        "trace a.scene -p 1,2 --arith f64,f32,i16f16",
        "trace a.scene -p 1,2 --arith f16",
        "trace a.scene -p 1,2 -o ./a.scene",
        "trace a.scene -p 1,2 --lights 3",
        "trace a.scene -p 1,2 --samples 2 --pixels-per-ray 4",
    ] {
        octray(folder.path(), line).assert().code(2).stdout_eq("");
    }
}

#[test]
fn adaptive_samples_and_negative_numbers_are_refused_with_what_was_expected() {
    let folder = folder();
    for (option, expected) in [
        (
            "--samples adaptive",
            "error: invalid value 'adaptive' for '--samples <K>': expected a number from 1 to 64: adaptive samples are for \
             octray render\n",
        ),
        (
            "--samples -1",
            "error: invalid value '-1' for '--samples <K>': expected a number from 1 to 64\n",
        ),
        (
            "--cut-off -1",
            "error: invalid value '-1' for '--cut-off <C>': expected a weight from 0 to 1, such as 0.01 or 1/512\n",
        ),
        (
            "--lights -1",
            "error: invalid value '-1' for '--lights <N>': [..]\n",
        ),
    ] {
        octray(folder.path(), &format!("trace a.scene -p 1,2 {option}"))
            .assert()
            .code(2)
            .stderr_eq(format!("{expected}\nFor more information, try '--help'.\n"));
    }
}

#[test]
fn an_output_of_no_form_is_bad_usage() {
    let folder = folder();
    octray(folder.path(), "trace a.scene -p 1,1 -o x.png")
        .assert()
        .code(2)
        .stderr_eq(str![[r#"
error: '.png' is no form of the tree: expected '.txt', '.json' or '.svg', or --format

For more information, try '--help'.

"#]]);
    assert!(!folder.path().join("x.png").exists());
}

#[test]
fn a_tree_without_end_is_refused() {
    let folder = folder();
    let hall = "v 0 0 4 at 0 0 0 up 0 1 0 angle 60 resolution 16 16 b 0.2 0.3 0.4
        f 0 0 0 0.1 0.1 0.1 0.1 0.1 0.1 9 1 1 1.3 s 0 0 0 9 s 0 0 0 8.5 s 0 0 0 8 s 1 0 0 1.5";
    fs::write(folder.path().join("hall.scene"), hall).unwrap();
    octray(
        folder.path(),
        "trace hall.scene -p 8,8 --max-depth 64 --cut-off 0",
    )
    .assert()
    .code(1)
    .stderr_eq(str![[r#"
note: the scene has no lights: surfaces show ambient light, and what they mirror and let through
error: more than 50,000 rays colour this pixel: lower --max-depth, or raise --cut-off

"#]]);
}
