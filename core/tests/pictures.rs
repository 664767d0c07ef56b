//! Whole pictures are equal, byte for byte, whatever the accelerator and however little room it has.

use octray_core::accel::{
    Accelerator, BruteForce, BuildOptions, COMPACT_MAX_DEPTH, LinkBy, OctreeVariant,
};
use octray_core::observe::Counters;
use octray_core::quantize::Quantize;
use octray_core::scalar::Fixed;
use octray_core::trace::{QueuedRay, Tracer, required_rays};
use octray_prepare::quantise::{Prepared, quantise};
use octray_prepare::saturation::PerThread;
use octray_prepare::tree::{Growth, OwnedBvh8, OwnedCompactBvh8, OwnedOctree, every_object};
use octray_prepare::{Arith, Format, RenderSettings};
use octray_scenes::model::Scene;
use std::path::{Path, PathBuf};

const VIEW: RenderSettings = RenderSettings {
    size: Some((64, 48)),
    ..RenderSettings::DEFAULT
};

/// Levels, and rays by kind.
type Picture = (Vec<[u8; 3]>, [u64; 4]);

fn scene_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "scene"))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

#[test]
fn pictures_are_the_same_in_f32() {
    all_scenes(compare::<f32>);
}

#[test]
fn pictures_are_the_same_in_f64() {
    all_scenes(compare::<f64>);
}

#[test]
fn pictures_are_the_same_in_the_finest_fixed_point() {
    all_scenes(
        |scene, name| match Arith::Auto.format(scene, VIEW.max_depth) {
            Format::I4F28 => compare::<Fixed<28, PerThread>>(scene, name),
            Format::I8F24 => compare::<Fixed<24, PerThread>>(scene, name),
            Format::I12F20 => compare::<Fixed<20, PerThread>>(scene, name),
            Format::I16F16 => compare::<Fixed<16, PerThread>>(scene, name),
            Format::I20F12 => compare::<Fixed<12, PerThread>>(scene, name),
            _ => compare::<Fixed<8, PerThread>>(scene, name),
        },
    );
}

fn all_scenes(compare: impl Fn(&Scene, &str)) {
    for path in scene_files() {
        let scene = octray_scenes::read(&path).unwrap();
        compare(&scene, &path.display().to_string());
    }
}

fn compare<S: Quantize>(scene: &Scene, name: &str) {
    let prepared = || quantise::<S>(scene, &VIEW).unwrap();
    let expected = {
        let prepared = prepared();
        let all = every_object(&prepared.scene);
        render(&prepared, &BruteForce(&all))
    };
    let check = |picture, what: &str| {
        assert!(picture == expected, "{name} in {}: {what}", S::NAME);
    };
    for arena in [None, Some(1), Some(2), Some(5), Some(20)] {
        let growth = |depth| Growth {
            options: BuildOptions {
                depth,
                leaf_size: 2,
            },
            arena,
        };
        let mut bvh8 = prepared();
        let (tree, _) = OwnedBvh8::build(&mut bvh8.scene, &growth(24));
        check(render(&bvh8, &tree.tree()), "bvh8");
        let mut compact = prepared();
        let grown = OwnedCompactBvh8::build(&mut compact.scene, &growth(COMPACT_MAX_DEPTH));
        let (tree, _) = grown.unwrap();
        check(render(&compact, &tree.tree()), "compact bvh8");
        for variant in [OctreeVariant::Modified, OctreeVariant::Plain] {
            for link in [LinkBy::Shape, LinkBy::Box] {
                let mut octree = prepared();
                let (tree, _) = OwnedOctree::build(&mut octree.scene, &growth(8), variant, link);
                let what = format!("{variant:?} octree linked by {link:?}, arena {arena:?}");
                check(render(&octree, &tree.tree()), &what);
            }
        }
    }
}

fn render<S: Quantize, A: Accelerator<S>>(prepared: &Prepared<S>, accelerator: &A) -> Picture {
    let scene = prepared.scene.scene();
    let tracer = Tracer {
        scene: &scene,
        accelerator,
        max_depth: VIEW.max_depth,
        cut_off: S::from_f64(1.0 / 512.0),
    };
    let rays = required_rays(VIEW.max_depth, octray_core::features::ALL_FEATURES);
    let mut rays = vec![QueuedRay::EMPTY; rays];
    let mut shadow_cache = vec![None; scene.lights.len()];
    let mut stack = A::Stack::default();
    let mut workspace = tracer
        .workspace(&mut rays, &mut stack, &mut shadow_cache)
        .unwrap();
    let mut counters = Counters::default();
    let mut levels = vec![[0; 3]; 64 * 48];
    prepared.frame.render(
        0..48,
        &tracer,
        &mut workspace,
        &mut counters,
        |x, y, colour| {
            levels[(y * 64 + x) as usize] = colour.to_array().map(S::level);
        },
    );
    assert_eq!(counters.dropped, octray_core::observe::Dropped::default());
    (levels, counters.rays)
}
