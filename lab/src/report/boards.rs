//! Microcontrollers, from the newest record of `octray measure` that comes with octray: table III, and sizes.

use crate::page::{self, Section, table};
use crate::tables::record::{self, RecordRow};
use crate::tables::runs::Runs;
use crate::tables::thesis::Thesis;
use crate::tables::{self, emulated};
use maud::html;
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;

/// Returns table III with today's boards, and the needs of programs.
///
/// # Errors
/// [`Error::Failed`] if a record is invalid, [`Error::Interrupted`].
pub(super) fn sections(interrupt: &Interrupt) -> Result<Vec<Section>, Error> {
    let rows = record::read(record::NEWEST)
        .map_err(|cause| Error::Failed(format!("{}: {cause}", record::NAME)))?;
    let commit = rows.first().map_or("", |row| &row.commit);
    let three =
        emulated::three(None, &Runs::new(None, false, interrupt))?.beside(&Thesis::read(None)?);
    let measured = format!("{}, measured at commit {commit}", record::NAME);
    let units = Section {
        id: "units".into(),
        title: "Table III, today: without and with a floating-point unit".into(),
        body: html! {
            (page::chart(record::CHART, "instructions per pixel without and with a floating-point unit"))
            (tables::page::body(&three))
        },
        commands: vec![
            "octray tables III".into(),
            "octray measure --arith f32,approx2,auto --chart table-3.svg".into(),
        ],
    };
    let sizes = Section {
        id: "sizes".into(),
        title: "What programs need on microcontrollers".into(),
        body: html! {
            p {
                "Instructions per pixel; bytes of flash, of RAM without the stack, and of the stack; and decibels "
                "against 64-bit floats, from " (measured) "."
            }
            (table(&HEAD, WORDS, &rows.iter().map(cells).collect::<Vec<_>>()))
        },
        commands: vec!["octray measure --arith f32,approx2,auto".into()],
    };
    Ok(vec![units, sizes])
}

/// The number of columns with words, which come first.
const WORDS: usize = 3;
const HEAD: [&str; 8] = [
    "scene",
    "board",
    "arithmetic",
    "per pixel",
    "flash",
    "RAM",
    "stack",
    "PSNR",
];

fn cells(row: &RecordRow) -> Vec<String> {
    let whole = |n: Option<u64>| n.map_or("–".into(), thousands);
    let (cost, accuracy) = match row.per_pixel {
        None => (row.outcome.clone(), "–".into()),
        Some(cost) => (
            thousands(cost.round() as u64),
            row.psnr.map_or("equal".into(), |psnr| format!("{psnr:.1}")),
        ),
    };
    vec![
        row.scene.clone(),
        row.board.clone(),
        row.arith.with_format(row.format),
        cost,
        whole(row.flash),
        whole(row.ram),
        whole(row.stack),
        accuracy,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_record_that_comes_with_octray_is_shown() {
        let sections = sections(&Interrupt::new()).unwrap();
        let text: String = sections.iter().map(|s| s.body.0.clone()).collect();
        for expected in [
            "figure-23",
            "rv32imafc",
            "auto: ",
            "<svg",
            "opaque, without",
        ] {
            assert!(text.contains(expected), "{expected}");
        }
    }

    #[test]
    fn a_failure_is_not_reported_as_equal() {
        let text = "scene,board,arith,format,outcome,per_pixel,flash,ram,stack,psnr,commit,toolchain,emulator\n\
                    a,m0,f32,,stack overflow,,,,,,c,rustc,QEMU\na,m3,f32,f32,ok,10.4,1000,20,30,,c,rustc,QEMU\n";
        let rows: Vec<_> = record::read(text).unwrap().iter().map(cells).collect();
        let failed = ["a", "m0", "f32", "stack overflow", "–", "–", "–", "–"];
        assert_eq!(rows[0], failed);
        let equal = ["a", "m3", "f32", "10", "1,000", "20", "30", "equal"];
        assert_eq!(rows[1], equal);
    }
}
