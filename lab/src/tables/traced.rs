//! The tables of what is counted while scenes are traced: I, II, IV, V, VI and VII.

use super::agreement;
use super::number::Number;
use super::runs::{Runs, Tally};
use super::subject::{FIGURES, FLAT, Subject, Trial};
use super::table::{Base, Draft, Quantity};
use super::thesis::Thesis;
use octray_prepare::{PixelsPerRay, TreeKind};
use octray_render::error::Error;

/// What a column holds, and how it is got.
type Column = (Quantity, fn(&Tally) -> f64);

const VOXELS: Column = (Quantity::count("voxel tests"), |tally| tally.steps as f64);
const SURFACES: Column = (Quantity::count("surface tests"), |tally| tally.tests as f64);
const PIXELS: Column = (Quantity::count("pixels"), |tally| tally.pixels as f64);
const PRIMARY: Column = (Quantity::count("primary rays"), |tally| {
    tally.rays.primary as f64
});
const REFLECTED: Column = (agreement::REFLECTED, |tally| tally.rays.reflected as f64);
const LIGHT_TESTS: Column = (Quantity::count("light tests"), |tally| {
    tally.rays.shadow as f64
});
const BLOCKED: Column = (agreement::BLOCKED, |tally| tally.rays.blocked as f64);
const TIME: Column = (Quantity::instructions("time"), |tally| {
    tally.instructions / 1e6
});
const MEASURED: Column = (
    Quantity {
        thesis: "time",
        unit: "ms",
        decimals: 1,
        ..Quantity::count("measured")
    },
    |tally| tally.seconds * 1e3,
);

/// What is said of every time.
const TIME_IS: &str = "Time is in instructions of one processor, estimated from counted events, and the same every \
time; the thesis's is in minutes. So ratios compare.";

/// Table I.
///
/// # Errors
/// As [`Runs::tally`].
pub fn one(runs: &Runs<'_>) -> Result<Draft, Error> {
    let mut trials = Vec::new();
    for subject in [FLAT].into_iter().chain(FIGURES) {
        for (tree, name) in [(TreeKind::Plain, "plain"), (TreeKind::Modified, "modified")] {
            let trial = Trial {
                tree,
                ..Trial::of(subject)
            };
            trials.push((trial, name.to_owned()));
        }
    }
    let mut draft = draft(runs, Number::One, &[VOXELS, SURFACES], trials)?;
    let fewer = |column: usize| {
        let pairs = draft.lines.chunks(2);
        pairs
            .filter(|pair| pair[1].2[column] < pair[0].2[column])
            .count()
    };
    let (voxels, surfaces, all) = (fewer(0), fewer(1), draft.lines.len() / 2);
    draft.notes = vec![
        format!(
            "The thesis claims that the modified octree takes fewer tests. Here it takes fewer voxel tests in \
             {voxels} of {all} scenes, and fewer surface tests in {surfaces}."
        ),
        "Both trees have the depth and the leaves that `octray render` gives them; the thesis's limits are not \
         at hand, nor is the layout of its 2-D scene: `flat` is ours."
            .into(),
        "A voxel test is a node that a ray comes to, inner ones counted.".into(),
    ];
    Ok(draft)
}

/// Table II.
///
/// # Errors
/// As [`Runs::tally`].
pub fn two(runs: &Runs<'_>, thesis: &Thesis) -> Result<Draft, Error> {
    let mut trials = Vec::new();
    for subject in FIGURES {
        let all = subject.scene()?.lights.len();
        let sets = [all, 1, 2, 4, 8].map(|lights| lights.min(all));
        for lights in with_the_thesis(sets, thesis, Number::Two, subject) {
            let trial = Trial::of(subject).with_lights(lights, all);
            trials.push((trial, lights.to_string()));
        }
    }
    let alone = |(quantity, get): Column| {
        let ratio = false;
        (Quantity { ratio, ..quantity }, get)
    };
    let [primary, reflected, light_tests, blocked] =
        [PRIMARY, REFLECTED, LIGHT_TESTS, BLOCKED].map(alone);
    let columns = [primary, reflected, light_tests, blocked, TIME];
    let mut draft = draft(runs, Number::Two, &columns, trials)?;
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

/// Table IV.
///
/// # Errors
/// As [`Runs::tally`].
pub fn four(runs: &Runs<'_>) -> Result<Draft, Error> {
    let variants = |trial| {
        let opaque = Trial {
            opaque: true,
            ..trial
        };
        [(opaque, "opaque".into()), (trial, "reflective".into())]
    };
    let columns = [REFLECTED, LIGHT_TESTS, BLOCKED, TIME];
    let mut draft = draft(runs, Number::Four, &columns, each(variants))?;
    draft.notes = vec![
        TIME_IS.into(),
        "Opaque are the same scenes with nothing that reflects.".into(),
    ];
    Ok(draft)
}

/// Table V.
///
/// # Errors
/// As [`Runs::tally`].
pub fn five(runs: &Runs<'_>, thesis: &Thesis) -> Result<Draft, Error> {
    let mut trials = Vec::new();
    for subject in FIGURES {
        let all = subject.scene()?.objects.len();
        let counts = [all / 4, all / 2, all];
        for few in with_the_thesis(counts, thesis, Number::Five, subject) {
            let trial = Trial::of(subject).with_surfaces(few, all);
            trials.push((trial, few.to_string()));
        }
    }
    let mut draft = draft(runs, Number::Five, &[REFLECTED, BLOCKED, TIME], trials)?;
    draft.notes = vec![
        TIME_IS.into(),
        "Of a figure's surfaces a quarter and a half are taken, evenly; a sphere, a box and a polygon are one \
         surface each."
            .into(),
    ];
    Ok(draft)
}

/// Table VI.
///
/// # Errors
/// As [`Runs::tally`].
pub fn six(runs: &Runs<'_>) -> Result<Draft, Error> {
    let variants = |trial| {
        let larger = Trial {
            larger: true,
            ..trial
        };
        [(trial, "as it is".into()), (larger, "larger".into())]
    };
    let columns = [PIXELS, REFLECTED, BLOCKED, TIME];
    let mut draft = draft(runs, Number::Six, &columns, each(variants))?;
    draft.notes = vec![
        TIME_IS.into(),
        "Larger is a quarter more columns and rows in the scene file (640 for 512): it shows more around the \
         same picture. Around ours there is floor that reflects; that the thesis has 56 % more pixels and only 9 % \
         more reflected rays says that there is little around its picture."
            .into(),
    ];
    Ok(draft)
}

/// Table VII.
///
/// # Errors
/// As [`Runs::tally`].
pub fn seven(runs: &Runs<'_>) -> Result<Draft, Error> {
    let variants = |trial| {
        let four = Trial {
            pixels_per_ray: PixelsPerRay::Four,
            ..trial
        };
        [(trial, "1".into()), (four, "4".into())]
    };
    let columns = [PRIMARY, REFLECTED, BLOCKED, TIME];
    let mut draft = draft(runs, Number::Seven, &columns, each(variants))?;
    // Reflected rays and time, four pixels per ray over one.
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

/// The variants of each figure.
fn each(variants: impl Fn(Trial) -> [(Trial, String); 2]) -> Vec<(Trial, String)> {
    (FIGURES.into_iter())
        .flat_map(|subject| variants(Trial::of(subject)))
        .collect()
}

/// The numbers, and those for which the thesis has something, each once: 1 up to the largest of them.
fn with_the_thesis<const N: usize>(
    numbers: [usize; N],
    thesis: &Thesis,
    table: Number,
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

/// The table with these columns; where time is taken, that is one more.
fn draft(
    runs: &Runs<'_>,
    number: Number,
    columns: &[Column],
    trials: Vec<(Trial, String)>,
) -> Result<Draft, Error> {
    let measured = runs.time.then_some(&MEASURED);
    let columns: Vec<&Column> = columns.iter().chain(measured).collect();
    let mut lines = Vec::new();
    for (trial, variant) in trials {
        let tally = runs.tally(trial)?;
        let values = columns.iter().map(|(_, get)| get(&tally)).collect();
        lines.push((trial.subject.name.into(), variant, values));
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
    fn a_scene_as_it_is_is_traced_once_for_all_tables() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((8, 8)), false, &interrupt);
        let nothing = Thesis::default();
        four(&runs).unwrap();
        // Each figure as it is, and opaque.
        assert_eq!(runs.traced(), 10);
        five(&runs, &nothing).unwrap();
        // A quarter and a half of its surfaces.
        assert_eq!(runs.traced(), 20);
        let lines = two(&runs, &nothing).unwrap().lines.len();
        assert_eq!(runs.traced(), 20 + lines - 5);
    }

    #[test]
    fn what_the_thesis_has_is_traced_if_there_is_enough() {
        let lines = ["3", "11", "0", "2", "many"]
            .map(|lights| format!("II,figure-20,{lights},time,,1,,\n"))
            .concat();
        let thesis = thesis(&lines).unwrap();
        let sets = |subject| with_the_thesis([10, 1, 2, 2], &thesis, Number::Two, subject);
        assert_eq!(sets(FIGURES[1]), [10, 1, 2, 3]);
        assert_eq!(sets(FIGURES[0]), [10, 1, 2]);
    }
}
