//! What formats are too coarse for, and how it is reported.

use octray_core::quantize::Quantize;
use octray_core::scalar::{Approx, Fixed};
use octray_prepare::RenderSettings;
use octray_prepare::quantise::resolution;
use octray_prepare::saturation::PerThread;
use octray_scenes::model::Scene;
use octray_scenes::parse::{parse, read};
use std::path::Path;

const FIGURES: [&str; 5] = [
    "figure-19",
    "figure-20",
    "figure-21",
    "figure-22",
    "figure-23",
];

fn reported<S: Quantize>(scene: &Scene, size: (u32, u32)) -> Option<String> {
    reported_at_depth::<S>(scene, size, 8)
}

fn reported_at_depth<S: Quantize>(
    scene: &Scene,
    size: (u32, u32),
    max_depth: u32,
) -> Option<String> {
    let view = RenderSettings {
        size: Some(size),
        max_depth,
        ..RenderSettings::DEFAULT
    };
    resolution::<S>(scene, &view)
        .err()
        .map(|fine| fine.to_string())
}

#[test]
fn the_figures_are_resolved_by_fine_formats_only() {
    for name in FIGURES {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.scene"));
        let scene = read(&file).unwrap();
        let large = (512, 512);
        assert_eq!(reported::<f32>(&scene, large), None);
        assert_eq!(reported::<Approx<2>>(&scene, large), None);
        assert_eq!(reported::<Fixed<16, PerThread>>(&scene, large), None);
        assert!(reported::<Approx<1>>(&scene, large).is_some());
        assert!(reported::<Fixed<12, PerThread>>(&scene, large).is_some());
        assert!(reported::<Fixed<8, PerThread>>(&scene, (32, 24)).is_some());
    }
}

#[test]
fn what_is_too_fine_is_named() {
    let surface = "f 1 1 1  1 1 1  0 0 0  1 0 0";
    let scene = |view: &str, objects: &str| {
        parse(&format!("{view} resolution 4 4 {surface} {objects}")).unwrap()
    };
    let far = scene("v 0 0 -8000", "s 0 0 0 1  s 0 0 0 9");
    assert_eq!(
        reported::<Fixed<16, PerThread>>(&far, (1, 1)).unwrap(),
        "i16f16 resolves 1/4096, but the size of object 1 as a share of the scene, which the viewpoint makes large, is 1/8009"
    );
    assert_eq!(reported::<Fixed<20, PerThread>>(&far, (1, 1)), None);
    let near = scene("v 0 0 -9.01", "s 0 0 0 9");
    assert_eq!(
        reported::<Fixed<12, PerThread>>(&near, (4, 4)).unwrap(),
        "i20f12 resolves 1/256, but the eye's distance from object 1 as a share of the scene is 1/3118"
    );
    let thin = scene("v 0 0 -9", "c 0 0 0 0.01 0 9 0 0");
    assert_eq!(
        reported::<Fixed<12, PerThread>>(&thin, (1, 1)).unwrap(),
        "i20f12 resolves 1/256, but the size of object 1 as a share of the scene is 1/1274"
    );
    let mirror = "f 0 0 0  0 0 0  0 0 0  1 0.95 0";
    let deep = parse(&format!("v 0 0 -9 resolution 4 4 {mirror} s 0 0 0 1")).unwrap();
    assert_eq!(
        reported_at_depth::<Fixed<8, PerThread>>(&deep, (1, 1), 400).unwrap(),
        "i24f8 resolves 1/512, but the error allowed to each of 122 rays via surface 1 is 1/3889"
    );
    assert_eq!(
        reported_at_depth::<Fixed<8, PerThread>>(&deep, (1, 1), 8),
        None
    );
    let beside = scene("v 0 0 -9 view parallel", "s 0 0 0 9");
    assert_eq!(
        reported::<Fixed<8, PerThread>>(&beside, (400, 400)).unwrap(),
        "i24f8 resolves 1/16, but a pixel's share of the scene is 1/3118"
    );
}

#[test]
fn what_is_large_or_far_is_no_matter_where_rounding_is_relative() {
    let view = "v 4 3 6 at 0 1 0 up 0 1 0 angle 40 resolution 64 64";
    let surface = "f 1 1 1  1 1 1  0 0 0  1 0 0";
    let floor = "p 4 -1e7 0 -1e7 1e7 0 -1e7 1e7 0 1e7 -1e7 0 1e7";
    let scene = |text: &str| parse(&format!("{view} {surface} s 0 1 0 1 {text}")).unwrap();
    let sun = scene("l 6e5 7e5 3e5 1");
    for told in [
        reported::<f32>(&sun, (64, 64)),
        reported::<Fixed<16, PerThread>>(&sun, (64, 64)),
        reported::<f32>(&scene(floor), (64, 64)),
    ] {
        assert_eq!(told, None);
    }
    assert_eq!(
        reported::<Fixed<16, PerThread>>(&scene(floor), (64, 64)).unwrap(),
        "i16f16 resolves 1/4096, but the size of object 1 as a share of the scene, which object 2 makes large, is 1/28284271"
    );
    assert_eq!(
        reported::<f32>(&scene("s 1e7 0 0 1"), (64, 64)).unwrap(),
        "f32 resolves 1/262144, but the size of object 1 as a share of its distance is 1/5000001"
    );
}

#[test]
fn an_eye_on_a_curved_surface_is_told() {
    let surface = "f 1 1 1  1 1 1  0 0 0  1 0 0";
    let told = |objects: &str| {
        let text = format!("v 0 2 0 at 3 0 3 up 0 1 0 angle 40 resolution 4 4 {surface} {objects}");
        reported::<f32>(&parse(&text).unwrap(), (4, 4))
    };
    let on =
        "f32 resolves 1/262144, but the eye's distance from object 1 as a share of the scene is 0";
    assert_eq!(told("s 0 1 0 1").as_deref(), Some(on));
    // On a cylinder, on a cone, at its tip.
    assert_eq!(told("c -2 0 0 1 -2 3 0 1").as_deref(), None);
    assert_eq!(told("c 1 0 0 1 1 3 0 1").as_deref(), Some(on));
    assert_eq!(told("c 0 0 0 1 0 2 0 0").as_deref(), Some(on));
    assert_eq!(told("c 1 1 0 0.5 1 3 0 1.5").as_deref(), Some(on));
    assert_eq!(told("s 0 1 0 0.99").as_deref(), None);
}

#[test]
fn gaps_that_a_format_cannot_see_are_told() {
    let surface = "f 1 1 1  1 1 1  0 0 0  1 0 0";
    let scene = |objects: &str| {
        let view = "v 3 2 4 at 0 0 0 up 0 1 0 angle 40 resolution 4 4";
        parse(&format!("{view} {surface} {objects}")).unwrap()
    };
    let square = |y: f64, half: f64| {
        format!("p 4 -{half} {y} -{half} {half} {y} -{half} {half} {y} {half} -{half} {y} {half} ")
    };
    let decal = |gap: f64| scene(&(square(0.0, 2.0) + &square(gap, 1.0)));
    let told = reported::<Fixed<16, PerThread>>(&decal(1e-5), (4, 4)).unwrap();
    assert_eq!(
        told,
        "i16f16 resolves 1/130945, but the gap between objects 1 and 2 as a share of the scene is 1/806226"
    );
    assert_eq!(reported::<Fixed<24, PerThread>>(&decal(1e-5), (4, 4)), None);
    assert_eq!(reported::<f64>(&decal(1e-9), (4, 4)), None);
    assert!(reported::<f32>(&decal(1e-7), (4, 4)).is_some());
    assert_eq!(reported::<f32>(&decal(1e-4), (4, 4)), None);
    // In the same place, or beside each other: no gap.
    assert_eq!(reported::<f32>(&decal(0.0), (4, 4)), None);
    let beside = scene("p 3 0 0 0 1 0 0 0 0 1  p 3 2 1e-8 0 3 1e-8 0 2 1e-8 1");
    assert_eq!(reported::<f32>(&beside, (4, 4)), None);
    for [a, b] in [
        ["s 0 1 0 0.9", "s 0 1 0 0.9000001"],
        ["c 0 0 0 1 0 1 1 0.5", "c 0 0 0 1.0000001 0 1 1 0.5000001"],
        ["box 0 0 0 1 1 1", "box 0 0 0 1.0000001 2 2"],
        [
            "box 0 0 0 1 1 1",
            "p 3 -1 0.5000001 0 1 0.5000001 0 0 0.5000001 1",
        ],
    ] {
        let told = reported::<f32>(&scene(&format!("{a} s 9 9 9 1 {b}")), (4, 4)).unwrap();
        assert!(told.contains("the gap between objects 1 and 3 "), "{told}");
    }
}

#[test]
fn a_shine_that_counts_as_0_is_told() {
    let scene =
        |surface: &str| parse(&format!("v 0 0 9 resolution 4 4 {surface} s 0 0 0 1")).unwrap();
    let dull = scene("f 0 0 0  1 1 1  0.5 0.5 0.5  0.001 0 0");
    assert_eq!(
        reported::<Fixed<8, PerThread>>(&dull, (1, 1)).unwrap(),
        "i24f8 resolves 1/512, but the shine of surface 1, which counts as 0, is 1/1000"
    );
    assert_eq!(reported::<Fixed<12, PerThread>>(&dull, (1, 1)), None);
    let matte = scene("f 0 0 0  1 1 1  0 0 0  0.001 0 0");
    assert_eq!(reported::<Fixed<8, PerThread>>(&matte, (1, 1)), None);
}
