//! The kernels' costs as a table.

use super::super::table::{left, table};
use super::{KERNELS, KernelRow};

/// Formats the table: a line per kernel, a column per board and arithmetic; the failures follow.
pub(super) fn text(rows: &[KernelRow]) -> String {
    let runs: Vec<_> = rows.chunks(KERNELS.len()).collect();
    let heads = runs.iter().filter_map(|run| run.first()).map(head);
    let heads: Vec<_> = ["instructions per call".into()]
        .into_iter()
        .chain(heads)
        .collect();
    let heads: Vec<_> = heads.iter().map(String::as_str).collect();
    let mut table = table(&heads);
    left(&mut table, 1);
    for (i, (kernel, _)) in KERNELS.iter().enumerate() {
        let cost = |run: &&[KernelRow]| run.get(i).and_then(|row| row.per_call);
        let cell = |cost: Option<f64>| cost.map_or("–".into(), |cost| format!("{cost:.1}"));
        let cells = runs.iter().map(|run| cell(cost(run)));
        table.add_row([(*kernel).into()].into_iter().chain(cells));
    }
    let mut text = format!("{table}\n");
    for failure in failures(rows) {
        text += &format!("{failure}\n");
    }
    text
}

/// Returns the failures: a line per board and arithmetic.
pub(super) fn failures(rows: &[KernelRow]) -> Vec<String> {
    (rows.chunks(KERNELS.len()))
        .filter_map(|run| run.iter().find(|row| row.outcome != "ok"))
        .map(|row| format!("{}: {}", head(row), row.outcome))
        .collect()
}

/// Returns the board, the arithmetic, and the format if it differs.
fn head(row: &KernelRow) -> String {
    format!("{} {}", row.board.name, row.arith.with_format(row.format))
}

#[cfg(test)]
mod tests {
    use super::super::super::board::BOARDS;
    use super::super::{COLUMNS, row};
    use super::*;
    use octray_prepare::Arith;

    #[test]
    fn failures_are_reported_once_and_have_no_number() {
        let failed = Err("stack overflow".to_owned());
        let rows = KERNELS.map(|kernel| row(kernel, &BOARDS[1], Arith::F32, &failed));
        let text = text(&rows);
        assert!(text.ends_with("\nm3 f32: stack overflow\n"), "{text}");
        assert_eq!(text.matches("stack overflow").count(), 1);
        assert_eq!(text.matches("– |").count(), KERNELS.len(), "{text}");
    }

    #[test]
    fn every_field_has_a_column() {
        let row = row(KERNELS[0], &BOARDS[1], Arith::F32, &Err("hung".to_owned()));
        let row = serde_json::to_value(row).unwrap();
        let mut keys: Vec<_> = row.as_object().unwrap().keys().map(|k| &**k).collect();
        keys.sort_unstable();
        let mut columns = COLUMNS.to_vec();
        columns.sort_unstable();
        assert_eq!(keys, columns);
    }
}
