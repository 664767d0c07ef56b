//! The limits of a method as a table.

use comfy_table::{CellAlignment, Table, presets};
use octray_stability::method::About;
use octray_stability::number::ARITHMETICS;
use octray_stability::state::{State, StateLimit};
use octray_stability::survey::Outcome;
use std::fmt::Write;
use std::ops::RangeInclusive;

/// Formats a method's title, its forms and limits, and for each arithmetic the values up to which it is admitted, each
/// form holds, and does not break.
pub(super) fn of(outcome: &Outcome) -> String {
    let about = &outcome.about;
    let mut text = format!("{} ({}): {}\n", about.title, about.name, about.axis);
    for form in about.forms {
        let _ = writeln!(text, "  {:<9} {}", form.name, form.label);
    }
    let (holds, degrades) = limits(about);
    let _ = writeln!(
        text,
        "  {:<9} {holds}\n  {:<9} {degrades}",
        "holds", "degrades"
    );
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN);
    let mut head = vec![String::new(), "admitted".into()];
    for form in about.forms {
        head.push(format!("{} holds", form.name));
        head.push("breaks beyond".into());
    }
    table.set_header(head);
    for (a, arithmetic) in ARITHMETICS.iter().enumerate() {
        let mut line = vec![String::from(*arithmetic), admitted(outcome, a)];
        for f in 0..about.forms.len() {
            line.push(limit(outcome, f, a, State::Holds));
            line.push(limit(outcome, f, a, State::Degrades));
        }
        table.add_row(line);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    text + &table.trim_fmt() + "\n"
}

/// Describes what holds and what degrades.
pub(crate) fn limits(about: &About) -> (String, String) {
    let limits = &about.limits;
    let percent = |x: f64| format!("{} % wrong decisions", x * 100.0);
    let side = |x: f64| format!("{} % on the wrong side", x * 100.0);
    let error = |x: f64| format!("an error of {x} {}", about.unit);
    let angle = |x: f64| format!("an angle of {x} rad");
    let description = |pick: fn(&StateLimit) -> f64, saturations| {
        let each = [
            limits.wrong.map(|b| percent(pick(&b))),
            limits.side.map(|b| side(pick(&b))),
            limits.error.map(|b| error(pick(&b))),
            limits.angle.map(|b| angle(pick(&b))),
        ];
        let each: Vec<String> = each.into_iter().flatten().collect();
        format!("at most {}, {saturations}", each.join(", "))
    };
    (
        description(|b| b.holds, "no saturation"),
        description(|b| b.degrades, "any saturations"),
    )
}

/// Formats the range of values around the easiest one in which no state is worse.
pub(super) fn limit(outcome: &Outcome, form: usize, arithmetic: usize, state: State) -> String {
    range_text(&outcome.about, outcome.limits(form, arithmetic, state))
}

/// Formats the range of values around the easiest one whose scenes the arithmetic admits.
pub(super) fn admitted(outcome: &Outcome, arithmetic: usize) -> String {
    range_text(&outcome.about, outcome.admitted(arithmetic))
}

/// Formats a range; a dash if there is none. The ends of the sweep are marked, because the limit may be beyond them.
fn range_text(about: &About, range: Option<RangeInclusive<f64>>) -> String {
    let Some(range) = range else {
        return "-".into();
    };
    let (low, high) = (*range.start(), *range.end());
    let high_text = if about.values.last() == Some(&high) {
        format!("≥ {}", number(high))
    } else {
        number(high)
    };
    if about.values.first() == Some(&about.home) {
        return high_text;
    }
    if about.values.first() == Some(&low) {
        format!("≤ {} to {high_text}", number(low))
    } else {
        format!("{} to {high_text}", number(low))
    }
}

/// Formats a value as short as possible.
pub(super) fn number(x: f64) -> String {
    if (0.01..1e4).contains(&x) || x == 0.0 {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}
