//! Mirrors at grazing incidence.

use crate::exact::{Exact, angle, dot, exact, sub, times};
use crate::fixtures::{only, outline, polygon};
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::mock_accelerator::{self, Seen};
use crate::number::{self, Number, counted, exactly};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::accel::Hit;
use octray_core::object::ObjectKind;
use octray_core::ray::Ray;
use octray_core::scene::Surface;
use octray_core::vec3::Vec3;

/// Rays that hit a mirror at a cosine of 1 to 10⁻⁷.
#[derive(Debug)]
pub struct Mirror;

impl Sweep for Mirror {
    const ABOUT: About = About {
        name: "mirror",
        title: "Grazing mirror",
        axis: "1 / cosine of incidence",
        unit: "",
        values: SEVEN_DECADES,
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "R = I − 2(I·N)N",
            },
            Form {
                name: "thesis",
                label: "(1.0a–b): R = I/|I·N| + 2N",
            },
        ],
        limits: LIMITS,
    };

    fn setting(value: f64) -> Setting {
        Setting::pixel(1.0 / value)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let mut random = Random::new(4);
        for _ in 0..48 {
            let (incoming, normal) = incidence::<S>(&mut random, 1.0 / value);
            let (i, n) = (exactly(incoming), exactly(normal));
            let cosine = dot(&i, &n);
            let share = exact(2.0) * &cosine / dot(&n, &n);
            let truth = sub(&i, &times(&n, &share));
            let found = [
                counted(|| shipped(incoming, normal)),
                counted(|| thesis(incoming, normal)),
            ];
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.cases += 1;
                errors.saturations += saturations;
                let found = exactly(found);
                errors.turn(angle(&truth, &found));
                // A reflected ray leaves on the side from which it came.
                let wrong = dot(&found, &n) * &cosine > Exact::ZERO;
                errors.wrong_side += u32::from(wrong);
            }
        }
        all_errors
    }
}

/// The limits for directions: a pixel is about 0.002 rad wide.
pub(super) const LIMITS: StateLimits = StateLimits {
    angle: Some(limit(0.002, 0.05)),
    side: Some(limit(0.0, 0.05)),
    ..StateLimits::NONE
};

/// Returns a unit direction that hits a surface of some unit normal at this cosine.
pub(super) fn incidence<S: Number>(random: &mut Random, cosine: f64) -> (Vec3<S>, Vec3<S>) {
    let normal = random.direction();
    let along = random.across(normal);
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let down = random::times(normal, -cosine);
    let incoming = random::add(down, random::times(along, sine));
    (number::direction(incoming), number::direction(normal))
}

/// Returns the rays that leave a plane of this normal and surface.
pub(super) fn leaving<S: Number>(
    incoming: Vec3<S>,
    normal: Vec3<S>,
    surface: Surface<S>,
) -> Seen<S> {
    let ray = Ray::new(Vec3::ZERO, incoming);
    let plane = outline(normal, S::ZERO, &[]);
    let hit = Hit {
        t: S::ZERO,
        object: only(ObjectKind::Polygon),
    };
    mock_accelerator::leaving(polygon(&plane, &[]), surface, &ray, hit)
}

fn shipped<S: Number>(incoming: Vec3<S>, normal: Vec3<S>) -> Vec3<S> {
    let seen = leaving(incoming, normal, mock_accelerator::mirror());
    seen.follow.first().map_or(Vec3::ZERO, |ray| ray.direction)
}

fn thesis<S: Number>(incoming: Vec3<S>, normal: Vec3<S>) -> Vec3<S> {
    let (scaled, normal) = per_cosine(incoming, normal);
    (scaled + normal + normal).unit().0
}

/// Computes thesis (1.0a): V' = I/|I·N|, and the normal that faces the ray.
pub(super) fn per_cosine<S: Number>(incoming: Vec3<S>, normal: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
    let cosine = incoming.dot(normal);
    let facing = if cosine > S::ZERO { -normal } else { normal };
    (incoming.map(|c| c.quotient(cosine.abs())), facing)
}
