//! Compares the figures' numbers of rays with the thesis's table II.

use super::number::TableNumber;
use super::runs::Runs;
use super::subject::{FIGURES, SceneVariant};
use super::table::Quantity;
use super::thesis::{Datum, Thesis};
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::stats::Rays;

/// Reflected rays; they must agree within 5 %.
pub const REFLECTED: Quantity = Quantity::rays("reflected rays", 0.05);

/// Light tests that found an object in between ("shadows" in the thesis); they must agree within 15 %.
pub const BLOCKED: Quantity = Quantity::rays("blocked light tests", 0.15);

/// Returns a sentence for each count of the thesis with which ours does not agree for the stated number of lights: it
/// names the set of first lights that comes nearest. Returns one sentence if no count is known.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn notes(runs: &Runs<'_>, thesis: &Thesis) -> Result<Vec<String>, Error> {
    let of_rays = |datum: &&Datum| !datum.is_ratio() && count_of(datum).is_some();
    let data: Vec<&Datum> = thesis.of(TableNumber::Two).filter(of_rays).collect();
    if data.is_empty() {
        return Ok(vec![
            "The thesis's counts of rays are not at hand. So whether ours agree (reflected rays within 5 %, blocked \
             light tests within 15 %) is not known."
                .into(),
        ]);
    }
    let notes = data.into_iter().map(|datum| nearest(runs, datum));
    Ok(notes
        .collect::<Result<Vec<_>, _>>()?
        .into_iter()
        .flatten()
        .collect())
}

/// Returns the number of rays of a kind.
type Count = fn(&Rays) -> u64;

/// Returns how a quantity is counted, and the allowed relative difference.
fn count_of(datum: &Datum) -> Option<(Count, f64)> {
    let counts: [(Quantity, Count); 2] = [
        (REFLECTED, |rays| rays.reflected),
        (BLOCKED, |rays| rays.blocked),
    ];
    let named = |(quantity, _): &(Quantity, Count)| quantity.thesis == datum.quantity;
    let (quantity, count) = counts.into_iter().find(named)?;
    Some((count, quantity.within?))
}

/// Returns what comes nearest to a count of the thesis; `None` if ours agrees, or we have none.
fn nearest(runs: &Runs<'_>, datum: &Datum) -> Result<Option<String>, Error> {
    let subject = FIGURES
        .into_iter()
        .find(|subject| subject.name == datum.scene);
    let (Some(subject), Some((count, within)), Ok(stated)) =
        (subject, count_of(datum), datum.variant.parse::<usize>())
    else {
        return Ok(None);
    };
    let all = subject.scene()?.lights.len();
    let with = |lights| {
        let scene_variant = SceneVariant::of(subject).with_lights(lights, all);
        Ok::<_, Error>((lights, count(&runs.count(scene_variant)?.rays)))
    };
    let off = |ours: u64| (ours as f64 / datum.value - 1.0).abs();
    if (1..=all).contains(&stated) && off(with(stated)?.1) <= within {
        return Ok(None);
    }
    let sets = (1..=all).map(with).collect::<Result<Vec<_>, _>>()?;
    let best = sets
        .into_iter()
        .min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
    Ok(best.map(|(lights, ours)| {
        format!(
            "{}, {}: the thesis has {} with {stated} lights. Of ours, the first {lights} come nearest, with {} \
             ({:+.1} %).",
            datum.scene,
            datum.quantity,
            thousands(datum.value.round() as u64),
            thousands(ours),
            100.0 * (ours as f64 / datum.value - 1.0),
        )
    }))
}

#[cfg(test)]
mod tests {
    use super::super::thesis::tests::thesis;
    use super::*;
    use octray_render::interrupt::Interrupt;

    #[test]
    fn the_nearest_light_set_is_found_if_the_stated_one_disagrees() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((64, 64)), false, &interrupt);
        let blocked = |lights| {
            let scene_variant = SceneVariant {
                lights: Some(lights),
                ..SceneVariant::of(FIGURES[1])
            };
            runs.count(scene_variant).unwrap().rays.blocked
        };
        let (four, ten) = (blocked(4), blocked(10));
        assert!((1..=3).all(|lights| blocked(lights) != four));
        let lines = format!(
            "II,figure-20,10,blocked light tests,,{ten},,\n\
             II,figure-20,9,blocked light tests,,{four},,\n\
             II,figure-20,9,time,,1,minutes,"
        );
        let notes = notes(&runs, &thesis(&lines).unwrap()).unwrap();
        let four = thousands(four);
        let expected = format!(
            "figure-20, blocked light tests: the thesis has {four} with 9 lights. Of ours, the first 4 come \
             nearest, with {four} (+0.0 %)."
        );
        assert_eq!(notes, [expected]);
    }

    #[test]
    fn missing_counts_are_reported() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((8, 8)), false, &interrupt);
        let notes = notes(&runs, &Thesis::default()).unwrap();
        assert!(notes[0].contains("is not known"), "{notes:?}");
    }
}
