//! What finds no room is refused or counted, never left out without a word.

use octray_core::accel::{
    AccelScalar, Accelerator, BruteForce, BuildOptions, COMPACT_STACK_SIZE, CompactBvh8,
    StackTooSmall,
};
use octray_core::features::{ALL_FEATURES, REFLECTION, REFRACTION, SHADOWS};
use octray_core::object::ObjectRef;
use octray_core::observe::{Counters, Observer};
use octray_core::trace::{QueuedRay, Tracer, Workspace, required_rays};
use octray_core::vec3::Vec3;
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Prepared, quantise};
use octray_prepare::tree::{Growth, OwnedCompactBvh8, every_object};
use octray_scenes::generate::{SceneKind, Spec, generate};

const VIEW: RenderSettings = RenderSettings {
    size: Some((64, 48)),
    max_depth: 4,
    ..RenderSettings::DEFAULT
};

/// Glass spheres between two lights.
const GLASS: &str = "v 0 0 6 at 0 0 0 up 0 1 0 angle 40 l 2 3 4 1 l -3 4 3 1
    f 0.1 0.1 0.1 0.3 0.3 0.3 0.3 0.3 0.3 20 0.3 0.6 1.5
    s 0 0 0 1 s 1.2 0.5 -1 0.7 s -1.1 -0.4 -1 0.8 box 0 -2 0 4 0.2 4";

fn glass() -> Prepared<f32> {
    quantise::<f32>(&octray_scenes::parse(GLASS).unwrap(), &VIEW).unwrap()
}

fn grown(objects: usize) -> (Prepared<f32>, OwnedCompactBvh8) {
    let kind = SceneKind::Soup;
    let mut prepared = quantise::<f32>(&generate(Spec { kind, objects }, 3), &VIEW).unwrap();
    let options = BuildOptions {
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

/// The picture with so much room, and what was counted.
fn render<A: Accelerator<f32>>(
    prepared: &Prepared<f32>,
    tree: &A,
    rays: usize,
    lights: usize,
) -> (Vec<Vec3<f32>>, Counters) {
    let scene = prepared.scene.scene();
    let tracer = Tracer {
        scene: &scene,
        accelerator: tree,
        max_depth: VIEW.max_depth,
        cut_off: 0.002,
    };
    let mut workspace = Workspace {
        rays: &mut vec![QueuedRay::EMPTY; rays],
        stack: &mut A::Stack::default(),
        shadow_cache: &mut vec![None; lights],
    };
    let (mut picture, mut counters) = (Vec::new(), Counters::default());
    let put = |_, _, colour| picture.push(colour);
    (prepared.frame).render(0..48, &tracer, &mut workspace, &mut counters, put);
    (picture, counters)
}

#[test]
fn rays_that_find_no_room_are_counted() {
    let prepared = glass();
    let all = every_object(&prepared.scene);
    let list = BruteForce(&all);
    let enough = required_rays(VIEW.max_depth, ALL_FEATURES);
    let (picture, counters) = render(&prepared, &list, enough, 2);
    assert_eq!(
        counters.deepest, enough as u64,
        "the scene needs all the room"
    );
    assert_eq!((counters.dropped.rays, counters.dropped.children), (0, 0));
    for rays in (0..enough).rev() {
        let (poorer, counters) = render(&prepared, &list, rays, 2);
        let dropped = counters.dropped.rays;
        assert!(dropped > 0, "{rays} places");
        assert!(counters.dropped.harms() && poorer != picture);
    }
}

#[test]
fn lights_beyond_the_shadow_cache_are_counted_and_change_nothing() {
    let prepared = glass();
    let all = every_object(&prepared.scene);
    let rays = required_rays(VIEW.max_depth, ALL_FEATURES);
    let (picture, with) = render(&prepared, &BruteForce(&all), rays, 2);
    assert_eq!(with.dropped.uncached, 0);
    let (same, without) = render(&prepared, &BruteForce(&all), rays, 0);
    assert!(picture == same && !without.dropped.harms());
    assert_eq!(without.dropped.uncached, without.blocked);
    assert!(without.blocked > 0);
}

#[test]
fn a_workspace_that_is_too_small_is_refused() {
    let prepared = glass();
    let scene = prepared.scene.scene();
    let all = every_object(&prepared.scene);
    let tracer = Tracer {
        scene: &scene,
        accelerator: &BruteForce(&all),
        max_depth: 4,
        cut_off: 0.0,
    };
    let fits = |rays: usize, lights: usize| {
        let (mut rays, mut lights) = (vec![QueuedRay::EMPTY; rays], vec![None; lights]);
        let mut stack = ();
        let workspace = tracer.workspace(&mut rays, &mut stack, &mut lights);
        workspace
            .map(|_| ())
            .map_err(|needed| (needed.rays, needed.lights))
    };
    assert_eq!(fits(5, 2), Ok(()));
    assert_eq!(fits(4, 2), Err((5, 2)));
    assert_eq!(fits(5, 1), Err((5, 2)));
}

#[test]
fn rays_wait_only_where_they_branch() {
    assert_eq!(required_rays(8, ALL_FEATURES), 9);
    assert_eq!(required_rays(0, ALL_FEATURES), 0);
    assert_eq!(required_rays(8, REFLECTION | SHADOWS), 1);
    assert_eq!(required_rays(8, REFRACTION), 1);
    assert_eq!(required_rays(8, SHADOWS), 0);
}

#[test]
fn room_for_the_nodes_that_can_wait_is_enough_and_less_is_refused() {
    const ROOM: usize = 16;
    let (prepared, tree) = grown(60);
    let whole = tree.tree();
    assert_eq!(whole.required_stack(), ROOM);
    let (words, links, tick) = (whole.words(), whole.links(), whole.tick());
    let exact = CompactBvh8::<'_, ROOM>::new(words, links, tick).unwrap();
    let (picture, counters) = render(&prepared, &exact, 6, 0);
    assert!(picture == render(&prepared, &whole, 6, 0).0);
    assert_eq!(counters.dropped.children, 0);
    let StackTooSmall { needed, .. } =
        CompactBvh8::<'_, { ROOM - 1 }>::new(words, links, tick).unwrap_err();
    assert_eq!(needed, ROOM);
}

#[test]
fn without_nodes_below_the_root_only_its_children_wait() {
    let (_, tree) = grown(8);
    let tree = tree.tree();
    let children = tree.words()[1] >> 28;
    assert_eq!(tree.words().len(), 2 + 2 * children as usize);
    assert_eq!(tree.required_stack(), children as usize);
    let nothing = CompactBvh8::<'_, 0>::new(&[], &[], 1).unwrap();
    assert_eq!(nothing.required_stack(), 0);
}

/// Words that no builder wrote: nodes that are their own children.
#[test]
fn a_tree_without_a_floor_is_refused() {
    // A root at word 0 with one child, whose place is 0 and not marked as a leaf.
    let words = [0, 1 << 28, 0, 0];
    assert!(CompactBvh8::<'_, COMPACT_STACK_SIZE>::new(&words, &[], 1).is_err());
}

/// Counts the steps of a walk, and gives up on one without end.
struct Steps(u32);

impl Observer for Steps {
    fn step(&mut self, _: usize) {
        self.0 += 1;
        assert!(self.0 < 100_000, "a walk without end");
    }
}

/// Tables in which bits have been lost: refused, or walked to an end.
#[test]
fn a_damaged_tree_is_refused_or_its_walk_ends() {
    let (prepared, tree) = grown(60);
    let scene = prepared.scene.scene();
    let whole = tree.tree();
    let rays = [-0.4_f32, 0.0, 0.3].map(|y| prepared.frame.camera().row(y).ray(0.1));
    // Numbers as good as random.
    let mut seed = 1u32;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as usize % below
    };
    let mut refused = 0;
    for _ in 0..5000 {
        let (mut words, mut links) = (whole.words().to_vec(), whole.links().to_vec());
        for _ in 0..=random(3) {
            match random(4) {
                0 => links.truncate(random(links.len() + 1)),
                1 => words.truncate(random(words.len() + 1)),
                2 => {
                    let at = random(words.len().max(1));
                    if let Some(word) = words.get_mut(at) {
                        // Most of them the place of a child.
                        *word ^= 1 << [random(32), 24 + random(8)][random(2)];
                    }
                }
                _ => {
                    let at = random(links.len().max(1));
                    if let Some(link) = links.get_mut(at) {
                        *link = link.marked_last(!link.is_last());
                    }
                }
            }
        }
        let Ok(damaged) = CompactBvh8::<'_, 64>::new(&words, &links, whole.tick()) else {
            refused += 1;
            continue;
        };
        for ray in &rays {
            let mut steps = Steps(0);
            damaged.nearest(&scene, ray, &mut Default::default(), &mut steps);
        }
    }
    assert!((500..5000).contains(&refused), "{refused}");
}

#[test]
fn the_largest_tree_fits_the_stack() {
    let (_, tree) = grown(20_000);
    assert!(tree.tree().required_stack() <= COMPACT_STACK_SIZE);
    assert_eq!(<f32 as AccelScalar>::to_grid(1.0), 1 << 29);
}

#[test]
fn references_hold_their_kind_and_place() {
    let last = ObjectRef::MAX_OBJECTS as u32 - 1;
    for kind in octray_core::object::ObjectKind::ALL {
        let object = ObjectRef::new(kind, last).marked_last(true);
        assert_eq!((object.kind(), object.index()), (kind, last as usize));
        assert!(object.is_last() && !object.marked_last(false).is_last());
    }
}
