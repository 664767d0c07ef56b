//! Surfaces close to each other, and surfaces in the same place.

use crate::method::{About, Form, SHIPPED, Sweep};
use crate::number::{self, Number, counted};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::accel::{Accelerator, BruteForce};
use octray_core::object::ObjectRef;
use octray_core::ray::Ray;
use octray_prepare::quantise::Prepared;
use octray_scenes::model::Shape;

/// Two spheres or two squares, one of them 10⁻¹ to 10⁻⁷ of their size above the other, or both in the same place, where
/// the first in the file counts. A hit means the right one.
#[derive(Debug)]
pub struct Coincident;

impl Sweep for Coincident {
    const ABOUT: About = About {
        name: "coincident",
        title: "Coincident surfaces",
        axis: "size / gap between surfaces; last: none",
        unit: "",
        values: &[
            1e1,
            2e1,
            5e1,
            1e2,
            2e2,
            5e2,
            1e3,
            2e3,
            5e3,
            1e4,
            2e4,
            5e4,
            1e5,
            2e5,
            5e5,
            1e6,
            1e7,
            f64::INFINITY,
        ],
        home: 1e1,
        forms: &[
            Form {
                name: SHIPPED,
                label: "nearest t; for equal t the first in the file",
            },
            Form {
                name: "last",
                label: "nearest t; for equal t the last tested",
            },
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        let whole = Setting::sphere(1.0, 3.0);
        if value.is_infinite() {
            return whole;
        }
        // A detail as small as the gap must be resolved.
        whole.and(Shape::Sphere {
            centre: [0.0; 3],
            radius: 1.0 / value,
        })
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let mut random = Random::new(15);
        for case in 0..48 {
            // The upper one is the first or the second in the file.
            let upper_first = case % 2 == 0;
            let gap = 1.0 / value;
            let heights = if upper_first { [gap, 0.0] } else { [0.0, gap] };
            let right = u32::from(!upper_first && gap > 0.0);
            let normal = random.direction();
            let eye = random::times(normal, 3.0);
            let pair = if case % 4 < 2 {
                spheres(heights, eye)
            } else {
                squares(normal, random.across(normal), heights, eye)
            };
            let Some(prepared) = pair.prepare::<S>() else {
                continue;
            };
            let aside = random::times(random.across(normal), random.between(0.0, 0.6));
            let towards = random::add(random::times(normal, -2.0), aside);
            let direction = number::direction::<S>(towards);
            let ray = number::ray(prepared.world.point(eye), direction);
            let found = [
                counted(|| shipped(&prepared, &ray)),
                counted(|| last(&prepared, &ray)),
            ];
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.saturations += saturations;
                errors.decide(true, found == Some(right));
            }
        }
        all_errors
    }
}

fn spheres(heights: [f64; 2], eye: [f64; 3]) -> Setting {
    let [first, second] = heights.map(|height| Shape::Sphere {
        centre: [0.0; 3],
        radius: 1.0 + height,
    });
    Setting::of(first, eye).and(second)
}

fn squares(normal: [f64; 3], across: [f64; 3], heights: [f64; 2], eye: [f64; 3]) -> Setting {
    let third = random::cross(normal, across);
    let square = |height: f64| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| {
            let flat = random::add(random::times(across, x), random::times(third, y));
            random::add(flat, random::times(normal, 1.0 + height))
        })
    };
    // A sphere that comes first and is out of sight.
    let centre = random::times(normal, -1.0);
    Setting::of(
        Shape::Sphere {
            centre,
            radius: 0.1,
        },
        eye,
    )
    .and_polygon(&square(heights[0]))
    .and_polygon(&square(heights[1]))
}

/// Returns what the ray hits first: 0 or 1, in the order of the file.
fn shipped<S: Number>(prepared: &Prepared<S>, ray: &Ray<S>) -> Option<u32> {
    let scene = prepared.scene.scene();
    let all: Vec<ObjectRef> = scene.shapes.refs().collect();
    let hit = BruteForce(&all).nearest(&scene, ray, &mut (), &mut ())?;
    Some(hit.object.index() as u32)
}

fn last<S: Number>(prepared: &Prepared<S>, ray: &Ray<S>) -> Option<u32> {
    let (shapes, mut limit, mut found) = (prepared.scene.shapes(), prepared.scene.diameter, None);
    for object in shapes.refs() {
        if let Some(t) = shapes.hit(object, ray, limit, &mut ()) {
            (limit, found) = (t, Some(object.index() as u32));
        }
    }
    found
}
