//! Objects much smaller than a pixel, far away.

use super::sphere::{stable, textbook};
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::number::{self, Number, counted, vector};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_scenes::model::Shape;

/// The sphere sweep including the rounding of scene and ray: rays of a camera pass a sphere of 1/2 to 10⁻⁷ of their
/// length at 0 to 0.8 or at 1.2 to 2 radii. The reference is computed before any rounding.
#[derive(Debug)]
pub struct SubPixel;

impl Sweep for SubPixel {
    const ABOUT: About = About {
        name: "sub-pixel",
        title: "Sub-pixel objects",
        axis: "distance / radius, rounding of scene and rays included",
        unit: "",
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
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        Setting::sphere(1.0, value)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let mut random = Random::new(16);
        for case in 0..64 {
            let towards = random.direction();
            let share = match case % 2 {
                0 => random.between(0.0, 0.8),
                _ => random.between(1.2, 2.0),
            };
            let eye = random::times(towards, -value);
            let aside = random::times(random.across(towards), share);
            let aim = random::add(random::times(towards, value), aside);
            let length = random::dot(aim, aim).sqrt();
            let centre = [0.0; 3];
            let shape = Shape::Sphere {
                centre,
                radius: 1.0,
            };
            let Some(prepared) = Setting::of(shape, eye).prepare::<S>() else {
                continue;
            };
            // As the camera computes it: a vector of about ½, normalised.
            let ray = number::ray(
                prepared.world.point(eye),
                vector::<S>(random::times(aim, 0.5 / length)).unit().0,
            );
            let truth = share < 1.0;
            let sphere = &prepared.scene.spheres[0];
            let found = [
                counted(|| stable(sphere, &ray).is_some()),
                counted(|| textbook(sphere, &ray).is_some()),
            ];
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.saturations += saturations;
                errors.decide(truth, found);
            }
        }
        all_errors
    }
}
