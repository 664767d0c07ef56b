//! Limits how far each arithmetic's picture may be from that in `f64`, at 256 × 256 for every scene.
//!
//! `OCTRAY_NFF` may name a folder with more scenes: every `*_small.nff` in it is measured too.

use octray_core::accel::{Accelerator, TraversalStack};
use octray_core::quantize::Quantize;
use octray_prepare::Arith;
use octray_prepare::Prepare;
use octray_prepare::RenderSettings;
use octray_prepare::dispatch::InFormat;
use octray_prepare::format::Format;
use octray_prepare::quantise::quantise;
use octray_prepare::tree::{Growth, OwnedBvh8};
use octray_render::metric::Difference;
use octray_scenes::model::Scene;
use octray_tests::shot::{self, Shot};
use std::fs;
use std::path::PathBuf;

const SIDE: u32 = 256;

/// The lowest allowed PSNR in dB, by arithmetic.
const LEAST_PSNR: [(Arith, f64); 3] = [
    (Arith::F32, 50.0),
    (Arith::APPROX2, 45.0),
    (Arith::Auto, 40.0),
];

/// The largest allowed share of pixels whose first object differs.
const OTHER_OBJECTS: f64 = 0.001;

#[test]
fn pictures_are_close_to_those_in_f64() {
    let mut table = format!(
        "{:<14} {:<8} {:>7} {:>8} {:>8} {:>8} {:>12}\n",
        "scene", "format", "dB", "largest", "beyond 8", "others", "saturations"
    );
    let mut failures = Vec::new();
    for path in scenes() {
        let name = shot::stem(&path);
        let scene = shot::read(&path);
        let reference = Shot::new(Arith::F64).size(SIDE, SIDE).take(&scene);
        let first = first_objects::<f64>(&scene);
        for (arith, least) in LEAST_PSNR {
            let traced = Shot::new(arith).size(SIDE, SIDE).take(&scene);
            let difference = Difference::between(&reference.picture, &traced.picture)
                .expect("they are of one size");
            let others = first
                .iter()
                .zip(first_objects_in(traced.format, &scene))
                .filter(|(a, b)| **a != *b)
                .count();
            table += &format!(
                "{name:<14} {:<8} {:>7.2} {:>8} {:>8} {others:>8} {:>12}\n",
                traced.format,
                difference.psnr(),
                difference.largest,
                difference.beyond_8,
                traced.saturations
            );
            let share = others as f64 / first.len() as f64;
            if difference.psnr() < least || share > OTHER_OBJECTS || traced.saturations > 0 {
                failures.push(format!(
                    "{name} in {}: {:.2} dB of {least}, {others} pixels see another object, \
                     {} saturations",
                    traced.format,
                    difference.psnr(),
                    traced.saturations
                ));
            }
        }
    }
    println!("{table}");
    assert!(failures.is_empty(), "{}\n{table}", failures.join("\n"));
}

fn scenes() -> Vec<PathBuf> {
    let mut scenes = shot::scene_files();
    if let Ok(folder) = std::env::var("OCTRAY_NFF") {
        let entries = fs::read_dir(&folder).expect("OCTRAY_NFF names a folder");
        let mut more: Vec<PathBuf> = entries
            .map(|entry| entry.expect("a folder can be listed").path())
            .filter(|path| path.to_string_lossy().ends_with("_small.nff"))
            .collect();
        more.sort();
        scenes.extend(more);
    }
    scenes
}

/// Returns what the ray through each pixel's centre hits first, in a format.
fn first_objects_in(format: Format, scene: &Scene) -> Vec<Option<u32>> {
    struct Task<'a>(&'a Scene);
    impl InFormat for Task<'_> {
        type Output = Vec<Option<u32>>;
        fn run<S: Prepare>(self) -> Self::Output {
            first_objects::<S>(self.0)
        }
    }
    format.dispatch(Task(scene))
}

/// Returns what the ray through each pixel's centre hits first, row by row.
fn first_objects<S: Quantize>(scene: &Scene) -> Vec<Option<u32>> {
    let view = RenderSettings {
        size: Some((SIDE, SIDE)),
        ..RenderSettings::DEFAULT
    };
    let mut prepared = quantise::<S>(scene, &view).expect("the scene fits the format");
    let growth = Growth {
        options: octray_core::accel::BuildOptions {
            depth: 24,
            leaf_size: 2,
        },
        arena: None,
    };
    let (tree, _) = OwnedBvh8::build(&mut prepared.scene, &growth);
    let (scene, tree) = (prepared.scene.scene(), tree.tree());
    let mut stack = TraversalStack::default();
    let active = prepared.frame.active();
    let pixels = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (column, row)));
    pixels
        .map(|(column, row)| {
            if !active.columns.contains(&column) || !active.rows.contains(&row) {
                return None;
            }
            let (x, y) = prepared.frame.sample_position(column, row, 0, 0);
            let ray = prepared.frame.camera().row(y).ray(x);
            tree.nearest(&scene, &ray, &mut stack, &mut ())
                .map(|hit| scene.attributes_of(hit.object).id)
        })
        .collect()
}
