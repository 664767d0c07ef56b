//! Every file in `warned/` is read, with warnings as recorded in the file beside it. After a change of the texts, run
//! with `SNAPSHOTS=overwrite` and read the difference.

use octray_scenes::model::Shape;
use octray_scenes::{parse, parse_with_warnings, read_with_warnings};
use snapbox::{Data, assert_data_eq};
use std::path::Path;

#[test]
fn warnings_are_drawn_as_recorded() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("warned");
    let mut seen = 0;
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|end| end != "scene") {
            continue;
        }
        let (_, drawn) = read_with_warnings(&path).unwrap();
        let drawn = drawn.replace(&*folder.to_string_lossy(), "warned");
        let expected = Data::read_from(&path.with_extension("stderr"), None).raw();
        assert_data_eq!(format!("{drawn}\n"), expected);
        seen += 1;
    }
    assert!(seen >= 4, "only {seen} files");
}

#[test]
fn what_has_no_area_is_left_out_and_all_else_stays() {
    let (scene, warnings) = parse_with_warnings(
        "v 0 0 9 f 1 1 1 1 0 0 0 0
         pp 3 1 2 3 0 0 1  1 2 3 0 1 0  1 2 3 1 0 0
         p 3 0 0 0 1 0 0 0 1 0
         p 3 0 0 0 1 1 1 2 2 2
         pp 4 0 0 0 0 0 1  1 0 0 0 0 2  1 0 0 0 0 3  0 1 0 0 0 4
         s 0 0 0 1",
    )
    .unwrap();
    let shapes: Vec<_> = scene.objects.iter().map(|object| object.shape).collect();
    assert!(matches!(
        shapes[..],
        [
            Shape::Polygon { first: 0, count: 3 },
            // The vertex that is there twice stays: half of the patch has an area.
            Shape::Patch {
                first: 3,
                count: 4,
                first_normal: 0
            },
            Shape::Sphere { .. },
        ]
    ));
    assert_eq!((scene.vertices.len(), scene.normals.len()), (7, 4));
    assert_eq!(scene.normals[0], [0.0, 0.0, 1.0]);
    assert_eq!(warnings.list.len(), 3);
}

#[test]
fn a_file_without_oddities_has_no_warnings() {
    let (_, warnings) = parse_with_warnings("v 0 0 1 f 1 1 1 1 0 0 0 0 s 0 0 0 1").unwrap();
    assert_eq!(warnings.draw("a.scene", ""), "");
}

/// DOS ended text with control-Z, and padded blocks with what was left in memory.
#[test]
fn a_dos_end_of_file_has_no_meaning() {
    let scene = parse("v 0 0 1 b 1 0 0");
    for end in [
        "\u{1a}",
        "\r\n\u{1a}",
        " \u{1a}\u{1a}\r\n",
        "\n\u{1a}\0\0\0",
    ] {
        assert_eq!(parse(&format!("v 0 0 1 b 1 0 0{end}")), scene, "{end:?}");
    }
    assert!(parse("v 0 0 1 \u{1a} b 1 0 0").is_err());
    assert!(parse("v 0 0 1 \0").is_err());
}

#[test]
fn any_bytes_in_a_comment_have_no_meaning() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.scene");
    let all: Vec<u8> = (0..=255)
        .filter(|byte| *byte != b'\n' && *byte != b'\r')
        .collect();
    let source = [b"v 0 0 1 # ", &*all, b"\nb 1 0 0\n# caf\xe9"].concat();
    std::fs::write(&path, source).unwrap();
    assert_eq!(
        read_with_warnings(&path).unwrap().0,
        parse("v 0 0 1 b 1 0 0").unwrap()
    );
}
