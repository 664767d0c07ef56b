//! The kernels' costs as a table to read.

use super::super::table::{left, table};
use super::{KERNELS, Row};

/// The table: a line for each kernel, a column for each board and arithmetic; and below it what
/// failed.
pub(super) fn text(rows: &[Row]) -> String {
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
        let cost = |run: &&[Row]| run.get(i).and_then(|row| row.per_call);
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

/// What failed: a line for each board and arithmetic.
pub(super) fn failures(rows: &[Row]) -> Vec<String> {
    (rows.chunks(KERNELS.len()))
        .filter_map(|run| run.iter().find(|row| row.outcome != "ok"))
        .map(|row| format!("{}: {}", head(row), row.outcome))
        .collect()
}

/// The board, the arithmetic, and the format if that is another.
fn head(row: &Row) -> String {
    format!("{} {}", row.board.name, row.arith.with_format(row.format))
}

#[cfg(test)]
mod tests {
    use super::super::super::board::BOARDS;
    use super::super::{COLUMNS, row};
    use super::*;
    use octray_prepare::Arith;

    #[test]
    fn failures_are_told_once_and_have_no_number() {
        let failed = Err("stack overflow".to_owned());
        let rows = KERNELS.map(|kernel| row(kernel, &BOARDS[1], Arith::F32, &failed));
        let text = text(&rows);
        assert!(text.ends_with("\nm3 f32: stack overflow\n"), "{text}");
        assert_eq!(text.matches("stack overflow").count(), 1);
        assert_eq!(text.matches("– |").count(), KERNELS.len(), "{text}");
    }

    #[test]
    fn no_column_is_forgotten() {
        let row = row(KERNELS[0], &BOARDS[1], Arith::F32, &Err("hung".to_owned()));
        let row = serde_json::to_value(row).unwrap();
        let mut keys: Vec<_> = row.as_object().unwrap().keys().map(|k| &**k).collect();
        keys.sort_unstable();
        let mut columns = COLUMNS.to_vec();
        columns.sort_unstable();
        assert_eq!(keys, columns);
    }
}
