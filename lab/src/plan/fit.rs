//! Fits the model's weights to measurements.

use super::model::{Family, Model, Weights, code};
use super::record::Sample;
use std::collections::BTreeSet;

/// Returns the non-negative weights with the least sum of squared relative errors, found by coordinate descent. Each
/// row holds counts of events and their total cost.
pub fn least_squares<const N: usize>(rows: &[([f64; N], f64)]) -> [f64; N] {
    let mut weights = [0.0; N];
    let shares: Vec<[f64; N]> = (rows.iter())
        .map(|(events, cost)| events.map(|count| count / cost))
        .collect();
    let mut errors = vec![-1.0; rows.len()];
    let curvature: [f64; N] =
        std::array::from_fn(|event| shares.iter().map(|share| share[event].powi(2)).sum());
    for _ in 0..5000 {
        for event in (0..N).filter(|event| curvature[*event] > 0.0) {
            let slope: f64 = (shares.iter().zip(&errors))
                .map(|(share, error)| share[event] * error)
                .sum();
            let better = f64::max(weights[event] - slope / curvature[event], 0.0);
            let step = better - weights[event];
            weights[event] = better;
            for (error, share) in errors.iter_mut().zip(&shares) {
                *error += step * share[event];
            }
        }
    }
    weights
}

/// Returns the model fitted to all samples.
pub fn model(samples: &[Sample]) -> Model {
    let all = samples.iter();
    let pairs: BTreeSet<_> = all.map(|s| (s.board.target, s.family.name())).collect();
    let families = [Family::Fixed, Family::F32];
    let weights = pairs.into_iter().filter_map(|(target, family)| {
        let family = families.into_iter().find(|known| known.name() == family)?;
        let of = |s: &&Sample| (s.board.target, s.family) == (target, family);
        let samples: Vec<&Sample> = samples.iter().filter(of).collect();
        Some(Weights {
            errors: errors(&samples),
            ..weights(target, family, &samples)
        })
    });
    Model(weights.collect())
}

/// Returns the weights fitted to samples of one target and family, with unknown errors.
fn weights(target: &str, family: Family, samples: &[&Sample]) -> Weights {
    let mut search = Vec::new();
    let mut rest = Vec::new();
    for sample in samples {
        let line = &sample.line;
        // If a search is not a function of its own, its instructions are unknown.
        let Some((closest, shadow)) = line.per_closest_ray.zip(line.per_shadow_ray) else {
            continue;
        };
        let (closest, shadow) = (closest * line.closest_rays, shadow * line.shadow_rays);
        search.push((sample.events.search[0], closest));
        search.push((sample.events.search[1], shadow));
        rest.push((sample.events.rest, line.instructions - closest - shadow));
    }
    let parts = |sample: &Sample| code(sample.baked.features, sample.tree);
    let code: Vec<_> = (samples.iter())
        .map(|s| (parts(s), s.line.flash - s.baked.bytes as f64))
        .collect();
    let frames: Vec<_> = (samples.iter())
        .map(|s| (parts(s), s.line.stack - s.lent.total() as f64))
        .collect();
    Weights {
        target: target.into(),
        family,
        search: least_squares(&search),
        rest: least_squares(&rest),
        code: least_squares(&code),
        frames: least_squares(&frames),
        errors: [0.0; 3],
    }
}

/// Returns the root-mean-square relative errors of instructions, flash and RAM in leave-one-out cross-validation by
/// scene.
fn errors(samples: &[&Sample]) -> [f64; 3] {
    let scenes: BTreeSet<&str> = samples.iter().map(|s| &*s.line.scene).collect();
    let mut squares = [0.0; 3];
    for scene in scenes {
        let (out, known): (Vec<&Sample>, Vec<&Sample>) =
            samples.iter().partition(|s| s.line.scene == scene);
        let Some(first) = known.first() else {
            continue;
        };
        let weights = weights(first.board.target, first.family, &known);
        for sample in out {
            for (sum, error) in squares.iter_mut().zip(sample.errors(&weights)) {
                *sum += error * error;
            }
        }
    }
    squares.map(|sum| (sum / samples.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_weights_are_found() {
        let truth = [3.0, 0.0, 70.0];
        let rows = [
            [1.0, 2.0, 3.0],
            [4.0, 1.0, 0.0],
            [0.0, 5.0, 1.0],
            [9.0, 2.0, 2.0],
        ];
        let cost = |events: [f64; 3]| events.iter().zip(truth).map(|(e, w)| e * w).sum();
        let fitted = least_squares(&rows.map(|events| (events, cost(events))));
        for (found, expected) in fitted.iter().zip(truth) {
            assert!((found - expected).abs() < 1e-6, "{fitted:?}");
        }
    }
}
