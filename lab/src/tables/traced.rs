//! The tables of counts of traced scenes: II, IV, V, VI and VII, in the thesis's conditions.

use super::number::TableNumber;
use super::runs::{Runs, TraceCounts};
use super::subject::{FIGURES, SceneVariant};
use super::table::{Base, Draft, Quantity};
use octray_render::error::Error;

/// Reflected rays; they must agree within 5 %.
pub const REFLECTED: Quantity = Quantity::rays("reflected rays", 0.05);

/// Light tests that found an object in between ("shadows" in the thesis); they must agree within 15 %.
pub const BLOCKED: Quantity = Quantity::rays("blocked light tests", 0.15);

/// How well the ratios of times are to agree.
pub const TIMES_WITHIN: f64 = 0.1;

/// The content of a column, and how it is computed.
type Column = (Quantity, fn(&TraceCounts) -> f64);

const PIXELS: Column = (Quantity::rays("pixels", 0.0), |counts| counts.pixels as f64);
const PRIMARY: Column = (Quantity::rays("primary rays", 0.0), |counts| {
    counts.rays.primary as f64
});
const LIGHTS: Column = (Quantity::rays("lights", 0.0), |counts| counts.lights as f64);
const COLUMNS: [Column; 3] = [
    (REFLECTED, |counts| counts.rays.reflected as f64),
    (BLOCKED, |counts| counts.rays.blocked as f64),
    (Quantity::instructions("time", TIMES_WITHIN), |counts| {
        counts.instructions / 1e6
    }),
];
const MEASURED: Column = (
    Quantity {
        thesis: "time",
        unit: "ms",
        decimals: 1,
        ratio: true,
        ..Quantity::count("measured")
    },
    |counts| counts.seconds * 1e3,
);

/// The remark on every time.
const TIME_IS: &str = "Time is in instructions of one processor, estimated from counted events, and the same every \
time; the thesis's is in minutes. So ratios compare.";

const BLOCKED_IS: &str =
    "A light is tested where the surface faces it; blocked is what the thesis calls a shadow.";

/// Makes table II: figure 20 with 10 and 8 lights.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn two(runs: &Runs<'_>) -> Result<Draft, Error> {
    let variants =
        [10, 8].map(|lights| (SceneVariant::lit(FIGURES[1], lights), lights.to_string()));
    let mut draft = draft(runs, TableNumber::Two, &[], &variants)?;
    draft.notes.push(BLOCKED_IS.into());
    Ok(draft)
}

/// Makes table IV: figure 22 with 6 lights.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn four(runs: &Runs<'_>) -> Result<Draft, Error> {
    let reflective = SceneVariant::lit(FIGURES[3], 6);
    let variants = [
        (reflective.opaque(), "opaque".into()),
        (reflective, "reflective".into()),
    ];
    let mut draft = draft(runs, TableNumber::Four, &[], &variants)?;
    draft
        .notes
        .push("With 6 lights. Opaque is the same scene with nothing that reflects.".into());
    Ok(draft)
}

/// Makes table V: five scenes with different numbers of surfaces.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn five(runs: &Runs<'_>) -> Result<Draft, Error> {
    let mut variants = Vec::new();
    for (subject, lights) in FIGURES.into_iter().zip([2, 2, 3, 2, 2]) {
        let variant = SceneVariant::lit(subject, lights);
        variants.push((variant, variant.scene()?.objects.len().to_string()));
    }
    let mut draft = draft(runs, TableNumber::Five, &[LIGHTS], &variants)?;
    draft.base = Base::OfTable;
    draft.notes.push(
        "A sphere, a box and a polygon are one surface each. Ratios are to figure 19; they tell more of the scenes \
         than of the number of surfaces."
            .into(),
    );
    Ok(draft)
}

/// Makes table VI: figure 23 with 2 lights, at two resolutions.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn six(runs: &Runs<'_>) -> Result<Draft, Error> {
    let as_it_is = SceneVariant::lit(FIGURES[4], 2);
    let larger = SceneVariant {
        larger: true,
        ..as_it_is
    };
    let variants = [(as_it_is, "as it is".into()), (larger, "larger".into())];
    let mut draft = draft(runs, TableNumber::Six, &[PIXELS], &variants)?;
    draft.notes.push(
        "With 2 lights. Larger is a quarter more columns and rows in the scene file (640 for 512): it shows more \
         around the same picture."
            .into(),
    );
    Ok(draft)
}

/// Makes table VII: figure 22 with 6 lights, with 1 and 4 pixels per ray.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn seven(runs: &Runs<'_>) -> Result<Draft, Error> {
    let one = SceneVariant::lit(FIGURES[3], 6);
    let variants = [(one, "1".into()), (one.four_pixels_per_ray(), "4".into())];
    let mut draft = draft(runs, TableNumber::Seven, &[PRIMARY], &variants)?;
    draft.notes.push("With 6 lights.".into());
    Ok(draft)
}

/// Makes the table with these columns before the common ones, and one more if time is measured.
fn draft(
    runs: &Runs<'_>,
    number: TableNumber,
    first: &[Column],
    variants: &[(SceneVariant, String)],
) -> Result<Draft, Error> {
    let measured = runs.time.then_some(&MEASURED);
    let columns: Vec<&Column> = first.iter().chain(&COLUMNS).chain(measured).collect();
    let mut lines = Vec::new();
    for (scene_variant, variant) in variants {
        let counts = runs.count(*scene_variant)?;
        let values = columns.iter().map(|(_, get)| get(&counts)).collect();
        lines.push((scene_variant.subject.name.into(), variant.clone(), values));
    }
    Ok(Draft {
        number,
        quantities: columns.iter().map(|(quantity, _)| *quantity).collect(),
        base: Base::OfScene,
        full_size: runs.size.is_none(),
        lines,
        notes: vec![TIME_IS.into()],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_render::interrupt::Interrupt;

    #[test]
    fn a_variant_is_traced_once_for_all_tables() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((8, 8)), false, &interrupt);
        four(&runs).unwrap();
        assert_eq!(runs.traced(), 2);
        // The reflective scene is also that of one pixel per ray.
        seven(&runs).unwrap();
        assert_eq!(runs.traced(), 3);
        five(&runs).unwrap();
        assert_eq!(runs.traced(), 8);
        // Figure 23 with 2 lights is in V, too.
        six(&runs).unwrap();
        assert_eq!(runs.traced(), 9);
        two(&runs).unwrap();
        assert_eq!(runs.traced(), 11);
    }
}
