//! What formats are too coarse for, and how that is told.

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

fn told<S: Quantize>(scene: &Scene, size: (u32, u32)) -> Option<String> {
    told_at_depth::<S>(scene, size, 8)
}

fn told_at_depth<S: Quantize>(scene: &Scene, size: (u32, u32), max_depth: u32) -> Option<String> {
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
fn the_figures_are_resolved_by_good_formats_only() {
    for name in FIGURES {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.scene"));
        let scene = read(&file).unwrap();
        let large = (512, 512);
        assert_eq!(told::<f32>(&scene, large), None);
        assert_eq!(told::<Approx<2>>(&scene, large), None);
        assert_eq!(told::<Fixed<16, PerThread>>(&scene, large), None);
        assert!(told::<Approx<1>>(&scene, large).is_some());
        assert!(told::<Fixed<12, PerThread>>(&scene, large).is_some());
        assert!(told::<Fixed<8, PerThread>>(&scene, (32, 24)).is_some());
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
        told::<Fixed<16, PerThread>>(&far, (1, 1)).unwrap(),
        "i16f16 resolves 1/4096, but the size of object 1 as a share of the scene is 1/8009"
    );
    assert_eq!(told::<Fixed<20, PerThread>>(&far, (1, 1)), None);
    let near = scene("v 0 0 -9.01", "s 0 0 0 9");
    assert_eq!(
        told::<Fixed<12, PerThread>>(&near, (4, 4)).unwrap(),
        "i20f12 resolves 1/256, but the eye's distance from object 1 as a share of the scene is 1/3118"
    );
    let thin = scene("v 0 0 -9", "c 0 0 0 0.01 0 9 0 0");
    assert_eq!(
        told::<Fixed<12, PerThread>>(&thin, (1, 1)).unwrap(),
        "i20f12 resolves 1/256, but the size of object 1 as a share of the scene is 1/1274"
    );
    let mirror = "f 0 0 0  0 0 0  0 0 0  1 0.95 0";
    let deep = parse(&format!("v 0 0 -9 resolution 4 4 {mirror} s 0 0 0 1")).unwrap();
    assert_eq!(
        told_at_depth::<Fixed<8, PerThread>>(&deep, (1, 1), 400).unwrap(),
        "i24f8 resolves 1/512, but what each of 122 rays by way of surface 1 may err by is 1/3889"
    );
    assert_eq!(told_at_depth::<Fixed<8, PerThread>>(&deep, (1, 1), 8), None);
    let beside = scene("v 0 0 -9 view parallel", "s 0 0 0 9");
    assert_eq!(
        told::<Fixed<8, PerThread>>(&beside, (400, 400)).unwrap(),
        "i24f8 resolves 1/16, but a pixel's share of the scene is 1/3118"
    );
}
