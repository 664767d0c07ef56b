//! Table III: the cost of pictures without and with a floating-point unit, from a record of `octray measure`.

use super::number::TableNumber;
use super::record::{self, RecordRow};
use super::table::{Base, Draft, Quantity};
use super::thesis::MOST_CSV;
use crate::measure::ratio::{CORES, geometric_mean};
use octray_prepare::Arith;
use octray_render::error::Error;
use octray_scenes::{input, name::Shown};
use std::path::Path;

/// Makes the table from a record, or from the newest that comes with octray.
///
/// # Errors
/// [`Error::Read`] if the record cannot be read, [`Error::Failed`] if it is invalid or lacks the boards.
pub fn three(path: Option<&Path>) -> Result<Draft, Error> {
    match path {
        None => of(record::NEWEST, record::NAME),
        Some(path) => {
            let text =
                input::read_text(path, MOST_CSV).map_err(|source| Error::read(path, source))?;
            of(&text, &Shown(path).to_string())
        }
    }
}

fn of(text: &str, name: &str) -> Result<Draft, Error> {
    let failed = |why: &dyn std::fmt::Display| {
        Error::Failed(format!(
            "{name} is no record of `octray measure --csv`: {why}"
        ))
    };
    let rows = record::read(text).map_err(|error| failed(&error))?;
    let cost = |scene: &str, board: &str| {
        let here =
            |row: &&RecordRow| row.scene == scene && row.board == board && row.arith == Arith::F32;
        rows.iter().find(here)?.per_pixel
    };
    let mut scenes: Vec<&str> = Vec::new();
    for row in &rows {
        if !scenes.contains(&&*row.scene) {
            scenes.push(&row.scene);
        }
    }
    let mut lines = Vec::new();
    let mut ratios = Vec::new();
    for scene in scenes {
        let of = |board| cost(scene, board).unwrap_or(f64::NAN);
        let with = CORES.map(|(_, with)| of(with));
        let without = CORES.map(|(without, _)| of(without));
        if with.iter().chain(&without).any(|cost| cost.is_nan()) {
            continue;
        }
        ratios.push([0, 1].map(|core| without[core] / with[core]));
        lines.push((scene.to_owned(), "with".to_owned(), with.to_vec()));
        lines.push((scene.to_owned(), "without".to_owned(), without.to_vec()));
    }
    let Some(first) = rows.first().filter(|_| !lines.is_empty()) else {
        let boards = CORES.map(|(without, with)| format!("{without} and {with}"));
        let needed = format!("no scene in f32 on {}", boards.join(", "));
        return Err(failed(&needed));
    };
    let means = [0, 1].map(|core| geometric_mean(ratios.iter().map(|ratios| ratios[core])));
    let notes = vec![
        format!(
            "Without the unit f32 takes {:.2} (Cortex-M4) and {:.2} (RV32) times as many instructions, geometric \
             means.",
            means[0], means[1]
        ),
        "Ours are instructions, of which one does an addition or a product in the unit, on cores whose floats are \
         otherwise emulated in integers; the thesis's are minutes of a Sun 3/110, whose coprocessor takes many \
         cycles for each. So the ratios need not be alike."
            .into(),
        format!(
            "From {name}: commit {}, {}, {}.",
            first.commit, first.toolchain, first.emulator
        ),
    ];
    let core = |name| Quantity {
        thesis: "time",
        unit: "instructions per pixel",
        ..Quantity::count(name)
    };
    Ok(Draft {
        number: TableNumber::Three,
        quantities: vec![core("Cortex-M4"), core("RV32")],
        base: Base::OfScene,
        lines,
        notes,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "scene,board,arith,per_pixel,commit,toolchain,emulator\n";

    #[test]
    fn the_record_that_comes_with_octray_has_the_figures() {
        let table = three(None).unwrap();
        assert_eq!(table.lines.len(), 10);
        assert_eq!(table.lines[9].0, "figure-23");
    }

    #[test]
    fn the_documentation_states_the_ratios_of_the_newest_record() {
        let note = three(None).unwrap().notes.swap_remove(0);
        let number = |word: &str| word.parse::<f64>().is_ok().then(|| word.to_owned());
        let ratios: Vec<_> = note.split(' ').filter_map(number).collect();
        let expected = format!("| {} (geometric means)", ratios.join(" and "));
        let page = include_str!("../../../docs/thesis-tables.md");
        assert!(page.contains(&expected), "{expected}");
    }

    #[test]
    fn cores_without_their_unit_follow_those_with_it() {
        let mut text = String::from(HEAD);
        for (board, cost) in [("m4", 60), ("m4f", 10), ("rv32imac", 45), ("rv32imafc", 15)] {
            text += &format!("a,{board},f32,{cost},c,rustc,QEMU\na,{board},auto,1,c,rustc,QEMU\n");
        }
        text += "b,m4,f32,,c,rustc,QEMU\n";
        let table = of(&text, "a.csv").unwrap();
        assert_eq!(
            table.lines[0],
            ("a".into(), "with".into(), vec![10.0, 15.0])
        );
        assert_eq!(
            table.lines[1],
            ("a".into(), "without".into(), vec![60.0, 45.0])
        );
        assert_eq!(table.lines.len(), 2);
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
            (
                HEAD,
                "no scene in f32 on m4 and m4f, rv32imac and rv32imafc",
            ),
        ] {
            let message = of(text, "a.csv").unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }
}
