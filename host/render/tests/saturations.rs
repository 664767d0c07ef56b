//! Saturations are counted by whoever traced: two renderings in one process are told apart.

use octray_core::frame::Region;
use octray_render::renderer::{Renderer, prepare};
use octray_render::tile::Tile;
use octray_render::{Arith, RenderSettings};
use std::thread;

const SETTINGS: RenderSettings = RenderSettings {
    arith: Arith::I4F28,
    size: Some((32, 24)),
    max_depth: 2,
    ..RenderSettings::DEFAULT
};

fn renderer(light: &str) -> Box<dyn Renderer> {
    let file = format!(
        "b {light} {light} {light} v 0 0 6 at 0 0 0 up 0 1 0 angle 40 l 0 5 6 {light}
         f 0 0 0 1 1 1 0 0 0 1 1 0 s 0 0 0 2"
    );
    let scene = octray_scenes::parse(&file).unwrap();
    prepare(&scene, &SETTINGS).unwrap()
}

/// Traces the picture's rows one by one, so that two threads are sure to be at it at once; how many results were
/// clamped.
fn saturations(renderer: &dyn Renderer) -> u64 {
    let mut worker = renderer.worker();
    for row in 0..24 {
        let mut levels = [[0; 3]; 32];
        worker.trace(Tile {
            region: Region {
                columns: 0..32,
                rows: row..row + 1,
            },
            levels: &mut levels,
            intensities: None,
        });
        thread::yield_now();
    }
    worker.saturations()
}

#[test]
fn two_renderings_in_one_process_are_told_apart() {
    // The light of the sphere fits the format, and so does that of the sky; the sum of both does not.
    let (bright, dim) = (renderer("6"), renderer("0.5"));
    let alone = saturations(&*bright);
    assert!(alone > 0);
    assert_eq!(saturations(&*dim), 0);
    thread::scope(|scope| {
        let bright = scope.spawn(|| saturations(&*bright));
        let dim = scope.spawn(|| saturations(&*dim));
        assert_eq!((bright.join().unwrap(), dim.join().unwrap()), (alone, 0));
    });
    // On one thread, in turns.
    let (mut loud, mut quiet) = (bright.worker(), dim.worker());
    for row in 0..24 {
        for worker in [&mut loud, &mut quiet] {
            worker.probe(&Region {
                columns: 0..32,
                rows: row..row + 1,
            });
        }
    }
    assert_eq!((loud.saturations(), quiet.saturations()), (alone, 0));
}
