//! The committed record of where methods hold, degrade and break, and its comparison with a survey.

use crate::number::ARITHMETICS;
use crate::state::State;
use crate::survey::Survey;
use std::collections::BTreeMap;

const HEAD: &str = "method,form,arithmetic,states";

/// Writes a survey's states as text: one line per method, form and arithmetic, with one [`State::symbol`] per swept
/// value.
pub fn write(survey: &Survey) -> String {
    let mut text = format!("{HEAD}\n");
    for (key, states) in lines(survey) {
        text += &format!("{key},{states}\n");
    }
    text
}

/// Returns the recorded states of a method, a form and an arithmetic, one symbol per swept value, or `None` without
/// such a line.
pub fn states<'a>(record: &'a str, [method, form, arithmetic]: [&str; 3]) -> Option<&'a str> {
    let key = format!("{method},{form},{arithmetic},");
    record.lines().find_map(|line| line.strip_prefix(&key))
}

fn lines(survey: &Survey) -> Vec<(String, String)> {
    let mut lines = Vec::new();
    for outcome in &survey.outcomes {
        for (f, form) in outcome.about.forms.iter().enumerate() {
            for (a, arithmetic) in ARITHMETICS.iter().enumerate() {
                let row = outcome.row(f, a);
                let states = row.iter().map(|cell| cell.state.symbol()).collect();
                let key = format!("{},{},{arithmetic}", outcome.about.name, form.name);
                lines.push((key, states));
            }
        }
    }
    lines
}

/// Returns the differences of a record and a survey, one sentence per line.
pub fn compare(record: &str, survey: &Survey) -> Vec<String> {
    let mut recorded: BTreeMap<&str, &str> = record
        .lines()
        .skip(1)
        .filter_map(|line| line.rsplit_once(','))
        .collect();
    let mut sentences = Vec::new();
    for (key, now) in lines(survey) {
        match recorded.remove(key.as_str()) {
            None => sentences.push(format!("{key} is not in the record")),
            Some(then) if then == now => {}
            Some(then) => {
                let badness = |c| State::ALL.iter().position(|s| s.symbol() == c);
                let worse = then.len() != now.len()
                    || (then.chars().zip(now.chars())).any(|(a, b)| badness(b) > badness(a));
                let verdict = if worse { "worse" } else { "better" };
                sentences.push(format!("{key} got {verdict}: {then} became {now}"));
            }
        }
    }
    let gone = recorded.keys();
    sentences.extend(gone.map(|key| format!("{key} is in the record only")));
    sentences
}
