//! The kernels. Each is a function of its own, which is found by its name. Numbers are passed in registers, vectors and
//! rays in memory.

use crate::baked::{FEATURES, S, SCENE, Tree};
use core::hint::black_box;
use octray_core::accel::{Accelerator, Hit};
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::observe::Observer;
use octray_core::ray::Ray;
use octray_core::scalar::Scalar;
use octray_core::scene;
use octray_core::shape;
use octray_core::trace::{Tracer, Workspace};
use octray_core::vec3::Vec3;

pub(super) type Scene = scene::Scene<'static, S, FEATURES>;
pub(super) type Shapes = shape::Shapes<'static, S, FEATURES>;
pub(super) type Dot = fn(&Vec3<S>, &Vec3<S>) -> S;
pub(super) type Unit = fn(&Vec3<S>) -> Vec3<S>;
pub(super) type Found = Option<Hit<S>>;
pub(super) type Stack = <Tree as Accelerator<S, FEATURES>>::Stack;
pub(super) type Walk = fn(&Tree, &Ray<S>, &mut Stack) -> Found;
pub(super) type Lit = fn(&Scene, ObjectRef, &Ray<S>) -> Vec3<S>;

/// Only returns.
#[inline(never)]
pub(super) fn kernel_empty(a: S, _: S) -> S {
    a
}

#[inline(never)]
pub(super) fn kernel_add(a: S, b: S) -> S {
    a + b
}

#[inline(never)]
pub(super) fn kernel_mul(a: S, b: S) -> S {
    a * b
}

#[inline(never)]
pub(super) fn kernel_div(a: S, b: S) -> S {
    a.quotient(b)
}

#[inline(never)]
pub(super) fn kernel_sqrt(x: S) -> S {
    x.sqrt()
}

#[inline(never)]
pub(super) fn kernel_inverse_sqrt(x: S) -> S {
    S::ONE.quotient(x.sqrt())
}

#[inline(never)]
pub(super) fn kernel_dot(a: &Vec3<S>, b: &Vec3<S>) -> S {
    a.dot(*b)
}

#[inline(never)]
pub(super) fn kernel_normalise(v: &Vec3<S>) -> Vec3<S> {
    v.unit().0
}

#[inline(never)]
pub(super) fn kernel_sphere(shapes: &Shapes, i: usize, ray: &Ray<S>) -> Option<S> {
    hit(shapes, ObjectKind::Sphere, i, ray)
}

#[inline(never)]
pub(super) fn kernel_triangle(shapes: &Shapes, i: usize, ray: &Ray<S>) -> Option<S> {
    hit(shapes, ObjectKind::Triangle, i, ray)
}

#[inline(never)]
pub(super) fn kernel_polygon(shapes: &Shapes, i: usize, ray: &Ray<S>) -> Option<S> {
    hit(shapes, ObjectKind::Polygon, i, ray)
}

#[inline(never)]
pub(super) fn kernel_cone(shapes: &Shapes, i: usize, ray: &Ray<S>) -> Option<S> {
    hit(shapes, ObjectKind::Cone, i, ray)
}

#[inline(never)]
pub(super) fn kernel_box(shapes: &Shapes, i: usize, ray: &Ray<S>) -> Option<S> {
    hit(shapes, ObjectKind::Cuboid, i, ray)
}

#[inline(always)]
fn hit(shapes: &Shapes, kind: ObjectKind, i: usize, ray: &Ray<S>) -> Option<S> {
    shapes.hit(ObjectRef::new(kind, i as u32), ray, SCENE.diameter, &mut ())
}

/// Searches the whole tree. The barriers here and in the next function keep the two from being merged.
#[inline(never)]
pub(super) fn kernel_walk(tree: &Tree, ray: &Ray<S>, stack: &mut Stack) -> Found {
    black_box(1u32);
    tree.nearest(&SCENE, ray, stack, &mut ())
}

/// The same, for a tree that consists of the root only.
#[inline(never)]
pub(super) fn kernel_root(tree: &Tree, ray: &Ray<S>, stack: &mut Stack) -> Found {
    black_box(2u32);
    tree.nearest(&SCENE, ray, stack, &mut ())
}

/// Shades a surface with the first of the scene's lights.
#[inline(never)]
pub(super) fn kernel_one_light(scene: &Scene, object: ObjectRef, ray: &Ray<S>) -> Vec3<S> {
    lit(scene, 1, object, ray)
}

/// The same with two lights.
#[inline(never)]
pub(super) fn kernel_two_lights(scene: &Scene, object: ObjectRef, ray: &Ray<S>) -> Vec3<S> {
    lit(scene, 2, object, ray)
}

#[inline(never)]
fn lit(scene: &Scene, lights: usize, object: ObjectRef, ray: &Ray<S>) -> Vec3<S> {
    let lights = scene.lights.get(..lights).unwrap_or_default();
    let tracer = Tracer {
        scene: &Scene { lights, ..*scene },
        accelerator: &Alone(object),
        max_depth: 0,
        cut_off: S::ZERO,
    };
    let mut workspace = Workspace {
        rays: &mut [],
        stack: &mut (),
        shadow_cache: &mut [],
    };
    tracer.radiance(*ray, &mut workspace, &mut ())
}

/// A single object without shadows.
struct Alone(ObjectRef);

impl Accelerator<S, FEATURES> for Alone {
    type Stack = ();

    fn nearest<O: Observer>(
        &self,
        scene: &scene::Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        (): &mut (),
        _: &mut O,
    ) -> Option<Hit<S>> {
        let t = scene.shapes.hit(self.0, ray, scene.diameter, &mut ())?;
        Some(Hit { t, object: self.0 })
    }

    // The ray is computed, though it is not traced.
    fn any_hit<O: Observer>(
        &self,
        _: &scene::Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        limit: S,
        _: Option<&scene::Light<S>>,
        (): &mut (),
        _: &mut O,
    ) -> Option<ObjectRef> {
        black_box((ray, limit));
        None
    }
}
