//! The tables of counts of traced scenes: II, IV, V, VI and VII.

use super::agreement;
use super::number::TableNumber;
use super::runs::{Runs, TraceCounts};
use super::subject::{FIGURES, SceneVariant, Subject};
use super::table::{Base, Draft, Quantity};
use super::thesis::Thesis;
use octray_prepare::PixelsPerRay;
use octray_render::error::Error;

/// The content of a column, and how it is computed.
type Column = (Quantity, fn(&TraceCounts) -> f64);

const PIXELS: Column = (Quantity::count("pixels"), |counts| counts.pixels as f64);
const PRIMARY: Column = (Quantity::count("primary rays"), |counts| {
    counts.rays.primary as f64
});
const REFLECTED: Column = (agreement::REFLECTED, |counts| counts.rays.reflected as f64);
const LIGHT_TESTS: Column = (Quantity::count("light tests"), |counts| {
    counts.rays.shadow as f64
});
const BLOCKED: Column = (agreement::BLOCKED, |counts| counts.rays.blocked as f64);
const TIME: Column = (Quantity::instructions("time"), |counts| {
    counts.instructions / 1e6
});
const MEASURED: Column = (
    Quantity {
        thesis: "time",
        unit: "ms",
        decimals: 1,
        ..Quantity::count("measured")
    },
    |counts| counts.seconds * 1e3,
);

/// The remark on every time.
const TIME_IS: &str = "Time is in instructions of one processor, estimated from counted events, and the same every \
time; the thesis's is in minutes. So ratios compare.";

/// Makes table II.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn two(runs: &Runs<'_>, thesis: &Thesis) -> Result<Draft, Error> {
    let mut variants = Vec::new();
    for subject in FIGURES {
        let all = subject.scene()?.lights.len();
        let sets = [all, 1, 2, 4, 8].map(|lights| lights.min(all));
        for lights in with_the_thesis(sets, thesis, TableNumber::Two, subject) {
            let scene_variant = SceneVariant::of(subject).with_lights(lights, all);
            variants.push((scene_variant, lights.to_string()));
        }
    }
    let alone = |(quantity, get): Column| {
        let ratio = false;
        (Quantity { ratio, ..quantity }, get)
    };
    let [primary, reflected, light_tests, blocked] =
        [PRIMARY, REFLECTED, LIGHT_TESTS, BLOCKED].map(alone);
    let columns = [primary, reflected, light_tests, blocked, TIME];
    let mut draft = draft(runs, TableNumber::Two, &columns, variants)?;
    draft.base = Base::OfTable;
    draft.notes = vec![
        TIME_IS.into(),
        "A light set is the first lights of the scene. A light is tested where the surface faces it; blocked is \
         what the thesis calls a shadow."
            .into(),
    ];
    draft.notes.extend(agreement::notes(runs, thesis)?);
    Ok(draft)
}

/// Makes table IV.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn four(runs: &Runs<'_>) -> Result<Draft, Error> {
    let variants = |scene_variant| {
        let opaque = SceneVariant {
            opaque: true,
            ..scene_variant
        };
        [
            (opaque, "opaque".into()),
            (scene_variant, "reflective".into()),
        ]
    };
    let columns = [REFLECTED, LIGHT_TESTS, BLOCKED, TIME];
    let mut draft = draft(runs, TableNumber::Four, &columns, each(variants))?;
    draft.notes = vec![
        TIME_IS.into(),
        "Opaque are the same scenes with nothing that reflects.".into(),
    ];
    Ok(draft)
}

/// Makes table V.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn five(runs: &Runs<'_>, thesis: &Thesis) -> Result<Draft, Error> {
    let mut variants = Vec::new();
    for subject in FIGURES {
        let all = subject.scene()?.objects.len();
        let counts = [all / 4, all / 2, all];
        for few in with_the_thesis(counts, thesis, TableNumber::Five, subject) {
            let scene_variant = SceneVariant::of(subject).with_surfaces(few, all);
            variants.push((scene_variant, few.to_string()));
        }
    }
    let mut draft = draft(
        runs,
        TableNumber::Five,
        &[REFLECTED, BLOCKED, TIME],
        variants,
    )?;
    draft.notes = vec![
        TIME_IS.into(),
        "Of a figure's surfaces a quarter and a half are taken, evenly; a sphere, a box and a polygon are one \
         surface each."
            .into(),
    ];
    Ok(draft)
}

/// Makes table VI.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn six(runs: &Runs<'_>) -> Result<Draft, Error> {
    let variants = |scene_variant| {
        let larger = SceneVariant {
            larger: true,
            ..scene_variant
        };
        [
            (scene_variant, "as it is".into()),
            (larger, "larger".into()),
        ]
    };
    let columns = [PIXELS, REFLECTED, BLOCKED, TIME];
    let mut draft = draft(runs, TableNumber::Six, &columns, each(variants))?;
    draft.notes = vec![
        TIME_IS.into(),
        "Larger is a quarter more columns and rows in the scene file (640 for 512): it shows more around the \
         same picture. Around ours there is floor that reflects; that the thesis has 56 % more pixels and only 9 % \
         more reflected rays says that there is little around its picture."
            .into(),
    ];
    Ok(draft)
}

/// Makes table VII.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn seven(runs: &Runs<'_>) -> Result<Draft, Error> {
    let variants = |scene_variant| {
        let four = SceneVariant {
            pixels_per_ray: PixelsPerRay::Four,
            ..scene_variant
        };
        [(scene_variant, "1".into()), (four, "4".into())]
    };
    let columns = [PRIMARY, REFLECTED, BLOCKED, TIME];
    let mut draft = draft(runs, TableNumber::Seven, &columns, each(variants))?;
    // Reflected rays and time, four pixels per ray relative to one.
    let [rays, time] = [1, 3].map(|column| {
        let pairs = draft.lines.chunks(2);
        let shares = pairs.map(|pair| pair[1].2[column] / pair[0].2[column]);
        let (least, most) = shares.fold((f64::INFINITY, 0.0), |(least, most), share| {
            (f64::min(least, share), f64::max(most, share))
        });
        format!("{least:.3} to {most:.3}")
    });
    draft.notes = vec![
        TIME_IS.into(),
        format!(
            "One ray for 2 x 2 pixels takes {time} of the time of one for each, and {rays} of the reflected rays."
        ),
    ];
    Ok(draft)
}

/// Returns the variants of each figure.
fn each(
    variants: impl Fn(SceneVariant) -> [(SceneVariant, String); 2],
) -> Vec<(SceneVariant, String)> {
    (FIGURES.into_iter())
        .flat_map(|subject| variants(SceneVariant::of(subject)))
        .collect()
}

/// Returns the given numbers and those for which the thesis has a value, without duplicates, from 1 to the largest.
fn with_the_thesis<const N: usize>(
    numbers: [usize; N],
    thesis: &Thesis,
    table: TableNumber,
    subject: Subject,
) -> Vec<usize> {
    let most = numbers.iter().copied().max().unwrap_or_default();
    let of_scene = thesis.of(table).filter(|datum| datum.scene == subject.name);
    let known = of_scene.filter_map(|datum| datum.variant.parse().ok());
    let mut all = Vec::new();
    for number in numbers.into_iter().chain(known) {
        if (1..=most).contains(&number) && !all.contains(&number) {
            all.push(number);
        }
    }
    all
}

/// Makes the table with these columns, and one more if time is measured.
fn draft(
    runs: &Runs<'_>,
    number: TableNumber,
    columns: &[Column],
    variants: Vec<(SceneVariant, String)>,
) -> Result<Draft, Error> {
    let measured = runs.time.then_some(&MEASURED);
    let columns: Vec<&Column> = columns.iter().chain(measured).collect();
    let mut lines = Vec::new();
    for (scene_variant, variant) in variants {
        let counts = runs.count(scene_variant)?;
        let values = columns.iter().map(|(_, get)| get(&counts)).collect();
        lines.push((scene_variant.subject.name.into(), variant, values));
    }
    Ok(Draft {
        number,
        quantities: columns.iter().map(|(quantity, _)| *quantity).collect(),
        base: Base::OfScene,
        lines,
        notes: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::thesis::tests::thesis;
    use super::*;
    use octray_render::interrupt::Interrupt;

    #[test]
    fn the_unchanged_scene_is_traced_once_for_all_tables() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((8, 8)), false, &interrupt);
        let nothing = Thesis::default();
        four(&runs).unwrap();
        // Each figure unchanged, and opaque.
        assert_eq!(runs.traced(), 10);
        five(&runs, &nothing).unwrap();
        // A quarter and a half of its surfaces.
        assert_eq!(runs.traced(), 20);
        let lines = two(&runs, &nothing).unwrap().lines.len();
        assert_eq!(runs.traced(), 20 + lines - 5);
    }

    #[test]
    fn variants_of_the_thesis_are_traced_if_the_scene_is_large_enough() {
        let lines = ["3", "11", "0", "2", "many"]
            .map(|lights| format!("II,figure-20,{lights},time,,1,,\n"))
            .concat();
        let thesis = thesis(&lines).unwrap();
        let sets = |subject| with_the_thesis([10, 1, 2, 2], &thesis, TableNumber::Two, subject);
        assert_eq!(sets(FIGURES[1]), [10, 1, 2, 3]);
        assert_eq!(sets(FIGURES[0]), [10, 1, 2]);
    }
}
