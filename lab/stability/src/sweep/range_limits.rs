//! Objects at the limits of a format's range.

use super::{slab, sphere};
use crate::exact::{Exact, near};
use crate::fixtures;
use crate::method::{About, Form, SHIPPED, Sweep};
use crate::number::{self, Number, counted, vector};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::object::ObjectKind;
use octray_core::ray::Ray;
use octray_core::shape;
use octray_core::vec3::Axis;
use octray_scenes::model::Shape;

/// A box as large as the scene and a sphere in its corner, seen from the opposite corner, in scenes of 1 to almost 2
/// units: any size is scaled by a power of two. Some rays go along the faces of the box, which is the root of an
/// octree.
#[derive(Debug)]
pub struct RangeLimits;

impl Sweep for RangeLimits {
    const ABOUT: About = About {
        name: "arena",
        title: "At the edge of the scene",
        axis: "size of the scene",
        unit: "of the scene in t",
        values: &[
            1.0, 1.1, 1.15, 1.2, 1.3, 1.33, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 1.99, 1.999,
        ],
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "one and a half diagonals fit the format",
            },
            Form {
                name: "coordinates",
                label: "only coordinates fit the format",
            },
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            error: Some(limit(0.01, 0.25)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        Setting::of(block(value), [0.49 * value; 3]).and(ball(value))
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let Some(prepared) = Self::setting(value).prepare::<S>() else {
            return all_errors;
        };
        let exponent = match S::FRACTION_BITS {
            Some(_) => libm::floor(libm::log2(S::MAX.to_f64() / (value / 2.0))),
            None => 0.0,
        };
        let scales = [prepared.world.scale(), libm::exp2(exponent)];
        for (scale, errors) in scales.into_iter().zip(&mut all_errors) {
            measure::<S>(value * scale, errors);
        }
        all_errors
    }
}

const RADIUS: f64 = 0.1;

fn block(size: f64) -> Shape {
    Shape::Cuboid {
        centre: [0.0; 3],
        size: [size; 3],
    }
}

fn ball(size: f64) -> Shape {
    Shape::Sphere {
        centre: [-(0.5 - RADIUS) * size; 3],
        radius: RADIUS * size,
    }
}

/// Measures in a scene of this size in a format's numbers.
fn measure<S: Number>(size: f64, errors: &mut ErrorStats) {
    let mut random = Random::new(17);
    let block = shape::Cuboid {
        low: vector::<S>([-size / 2.0; 3]),
        high: vector([size / 2.0; 3]),
    };
    let ball = shape::Sphere {
        centre: vector::<S>([-(0.5 - RADIUS) * size; 3]),
        radius: S::from_f64(RADIUS * size),
    };
    let mut take = |truth: Option<Exact>, found: (Option<S>, u32)| {
        errors.saturations += found.1;
        let found = found.0;
        errors.decide(truth.is_some(), found.is_some());
        if let (Some(truth), Some(found)) = (truth, found) {
            errors.err(near(&(found.exact() - truth)) / size);
        }
    };
    for case in 0..48 {
        let corner = [0.49 * size; 3];
        // At the ball or past it, and at the faces behind it.
        let off = random::times(random.direction(), random.between(0.0, 0.15) * size);
        let aim = random::add([-0.4 * size; 3], off);
        let towards = number::direction::<S>(random::add(aim, random::times(corner, -1.0)));
        let ray = number::ray(corner, towards);
        let hit = |ray: &Ray<S>| {
            Some(fixtures::hit(&fixtures::sphere(&ball), ObjectKind::Sphere, ray, S::MAX)?.0)
        };
        take(
            sphere::truth(&ball, &ray).map(|(t, _)| t),
            counted(|| hit(&ray)),
        );
        let hit = |ray: &Ray<S>| {
            Some(fixtures::hit(&fixtures::cuboid(&block), ObjectKind::Cuboid, ray, S::MAX)?.0)
        };
        take(slab::truth(&block, &ray), counted(|| hit(&ray)));
        let along = along(&block, case, &mut random);
        take(slab::truth(&block, &along), counted(|| hit(&along)));
    }
}

/// Returns a ray in the plane of a face, from one edge to the opposite one.
fn along<S: Number>(block: &shape::Cuboid<S>, case: usize, random: &mut Random) -> Ray<S> {
    let axis = Axis::ALL[case % 3];
    let across = axis.others();
    let mut ray = Ray::new(block.low, vector([0.0; 3]));
    ray.direction[axis] = S::ONE;
    ray.origin[across.0] = if case.is_multiple_of(2) {
        block.low
    } else {
        block.high
    }[across.0];
    ray.origin[across.1] = S::from_f64(random.between(-0.9, 0.9) * block.high.x.to_f64());
    ray
}
