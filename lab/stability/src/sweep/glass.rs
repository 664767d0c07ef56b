//! Glass: at grazing incidence, and near the critical angle.

use super::mirror::{LIMITS, incidence, leaving, per_cosine};
use crate::exact::{Exact, Exact3, add, angle, dot, exact, root, times, unit};
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::mock_accelerator;
use crate::number::{Number, counted, exactly};
use crate::random::Random;
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::vec3::Vec3;

const IOR: f64 = 1.5;

const FORMS: &[Form] = &[
    Form {
        name: SHIPPED,
        label: "Snell's law by the cosine",
    },
    Form {
        name: "thesis",
        label: "(1.0a–d): Kf (N + I/|I·N|) − N",
    },
];

/// Rays that enter glass at a cosine of 1 to 10⁻⁷.
#[derive(Debug)]
pub struct Glass;

impl Sweep for Glass {
    const ABOUT: About = About {
        name: "glass",
        title: "Grazing glass",
        axis: "1 / cosine of incidence",
        unit: "",
        values: SEVEN_DECADES,
        home: 1.0,
        forms: FORMS,
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            ..LIMITS
        },
    };

    fn setting(value: f64) -> Setting {
        Setting::pixel(1.0 / value)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let mut random = Random::new(5);
        for _ in 0..48 {
            let (incoming, normal) = incidence::<S>(&mut random, 1.0 / value);
            compare(incoming, normal, 1.0 / IOR, &mut all_errors);
        }
        all_errors
    }
}

/// Rays that leave glass at a sine that differs from the critical one by a share of 1/5 to 10⁻⁷.
#[derive(Debug)]
pub struct Critical;

impl Sweep for Critical {
    const ABOUT: About = About {
        name: "critical",
        title: "Near the critical angle",
        axis: "critical sine / distance from it",
        unit: "",
        values: SEVEN_DECADES.split_at(2).1,
        home: 5.0,
        forms: FORMS,
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            ..LIMITS
        },
    };

    fn setting(value: f64) -> Setting {
        Setting::pixel(1.0 / value)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let mut random = Random::new(6);
        for case in 0..48 {
            let off = if case % 2 == 0 { 1.0 } else { -1.0 } / value;
            let sine = ((1.0 + off) / IOR).min(1.0);
            let cosine = (1.0 - sine * sine).sqrt();
            let (incoming, normal) = incidence::<S>(&mut random, cosine);
            compare(incoming, normal, IOR, &mut all_errors);
        }
        all_errors
    }
}

/// Measures both forms on one ray; a hit means a transmitted ray.
fn compare<S: Number>(
    incoming: Vec3<S>,
    normal: Vec3<S>,
    ratio: f64,
    all_errors: &mut [ErrorStats],
) {
    let ratio = S::from_f64(ratio);
    let truth = truth(exactly(incoming), exactly(normal), &ratio.exact());
    let found = [
        counted(|| shipped(incoming, normal, ratio)),
        counted(|| thesis(incoming, normal, ratio)),
    ];
    for ((found, saturations), errors) in found.into_iter().zip(all_errors) {
        errors.saturations += saturations;
        if errors.decide(truth.is_some(), found.is_some())
            && let (Some(truth), Some(found)) = (&truth, found)
        {
            let found = exactly(found);
            errors.turn(angle(truth, &found));
            let cosine = dot(&exactly(incoming), &exactly(normal));
            // A transmitted ray leaves on the other side.
            let wrong = dot(&found, &exactly(normal)) * cosine < Exact::ZERO;
            errors.wrong_side += u32::from(wrong);
        }
    }
}

fn truth(incoming: Exact3, normal: Exact3, ratio: &Exact) -> Option<Exact3> {
    let (i, mut n) = (unit(&incoming), unit(&normal));
    let mut cosine = -dot(&i, &n);
    if cosine < Exact::ZERO {
        (n, cosine) = (times(&n, &exact(-1.0)), -cosine);
    }
    let square = exact(1.0) - ratio * ratio * (exact(1.0) - &cosine * &cosine);
    if square < Exact::ZERO {
        return None;
    }
    let along = ratio * cosine - root(&square);
    Some(add(&times(&i, ratio), &times(&n, &along)))
}

fn shipped<S: Number>(incoming: Vec3<S>, normal: Vec3<S>, ratio: S) -> Option<Vec3<S>> {
    let seen = leaving(incoming, normal, mock_accelerator::glass(ratio));
    // At total reflection the only ray that follows is a mirrored one, on the side that the incoming one is on.
    let from_behind = normal.dot(incoming) > S::ZERO;
    let mut through = seen
        .follow
        .iter()
        .filter(|ray| ray.from.is_inward() != from_behind);
    through.next().map(|ray| ray.direction)
}

fn thesis<S: Number>(incoming: Vec3<S>, normal: Vec3<S>, ratio: S) -> Option<Vec3<S>> {
    let (scaled, normal) = per_cosine(incoming, normal);
    let index = S::ONE.quotient(ratio);
    let between = scaled + normal;
    let square = index * index * scaled.dot(scaled) - between.dot(between);
    if square <= S::ZERO {
        return None;
    }
    let factor = S::ONE.quotient(square.sqrt());
    Some((between * factor - normal).unit().0)
}
