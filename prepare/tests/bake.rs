//! Baked scenes: the features that they request, and the numbers that are written.

use octray_prepare::RenderSettings;
use octray_prepare::bake::{BakeError, BakeOptions, Baked, bake, file};
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, FirmwareTree, Format, TreeKind, TreeSettings};

const HEAD: &str = "v 0 0 9 resolution 8 8 l 5 5 9 1";

fn baked(text: &str, arith: Arith, max_depth: u32) -> Result<Baked, BakeError> {
    let scene = octray_scenes::parse(&format!("{HEAD} {text}")).unwrap();
    let options = BakeOptions {
        name: "test",
        settings: RenderSettings {
            arith,
            tree: TreeSettings::of(TreeKind::None),
            max_depth,
            ..RenderSettings::DEFAULT
        },
        on_device: false,
        target: None,
        rays: None,
    };
    bake(&scene, &options)
}

fn line(baked: &Baked, start: &str) -> String {
    let mut lines = baked.source.lines();
    lines.find(|line| line.starts_with(start)).unwrap().into()
}

#[test]
fn a_scene_requests_exactly_the_features_it_has() {
    let matt = "f 0 0 0 1 1 1 0 0 0 0 0 0";
    let mirror = "f 0 0 0 1 1 1 0 0 0 0 0.5 0";
    let glass = "f 0 0 0 1 1 1 1 1 1 2.5 0.5 0.5 1.5";
    let cases = [
        (
            matt,
            "s 0 0 -5 1",
            8,
            "features::SPHERES | features::SHADOWS",
            0,
        ),
        (
            mirror,
            "s 0 0 -5 1",
            8,
            "features::SPHERES | features::SHADOWS | features::REFLECTION",
            1,
        ),
        (
            mirror,
            "s 0 0 -5 1",
            0,
            "features::SPHERES | features::SHADOWS",
            0,
        ),
        (
            glass,
            "box 0 0 -5 1 1 1",
            3,
            "features::CUBOIDS | features::SHADOWS | features::SPECULAR | features::FRACTIONS | \
             features::REFLECTION | features::REFRACTION",
            4,
        ),
    ];
    for (surface, object, max_depth, needs, rays) in cases {
        let baked = baked(&format!("{surface} {object}"), Arith::F32, max_depth).unwrap();
        let expected = format!("pub const FEATURES: features::FeatureSet = {needs};");
        assert_eq!(line(&baked, "pub const FEATURES"), expected);
        let expected = format!("pub const RAYS: usize = {rays};");
        assert_eq!(line(&baked, "pub const RAYS"), expected);
    }
}

#[test]
fn numbers_are_bit_patterns() {
    let scene = "f 0 0 0 1 1 1 0 0 0 0 0.5 0 s 0 0 -5 1";
    let surface = |arith| line(&baked(scene, arith, 8).unwrap(), "    scene::Surface");
    assert!(surface(Arith::I16F16).contains("diffuse: v(65536, 65536, 65536)"));
    assert!(surface(Arith::I16F16).contains("reflect: n(32768)"));
    assert!(surface(Arith::F32).contains("reflect: n(0x3f000000)"));
}

#[test]
fn every_format_is_baked_as_itself_and_auto_as_the_finest() {
    let scene = "f 0 0 0 1 1 1 0 0 0 0 0 0 s 0 0 -5 1";
    for format in Format::all() {
        assert_eq!(baked(scene, format.into(), 8).unwrap().format, format);
    }
    let auto = baked(scene, Arith::Auto, 8).unwrap();
    assert_eq!(auto.format, Format::I4F28);
}

#[test]
fn what_does_not_fit_a_format_is_reported() {
    let glass = "f 0 0 0 1 1 1 0 0 0 0 0 1.5 1.5 s 0 0 -5 1";
    let why = baked(glass, Arith::I16F16, 8).unwrap_err().to_string();
    assert_eq!(
        why,
        "i16f16 takes transmitted shares up to 1, but that of surface 1 is 1.5"
    );
    assert!(baked(glass, Arith::F32, 8).is_ok());
    let bright = "f 0 0 0 9e4 1 1 0 0 0 0 0 0 s 0 0 -5 1";
    let why = baked(bright, Arith::I16F16, 8).unwrap_err().to_string();
    let expected = "but diffuse and specular light of surface 1 can reach 90000.000000";
    assert!(
        why.starts_with("i16f16 holds numbers below 32767.99"),
        "{why}"
    );
    assert!(why.ends_with(expected), "{why}");
}

#[test]
fn what_a_format_is_too_coarse_for_is_told() {
    let scene = "f 0 0 0 1 1 1 0 0 0 0 0 0 s 0 0 -5 1";
    assert_eq!(baked(scene, Arith::I16F16, 8).unwrap().too_fine, None);
    let small = "f 0 0 0 1 1 1 0 0 0 0 0 0 s 0 0 -5 1 s 3 0 -5 0.0001";
    let what = baked(small, Arith::I20F12, 8).unwrap().too_fine.unwrap();
    assert!(what.what.contains("object 2"), "{what}");
}

/// A scene file in a folder of its own.
fn written(text: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ball.scene");
    std::fs::write(&path, format!("{HEAD} {text}")).unwrap();
    (folder, path)
}

#[test]
fn a_build_script_bakes_what_the_command_bakes() {
    let ball = "f 0 0 0 1 1 1 0 0 0 0 0.5 0 s 0 0 -5 1";
    let (_folder, path) = written(ball);
    let script = file(&path).arith(Arith::I16F16).max_depth(3);
    let by_script = script.tree(FirmwareTree::NONE).source(None).unwrap();
    let by_command = baked(ball, Arith::I16F16, 3).unwrap();
    let rest = |source: &str| {
        source
            .split_once('\n')
            .unwrap()
            .1
            .replace("\"ball\"", "\"test\"")
    };
    assert_eq!(rest(&by_script.source), rest(&by_command.source));
}

#[test]
fn mistakes_reach_a_build_script() {
    let why = |script: octray_prepare::bake::Script| script.source(None).unwrap_err().to_string();
    let (_folder, path) = written("f 0 0 0 1 1 1 0 0 0 0 0.5 0 s 0 0 -5 blob");
    assert!(why(file(&path)).contains("blob"), "{}", why(file(&path)));
    let (_folder, path) = written("f 0 0 0 1 1 1 0 0 0 0 0 0 s 0 0 -5 1");
    let far = file(&path).room([0.0; 3], [f64::NAN, 1.0, 1.0]);
    assert_eq!(why(far), "room: a number that is not finite");
    let text = why(file(&path).size(0, 4));
    assert_eq!(text, "setting size (columns) 0: expected 1 to 65535");
    assert!(why(file(path.with_file_name("none.scene"))).contains("none.scene"));
}

#[test]
fn room_to_move_makes_the_numbers_smaller_and_the_tree_larger() {
    let balls = "f 0 0 0 1 1 1 0 0 0 0 0 0 s 0 0 -5 1 s 2 0 -5 1 s 4 0 -5 1 s 0 2 -5 1";
    let (_folder, path) = written(balls);
    let script = file(&path).arith(Arith::I16F16).tree(FirmwareTree::DEVICE);
    let still = script.clone().source(None).unwrap();
    let moving = script
        .room([99.0, -2.0, -9.0], [-9.0, 2.0, 9.0])
        .source(None)
        .unwrap();
    let words = |baked: &Baked| baked.words;
    assert_eq!(words(&moving), octray_core::accel::compact_words(4));
    assert!(words(&still) < words(&moving));
    // The middle of the room, of the viewpoint and of the light.
    let centre = line(&moving, "    centre: ");
    assert_eq!(centre, "    centre: [45.0, 1.5, 0.0],");
    assert!(line(&still, "    exponent: ") != line(&moving, "    exponent: "));
}
