//! Tables as a page: a section for each, with its chart, its remarks and its command.

use super::number::TableNumber;
use super::shared::{COHERENCE, Simulation};
use super::table::Table;
use super::{Charted, TablesJob, text};
use crate::page::{self, Section};
use maud::{Markup, html};
use std::path::Path;

const TITLE: &str = "The thesis's tables";
const ABOUT: &str = "Tables of T. Jadi, Implementing Ray Tracing Algorithm in Parallel Environment (Portland State \
    University, 1989), from our own runs beside the thesis's numbers, each row in its conditions. Below each table stands \
    what agrees and what does not.";

/// Returns the page.
pub(super) fn of(made: &[Charted], job: &TablesJob) -> String {
    let sections: Vec<Section> = (made.iter())
        .map(|(table, svg)| section(table, svg.as_deref(), job))
        .collect();
    page::of(TITLE, ABOUT, &sections).into_string()
}

fn section(table: &Table, svg: Option<&str>, job: &TablesJob) -> Section {
    let title = format!("Table {}: {}", table.table.name(), table.title);
    Section {
        id: format!("table-{}", table.table.name()),
        body: html! {
            (body(table))
            @if let Some(svg) = svg { (page::chart(svg, &title)) }
        },
        title,
        commands: vec![command(table.table, job)],
    }
}

/// Returns a table and its remarks, without its title.
pub(crate) fn body(table: &Table) -> Markup {
    let (headings, lines) = text::cells(table);
    html! {
        (page::table(&headings, text::WORDS, &lines))
        ul { @for note in text::notes(table) { li { (note) } } }
    }
}

/// Returns the command that prints a table again, with what of the job bears on it.
fn command(number: TableNumber, job: &TablesJob) -> String {
    let mut words = format!("octray tables {}", number.name());
    let mut add = |option: &str, value: String| words += &format!(" --{option} {value}");
    let file = |path: &Path| page::quoted(path);
    if let Some((width, height)) = job.size {
        add("size", format!("{width}x{height}"));
    }
    if let Some(thesis) = &job.thesis {
        add("thesis", file(thesis));
    }
    if let (TableNumber::Three, Some(record)) = (number, &job.record) {
        add("record", file(record));
    }
    if number >= TableNumber::Eight {
        let Simulation {
            processors,
            rows,
            machine,
        } = job.simulation;
        let numbers = [
            ("processors", f64::from(processors.get()), 8.0),
            ("tile-rows", f64::from(rows.get()), 2.0),
            ("hand-out", machine.hand_out, 0.0),
            ("contention", machine.contention, 0.0),
            ("coherence", machine.coherence, COHERENCE),
            ("serial", machine.serial, 0.0),
        ];
        for (option, value, default) in numbers {
            if value != default {
                add(option, value.to_string());
            }
        }
        add("charts", "charts".into());
    }
    if job.time {
        words += " --time";
    }
    words
}
