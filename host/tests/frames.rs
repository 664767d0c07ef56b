//! `octray render` with a moving camera, and as a wire frame.

mod common;

use common::{names, octray};
use octray_render::picture::{self, Picture};
use snapbox::str;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Four balls of one colour around the point looked at, alike from all four sides.
const ROUND: &str = "v 0 2 9 at 0 0 0 up 0 1 0 angle 40 resolution 30 40
b 0.2 0.3 0.5  l 0 99 0 1
f 0.5 0.4 0.3  0 0 0  0 0 0  1 0 0
s 2 0 0 0.7  s -2 0 0 0.7  s 0 0 2 0.7  s 0 0 -2 0.7
";

/// The thesis's camera, beside the middle of the picture.
const THESIS: &str = "v 30 20 90 resolution 30 40
b 0.2 0.3 0.5  l 0 99 0 1
f 0.5 0.4 0.3  0 0 0  0 0 0  1 0 0
s 5 0 0 4  s -5 0 0 4  s 0 0 5 4  s 0 0 -5 4
";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("a.scene", ROUND);
    write("b.scene", THESIS);
    write(
        "path",
        "# there and back\nv 0 2 9 at 0 0 0 up 0 1 0 angle 40\n\nv 4 2 9 at 0 0 0 up 0 1 0 angle 30\n",
    );
    folder
}

fn done(folder: &Path, line: &str) -> String {
    let output = octray(folder, line).output().unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && complaint.is_empty(),
        "{line}: {complaint}"
    );
    String::from_utf8(output.stdout).unwrap()
}

fn read(folder: &Path, name: &str) -> Picture {
    picture::read(&folder.join(name)).unwrap()
}

#[test]
fn an_orbit_shows_a_round_scene_the_same_after_every_quarter() {
    let folder = folder();
    for scene in ["a", "b"] {
        let told = done(
            folder.path(),
            &format!("render {scene}.scene --arith f64 -o o.png --frames 8 --orbit 360"),
        );
        assert_eq!(told.lines().count(), 8, "{told}");
        let frames: Vec<_> = (1..=8)
            .map(|i| read(folder.path(), &format!("o-000{i}.png")))
            .collect();
        // Rounding may move a pixel at an edge.
        let off = |a: &Picture, b: &Picture| {
            let pairs = a.levels().iter().zip(b.levels());
            pairs.filter(|(a, b)| a != b).count()
        };
        for i in 0..8 {
            assert!(off(&frames[i], &frames[i % 2]) < 8, "{scene} {i}");
        }
        assert!(off(&frames[0], &frames[1]) > 30);
        // The first is the picture as it is without an orbit.
        done(
            folder.path(),
            &format!("render {scene}.scene --arith f64 -o still.png"),
        );
        assert_eq!(frames[0], read(folder.path(), "still.png"));
        done(
            folder.path(),
            &format!("render {scene}.scene --arith f64 -o turned.png --orbit 45"),
        );
        assert_eq!(frames[1], read(folder.path(), "turned.png"));
    }
}

#[test]
fn a_positive_orbit_moves_the_camera_to_its_right() {
    let folder = folder();
    let render = |text: &str, options: &str| {
        fs::write(folder.path().join("c.scene"), text).unwrap();
        done(
            folder.path(),
            &format!("render c.scene --arith f64 -o c.png {options}"),
        );
        read(folder.path(), "c.png")
    };
    let text = ROUND.replace("s -2 0 0 0.7", "");
    let turned = render(&text, "--orbit 90");
    let moved = render(&text.replace("v 0 2 9", "v 9 2 0"), "");
    let off = turned.levels().iter().zip(moved.levels());
    assert!(off.filter(|(a, b)| a != b).count() < 8);
}

#[test]
fn a_path_goes_through_its_views() {
    let folder = folder();
    let folder = folder.path();
    done(folder, "render a.scene -o p.ppm --path path");
    done(folder, "render a.scene -o q.ppm --path path --frames 3");
    for (i, view) in ["v 0 2 9", "v 2 2 9", "v 4 2 9"].into_iter().enumerate() {
        let angle = ["angle 40", "angle 35", "angle 30"][i];
        let text = ROUND.replace("v 0 2 9", view).replace("angle 40", angle);
        fs::write(folder.join("c.scene"), text).unwrap();
        done(folder, "render c.scene -o c.ppm");
        let expected = read(folder, "c.ppm");
        assert_eq!(read(folder, &format!("q-000{}.ppm", i + 1)), expected);
        if i != 1 {
            assert_eq!(read(folder, &format!("p-000{}.ppm", i / 2 + 1)), expected);
        }
    }
    let written = names(folder).into_iter().filter(|name| name.contains('-'));
    assert_eq!(written.count(), 5);
}

#[test]
fn an_animation_has_the_numbered_pictures() {
    let folder = folder();
    let folder = folder.path();
    done(
        folder,
        "render a.scene -o n.png --frames 3 --orbit 90 --stats none",
    );
    for options in ["-o a.apng", "-o a.png --apng --fps 25"] {
        let line = format!("render a.scene --frames 3 --orbit 90 --stats json {options}");
        let told = done(folder, &line);
        let frames: Vec<serde_json::Value> = told
            .lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect();
        assert_eq!(frames.len(), 3);
        for (i, frame) in frames.iter().enumerate() {
            let numbered = read(folder, &format!("n-000{}.png", i + 1));
            assert_eq!(frame["hash"], format!("{:016x}", numbered.hash()));
        }
        let name = options.split_whitespace().nth(1).unwrap();
        // Whoever knows no animations sees the first.
        assert_eq!(read(folder, name), read(folder, "n-0001.png"));
        let bytes = fs::read(folder.join(name)).unwrap();
        let chunks = |kind: &[u8]| bytes.windows(4).filter(|bytes| *bytes == kind).count();
        assert_eq!((chunks(b"acTL"), chunks(b"fcTL")), (1, 3));
    }
}

#[test]
fn what_contradicts_itself_is_bad_usage() {
    let folder = folder();
    for (line, message) in [
        (
            "--frames 3",
            "--frames needs a path: --orbit DEGREES or --path FILE",
        ),
        ("--apng", "an animation needs --frames or --path"),
        ("-o a.apng", "an animation needs --frames or --path"),
        (
            "--fps 3 --orbit 3 --frames 2",
            "--fps is for animations: use --apng, or an output that ends in .apng",
        ),
        (
            "--frames 2 --orbit 3 --apng -o a.ras",
            "an animation is a PNG: let the output end in .apng or .png",
        ),
        (
            "--frames 2 --orbit 3 -o -",
            "numbered pictures need a name: use '-o NAME.png', or --apng",
        ),
        (
            "--wire --samples 2",
            "--wire draws lines of whole pixels: leave out --samples",
        ),
    ] {
        octray(folder.path(), &format!("render a.scene {line}"))
            .assert()
            .code(2)
            .stdout_eq("")
            .stderr_eq(format!(
                "error: {message}\n\nFor more information, try '--help'.\n"
            ));
    }
    for line in [
        "--frames 0 --orbit 1",
        "--orbit x",
        "--orbit 1 --path path",
        "--fps 0",
        "--frames 10000 --orbit 1",
    ] {
        octray(folder.path(), &format!("render a.scene {line}"))
            .assert()
            .code(2)
            .stdout_eq("");
    }
    assert_eq!(names(folder.path()), ["a.scene", "b.scene", "path"]);
}

#[test]
fn a_mistake_in_a_path_is_told_with_its_place() {
    let folder = folder();
    let path = folder.path().join("path");
    fs::write(
        &path,
        "v 0 2 9 at 0 0 0 up 0 1 0 angle 40\n\nv 0 2 9 at 0 0 x up 0 1 0 angle 40\n",
    )
    .unwrap();
    octray(folder.path(), "render a.scene --path path")
        .assert()
        .code(1)
        .stdout_eq("")
        .stderr_eq(str![[r#"
path:3:16: error: `x` is not a number
  |
3 | v 0 2 9 at 0 0 x up 0 1 0 angle 40
  |                ^ expected a number or a keyword

"#]]);
    fs::write(&path, "v 0 2 9 at 0 0 0 up 0 1 0 angle 40\nv 0 2 9\n").unwrap();
    octray(folder.path(), "render a.scene --path path")
        .assert()
        .code(1)
        .stderr_eq(str![[r#"
error: path:2: a view of another kind than the first: expected 'v x y z' on all lines, or 'at', 'up' and 'angle' on all

"#]]);
    fs::write(
        &path,
        "v from 0 2 9 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 9 9\n",
    )
    .unwrap();
    octray(folder.path(), "render a.scene --path path")
        .assert()
        .code(1)
        .stderr_eq(str![[r#"
error: path:1:50: 'resolution' on a line of a path: expected only 'v x y z', 'at', 'up', 'angle' and 'view'; the scene has the size and the background

"#]]);
    fs::write(&path, "# nothing\n").unwrap();
    octray(folder.path(), "render a.scene --path path")
        .assert()
        .code(1)
        .stderr_eq(str![[r#"
error: path: no views: expected lines such as 'v 0 1 6 at 0 0 0 up 0 1 0 angle 40'

"#]]);
}

#[test]
fn a_result_that_would_replace_the_scene_is_refused() {
    let folder = folder();
    fs::write(folder.path().join("o-0002.png"), ROUND).unwrap();
    octray(
        folder.path(),
        "render o-0002.png -o o.png --frames 2 --orbit 9",
    )
    .assert()
    .code(2)
    .stderr_eq(str![[r#"
error: the result o-0002.png would replace o-0002.png, which is read: name another file

For more information, try '--help'.

"#]]);
    assert!(!folder.path().join("o-0001.png").exists());
}

#[test]
fn a_wire_frame_has_a_line_wherever_another_object_begins() {
    let folder = folder();
    let folder = folder.path();
    // A square of 20 x 10 pixels in the middle of 40 x 30.
    let text = "v 0 0 10 view parallel resolution 30 40 l 0 0 9 1 f 1 1 1 0 0 0 0 0 0 1 0 0
        p 4 -10 -5 0 10 -5 0 10 5 0 -10 5 0";
    fs::write(folder.join("c.scene"), text).unwrap();
    for options in ["", "--threads 1 --arith i16f16 --tree none"] {
        let stats = done(
            folder,
            &format!("render c.scene --wire -o c.png --stats json {options}"),
        );
        let stats: serde_json::Value = serde_json::from_str(&stats).unwrap();
        assert_eq!(stats["rays"]["shadow"], 0);
        assert_eq!(stats["hits"], 200);
        let picture = read(folder, "c.png");
        for (i, level) in picture.levels().iter().enumerate() {
            let (x, y) = (i % 40, i / 40);
            let inside = |x: usize, y: usize| (10..30).contains(&x) && (10..20).contains(&y);
            let line = inside(x, y) != inside(x + 1, y) || inside(x, y) != inside(x, y + 1);
            assert_eq!(*level, if line { [0; 3] } else { [255; 3] }, "{x},{y}");
        }
    }
}

#[test]
fn a_view_from_which_nothing_can_be_seen_is_refused_with_its_frame() {
    let folder = folder();
    for (second, why) in [
        ("v 0 2 -9 at 0 0 0 up 0 1 0", "parallel"),
        ("v 0 -2 -9 at 0 0 0 up 0 1 0", "looks at"),
        ("v 0 2 8 at 0 0 0 up 0 -1 0", "up"),
    ] {
        let views = format!("v 0 2 9 at 0 0 0 up 0 1 0 angle 40\n{second} angle 40\n");
        fs::write(folder.path().join("through"), views).unwrap();
        let line = "render a.scene --path through --frames 3 -o out.png";
        let output = octray(folder.path(), line).output().unwrap();
        let complaint = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{second}");
        assert!(
            complaint.starts_with("error: frame 2 of 3: "),
            "{complaint}"
        );
        assert!(complaint.contains(why), "{complaint}");
        assert!(!folder.path().join("out-0001.png").exists());
    }
}

#[test]
fn what_a_picture_warns_of_a_frame_warns_of() {
    let folder = folder();
    let away = "v 0 2 9 at 0 0 0 up 0 1 0 angle 40\nv 0 2 9 at 0 9 99 up 0 1 0 angle 40\n";
    fs::write(folder.path().join("away"), away).unwrap();
    let told = done(folder.path(), "render a.scene --path away -o out.png");
    let lines: Vec<_> = told.lines().collect();
    assert_eq!(lines.len(), 3, "{told}");
    assert!(lines[1].starts_with("out-0002.png"), "{told}");
    assert!(lines[2].starts_with("  "), "{told}");
    fs::write(
        folder.path().join("with"),
        "v 0 2 9 at 0 0 0 up 0 1 0 angle 40 l 0 1 0 1\n",
    )
    .unwrap();
    let output = octray(folder.path(), "render a.scene --path with -o out.png")
        .output()
        .unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert!(
        complaint.starts_with("error: with:1: more than a view"),
        "{complaint}"
    );
}

#[test]
fn a_frame_in_which_nothing_is_in_sight_is_told_beside_json() {
    let folder = folder();
    fs::write(
        folder.path().join("away"),
        "v 0 2 9 at 0 0 0 up 0 1 0 angle 40\nv 0 2 9 at 0 2 20 up 0 1 0 angle 40\n",
    )
    .unwrap();
    for form in ["json", "none"] {
        let line = format!("render a.scene --path away -o o.png --stats {form}");
        octray(folder.path(), &line).assert().success().stderr_eq(
            "note: frame 2: no ray of the camera meets an object: the picture is all background\n",
        );
    }
}

#[test]
fn up_is_refused_only_where_it_is_parallel_to_the_view() {
    let folder = folder();
    let scene = |up: &str| ROUND.replace("up 0 1 0", up).replace("v 0 2 9", "v 0 9 0");
    for up in ["up 1e-6 1 0", "up 1e-11 1 0"] {
        fs::write(folder.path().join("above.scene"), scene(up)).unwrap();
        done(folder.path(), "render above.scene -o near.png");
        fs::write(folder.path().join("above.scene"), scene("up 1 0 0")).unwrap();
        done(folder.path(), "render above.scene -o far.png");
        assert_eq!(
            read(folder.path(), "near.png"),
            read(folder.path(), "far.png")
        );
    }
    fs::write(folder.path().join("above.scene"), scene("up 1e-13 1 0")).unwrap();
    octray(folder.path(), "render above.scene").assert().code(1);
}
