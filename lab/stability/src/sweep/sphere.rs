//! A sphere seen from far away.

use crate::exact::{Exact, Exact3, add, angle, dot, exact, near, root, sub, times};
use crate::fixtures;
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::number::{self, Number, counted, exactly, floats, span, vector};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::object::ObjectKind;
use octray_core::ray::Ray;
use octray_core::shape;
use octray_core::vec3::Vec3;

/// Rays that pass a sphere's centre at 0 to 2 radii (see `AIMS`), from a distance of 2 to 10⁷ radii.
#[derive(Debug)]
pub struct Sphere;

/// Distances between the rays and the centre, in radii.
const AIMS: [f64; 8] = [0.0, 0.3, 0.5, 0.8, 0.9, 1.1, 1.3, 2.0];

impl Sweep for Sphere {
    const ABOUT: About = About {
        name: "sphere",
        title: "Sphere from far away",
        axis: "distance / radius",
        unit: "radii in t",
        values: SEVEN_DECADES.split_at(1).1,
        home: 2.0,
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
                name: "twice",
                label: "closest approach found twice",
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
        Setting::sphere(1.0, value)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 3];
        let mut random = Random::new(1);
        let distance = span::<S>() / 2.0;
        let radius = S::from_f64(distance / value);
        for aim in AIMS.repeat(6) {
            let towards = random.direction();
            let aside = random.across(towards);
            let direction = number::direction::<S>(towards);
            let sphere = shape::Sphere {
                centre: vector(random::times(towards, distance / 2.0)),
                radius,
            };
            // The target is placed along the rounded direction; otherwise all rays would miss from far away.
            let back = random::times(floats(direction), -distance);
            let off = random::times(aside, aim * radius.to_f64());
            let origin = random::add(floats(sphere.centre), random::add(back, off));
            let ray = number::ray(origin, direction);
            compare(&sphere, &ray, &mut all_errors, &[stable, textbook, twice]);
        }
        all_errors
    }
}

/// A form: returns the distance of the hit and the unit normal there.
pub(super) type Hit<S> = fn(&shape::Sphere<S>, &Ray<S>) -> Option<(S, Vec3<S>)>;

/// Measures forms on one ray. The unit of errors in t is the radius.
pub(super) fn compare<S: Number>(
    sphere: &shape::Sphere<S>,
    ray: &Ray<S>,
    all_errors: &mut [ErrorStats],
    forms: &[Hit<S>],
) {
    let truth = truth(sphere, ray);
    for (form, errors) in forms.iter().zip(all_errors) {
        let (found, saturations) = counted(|| form(sphere, ray));
        errors.saturations += saturations;
        errors.decide(truth.is_some(), found.is_some());
        if let (Some((t, normal)), Some((found_t, found_normal))) = (&truth, found) {
            errors.err(near(&((found_t.exact() - t) / sphere.radius.exact())));
            errors.turn(angle(normal, &exactly(found_normal)));
        }
    }
}

/// Returns the parameter of the first hit at t > 0, and the outward normal, not normalised.
pub(super) fn truth<S: Number>(sphere: &shape::Sphere<S>, ray: &Ray<S>) -> Option<(Exact, Exact3)> {
    let (origin, direction) = (exactly(ray.origin), exactly(ray.direction));
    let (centre, radius) = (exactly(sphere.centre), sphere.radius.exact());
    let to_centre = sub(&centre, &origin);
    let a = dot(&direction, &direction);
    let b = dot(&direction, &to_centre);
    let c = dot(&to_centre, &to_centre) - &radius * &radius;
    let discriminant = &b * &b - &a * c;
    if discriminant < Exact::ZERO {
        return None;
    }
    let half_chord = root(&discriminant);
    let first = (&b - &half_chord) / &a;
    let t = if first > Exact::ZERO {
        first
    } else {
        (b + half_chord) / a
    };
    (t > exact(0.0)).then(|| {
        let point = add(&origin, &times(&direction, &t));
        (t, sub(&point, &centre))
    })
}

/// Applies octray's method.
pub(super) fn stable<S: Number>(sphere: &shape::Sphere<S>, ray: &Ray<S>) -> Option<(S, Vec3<S>)> {
    fixtures::hit(&fixtures::sphere(sphere), ObjectKind::Sphere, ray, S::MAX)
}

/// Computes thesis (2.8). The difference is computed in the wide type, to give fixed point a chance.
pub(super) fn textbook<S: Number>(sphere: &shape::Sphere<S>, ray: &Ray<S>) -> Option<(S, Vec3<S>)> {
    let to_centre = sphere.centre - ray.origin;
    let b = to_centre.dot(ray.direction);
    let c = to_centre.dot_wide(to_centre) - S::product(sphere.radius, sphere.radius);
    let discriminant = S::product(b, b) - c;
    if discriminant < S::product(S::ZERO, S::ZERO) {
        return None;
    }
    let half_chord = S::sqrt_wide(discriminant);
    let near = b - half_chord;
    let t = if near > S::ZERO { near } else { b + half_chord };
    (t > S::ZERO).then(|| (t, (ray.at(t) - sphere.centre).unit().0))
}

/// The shipped form with a second step to the closest approach. The step removes the error that the first one has when
/// the direction is not exactly a unit vector.
fn twice<S: Number>(sphere: &shape::Sphere<S>, ray: &Ray<S>) -> Option<(S, Vec3<S>)> {
    let to_centre = sphere.centre - ray.origin;
    let first = to_centre.dot(ray.direction);
    let rest = to_centre - ray.direction * first;
    let second = rest.dot(ray.direction);
    let apart = rest - ray.direction * second;
    let discriminant = S::product(sphere.radius, sphere.radius) - apart.dot_wide(apart);
    if discriminant < S::product(S::ZERO, S::ZERO) {
        return None;
    }
    let half_chord = S::sqrt_wide(discriminant);
    let middle = first + second;
    let near = middle - half_chord;
    let (t, from_middle) = if near > S::ZERO {
        (near, second - half_chord)
    } else {
        (middle + half_chord, second + half_chord)
    };
    // Relative to the first approach, so what is added is small.
    let normal = ray.direction * from_middle - rest;
    (t > S::ZERO).then(|| (t, normal.unit().0))
}
