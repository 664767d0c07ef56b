//! Baked scenes: the features that they request, and the numbers that are written.

use octray_prepare::RenderSettings;
use octray_prepare::bake::{BakeError, BakeOptions, Baked, bake};
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, Format, TreeKind, TreeSettings};

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
