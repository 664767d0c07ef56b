//! The rules of the thesis's figure 12, on scenes of a few balls.

use octray_core::accel::{
    BuildOptions, BuildStats, LinkBy, Octree, OctreeNode, OctreeVariant, Walk,
};
use octray_core::object::ObjectRef;
use octray_core::ray::Aabb;
use octray_core::shape::{Shapes, Sphere};
use octray_core::vec3::{Axis, vec3};

/// Builds the modified octree of balls, each given by centre and radius, and looks at it.
fn modified<R>(
    balls: &[[f32; 4]],
    options: BuildOptions,
    look: impl FnOnce(&Octree<'_, f32>, BuildStats) -> R,
) -> R {
    build(balls, options, OctreeVariant::Modified, look)
}

fn build<R>(
    balls: &[[f32; 4]],
    options: BuildOptions,
    variant: OctreeVariant,
    look: impl FnOnce(&Octree<'_, f32>, BuildStats) -> R,
) -> R {
    let spheres: Vec<_> = (balls.iter())
        .map(|&[x, y, z, radius]| Sphere {
            centre: vec3(x, y, z),
            radius,
        })
        .collect();
    let shapes: Shapes<'_, f32> = Shapes {
        spheres: &spheres,
        ..Shapes::empty(1e-6)
    };
    let mut nodes = vec![OctreeNode::EMPTY; 1 << 16];
    let mut links = vec![ObjectRef::default(); 1 << 16];
    let (tree, stats) = Octree::build(
        &shapes,
        &mut nodes,
        &mut links,
        options,
        variant,
        LinkBy::Shape,
    )
    .unwrap();
    assert_eq!(stats.unsplit, 0);
    look(&tree, stats)
}

const USUAL: BuildOptions = BuildOptions {
    depth: 8,
    leaf_size: 2,
};

fn parts<'a>(tree: &Octree<'a, f32>, cell: &OctreeNode<f32>) -> &'a [OctreeNode<f32>] {
    match cell.is_leaf() {
        true => &[],
        false => &tree.nodes[cell.first()..][..cell.count() as usize],
    }
}

fn volume(bounds: &Aabb<f32>) -> f32 {
    let sides = bounds.high - bounds.low;
    sides.x * sides.y * sides.z
}

fn is_inside(inner: &Aabb<f32>, outer: &Aabb<f32>) -> bool {
    (Axis::ALL.into_iter()).all(|a| outer.low[a] <= inner.low[a] && inner.high[a] <= outer.high[a])
}

/// Balls in a heap at one corner, and one far away.
const HEAP: [[f32; 4]; 4] = [
    [-0.40, -0.40, -0.40, 0.03],
    [-0.32, -0.40, -0.40, 0.03],
    [-0.40, -0.32, -0.32, 0.03],
    [0.40, 0.40, 0.40, 0.05],
];

#[test]
fn two_objects_that_overlap_are_one_leaf() {
    let balls = [[-0.1, 0.0, 0.0, 0.2], [0.1, 0.0, 0.0, 0.2]];
    modified(&balls, USUAL, |tree, stats| {
        assert_eq!((tree.nodes.len(), stats.leaves, stats.links), (1, 1, 2));
        assert_eq!(tree.nodes[0].count(), 2);
    });
    // The plain tree would cut them to pieces if told to.
    let alone = BuildOptions {
        leaf_size: 1,
        ..USUAL
    };
    build(&balls, alone, OctreeVariant::Plain, |tree, _| {
        assert!(tree.nodes.len() > 1000);
    });
}

#[test]
fn two_objects_that_are_apart_are_parted_at_once() {
    // Halving cells takes eight levels to come between these two.
    let balls = [[-0.25, 0.0, 0.0, 0.25], [0.2515, 0.1, 0.0, 0.25]];
    modified(&balls, USUAL, |tree, stats| {
        assert_eq!((tree.nodes.len(), stats.inner, stats.depth), (3, 1, 1));
        let [left, right] = parts(tree, &tree.nodes[0]) else {
            panic!("{:?}", tree.nodes)
        };
        let plane = left.bounds().high.x;
        assert!(0.0 < plane && plane < 0.0015 && right.bounds().low.x == plane);
        assert!(left.is_leaf() && right.is_leaf());
        assert_eq!((left.count(), right.count()), (1, 1));
        let of = |leaf: &OctreeNode<f32>| tree.links[leaf.first()].index();
        assert_eq!((of(left), of(right)), (0, 1));
    });
}

#[test]
fn the_maximum_of_objects_is_the_roots() {
    let three = [
        [-0.4, -0.4, -0.4, 0.05],
        [-0.2, -0.4, -0.4, 0.05],
        [0.4, 0.4, 0.4, 0.05],
    ];
    let depth = |leaf_size| {
        let options = BuildOptions {
            depth: 8,
            leaf_size,
        };
        modified(&three, options, |_, stats| stats.depth)
    };
    // Up to it the root is split once, and its octants keep what they hold.
    assert_eq!(depth(3), 1);
    // Beyond it two in a cell are parted.
    assert_eq!(depth(2), 2);
    assert_eq!(depth(1), 2);
}

#[test]
fn three_objects_are_split_for_as_far_as_the_depth_allows() {
    let nested = [
        [0.0, 0.0, 0.0, 0.5],
        [0.0, 0.0, 0.0, 0.499],
        [0.0, 0.0, 0.0, 0.498],
    ];
    for depth in 1..4 {
        let options = BuildOptions { depth, ..USUAL };
        assert_eq!(modified(&nested, options, |_, stats| stats.depth), depth);
    }
}

#[test]
fn a_cluster_box_lies_inside_its_cell_and_fills_less_than_half_of_it() {
    modified(&HEAP, USUAL, |tree, _| {
        let clusters: Vec<_> = tree.nodes.iter().filter(|n| n.is_cluster()).collect();
        assert!(!clusters.is_empty());
        for cell in clusters {
            let [inside] = parts(tree, cell) else {
                panic!("{cell:?}")
            };
            assert!(is_inside(inside.bounds(), cell.bounds()));
            assert!(2.0 * volume(inside.bounds()) < volume(cell.bounds()));
            assert!(!inside.is_cluster());
        }
    });
    // Whoever fills its cell has none.
    let full = [
        [-0.1, 0.0, 0.0, 0.4],
        [0.1, 0.0, 0.0, 0.4],
        [0.0, 0.1, 0.0, 0.4],
    ];
    let once = BuildOptions { depth: 1, ..USUAL };
    modified(&full, once, |tree, _| {
        assert!(!tree.nodes[0].is_cluster());
    });
}

#[test]
fn only_a_cell_of_one_object_is_merged_with_three_empty_ones() {
    // The left half has one octant with one ball, the right half one octant with two.
    let balls = [
        [-0.4, -0.4, -0.4, 0.05],
        [0.4, 0.4, 0.4, 0.05],
        [0.28, 0.4, 0.4, 0.05],
    ];
    modified(&balls, USUAL, |tree, _| {
        let cells = parts(tree, &tree.nodes[0]);
        // Along whatever axis, only the half of the first ball is merged.
        assert_eq!(cells.len(), 5);
        let root = volume(tree.nodes[0].bounds());
        let halves: Vec<_> = (cells.iter())
            .filter(|cell| volume(cell.bounds()) > 0.4 * root)
            .collect();
        assert_eq!(halves.len(), 1);
        assert!(halves[0].is_leaf() && halves[0].count() == 1);
        let with_two = cells.iter().find(|cell| !cell.is_leaf()).unwrap();
        assert!(volume(with_two.bounds()) < 0.2 * root);
    });
}

#[test]
fn a_cell_with_objects_everywhere_keeps_its_octants() {
    let corners = [-0.4f32, 0.4].map(|x| [-0.4f32, 0.4].map(|y| [x, y]));
    let full: Vec<_> = (corners.iter().flatten())
        .flat_map(|[x, y]| [[*x, *y, -0.4, 0.05], [*x, *y, 0.4, 0.05]])
        .collect();
    modified(&full, USUAL, |tree, _| {
        assert_eq!(parts(tree, &tree.nodes[0]).len(), 8);
    });
}

/// Parts lie side by side and fill their cell, whatever the balls.
#[test]
fn parts_fill_their_cell() {
    let mut rng = fastrand::Rng::with_seed(5);
    for _ in 0..200 {
        let mut ball = || {
            let place = [(); 3].map(|()| rng.f32() - 0.5);
            [place[0], place[1], place[2], 0.01 + 0.1 * rng.f32()]
        };
        let balls: Vec<_> = (0..12).map(|_| ball()).collect();
        modified(&balls, USUAL, |tree, stats| {
            assert_eq!(stats.inner + stats.leaves, tree.nodes.len() as u32);
            for cell in tree
                .nodes
                .iter()
                .filter(|c| !c.is_leaf() && !c.is_cluster())
            {
                let parts = parts(tree, cell);
                assert!([2, 5, 8].contains(&parts.len()), "{}", parts.len());
                assert!(parts.iter().all(|p| is_inside(p.bounds(), cell.bounds())));
                let all: f32 = parts.iter().map(|part| volume(part.bounds())).sum();
                let whole = volume(cell.bounds());
                assert!((all - whole).abs() < 1e-4 * whole + 1e-12, "{all} {whole}");
                if let [half, others @ ..] = parts
                    && parts.len() == 5
                {
                    assert!((volume(half.bounds()) / whole - 0.5).abs() < 1e-3);
                    assert!(half.is_leaf() && half.count() <= 1);
                    // Had the other half been empty, that would have been merged.
                    let some = |cell: &OctreeNode<f32>| !cell.is_leaf() || cell.count() > 0;
                    assert!(others.iter().any(some));
                }
            }
        });
    }
}

/// A link leads through its face: to a cell that touches it, or to the one around a cluster box.
#[test]
fn links_lead_through_their_faces() {
    let mut room = vec![[0; 6]; 1 << 16];
    modified(&HEAP, USUAL, |tree, _| {
        let tree = tree.with_links(&mut room).unwrap();
        assert_eq!(
            (tree.walk, tree.neighbours.len()),
            (Walk::Links, tree.nodes.len())
        );
        assert_eq!(tree.neighbours[0], [u32::MAX; 6]);
        let (mut same, mut outside) = (0, 0);
        for (cell, links) in tree.nodes.iter().zip(tree.neighbours) {
            for (i, &link) in links.iter().enumerate() {
                let axis = Axis::ALL[i / 2];
                let (mine, low) = (cell.bounds(), i % 2 == 0);
                let plane = if low { mine.low[axis] } else { mine.high[axis] };
                let root = tree.nodes[0].bounds();
                let Some(behind) = tree.nodes.get(link as usize) else {
                    assert_eq!(plane, if low { root.low[axis] } else { root.high[axis] });
                    outside += 1;
                    continue;
                };
                let there = behind.bounds();
                let face = if low {
                    there.high[axis]
                } else {
                    there.low[axis]
                };
                assert!(
                    face == plane || is_inside(mine, there),
                    "{cell:?} {behind:?}"
                );
                same += u32::from(face == plane);
            }
        }
        assert!(same > 20 && outside > 6);
    });
    modified(&HEAP, USUAL, |tree, _| {
        assert!(tree.with_links(&mut []).is_none());
    });
}
