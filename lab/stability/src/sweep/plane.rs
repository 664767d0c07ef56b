//! Planes that are nearly parallel to a ray.

use crate::exact::{Exact, dot, near};
use crate::fixtures::{self, outline, polygon, square};
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::number::{self, Number, counted, exactly, floats, span};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::object::ObjectKind;
use octray_core::ray::Ray;
use octray_core::shape::Plane as CorePlane;

/// Rays along a plane, at a slope of 1 to 10⁻⁷ to it.
#[derive(Debug)]
pub struct Plane;

impl Sweep for Plane {
    const ABOUT: About = About {
        name: "plane",
        title: "Nearly parallel plane",
        axis: "1 / slope of the ray",
        unit: "of the distance",
        values: SEVEN_DECADES,
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "one rounding; compared, then divided",
            },
            Form {
                name: "textbook",
                label: "thesis (2.4): −(N·O + D) times 1/(N·d)",
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
        let mut random = Random::new(7);
        let span = span::<S>();
        let limit = S::from_f64(span / 2.0);
        let corners = square::<S>(0.9 * span);
        for case in 0..48 {
            let normal = random.direction();
            let along = random.across(normal);
            let towards = random::add(along, random::times(normal, 1.0 / value));
            let origin = random::times(random.direction(), 0.1 * span);
            let normal = number::direction::<S>(normal);
            let ray = number::ray(origin, number::direction::<S>(towards));
            // Within the limit, beyond it, or behind.
            let distance = match case % 4 {
                0 | 1 => random.between(0.05, 0.45),
                2 => random.between(0.6, 0.8),
                _ => -random.between(0.1, 0.45),
            } * span;
            let slope = random::dot(floats(normal), floats(ray.direction));
            let above = random::dot(floats(normal), floats(ray.origin));
            let offset = S::from_f64(above + slope * distance);
            let square = outline(normal, offset, &corners);
            let truth = truth(&square.plane, &ray).filter(|t| *t <= limit.exact());
            let shipped = || {
                let shapes = polygon(&square, &corners);
                Some(fixtures::hit(&shapes, ObjectKind::Polygon, &ray, limit)?.0)
            };
            let textbook = || textbook(&square.plane, &ray, limit);
            let found = [counted(shipped), counted(textbook)];
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.saturations += saturations;
                errors.decide(truth.is_some(), found.is_some());
                if let (Some(truth), Some(found)) = (&truth, found) {
                    errors.err(near(&((found.exact() - truth) / truth)));
                }
            }
        }
        all_errors
    }
}

/// Returns where the line intersects the plane, if that is ahead.
pub(super) fn truth<S: Number>(plane: &CorePlane<S>, ray: &Ray<S>) -> Option<Exact> {
    let normal = exactly(plane.normal);
    let rise = dot(&normal, &exactly(ray.direction));
    if rise == Exact::ZERO {
        return None;
    }
    let t = (plane.offset.exact() - dot(&normal, &exactly(ray.origin))) / rise;
    (t > Exact::ZERO).then_some(t)
}

/// The reciprocal is rounded to the format, as on machines without division.
fn textbook<S: Number>(plane: &CorePlane<S>, ray: &Ray<S>, limit: S) -> Option<S> {
    let reciprocal = S::ONE.quotient(plane.normal.dot(ray.direction));
    let t = (plane.offset - plane.normal.dot(ray.origin)) * reciprocal;
    (t > S::ZERO && t <= limit).then_some(t)
}
