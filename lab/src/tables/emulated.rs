//! Table III: pictures without and with a floating-point unit, from a record of `octray measure`.

use super::number::TableNumber;
use super::record::{self, RecordRow};
use super::runs::Runs;
use super::subject::{FIGURES, SceneVariant};
use super::table::{Base, Compare, Draft, Quantity};
use super::thesis::MOST_CSV;
use super::traced::{BLOCKED, REFLECTED};
use crate::measure::ratio::{CORES, geometric_mean};
use octray_prepare::Arith;
use octray_render::error::Error;
use octray_scenes::{input, name::Shown};
use std::path::Path;

/// Makes the table from a record, or from the one that comes with octray. Its counts of rays are of our own runs.
///
/// # Errors
/// [`Error::Read`] if the record cannot be read, [`Error::Failed`] if it is invalid or lacks a picture; those of
/// [`Runs::count`].
pub fn three(path: Option<&Path>, runs: &Runs<'_>) -> Result<Draft, Error> {
    match path {
        None => of(record::TABLE_III, record::TABLE_III_NAME, runs),
        Some(path) => {
            let text =
                input::read_text(path, MOST_CSV).map_err(|source| Error::read(path, source))?;
            of(&text, &Shown(path).to_string(), runs)
        }
    }
}

/// The pictures, and how the thesis's conditions are told.
fn pictures() -> [(SceneVariant, &'static str); 2] {
    [
        (SceneVariant::lit(FIGURES[0], 10), "10 lights"),
        (
            SceneVariant::lit(FIGURES[1], 3).opaque(),
            "3 lights, opaque",
        ),
    ]
}

fn of(text: &str, name: &str, runs: &Runs<'_>) -> Result<Draft, Error> {
    let failed = |why: &dyn std::fmt::Display| {
        Error::Failed(format!(
            "{name} is no record of `octray measure --csv` for table III: {why}"
        ))
    };
    let rows = record::read(text).map_err(|error| failed(&error))?;
    let mut lines = Vec::new();
    let mut ratios = Vec::new();
    for (variant, conditions) in pictures() {
        let scene = variant.subject.name;
        let cost = |board: &str| {
            let here = |row: &&RecordRow| {
                row.scene == scene
                    && row.board == board
                    && row.arith == Arith::F32
                    && row.lights == variant.reduction.lights
                    && row.opaque == variant.reduction.opaque
            };
            let missing = || failed(&format!("no {scene}, {conditions}, in f32 on {board}"));
            (rows.iter().find(here))
                .and_then(|row| row.per_pixel)
                .ok_or_else(missing)
        };
        let with = [cost(CORES[0].1)?, cost(CORES[1].1)?];
        let without = [cost(CORES[0].0)?, cost(CORES[1].0)?];
        ratios.push([0, 1].map(|core| without[core] / with[core]));
        let rays = runs.count(variant)?.rays;
        for (unit, costs) in [("with", with), ("without", without)] {
            let rays = [rays.reflected, rays.blocked].map(|count| count as f64);
            let values = rays.into_iter().chain(costs).collect();
            lines.push((scene.to_owned(), format!("{conditions}, {unit}"), values));
        }
    }
    let means = [0, 1].map(|core| geometric_mean(ratios.iter().map(|ratios| ratios[core])));
    let mut notes = vec![
        format!(
            "Without the unit f32 takes {:.2} (Cortex-M4) and {:.2} (RV32) times as many instructions, geometric \
             means; the thesis's Sun 2.50 and 2.58 times as many minutes.",
            means[0], means[1]
        ),
        "Ours are instructions, of which one does an addition or a product in the unit, on cores whose floats are \
         otherwise emulated in integers; the Sun's coprocessor takes many cycles for each. So the ratios need not be \
         alike."
            .into(),
    ];
    if let Some(first) = rows.first() {
        notes.push(format!(
            "Instructions from {name}: commit {}, {}, {}. Rays are counted here.",
            first.commit, first.toolchain, first.emulator
        ));
    }
    let core = |name| Quantity {
        thesis: "time",
        unit: "instructions per pixel",
        ratio: true,
        compare: Compare::Nothing,
        ..Quantity::count(name)
    };
    Ok(Draft {
        number: TableNumber::Three,
        quantities: vec![REFLECTED, BLOCKED, core("Cortex-M4"), core("RV32")],
        base: Base::OfScene,
        full_size: runs.size.is_none(),
        lines,
        notes,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_render::interrupt::Interrupt;

    const HEAD: &str = "scene,lights,opaque,board,arith,per_pixel,commit,toolchain,emulator\n";

    fn small(text: Option<&str>) -> Result<Draft, String> {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((8, 8)), false, &interrupt);
        let draft = match text {
            None => three(None, &runs),
            Some(text) => of(text, "a.csv", &runs),
        };
        draft.map_err(|error| error.to_string())
    }

    #[test]
    fn the_record_that_comes_with_octray_has_the_figures() {
        let table = small(None).unwrap();
        assert_eq!(table.lines.len(), 4);
        assert_eq!(table.lines[3].1, "3 lights, opaque, without");
    }

    #[test]
    fn the_documentation_states_the_ratios_of_the_newest_record() {
        let note = small(None).unwrap().notes.swap_remove(0);
        let number = |word: &str| word.parse::<f64>().is_ok().then(|| word.to_owned());
        let ratios: Vec<_> = note.split(' ').filter_map(number).take(2).collect();
        let expected = format!("| {} (geometric means)", ratios.join(" and "));
        let page = include_str!("../../../docs/thesis-tables.md");
        assert!(page.contains(&expected), "{expected}");
    }

    #[test]
    fn cores_without_their_unit_follow_those_with_it() {
        let mut text = String::from(HEAD);
        for (board, cost) in [("m4", 60), ("m4f", 10), ("rv32imac", 45), ("rv32imafc", 15)] {
            text += &format!("figure-19,2,false,{board},f32,1,c,rustc,QEMU\n");
            text += &format!("figure-19,10,false,{board},f32,{cost},c,rustc,QEMU\n");
            text += &format!("figure-19,10,false,{board},auto,1,c,rustc,QEMU\n");
            text += &format!("figure-20,3,true,{board},f32,{cost},c,rustc,QEMU\n");
        }
        let table = small(Some(&text)).unwrap();
        assert_eq!(table.lines[0].1, "10 lights, with");
        assert_eq!(table.lines[0].2[2..], [10.0, 15.0]);
        assert_eq!(table.lines[1].2[2..], [60.0, 45.0]);
        assert!(
            table.notes[0].contains("6.00 (Cortex-M4) and 3.00"),
            "{}",
            table.notes[0]
        );
    }

    #[test]
    fn invalid_records_are_refused() {
        for (text, expected) in [
            ("a,b\n1,2\n", "missing field"),
            (HEAD, "no figure-19, 10 lights, in f32 on m4f"),
        ] {
            let message = small(Some(text)).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
    }
}
