//! How much room the walk of a packed tree takes.

use octray_core::accel::{Accelerator, BuildOptions, CompactBvh8};
use octray_core::trace::{QueuedRay, Tracer, Workspace};
use octray_core::vec3::Vec3;
use octray_scenes::generate::{Kind, Spec, generate};
use octray_scenes::quantise::{Prepared, View, quantise};
use octray_scenes::tree::{Growth, PackedTree};

const VIEW: View = View {
    size: Some((64, 48)),
    pixels_per_ray: 1,
    samples: 1,
    max_depth: 4,
};

fn grown(objects: usize) -> (Prepared<f32>, PackedTree) {
    let kind = Kind::Soup;
    let mut prepared = quantise::<f32>(&generate(Spec { kind, objects }, 3), &VIEW).unwrap();
    let options = BuildOptions {
        depth: 24,
        leaf_size: 2,
    };
    let growth = Growth {
        options,
        arena: None,
    };
    let (tree, _) = PackedTree::build(&mut prepared.scene, &growth).unwrap();
    (prepared, tree)
}

fn render<A: Accelerator<f32>>(prepared: &Prepared<f32>, tree: &A) -> Vec<Vec3<f32>> {
    let scene = prepared.scene.scene();
    let tracer = Tracer {
        scene: &scene,
        accelerator: tree,
        max_depth: VIEW.max_depth,
        cut_off: 0.002,
    };
    let mut workspace = Workspace {
        rays: &mut [QueuedRay::EMPTY; 6],
        stack: &mut A::Stack::default(),
        shadow_cache: &mut [],
    };
    let mut picture = Vec::new();
    let put = |_, _, colour| picture.push(colour);
    (prepared.frame).render(0..48, &tracer, &mut workspace, &mut (), put);
    picture
}

#[test]
fn room_for_the_nodes_that_can_wait_is_enough() {
    const ROOM: usize = 16;
    let (prepared, tree) = grown(60);
    assert_eq!(tree.tree().waiting(), ROOM);
    let exact = CompactBvh8::<'_, ROOM> {
        words: &tree.words,
        links: &tree.links,
        tick: tree.tick,
    };
    assert!(render(&prepared, &exact) == render(&prepared, &tree.tree()));
}

#[test]
fn without_nodes_below_the_root_only_its_children_wait() {
    let (_, tree) = grown(8);
    let children = tree.words[1] >> 28;
    assert_eq!(tree.words.len(), 2 + 2 * children as usize);
    assert_eq!(tree.tree().waiting(), children as usize);
    let nothing = CompactBvh8::<'_, 64> {
        words: &[],
        links: &[],
        tick: 0,
    };
    assert_eq!(nothing.waiting(), 0);
}
