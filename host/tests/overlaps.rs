//! `octray overlaps` and `octray trace --through`: what is in the way of what.

mod common;

use common::octray;
use snapbox::str;
use std::fs;
use tempfile::TempDir;

/// A ball in a box, a pole through it, all on a floor.
const SCENE: &str = "v 0 1 9 at 0 1 0 up 0 1 0 angle 40 resolution 30 40
f 0.5 0.4 0.3  0 0 0  0 0 0  1 0.5 0.5 1.5
box 0 1 0 2 2 2
s 0 1 0 0.5
c -3 1 0 0.2  3 1 0 0.2
p 4  -9 0 -9  9 0 -9  9 0 9  -9 0 9
";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    folder
}

#[test]
fn pairs_are_named_by_kind_number_and_line() {
    let folder = folder();
    octray(folder.path(), "overlaps a.scene")
        .assert()
        .success()
        .stdout_eq(str![[r#"
box 1, line 3  crosses  cone 3, line 5
sphere 2, line 4  is inside  box 1, line 3
sphere 2, line 4  crosses  cone 3, line 5
4 objects: 2 pairs cross, 1 is inside another

"#]]);
    octray(folder.path(), "overlaps a.scene --json")
        .assert()
        .success()
        .stdout_eq(str![[r#"
[{"object":{"kind":"box","number":1,"line":3},"how":"crosses","other":{"kind":"cone","number":3,"line":5}},{"object":{"kind":"sphere","number":2,"line":4},"how":"inside","other":{"kind":"box","number":1,"line":3}},{"object":{"kind":"sphere","number":2,"line":4},"how":"crosses","other":{"kind":"cone","number":3,"line":5}}]

"#]]);
}

#[test]
fn a_scene_without_pairs_is_told_so() {
    let folder = folder();
    fs::write(
        folder.path().join("b.scene"),
        "v 0 0 9 l 1 1 1 1 f 1 1 1 0 0 0 0 0 0 1 0 0 s 0 0 0 1 s 2 0 0 1",
    )
    .unwrap();
    octray(folder.path(), "overlaps b.scene")
        .assert()
        .success()
        .stderr_eq("")
        .stdout_eq(str![[r#"
2 objects: 0 pairs cross, 0 are inside another

"#]]);
    octray(folder.path(), "overlaps b.scene --json")
        .assert()
        .success()
        .stdout_eq("[]\n");
}

#[test]
fn all_surfaces_along_a_ray_are_told_whatever_they_are_made_of() {
    let folder = folder();
    octray(
        folder.path(),
        "trace a.scene -p 20,15 --through --size 41x31 --arith f64",
    )
    .assert()
    .success()
    .stdout_eq(str![[r#"
a.scene, pixel 20,15 of 41 x 31, f64
       8.000  box 1, line 3
       8.500  sphere 2, line 4
       8.800  cone 3, line 5
       9.200  cone 3, line 5
       9.500  sphere 2, line 4
      10.000  box 1, line 3

"#]]);
    octray(
        folder.path(),
        "trace a.scene -p 0,0 --through --format json",
    )
    .assert()
    .success()
    .stdout_eq(str![[r#"
{"scene":"a.scene","pixel":[0,0],"size":[40,30],"format":"f32","rays":[{"surfaces":[],"cut_short":false}]}

"#]]);
    octray(folder.path(), "trace a.scene -p 0,0 --through --format svg")
        .assert()
        .code(2);
}
