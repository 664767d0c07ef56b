//! Rays of all kinds that a scene's own planes, corners and surfaces suggest.

use fastrand::Rng;
use octray_core::accel::{Accelerator, BoundScalar, BruteForce};
use octray_core::object::ObjectRef;
use octray_core::quantize::Quantize;
use octray_core::ray::{Aabb, Departure, Ray};
use octray_core::vec3::{Axis, Vec3, vec3};
use octray_prepare::quantise::{Prepared, Quantised};

/// Makes rays for one scene.
pub(crate) struct Rays<'a, S: Quantize> {
    scene: &'a Quantised<S>,
    objects: &'a [ObjectRef],
    eye: Vec3<S>,
    /// The box around all objects.
    world: Aabb<S>,
}

impl<'a, S: Quantize> Rays<'a, S> {
    /// Rays for a scene of which these are all the objects.
    pub(crate) fn new(prepared: &'a Prepared<S>, objects: &'a [ObjectRef]) -> Self {
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
            scene: &prepared.scene,
            objects,
            eye: prepared.frame.camera().origin,
            world,
        }
    }

    /// Another ray.
    pub(crate) fn next(&self, rng: &mut Rng) -> Ray<S> {
        let shapes = self.scene.shapes();
        let object = self.objects[rng.usize(..self.objects.len())];
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
                Ray::new(origin, direction(rng))
            }
            // From the face of a cell, anywhere.
            3 => {
                let mut origin = within(&self.world, rng);
                let axis = Axis::ALL[rng.usize(..3)];
                origin[axis] = self.plane(axis, rng);
                Ray::new(origin, direction(rng))
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
                Ray::new(origin, direction)
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
                Ray::new(origin, towards.unit().0)
            }
            // From a surface.
            6 => {
                let ray = towards(self.eye, within(&bounds, rng), rng);
                let list = BruteForce(self.objects);
                let scene = self.scene.scene();
                let mut ray_from = Ray::new(within(&self.world, rng), direction(rng));
                if let Some(hit) = list.nearest(&scene, &ray, &mut (), &mut ()) {
                    let contact = shapes.contact(hit.object, &ray, hit.t);
                    let size = contact.point.size();
                    let error = S::surface_error(size, contact.curvature_extent);
                    ray_from.origin = match rng.u8(..4) {
                        0 => ray.at(hit.t),
                        1 => contact.point,
                        2 => contact.point + contact.outward * error,
                        _ => contact.point - contact.outward * error,
                    };
                    if rng.bool() {
                        ray_from.from = Departure::new(hit.object, rng.bool());
                    }
                }
                ray_from
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
                Ray::new(origin, direction)
            }
        }
    }

    /// A coordinate where a tree's cell or an object's box may end.
    fn plane(&self, axis: Axis, rng: &mut Rng) -> S {
        let shapes = self.scene.shapes();
        let object = self.objects[rng.usize(..self.objects.len())];
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
                    let middle = low.midpoint(high);
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

/// `x` or its opposite.
pub(crate) fn sign<S: Quantize>(x: S, rng: &mut Rng) -> S {
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
    Ray::new(origin, direction)
}
