//! One scene in every accelerator, and the comparison of what they find.

use fastrand::Rng;
use octray_core::accel::{Accelerator, BruteForce, BuildOptions, LinkBy, OctreeVariant, Walk};
use octray_core::object::ObjectRef;
use octray_core::quantize::Quantize;
use octray_core::ray::{Departure, Ray};
use octray_core::scene::Light;
use octray_core::vec3::Vec3;
use octray_prepare::quantise::Quantised;
use octray_prepare::tree::{Growth, OwnedBvh8, OwnedCompactBvh8, OwnedOctree, every_object};
use std::collections::BTreeMap;

/// A tree with its name and the scene in its order.
pub(crate) type Built<S, T> = (String, Quantised<S>, T);

/// The ways to walk octrees, by turns.
const WALKS: [&[Walk]; 3] = [
    &[Walk::Ordered],
    &[Walk::Neighbour, Walk::Links],
    &[Walk::Links, Walk::Neighbour, Walk::Ordered],
];

/// One scene in all accelerators. Building a tree puts the objects into its own order, so that each
/// has a copy of its own.
pub(crate) struct Forest<S: Quantize> {
    /// The scene in the order of its file.
    pub(crate) bare: Quantised<S>,
    /// All objects.
    pub(crate) all: Vec<ObjectRef>,
    /// The 8-wide BVH.
    pub(crate) bvh8: Built<S, OwnedBvh8<S::Bound>>,
    /// The compact one.
    pub(crate) compact: Built<S, OwnedCompactBvh8>,
    /// Octrees, walked in all ways.
    pub(crate) octrees: Vec<Built<S, OwnedOctree<S::Bound>>>,
}

impl<S: Quantize> Forest<S> {
    /// Builds all of them; the seed decides how.
    pub(crate) fn new(bare: &Quantised<S>, seed: u64) -> Self {
        let tiny = [1, 2, 5, 20][seed as usize % 4];
        let growth = |depth, leaf_size, arena| Growth {
            options: BuildOptions { depth, leaf_size },
            arena,
        };
        let bvh8 = match seed % 3 {
            0 => ("bvh8, tiny arena", growth(24, 1, Some(tiny))),
            _ => ("bvh8", growth(24, 2, None)),
        };
        let few = growth(6, 1 + seed as u32 % 3, Some(3000));
        let full = growth(8, 1, Some(tiny));
        let octrees = [
            ("plain by shape", few, OctreeVariant::Plain, LinkBy::Shape),
            (
                "modified by shape",
                few,
                OctreeVariant::Modified,
                LinkBy::Shape,
            ),
            [
                ("plain by box", few, OctreeVariant::Plain, LinkBy::Box),
                ("modified by box", few, OctreeVariant::Modified, LinkBy::Box),
                (
                    "plain, tiny arena",
                    full,
                    OctreeVariant::Plain,
                    LinkBy::Shape,
                ),
                (
                    "modified, tiny arena",
                    full,
                    OctreeVariant::Modified,
                    LinkBy::Shape,
                ),
            ][seed as usize / 4 % 4],
        ];
        Self {
            bare: bare.clone(),
            all: every_object(bare),
            bvh8: {
                let mut scene = bare.clone();
                let (tree, _) = OwnedBvh8::build(&mut scene, &bvh8.1);
                (bvh8.0.into(), scene, tree)
            },
            compact: {
                let mut scene = bare.clone();
                let (tree, _) = OwnedCompactBvh8::build(&mut scene, &bvh8.1).expect("few objects");
                ("compact bvh8".into(), scene, tree)
            },
            octrees: octrees
                .into_iter()
                .zip([&WALKS[..2], &WALKS[..2], &WALKS[2..]])
                .flat_map(|((name, growth, variant, link), walks)| {
                    let mut scene = bare.clone();
                    let (tree, _) = OwnedOctree::build(&mut scene, &growth, variant, link);
                    walks.iter().map(move |walks| {
                        let walk = walks[seed as usize % walks.len()];
                        let tree = tree.clone().walked(walk);
                        (format!("{name}, {walk:?}"), scene.clone(), tree)
                    })
                })
                .collect(),
        }
    }

    /// Compares what each of them finds with what testing every object finds.
    pub(crate) fn compare(&self, ray: &Ray<S>, rng: &mut Rng, wrong: &mut Wrong, case: &str) {
        let list = BruteForce(&self.all);
        let nearest = seen(&self.bare, &list, ray);
        wrong.rays += 1;
        wrong.hits += u64::from(nearest.is_some());
        // How far an any-hit ray goes: everywhere; up to the hit, a little short of it, anywhere.
        let limits = [
            S::MAX,
            nearest.map_or(S::ONE, |(t, _)| {
                let part = [S::ONE, S::from_f64(0.999), S::from_f64(rng.f64())];
                t * part[rng.usize(..3)]
            }),
        ];
        let blocked = limits.map(|limit| meets(&self.bare, &list, ray, limit));
        // The way to a light there, or one that the first object holds.
        let light = nearest.map_or(S::ONE, |(t, _)| t);
        let lit = arrives(&self.bare, &list, ray, light);
        for (&limit, &blocked) in limits.iter().zip(&blocked) {
            let reached = nearest.is_some_and(|(t, _)| t <= limit);
            wrong.check("list", reached == blocked, || {
                format!("{case}: {nearest:?}, but within {limit:?} {blocked}; {ray:?}")
            });
        }
        let mut check = |name: &str, got, meets: &[bool], arrives| {
            let right = got == nearest && meets == blocked && arrives == lit;
            wrong.check(name, right, || {
                format!(
                    "{case}: {got:?} {meets:?} {arrives}, not {nearest:?} {blocked:?} {lit} \
                     within {limits:?}; {ray:?}"
                )
            });
        };
        let (name, scene, tree) = &self.bvh8;
        let (tree, own) = (tree.tree(), reordered(ray, &self.bare, scene));
        check(
            name,
            seen(scene, &tree, &own),
            &limits.map(|limit| meets(scene, &tree, &own, limit)),
            arrives(scene, &tree, &own, light),
        );
        let (name, scene, tree) = &self.compact;
        let (tree, own) = (tree.tree(), reordered(ray, &self.bare, scene));
        check(
            name,
            seen(scene, &tree, &own),
            &limits.map(|limit| meets(scene, &tree, &own, limit)),
            arrives(scene, &tree, &own, light),
        );
        for (name, scene, tree) in &self.octrees {
            let (tree, own) = (tree.tree(), reordered(ray, &self.bare, scene));
            check(
                name,
                seen(scene, &tree, &own),
                &limits.map(|limit| meets(scene, &tree, &own, limit)),
                arrives(scene, &tree, &own, light),
            );
        }
    }
}

/// The ray in the order of another tree's objects.
fn reordered<S: Quantize>(ray: &Ray<S>, from: &Quantised<S>, to: &Quantised<S>) -> Ray<S> {
    let (from, to) = (from.scene(), to.scene());
    let mut ray = *ray;
    if let Some(object) = from.shapes.refs().find(|o| ray.from.leaves(*o)) {
        let id = from.attributes_of(object).id;
        let there = to.shapes.refs().find(|o| to.attributes_of(*o).id == id);
        ray.from = Departure::new(there.expect("the same objects"), ray.from.is_inward());
    }
    ray
}

/// At which distance a ray meets which object of the file first.
fn seen<S: Quantize, A: Accelerator<S>>(
    scene: &Quantised<S>,
    tree: &A,
    ray: &Ray<S>,
) -> Option<(S, u32)> {
    let scene = scene.scene();
    tree.nearest(&scene, ray, &mut A::Stack::default(), &mut ())
        .map(|hit| (hit.t, scene.attributes_of(hit.object).id))
}

/// Whether a ray meets anything within a limit; what it is said to meet it does meet.
fn meets<S: Quantize, A: Accelerator<S>>(
    scene: &Quantised<S>,
    tree: &A,
    ray: &Ray<S>,
    limit: S,
) -> bool {
    let scene = scene.scene();
    let found = tree.any_hit(&scene, ray, limit, None, &mut A::Stack::default(), &mut ());
    if let Some(object) = found {
        assert!(scene.shapes.blocks(object, ray, limit, None, &mut ()));
    }
    found.is_some()
}

/// Whether a ray comes to a light at distance `t`.
fn arrives<S: Quantize, A: Accelerator<S>>(
    scene: &Quantised<S>,
    tree: &A,
    ray: &Ray<S>,
    t: S,
) -> bool {
    let light = Light::new(ray.at(t), Vec3::ZERO);
    let mut stack = A::Stack::default();
    tree.any_hit(&scene.scene(), ray, t, Some(&light), &mut stack, &mut ())
        .is_none()
}

/// What was found to be wrong.
#[derive(Default)]
pub(crate) struct Wrong {
    /// Rays that were shot.
    pub(crate) rays: u64,
    /// Those that met something.
    pub(crate) hits: u64,
    /// By tree: how many rays, and the first of them.
    by_tree: BTreeMap<String, (u64, String)>,
}

impl Wrong {
    fn check(&mut self, tree: &str, right: bool, tell: impl FnOnce() -> String) {
        if !right {
            let of_tree = self.by_tree.entry(tree.into());
            of_tree.or_insert_with(|| (0, tell())).0 += 1;
        }
    }

    /// Fails if anything was wrong, or too little was tried.
    pub(crate) fn report(&self, name: &str) {
        println!("{name}: {} rays, {} hits", self.rays, self.hits);
        let &Self { rays, hits, .. } = self;
        assert!(rays >= 1_000_000 && hits * 8 > rays, "{hits} of {rays}");
        self.agree(name);
    }

    /// Fails if any tree found something else.
    pub(crate) fn agree(&self, name: &str) {
        let differing: Vec<String> = self
            .by_tree
            .iter()
            .map(|(tree, (count, first))| format!("{tree}: {count} rays differ, first {first}"))
            .collect();
        assert!(differing.is_empty(), "{name}\n{}", differing.join("\n"));
    }
}
