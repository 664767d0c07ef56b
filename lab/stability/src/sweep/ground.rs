//! A huge sphere as the ground.

use super::sphere::{compare, stable, textbook};
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::number::{self, Number, span, vector};
use crate::random::Random;
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::ray::Ray;
use octray_core::shape;
use octray_core::vec3::Vec3;

/// A ground sphere whose radius is 1 to 10⁷ times the height of the eye.
#[derive(Debug)]
pub struct Ground;

impl Sweep for Ground {
    const ABOUT: About = About {
        name: "ground",
        title: "Huge sphere as the ground",
        axis: "radius / height of the eye",
        unit: "heights in t",
        values: SEVEN_DECADES,
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "discriminant from the perpendicular vector",
            },
            Form {
                name: "textbook",
                label: "thesis (2.8): b² − c",
            },
            Form {
                name: "c/q",
                label: "the near root as c / (b + √disc)",
            },
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            error: Some(limit(0.01, 0.25)),
            angle: Some(limit(0.02, 0.25)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        Setting::sphere(value, value + 1.0)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 3];
        let mut random = Random::new(2);
        // The scene contains the whole sphere and the eye above it.
        let radius = span::<S>() / (2.0 + 1.0 / value);
        let height = radius / value;
        let sphere = shape::Sphere {
            centre: vector([0.0; 3]),
            radius: S::from_f64(radius),
        };
        for _ in 0..48 {
            let x = random.between(-0.1, 0.1) * height;
            let origin = [x, radius + height, -x];
            // Downward at 30 to 90 degrees, or upward.
            let mut towards = random.direction();
            towards[1] = -random.between(0.5, 1.0);
            if random.between(0.0, 1.0) < 0.25 {
                towards[1] = -towards[1];
            }
            let ray = number::ray(origin, number::direction::<S>(towards));
            compare(
                &sphere,
                &ray,
                &mut all_errors,
                &[stable, textbook, quotient],
            );
        }
        for errors in &mut all_errors {
            errors.error = (errors.error * value).min(ErrorStats::LARGEST);
        }
        all_errors
    }
}

/// Returns the near root as the product of both roots divided by the far one.
fn quotient<S: Number>(sphere: &shape::Sphere<S>, ray: &Ray<S>) -> Option<(S, Vec3<S>)> {
    let to_centre = sphere.centre - ray.origin;
    let b = to_centre.dot(ray.direction);
    let apart = to_centre - ray.direction * b;
    let discriminant = S::product(sphere.radius, sphere.radius) - apart.dot_wide(apart);
    if discriminant < S::product(S::ZERO, S::ZERO) {
        return None;
    }
    let far = b + S::sqrt_wide(discriminant);
    // |to centre|² − r² as a product of lengths.
    let (_, distance) = to_centre.unit();
    let (above, sum) = (distance - sphere.radius, distance + sphere.radius);
    let near = above * sum.quotient(far);
    let t = if near > S::ZERO { near } else { far };
    (t > S::ZERO).then(|| (t, (ray.at(t) - sphere.centre).unit().0))
}
