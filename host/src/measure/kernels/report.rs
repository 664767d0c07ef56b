//! The kernels' costs as a table to read, as JSON, and as comma-separated values.

use super::super::report::{left, table};
use super::{KERNELS, Row};
use serde::Serialize;
use std::io;

/// Everything that was measured, and with what.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Report {
    pub(super) commit: String,
    pub(super) toolchain: String,
    pub(super) emulator: String,
    /// All kernels of a board and an arithmetic, one after another.
    pub(super) rows: Vec<Row>,
}

impl Report {
    /// Writes one JSON object.
    pub(super) fn write_json(&self, out: &mut dyn io::Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, self)?;
        writeln!(out)
    }

    /// Writes comma-separated values, with a line of names. What is not known is empty.
    pub(super) fn write_csv(&self, out: &mut dyn io::Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        for row in &self.rows {
            csv.serialize(row)?;
        }
        csv.flush()
    }

    /// The table: a line for each kernel, a column for each board and arithmetic; and below it what
    /// failed.
    pub(super) fn text(&self) -> String {
        let runs: Vec<_> = self.rows.chunks(KERNELS.len()).collect();
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
        for failure in self.failures() {
            text += &format!("{failure}\n");
        }
        text
    }

    /// What failed: a line for each board and arithmetic.
    pub(super) fn failures(&self) -> Vec<String> {
        (self.rows.chunks(KERNELS.len()))
            .filter_map(|run| run.iter().find(|row| row.outcome != "ok"))
            .map(|row| format!("{}: {}", head(row), row.outcome))
            .collect()
    }
}

/// The board, the arithmetic, and the format if that is another.
fn head(row: &Row) -> String {
    let arith = row.arith.name();
    match &row.format {
        Some(format) if format != arith => format!("{} {arith}: {format}", row.board.name),
        _ => format!("{} {arith}", row.board.name),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::board::BOARDS;
    use super::super::row;
    use super::*;
    use crate::job::Arith;

    #[test]
    fn failures_are_told_once_and_have_no_number() {
        let failed = Err("stack overflow".to_owned());
        let rows = KERNELS.map(|kernel| row(kernel, &BOARDS[1], Arith::F32, &failed));
        let report = Report {
            commit: String::new(),
            toolchain: String::new(),
            emulator: String::new(),
            rows: rows.to_vec(),
        };
        let text = report.text();
        assert!(text.ends_with("\nm3 f32: stack overflow\n"), "{text}");
        assert_eq!(text.matches("stack overflow").count(), 1);
        assert_eq!(text.matches("– |").count(), KERNELS.len(), "{text}");
        let mut csv = Vec::new();
        report.write_csv(&mut csv).unwrap();
        let csv = String::from_utf8(csv).unwrap();
        assert_eq!(csv.lines().count(), 1 + KERNELS.len());
        assert!(csv.contains("\nadd,m3,thumbv7m-none-eabi,Cortex-M3,f32,,stack overflow,,,,\n"));
    }
}
