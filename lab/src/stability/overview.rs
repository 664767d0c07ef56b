//! The limits of all methods in one table.

use super::table::{admitted, limit};
use comfy_table::{CellAlignment, Table, presets};
use octray_stability::number::ARITHMETICS;
use octray_stability::state::State;
use octray_stability::survey::Survey;

/// Formats one line per method and form: the value to which it holds, and the value beyond which it breaks, in some
/// arithmetics by their numbers; for octray's own form also the value to which it is admitted.
pub(crate) fn of(survey: &Survey, arithmetics: &[usize]) -> String {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN);
    let mut head = vec!["method".into(), "swept".into(), "form".into()];
    for &a in arithmetics {
        head.push(format!("{} holds to", ARITHMETICS[a]));
        head.push("breaks beyond".into());
        head.push("admitted to".into());
    }
    table.set_header(head);
    for outcome in &survey.outcomes {
        let about = &outcome.about;
        for (f, form) in about.forms.iter().enumerate() {
            let [name, axis] = match f {
                0 => [about.name, about.axis],
                _ => [""; 2],
            };
            let mut line = vec![name.into(), axis.into(), form.name.into()];
            for &a in arithmetics {
                line.push(limit(outcome, f, a, State::Holds));
                line.push(limit(outcome, f, a, State::Degrades));
                line.push(match f {
                    0 => admitted(outcome, a),
                    _ => String::new(),
                });
            }
            table.add_row(line);
        }
    }
    for column in table.column_iter_mut().skip(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.trim_fmt() + "\n"
}
