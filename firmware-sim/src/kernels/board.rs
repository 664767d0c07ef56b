//! Calls every kernel on all its inputs, by an address that the compiler does not know, and prints what the counts do
//! not contain: the number format, hits, and steps.

#[cfg(target_arch = "arm")]
#[path = "../board/cortex_m.rs"]
mod cortex_m;
mod inputs;
mod kernels;
#[path = "../board/print.rs"]
#[expect(dead_code, reason = "pictures have a hash")]
mod print;
#[cfg(target_arch = "riscv32")]
#[path = "../board/riscv.rs"]
mod riscv;

use crate::baked::{S, SCENE, TREE, Tree};
use core::hint::black_box;
use inputs::{NARROW, WIDE, aimed, numbers, pairs, vectors};
use kernels::{Shapes, Stack, Walk};
use octray_core::accel::Accelerator;
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::ray::Ray;
use octray_embedded::marks;
use octray_embedded::tally::Tally;
use semihosting::process::exit;

/// Calls the kernels, reports, exits.
fn run() -> ! {
    marks::begin();
    arithmetic();
    let hits = ObjectKind::ALL.map(shape);
    let steps = tree();
    lights();
    marks::end();
    print::text("arith ");
    print::text(crate::baked::ARITH);
    for (name, hits) in ["sphere", "triangle", "polygon", "cone", "box"]
        .iter()
        .zip(hits)
    {
        print::number(name, hits);
    }
    print::number("steps", steps);
    print::text("\n");
    exit(0)
}

/// Says that an exception was taken.
fn fault() -> ! {
    print::text("fault\n");
    exit(102)
}

/// Runs operations on numbers and vectors.
fn arithmetic() {
    let binary: [fn(S, S) -> S; 4] = [
        kernels::kernel_empty,
        kernels::kernel_add,
        kernels::kernel_mul,
        kernels::kernel_div,
    ];
    for kernel in binary.map(black_box) {
        for (a, b) in pairs() {
            black_box(kernel(black_box(a), black_box(b)));
        }
    }
    let unary: [fn(S) -> S; 2] = [kernels::kernel_sqrt, kernels::kernel_inverse_sqrt];
    for kernel in unary.map(black_box) {
        for x in numbers() {
            black_box(kernel(black_box(x)));
        }
    }
    let (dot, normalise) = (
        kernels::kernel_dot as kernels::Dot,
        kernels::kernel_normalise as kernels::Unit,
    );
    let (dot, normalise) = (black_box(dot), black_box(normalise));
    for (a, b) in vectors() {
        black_box(dot(black_box(&a), black_box(&b)));
        black_box(normalise(black_box(&a)));
    }
}

/// Runs the hit test of one kind of shape, on rays of which some hit. Returns the number of hits.
fn shape(kind: ObjectKind) -> u32 {
    let kernel: fn(&Shapes, usize, &Ray<S>) -> Option<S> = match kind {
        ObjectKind::Sphere => kernels::kernel_sphere,
        ObjectKind::Triangle => kernels::kernel_triangle,
        ObjectKind::Polygon => kernels::kernel_polygon,
        ObjectKind::Cone => kernels::kernel_cone,
        ObjectKind::Cuboid => kernels::kernel_box,
    };
    let kernel = black_box(kernel);
    let shapes = black_box(&SCENE.shapes);
    let mut hits = 0;
    for i in 0..shapes.count(kind) {
        for ray in aimed(ObjectRef::new(kind, i as u32), WIDE) {
            hits += u32::from(kernel(shapes, black_box(i), black_box(&ray)).is_some());
        }
    }
    hits
}

/// Runs traversals of the tree that reach no object, and the same as far as the root. Returns the steps beyond the
/// root.
fn tree() -> u32 {
    let [walk, root] = [kernels::kernel_walk as Walk, kernels::kernel_root as Walk].map(black_box);
    let (scene, tree) = (black_box(&SCENE), black_box(&TREE));
    let root_alone = tree.root_alone();
    let trunk = black_box(&root_alone);
    let mut stack = Stack::default();
    let mut steps = 0;
    for ray in scene.shapes.refs().flat_map(|object| aimed(object, WIDE)) {
        let mut tally = Tally::default();
        tree.nearest(scene, &ray, &mut stack, &mut tally);
        if tally.tests == 0 && tally.steps > 1 {
            steps += tally.steps - 1;
            black_box(walk(tree, black_box(&ray), &mut stack));
            black_box(root(trunk, black_box(&ray), &mut stack));
        }
    }
    steps
}

/// Shades surfaces in the light of one lamp and of two.
fn lights() {
    let kernels = [
        kernels::kernel_one_light as kernels::Lit,
        kernels::kernel_two_lights as kernels::Lit,
    ];
    let [one, two] = kernels.map(black_box);
    let scene = black_box(&SCENE);
    for i in 0..scene.shapes.count(ObjectKind::Sphere) {
        let sphere = ObjectRef::new(ObjectKind::Sphere, i as u32);
        for ray in aimed(sphere, NARROW) {
            black_box(one(scene, sphere, black_box(&ray)));
            black_box(two(scene, sphere, black_box(&ray)));
        }
    }
}
