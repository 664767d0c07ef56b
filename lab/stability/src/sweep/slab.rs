//! Boxes: rays along their faces, and past their edges and corners.

use crate::exact::{Exact, exact, near};
use crate::fixtures::{cuboid, hit};
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::number::{self, Number, counted, exactly, floats, span, vector};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::object::ObjectKind;
use octray_core::ray::Ray;
use octray_core::shape::Cuboid;
use octray_core::vec3::Axis;

/// Rays at a slope of 1 to 10⁻⁷ to a face of a box, aimed just inside and outside of its edges and corners. Every
/// fourth ray goes along the face, exactly in its plane or one step beside it.
#[derive(Debug)]
pub struct Slab;

impl Sweep for Slab {
    const ABOUT: About = About {
        name: "slab",
        title: "Box along its faces",
        axis: "1 / slope against the face",
        unit: "sides in t",
        values: SEVEN_DECADES,
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "no quotient along a slab; ties are inside",
            },
            Form {
                name: "textbook",
                label: "times 1/d, a number of the format",
            },
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            error: Some(limit(0.01, 0.25)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        Setting::pixel(1.0 / value)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let mut random = Random::new(9);
        let span = span::<S>();
        let half = span / 16.0;
        for case in 0..64 {
            let block = Cuboid {
                low: vector([-half; 3]),
                high: vector([half; 3]),
            };
            let ray = if case % 4 == 0 {
                along(&block, case / 4, &mut random)
            } else {
                // A point inside or outside of an edge or a corner.
                let off = half * if case % 2 == 0 { 0.99 } else { 1.01 };
                let third = if case % 8 < 4 { off } else { 0.3 * half };
                let edge = [off, half * random.between(-0.9, 0.9), third];
                let slope = 1.0 / value;
                let towards = [-slope, random.between(-0.7, 0.7), -1.0];
                let direction = number::direction::<S>(towards);
                let back = random::times(floats(direction), -span / 4.0);
                number::ray(random::add(edge, back), direction)
            };
            let truth = truth(&block, &ray);
            let shipped = || Some(hit(&cuboid(&block), ObjectKind::Cuboid, &ray, S::MAX)?.0);
            let found = [counted(shipped), counted(|| textbook(&block, &ray))];
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.saturations += saturations;
                errors.decide(truth.is_some(), found.is_some());
                if let (Some(truth), Some(found)) = (&truth, found) {
                    errors.err(near(&(found.exact() - truth)) / (2.0 * half));
                }
            }
        }
        all_errors
    }
}

/// Returns a ray in the plane of a face, or a thousandth beside it.
fn along<S: Number>(block: &Cuboid<S>, case: usize, random: &mut Random) -> Ray<S> {
    let half = block.high.x.to_f64();
    let beside = [1.0, -1.0, 1.001, 0.999][case % 4] * half;
    let height = half * random.between(-0.9, 0.9);
    number::ray([beside, height, 4.0 * half], vector([0.0, 0.0, -1.0]))
}

/// Returns the first intersection ahead with the closed box.
pub(super) fn truth<S: Number>(block: &Cuboid<S>, ray: &Ray<S>) -> Option<Exact> {
    let (origin, direction) = (exactly(ray.origin), exactly(ray.direction));
    let (low, high) = (exactly(block.low), exactly(block.high));
    let (mut entry, mut exit) = (exact(f64::MIN), exact(f64::MAX));
    for axis in 0..3 {
        if direction[axis] == Exact::ZERO {
            if origin[axis] < low[axis] || origin[axis] > high[axis] {
                return None;
            }
            continue;
        }
        let a = (&low[axis] - &origin[axis]) / &direction[axis];
        let b = (&high[axis] - &origin[axis]) / &direction[axis];
        let (first, last) = if a < b { (a, b) } else { (b, a) };
        entry = entry.max(first);
        exit = exit.min(last);
    }
    let t = if entry > Exact::ZERO {
        entry.clone()
    } else {
        exit.clone()
    };
    (entry <= exit && t > Exact::ZERO).then_some(t)
}

/// Computes Kay and Kajiya's slabs with precomputed reciprocals of the direction.
fn textbook<S: Number>(block: &Cuboid<S>, ray: &Ray<S>) -> Option<S> {
    let (mut entry, mut exit) = (-S::MAX, S::MAX);
    for axis in Axis::ALL {
        let reciprocal = S::ONE.quotient(ray.direction[axis]);
        let a = (block.low[axis] - ray.origin[axis]) * reciprocal;
        let b = (block.high[axis] - ray.origin[axis]) * reciprocal;
        entry = entry.max(a.min(b));
        exit = exit.min(a.max(b));
    }
    let t = if entry > S::ZERO { entry } else { exit };
    (entry <= exit && t > S::ZERO).then_some(t)
}
