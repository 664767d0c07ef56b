//! Writes all measurements as JSON and as CSV.

use octray_stability::method::About;
use octray_stability::number::ARITHMETICS;
use octray_stability::state::{Cause, ErrorStats, State};
use octray_stability::survey::{Outcome, Survey};
use serde::{Serialize, Serializer};
use std::io::{self, Write};

/// Writes one JSON object: each method with its description and its cells.
pub(super) fn json(survey: &Survey, out: &mut dyn Write) -> io::Result<()> {
    #[derive(Serialize)]
    struct MethodData<'a> {
        #[serde(flatten)]
        about: &'a About,
        cells: Vec<CellRow>,
    }
    let methods: Vec<MethodData<'_>> = survey
        .outcomes
        .iter()
        .map(|outcome| MethodData {
            about: &outcome.about,
            cells: rows(outcome).collect(),
        })
        .collect();
    serde_json::to_writer(&mut *out, &methods)?;
    writeln!(out)
}

/// Writes one line per cell.
pub(super) fn csv(survey: &Survey, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    for outcome in &survey.outcomes {
        for row in rows(outcome) {
            writer.serialize(row)?;
        }
    }
    writer.flush()
}

/// One cell as text and numbers.
#[derive(Serialize)]
struct CellRow {
    method: &'static str,
    form: &'static str,
    arithmetic: &'static str,
    #[serde(serialize_with = "swept")]
    value: f64,
    state: State,
    cause: Cause,
    admitted: bool,
    cases: u32,
    false_hits: u32,
    false_misses: u32,
    wrong_side: u32,
    saturations: u32,
    error: f64,
    angle: f64,
}

/// Serialises a swept value; infinity as text `inf`, because JSON has no number for it.
fn swept<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    match value.is_finite() {
        true => serializer.serialize_f64(*value),
        false => serializer.collect_str(value),
    }
}

fn rows(outcome: &Outcome) -> impl Iterator<Item = CellRow> + '_ {
    let about = &outcome.about;
    let lines = (0..about.forms.len()).flat_map(|f| (0..ARITHMETICS.len()).map(move |a| (f, a)));
    lines.flat_map(move |(f, a)| {
        let cells = about.values.iter().zip(outcome.row(f, a));
        cells.map(move |(&value, cell)| {
            let ErrorStats {
                cases,
                false_hits,
                false_misses,
                wrong_side,
                saturations,
                error,
                angle,
            } = cell.errors;
            CellRow {
                method: about.name,
                form: about.forms[f].name,
                arithmetic: ARITHMETICS[a],
                value,
                state: cell.state,
                cause: cell.cause,
                admitted: cell.admitted,
                cases,
                false_hits,
                false_misses,
                wrong_side,
                saturations,
                error,
                angle,
            }
        })
    })
}
