//! Limits, to read.

use comfy_table::{CellAlignment, Table, presets};
use octray_stability::method::About;
use octray_stability::number::ARITHMETICS;
use octray_stability::survey::Outcome;
use octray_stability::tally::{Bound, State};
use std::fmt::Write;
use std::ops::RangeInclusive;

/// A method's title, its forms and bounds, and for each arithmetic the values up to which it is
/// admitted, each form holds, and does not break.
pub(super) fn of(outcome: &Outcome) -> String {
    let about = &outcome.about;
    let mut text = format!("{} ({}): {}\n", about.title, about.name, about.axis);
    for form in about.forms {
        let _ = writeln!(text, "  {:<9} {}", form.name, form.label);
    }
    let (holds, degrades) = bounds(about);
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

/// What holds and what degrades, in words.
pub(crate) fn bounds(about: &About) -> (String, String) {
    let bounds = &about.bounds;
    let percent = |x: f64| format!("{} % wrong decisions", x * 100.0);
    let side = |x: f64| format!("{} % on the wrong side", x * 100.0);
    let error = |x: f64| format!("an error of {x} {}", about.unit);
    let angle = |x: f64| format!("an angle of {x} rad");
    let told = |pick: fn(&Bound) -> f64, saturations| {
        let each = [
            bounds.wrong.map(|b| percent(pick(&b))),
            bounds.side.map(|b| side(pick(&b))),
            bounds.error.map(|b| error(pick(&b))),
            bounds.angle.map(|b| angle(pick(&b))),
        ];
        let each: Vec<String> = each.into_iter().flatten().collect();
        format!("at most {}, {saturations}", each.join(", "))
    };
    (
        told(|b| b.holds, "no saturation"),
        told(|b| b.degrades, "any saturations"),
    )
}

/// The values around the gentlest one where the state is no worse.
pub(super) fn limit(outcome: &Outcome, form: usize, arithmetic: usize, state: State) -> String {
    told(&outcome.about, outcome.limits(form, arithmetic, state))
}

/// The values around the gentlest one whose scenes the arithmetic admits.
pub(super) fn admitted(outcome: &Outcome, arithmetic: usize) -> String {
    told(&outcome.about, outcome.admitted(arithmetic))
}

/// A dash for no value. An end of the sweep is marked: who knows what lies beyond.
fn told(about: &About, range: Option<RangeInclusive<f64>>) -> String {
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

/// A value as short as can be.
pub(super) fn number(x: f64) -> String {
    if (0.01..1e4).contains(&x) || x == 0.0 {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}
