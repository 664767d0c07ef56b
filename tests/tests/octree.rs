//! Every tree finds what testing every object finds: the same object at the same distance, bit for
//! bit, in every arithmetic.

use fastrand::Rng;
use octray::stats::Rays;
use octray_core::accel::{
    Accelerator, BoundScalar, BruteForce, BuildOptions, LinkBy, OctreeVariant,
};
use octray_core::object::ObjectRef;
use octray_core::observe::Counters;
use octray_core::ray::{Aabb, Ray};
use octray_core::scalar::{Approx, Fixed, Fixed64, Quantize};
use octray_core::trace::{QueuedRay, Tracer, Workspace};
use octray_core::vec3::{Axis, Vec3, vec3};
use octray_engine::options::{self, Arith, Tree};
use octray_scenes::generate::{Kind, Spec};
use octray_scenes::quantise::{Prepared, Quantised, View, quantise};
use octray_scenes::tree::{Growth, OctantTree, PackedTree, TightTree, every_object};
use octray_tests::shot::{self, Shot, scene_files};
use octray_tests::strew;
use std::collections::BTreeMap;
use std::num::NonZeroUsize;

/// Scenes in each arithmetic, and rays in each scene: more than a million rays in all.
const SCENES: u64 = 210;
const RAYS: usize = 5000;

macro_rules! in_every_arithmetic {
    ($($name:ident: $s:ty),* $(,)?) => {
        mod rays_meet_the_same {
            use super::*;
            $(#[test] fn $name() { rays_meet_the_same::<$s>(); })*
        }
        mod no_ray_panics {
            use super::*;
            $(#[test] fn $name() { no_ray_panics::<$s>(); })*
        }
    };
}

in_every_arithmetic! {
    f64: f64, f32: f32,
    approx0: Approx<0>, approx1: Approx<1>, approx2: Approx<2>,
    i24f8: Fixed<8, true>, i20f12: Fixed<12, true>, i16f16: Fixed<16, true>,
    i12f20: Fixed<20, true>, i8f24: Fixed<24, true>, i4f28: Fixed<28, true>,
    i4f28_unchecked: Fixed<28, false>, i32f32: Fixed64,
}

/// Whole pictures are equal, byte for byte, whatever the tree and however little room it has.
#[test]
fn pictures_are_the_same() {
    for path in scene_files() {
        let scene = shot::read(&path);
        for arith in [Arith::F32, Arith::F64, Arith::Auto] {
            let take = |kind, arena, link| {
                let mut shot = Shot::new(arith).size(64, 48).tree(kind);
                shot.tree.arena = NonZeroUsize::new(arena);
                shot.tree.link = link;
                let traced = shot.take(&scene);
                (traced.picture.levels().to_vec(), Rays::of(&traced.counters))
            };
            let (picture, rays) = take(Tree::None, 0, options::Link::Shape);
            for kind in [Tree::Tight, Tree::Packed, Tree::Modified, Tree::Plain] {
                for (arena, link) in [
                    (0, options::Link::Shape),
                    (0, options::Link::Box),
                    (1, options::Link::Shape),
                    (2, options::Link::Shape),
                    (5, options::Link::Shape),
                    (20, options::Link::Box),
                ] {
                    let (same_picture, same_rays) = take(kind, arena, link);
                    assert!(
                        picture == same_picture && rays == same_rays,
                        "{} in {}: {kind:?} with {arena} nodes, by {link:?}",
                        path.display(),
                        arith.name(),
                    );
                }
            }
        }
    }
}

fn rays_meet_the_same<S: Quantize>() {
    let mut wrong = Wrong::default();
    for seed in 0..SCENES {
        let prepared = prepare::<S>(seed);
        let house = House::new(&prepared.scene, seed);
        let mut rng = Rng::with_seed(seed);
        let mut shots = Shots::new(&prepared, &house);
        for number in 0..RAYS {
            let ray = shots.next(&mut rng);
            house.compare(
                &ray,
                &mut rng,
                &mut wrong,
                &format!("scene {seed}, ray {number}"),
            );
        }
    }
    wrong.report(S::NAME);
}

/// Rays that no scene would send: whatever the numbers, they come to an end without a panic.
fn no_ray_panics<S: Quantize>() {
    let mut rng = Rng::with_seed(7);
    for seed in 0..24 {
        let prepared = prepare::<S>(seed);
        let house = House::new(&prepared.scene, seed);
        let scenes = house.octants.iter().map(|(_, scene, _)| scene);
        let trees = house.octants.iter().map(|(_, _, tree)| tree.tree());
        let mut memory = Memory::new();
        for _ in 0..1000 {
            let mut ray = Ray::<S>::default();
            for axis in Axis::ALL {
                ray.origin[axis] = extreme(&mut rng);
                ray.direction[axis] = extreme(&mut rng);
            }
            let limit = extreme(&mut rng);
            shoot(
                &house.bare,
                &BruteForce(&house.all),
                ray,
                limit,
                &mut memory,
            );
            let (_, scene, tree) = &house.tight;
            shoot(scene, &tree.tree(), ray, limit, &mut memory);
            let (_, scene, tree) = &house.packed;
            shoot(scene, &tree.tree(), ray, limit, &mut memory);
            for (scene, tree) in scenes.clone().zip(trees.clone()) {
                shoot(scene, &tree, ray, limit, &mut memory);
            }
        }
    }
}

/// What a tracer works with.
struct Memory<S: Quantize> {
    rays: Vec<QueuedRay<S>>,
    shadow_cache: Vec<Option<ObjectRef>>,
}

impl<S: Quantize> Memory<S> {
    fn new() -> Self {
        Self {
            rays: vec![QueuedRay::EMPTY; 5],
            shadow_cache: vec![None; 2],
        }
    }
}

/// All that can be done with a ray.
fn shoot<S: Quantize, A: Accelerator<S>>(
    scene: &Quantised<S>,
    tree: &A,
    ray: Ray<S>,
    limit: S,
    memory: &mut Memory<S>,
) {
    let scene = scene.scene();
    let mut stack = A::Stack::default();
    let tracer = Tracer {
        scene: &scene,
        accelerator: tree,
        max_depth: 3,
        cut_off: S::ZERO,
    };
    let mut workspace = Workspace {
        rays: &mut memory.rays,
        stack: &mut stack,
        shadow_cache: &mut memory.shadow_cache,
    };
    let colour = tracer.radiance(ray, &mut workspace, &mut Counters::default());
    let _ = colour.to_array().map(S::level);
    tree.any_hit(&scene, &ray, limit, &mut stack, &mut ());
}

/// A number, most often one that hardly any scene has.
fn extreme<S: Quantize>(rng: &mut Rng) -> S {
    let size = match rng.u8(..8) {
        0 | 1 => S::ZERO,
        2 => S::ONE,
        3 => S::MAX,
        4 => S::from_f64(S::MAX.to_f64() * rng.f64()),
        5 => S::from_f64(10f64.powf(-320.0 * rng.f64())),
        6 => S::from_f64(10f64.powf(300.0 * rng.f64())).min(S::MAX),
        _ => S::from_f64(rng.f64()),
    };
    sign(size, rng)
}

fn prepare<S: Quantize>(seed: u64) -> Prepared<S> {
    let scene = if seed % 8 == 7 {
        let spec = Spec {
            kind: Kind::Soup,
            objects: 10 + seed as usize % 90,
        };
        octray_scenes::generate(spec, seed)
    } else {
        let text = strew::objects(seed);
        octray_scenes::parse(&text).unwrap_or_else(|e| panic!("{}", e.draw("strewn", &text)))
    };
    let view = View {
        size: Some((8, 8)),
        pixels_per_ray: 1,
        samples: 1,
        max_depth: 8,
    };
    quantise::<S>(&scene, &view).expect("the scene fits every format")
}

/// A tree with its name and the scene in its order.
type Roof<S, T> = (&'static str, Quantised<S>, T);

/// One scene under all roofs. Building a tree puts the objects into its own order, so that each
/// has a copy of its own.
struct House<S: Quantize> {
    bare: Quantised<S>,
    all: Vec<ObjectRef>,
    tight: Roof<S, TightTree<S::Bound>>,
    packed: Roof<S, PackedTree>,
    octants: Vec<Roof<S, OctantTree<S::Bound>>>,
}

impl<S: Quantize> House<S> {
    fn new(bare: &Quantised<S>, seed: u64) -> Self {
        let tiny = [1, 2, 5, 20][seed as usize % 4];
        let growth = |depth, leaf_size, arena| Growth {
            options: BuildOptions { depth, leaf_size },
            arena,
        };
        let tight = match seed % 3 {
            0 => ("tight, tiny arena", growth(24, 1, Some(tiny))),
            _ => ("tight", growth(24, 2, None)),
        };
        let few = growth(6, 1 + seed as u32 % 3, Some(3000));
        let full = growth(8, 1, Some(tiny));
        let octants = [
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
            tight: {
                let mut scene = bare.clone();
                let (tree, _) = TightTree::build(&mut scene, &tight.1);
                (tight.0, scene, tree)
            },
            packed: {
                let mut scene = bare.clone();
                let (tree, _) = PackedTree::build(&mut scene, &tight.1).expect("few objects");
                ("packed", scene, tree)
            },
            octants: octants
                .into_iter()
                .map(|(name, growth, variant, link)| {
                    let mut scene = bare.clone();
                    let (tree, _) = OctantTree::build(&mut scene, &growth, variant, link);
                    (name, scene, tree)
                })
                .collect(),
        }
    }

    fn compare(&self, ray: &Ray<S>, rng: &mut Rng, wrong: &mut Wrong, case: &str) {
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
        for (&limit, &blocked) in limits.iter().zip(&blocked) {
            let reached = nearest.is_some_and(|(t, _)| t <= limit);
            wrong.check("list", reached == blocked, || {
                format!("{case}: {nearest:?}, but within {limit:?} {blocked}; {ray:?}")
            });
        }
        let mut check = |name, got, meets: &[bool]| {
            wrong.check(name, got == nearest && meets == blocked, || {
                format!(
                    "{case}: {got:?} {meets:?}, not {nearest:?} {blocked:?} \
                     within {limits:?}; {ray:?}"
                )
            });
        };
        let (name, scene, tree) = &self.tight;
        let tree = tree.tree();
        let got = seen(scene, &tree, ray);
        check(
            name,
            got,
            &limits.map(|limit| meets(scene, &tree, ray, limit)),
        );
        let (name, scene, tree) = &self.packed;
        let tree = tree.tree();
        let got = seen(scene, &tree, ray);
        check(
            name,
            got,
            &limits.map(|limit| meets(scene, &tree, ray, limit)),
        );
        for (name, scene, tree) in &self.octants {
            let tree = tree.tree();
            let got = seen(scene, &tree, ray);
            check(
                name,
                got,
                &limits.map(|limit| meets(scene, &tree, ray, limit)),
            );
        }
    }
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
    let found = tree.any_hit(&scene, ray, limit, &mut A::Stack::default(), &mut ());
    if let Some(object) = found {
        assert!(scene.shapes.hit(object, ray, limit, &mut ()).is_some());
    }
    found.is_some()
}

/// Rays of all kinds that a scene's own planes, corners and surfaces suggest.
struct Shots<'a, S: Quantize> {
    house: &'a House<S>,
    eye: Vec3<S>,
    /// The box around all objects.
    world: Aabb<S>,
}

impl<'a, S: Quantize> Shots<'a, S> {
    fn new(prepared: &Prepared<S>, house: &'a House<S>) -> Self {
        let shapes = prepared.scene.shapes();
        let mut boxes = shapes.refs().map(|object| shapes.bounds(object));
        let first = boxes.next().expect("a scene is never empty");
        let world = boxes.fold(first, |mut all, bounds| {
            for axis in Axis::ALL {
                all.low[axis] = all.low[axis].min(bounds.low[axis]);
                all.high[axis] = all.high[axis].max(bounds.high[axis]);
            }
            all
        });
        Self {
            house,
            eye: prepared.frame.camera().origin,
            world,
        }
    }

    fn next(&mut self, rng: &mut Rng) -> Ray<S> {
        let shapes = self.house.bare.shapes();
        let object = self.house.all[rng.usize(..self.house.all.len())];
        let bounds = shapes.bounds(object);
        match rng.u8(..8) {
            // From anywhere to an object.
            0 => {
                let origin = within(&self.world, rng);
                towards(origin, within(&bounds, rng), rng)
            }
            // From the eye to an object.
            1 => towards(self.eye, within(&bounds, rng), rng),
            // From inside an object's box, or its very middle, anywhere.
            2 => {
                let mut origin = within(&bounds, rng);
                if rng.bool() {
                    for axis in Axis::ALL {
                        origin[axis] = half(bounds.low[axis], bounds.high[axis]);
                    }
                }
                Ray {
                    origin,
                    direction: direction(rng),
                }
            }
            // From the face of a cell, anywhere.
            3 => {
                let mut origin = within(&self.world, rng);
                let axis = Axis::ALL[rng.usize(..3)];
                origin[axis] = self.plane(axis, rng);
                Ray {
                    origin,
                    direction: direction(rng),
                }
            }
            // Along an axis, in the planes of cells or boxes: along edges.
            4 => {
                let mut origin = within(&self.world, rng);
                for axis in Axis::ALL {
                    if rng.u8(..4) > 0 {
                        origin[axis] = self.plane(axis, rng);
                    }
                }
                let mut direction = Vec3::ZERO;
                direction[Axis::ALL[rng.usize(..3)]] = sign(S::ONE, rng);
                Ray { origin, direction }
            }
            // In a plane of a cell, across.
            5 => {
                let mut origin = within(&self.world, rng);
                let mut towards = direction(rng);
                let axis = Axis::ALL[rng.usize(..3)];
                origin[axis] = self.plane(axis, rng);
                towards[axis] = S::ZERO;
                let (a, b) = axis.others();
                if rng.bool() {
                    (origin[a], origin[b]) = (self.plane(a, rng), self.plane(b, rng));
                    (towards[a], towards[b]) = (sign(S::ONE, rng), sign(S::ONE, rng));
                }
                Ray {
                    origin,
                    direction: towards.unit().0,
                }
            }
            // From a surface.
            6 => {
                let ray = towards(self.eye, within(&bounds, rng), rng);
                let list = BruteForce(&self.house.all);
                let scene = self.house.bare.scene();
                let mut origin = within(&self.world, rng);
                if let Some(hit) = list.nearest(&scene, &ray, &mut (), &mut ()) {
                    let contact = shapes.contact(hit.object, &ray, hit.t);
                    origin = match rng.u8(..3) {
                        0 => ray.at(hit.t),
                        1 => contact.point,
                        _ => {
                            let size = contact.point.size();
                            let error = S::surface_error(size, contact.curvature_extent);
                            contact.point + contact.outward * error
                        }
                    };
                }
                Ray {
                    origin,
                    direction: direction(rng),
                }
            }
            // Nearly along an axis: components so small that they hardly count.
            _ => {
                let origin = within(&self.world, rng);
                let mut direction = Vec3::ZERO;
                for axis in Axis::ALL {
                    let small = 10f64.powf(-45.0 * rng.f64());
                    direction[axis] = sign(S::from_f64(small), rng);
                }
                direction[Axis::ALL[rng.usize(..3)]] = sign(S::ONE, rng);
                let direction = direction.unit().0;
                Ray { origin, direction }
            }
        }
    }

    /// A coordinate where a tree's cell or an object's box may end.
    fn plane(&self, axis: Axis, rng: &mut Rng) -> S {
        let shapes = self.house.bare.shapes();
        let object = self.house.all[rng.usize(..self.house.all.len())];
        let bounds = shapes.bounds(object);
        match rng.u8(..4) {
            0 => bounds.low[axis],
            1 => bounds.high[axis],
            _ => {
                let (mut low, mut high) = (
                    self.world.low[axis].to_bound(),
                    self.world.high[axis].to_bound(),
                );
                for _ in 0..rng.u8(..6) {
                    let middle = low.middle(high);
                    if rng.bool() {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                S::from_bound(if rng.bool() { low } else { high })
            }
        }
    }
}

fn half<S: Quantize>(low: S, high: S) -> S {
    S::from_bound(low.to_bound().midpoint(high.to_bound()))
}

fn sign<S: Quantize>(x: S, rng: &mut Rng) -> S {
    if rng.bool() { x } else { -x }
}

fn within<S: Quantize>(bounds: &Aabb<S>, rng: &mut Rng) -> Vec3<S> {
    let mut point = Vec3::ZERO;
    for axis in Axis::ALL {
        let (low, high) = (bounds.low[axis].to_f64(), bounds.high[axis].to_f64());
        point[axis] = S::from_f64(low + (high - low) * rng.f64());
    }
    point
}

fn direction<S: Quantize>(rng: &mut Rng) -> Vec3<S> {
    loop {
        let [x, y, z] = [(); 3].map(|()| 2.0 * rng.f64() - 1.0);
        let square = x * x + y * y + z * z;
        if 0.01 < square && square < 1.0 {
            let [x, y, z] = [x, y, z].map(|c| S::from_f64(c / square.sqrt()));
            return vec3(x, y, z).unit().0;
        }
    }
}

/// A ray to a point; anywhere if it is there already.
fn towards<S: Quantize>(origin: Vec3<S>, to: Vec3<S>, rng: &mut Rng) -> Ray<S> {
    let (unit, length) = (to - origin).unit();
    let direction = if length > S::ZERO {
        unit
    } else {
        direction(rng)
    };
    Ray { origin, direction }
}

/// What was found to be wrong.
#[derive(Default)]
struct Wrong {
    rays: u64,
    hits: u64,
    /// By tree: how many rays, and the first of them.
    by_tree: BTreeMap<&'static str, (u64, String)>,
}

impl Wrong {
    fn check(&mut self, tree: &'static str, right: bool, tell: impl FnOnce() -> String) {
        if !right {
            self.by_tree.entry(tree).or_insert_with(|| (0, tell())).0 += 1;
        }
    }

    fn report(&self, name: &str) {
        println!("{name}: {} rays, {} hits", self.rays, self.hits);
        assert!(self.rays >= 1_000_000 && self.hits * 4 > self.rays);
        let told: Vec<String> = self
            .by_tree
            .iter()
            .map(|(tree, (count, first))| format!("{tree}: {count} rays differ, first {first}"))
            .collect();
        assert!(told.is_empty(), "{name}\n{}", told.join("\n"));
    }
}
