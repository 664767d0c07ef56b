//! The traversal stack that a compact BVH needs.

use octray_core::octree::{Accelerator, Options, Packed};
use octray_core::trace::{Pending, Tracer, Workspace};
use octray_core::vec3::Vec3;
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Prepared, quantise};
use octray_prepare::tree::{Growth, OwnedCompactBvh8};
use octray_scenes::generate::{SceneKind, Spec, generate};

const VIEW: RenderSettings = RenderSettings {
    size: Some((64, 48)),
    max_depth: 4,
    ..RenderSettings::DEFAULT
};

fn grown(objects: usize) -> (Prepared<f32>, OwnedCompactBvh8) {
    let kind = SceneKind::Soup;
    let mut prepared = quantise::<f32>(&generate(Spec { kind, objects }, 3), &VIEW).unwrap();
    let options = Options {
        depth: 24,
        leaf_size: 2,
    };
    let growth = Growth {
        options,
        arena: None,
    };
    let (tree, _) = OwnedCompactBvh8::build(&mut prepared.scene, &growth).unwrap();
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
        rays: &mut [Pending::EMPTY; 6],
        stack: &mut A::Stack::default(),
        blockers: &mut [],
    };
    let mut picture = Vec::new();
    let put = |_, _, colour| picture.push(colour);
    (prepared.frame).render(0..48, &tracer, &mut workspace, &mut (), put);
    picture
}

#[test]
fn a_stack_for_the_computed_number_of_nodes_is_enough() {
    const ROOM: usize = 16;
    let (prepared, tree) = grown(60);
    assert_eq!(tree.tree().waiting(), ROOM);
    let exact = Packed::<'_, ROOM> {
        words: &tree.words,
        links: &tree.links,
        tick: tree.tick,
    };
    assert!(render(&prepared, &exact) == render(&prepared, &tree.tree()));
}

#[test]
fn without_inner_nodes_only_the_children_of_the_root_wait() {
    let (_, tree) = grown(8);
    let children = tree.words[1] >> 28;
    assert_eq!(tree.words.len(), 2 + 2 * children as usize);
    assert_eq!(tree.tree().waiting(), children as usize);
    let nothing = Packed::<'_, 64> {
        words: &[],
        links: &[],
        tick: 0,
    };
    assert_eq!(nothing.waiting(), 0);
}
