//! Every accelerator finds what testing every object finds: the same object at the same distance, bit for
//! bit, in every arithmetic.

#[path = "support/forest.rs"]
mod forest;
#[path = "support/meshes.rs"]
mod meshes;
#[path = "support/rays.rs"]
mod rays;
#[allow(dead_code, unreachable_pub, reason = "other tests share it")]
#[path = "support/strew.rs"]
mod strew;

use fastrand::Rng;
use forest::{Forest, Wrong};
use meshes::Mesh;
use octray_core::accel::{Accelerator, BruteForce};
use octray_core::object::ObjectRef;
use octray_core::quantize::Quantize;
use octray_core::ray::Ray;
use octray_core::scalar::{Approx, Fixed, Fixed64};
use octray_core::trace::{QueuedRay, Tracer, Workspace};
use octray_core::vec3::Axis;
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Prepared, Quantised, quantise};
use octray_prepare::saturation::PerThread;
use octray_scenes::generate::{SceneKind, Spec};
use octray_scenes::model::Scene;
use rays::{Rays, sign};

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
        mod no_ray_passes_between {
            use super::*;
            $(#[test] fn $name() { no_ray_passes_between::<$s>(); })*
        }
    };
}

in_every_arithmetic! {
    f64: f64, f32: f32,
    approx0: Approx<0>, approx1: Approx<1>, approx2: Approx<2>,
    i24f8: Fixed<8, PerThread>, i20f12: Fixed<12, PerThread>, i16f16: Fixed<16, PerThread>,
    i12f20: Fixed<20, PerThread>, i8f24: Fixed<24, PerThread>, i4f28: Fixed<28, PerThread>,
    i4f28_unchecked: Fixed<28>, i32f32: Fixed64<PerThread>,
}

fn rays_meet_the_same<S: Quantize>() {
    let mut wrong = Wrong::default();
    for seed in 0..SCENES {
        let prepared = prepare::<S>(seed);
        let forest = Forest::new(&prepared.scene, seed);
        let mut rng = Rng::with_seed(seed);
        let rays = Rays::new(&prepared, &forest.all);
        for number in 0..RAYS {
            let ray = rays.next(&mut rng);
            forest.compare(
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
        let forest = Forest::new(&prepared.scene, seed);
        let scenes = forest.octrees.iter().map(|(_, scene, _)| scene);
        let trees = forest.octrees.iter().map(|(_, _, tree)| tree.tree());
        let mut memory = Memory::new();
        for _ in 0..1000 {
            let mut ray = Ray::<S>::default();
            for axis in Axis::ALL {
                ray.origin[axis] = extreme(&mut rng);
                ray.direction[axis] = extreme(&mut rng);
            }
            let limit = extreme(&mut rng);
            shoot(
                &forest.bare,
                &BruteForce(&forest.all),
                ray,
                limit,
                &mut memory,
            );
            let (_, scene, tree) = &forest.bvh8;
            shoot(scene, &tree.tree(), ray, limit, &mut memory);
            let (_, scene, tree) = &forest.compact;
            shoot(scene, &tree.tree(), ray, limit, &mut memory);
            for (scene, tree) in scenes.clone().zip(trees.clone()) {
                shoot(scene, &tree, ray, limit, &mut memory);
            }
        }
    }
}

/// Polygons that share an edge leave no gap there, in any tree.
fn no_ray_passes_between<S: Quantize>() {
    let mut wrong = Wrong::default();
    let mut first = None;
    for seed in 0..180 {
        let mesh = Mesh::new(seed);
        let prepared = parsed::<S>(&mesh.text);
        let forest = Forest::new(&prepared.scene, seed);
        let mut rng = Rng::with_seed(seed);
        for number in 0..400 {
            let ray = mesh.ray::<S>(&prepared.world, &mut rng);
            let case = format!("mesh {seed}, ray {number}");
            let hits = wrong.hits;
            forest.compare(&ray, &mut rng, &mut wrong, &case);
            if wrong.hits == hits {
                first.get_or_insert(format!("{case}: {ray:?}"));
            }
        }
    }
    let missed = wrong.rays - wrong.hits;
    assert_eq!(missed, 0, "of {} rays; first {first:?}", wrong.rays);
    wrong.agree(S::NAME);
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
    // With the observer of all other tests, so that each walk is compiled once.
    let colour = tracer.radiance(ray, &mut workspace, &mut ());
    let _ = colour.to_array().map(S::level);
    tree.any_hit(&scene, &ray, limit, None, &mut stack, &mut ());
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
    if seed % 8 != 7 {
        return parsed(&strew::objects(seed));
    }
    let spec = Spec {
        kind: SceneKind::Soup,
        objects: 10 + seed as usize % 90,
    };
    quantised(&octray_scenes::generate(spec, seed))
}

fn parsed<S: Quantize>(text: &str) -> Prepared<S> {
    let scene = octray_scenes::parse(text);
    quantised(&scene.unwrap_or_else(|error| panic!("{}", error.draw("strewn", text))))
}

fn quantised<S: Quantize>(scene: &Scene) -> Prepared<S> {
    let view = RenderSettings {
        size: Some((8, 8)),
        ..RenderSettings::DEFAULT
    };
    quantise::<S>(scene, &view).expect("the scene fits every format")
}
