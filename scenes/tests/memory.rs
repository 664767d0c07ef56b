//! Parsing needs little more memory than the resulting scene.

use octray_scenes::generate::{SceneKind, Spec};
use octray_scenes::model::{Object, Point, Scene};
use octray_scenes::{generate, parse, write};

fn size(scene: &Scene) -> u64 {
    let points = scene.vertices.len() + scene.normals.len();
    (scene.objects.len() * size_of::<Object>() + points * size_of::<Point>()) as u64
}

/// While a list that grows by doubling moves, it takes at most three times its contents. The number of allocations is
/// that of the doublings: tokens and objects need none.
#[test]
fn memory_is_bounded_by_the_scene() {
    for kind in SceneKind::ALL {
        let scene = generate(
            Spec {
                kind,
                objects: 100_000,
            },
            1,
        );
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let used = allocation_counter::measure(|| drop(parse(&text)));
        let bound = 3 * size(&scene) + 10_000;
        assert!(
            used.bytes_max <= bound,
            "{}: {} of {bound}",
            kind.name(),
            used.bytes_max
        );
        assert!(
            used.count_total <= 200,
            "{}: {}",
            kind.name(),
            used.count_total
        );
    }
}
