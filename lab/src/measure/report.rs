//! The results as JSON, and as comma-separated values.

use super::board::Board;
use super::emulate;
use super::job::MeasureJob;
use super::workspace::Workspace;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use serde::Serialize;
use std::io;

/// What was measured with.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct With {
    /// The sources' commit, marked if something has been changed since.
    pub commit: String,
    /// The compiler.
    pub toolchain: String,
    /// The emulators.
    pub emulator: String,
}

/// Everything that was measured, and with what.
#[derive(Clone, Debug, Serialize)]
pub struct Report<Row> {
    /// What was measured with.
    #[serde(flatten)]
    pub with: With,
    /// A line for each combination.
    pub rows: Vec<Row>,
}

impl With {
    /// The versions of what firmware is built with and of what runs these boards.
    pub fn of(workspace: &Workspace, boards: &[&Board]) -> Self {
        let mut emulators: Vec<_> = boards.iter().map(|board| emulate::version(board)).collect();
        emulators.sort();
        emulators.dedup();
        let versions = workspace.versions();
        Self {
            commit: versions.commit,
            toolchain: versions.toolchain,
            emulator: emulators.join(", "),
        }
    }
}

impl<Row: Serialize> Report<Row> {
    /// Writes the files that were asked for.
    ///
    /// # Errors
    /// If one cannot be written.
    pub fn write(
        &self,
        columns: &[&str],
        job: &MeasureJob,
        interrupt: &Interrupt,
    ) -> Result<(), Error> {
        if let Some(path) = &job.json {
            output::write_file(path, interrupt, |out| self.write_json(out))?;
        }
        if let Some(path) = &job.csv {
            output::write_file(path, interrupt, |out| self.write_csv(columns, out))?;
        }
        Ok(())
    }

    /// Writes one JSON object.
    fn write_json(&self, out: &mut dyn io::Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, self)?;
        writeln!(out)
    }

    /// Writes comma-separated values, with a line of names: these columns, and in every row with
    /// what it was measured. What is not known is empty.
    fn write_csv(&self, columns: &[&str], out: &mut dyn io::Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        csv.write_record(columns.iter().chain(&["commit", "toolchain", "emulator"]))?;
        let with = [
            &*self.with.commit,
            &self.with.toolchain,
            &self.with.emulator,
        ];
        for row in &self.rows {
            let row = serde_json::to_value(row)?;
            let cells = columns.iter().map(|name| match &row[name] {
                serde_json::Value::Null => String::new(),
                serde_json::Value::String(text) => text.clone(),
                other => other.to_string(),
            });
            csv.write_record(cells.chain(with.map(String::from)))?;
        }
        csv.flush()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::board::BOARDS;
    use super::super::job::Goal;
    use super::super::row::{COLUMNS, Cost, Row};
    use super::*;
    use octray_prepare::{Arith, FirmwareTree, Format};

    /// A row in which every number is another.
    pub(in super::super) fn example() -> Row {
        Row {
            scene: "figure-22".into(),
            objects: 45,
            width: 64,
            height: 48,
            max_depth: 8,
            pixels_per_ray: 1,
            cut_off: 0.01,
            board: &BOARDS[1],
            arith: Arith::Auto,
            tree: FirmwareTree::COMPACT,
            optimize: Goal::Speed,
            outcome: "ok".into(),
            cost: Some(Cost {
                target: BOARDS[1].target,
                core: BOARDS[1].core,
                format: Format::I4F28,
                instructions: 55_674_955,
                per_pixel: 18_123.4,
                rays: 39_804,
                per_ray: 1398.7,
                closest_rays: 9222,
                per_closest_ray: Some(1168.6),
                shadow_rays: 30_582,
                per_shadow_ray: None,
                load_store: 12_555_578,
                branch: 4_618_981,
                multiply: 5_114_358,
                divide: 0,
                float: 0,
                other: 33_386_038,
                float_library: 0,
                estimated_cycles_least: Some(66_000_000),
                estimated_cycles_most: Some(88_120_000),
                estimate_source: BOARDS[1].cycles.map(|table| table.source),
                computed_pixels_per_s_mhz: 55.2,
                flash: 20_480,
                ram: 0,
                stack: 2008,
                psnr: Some(75.25),
                hash: "d38e2a88a8a19894".into(),
            }),
            functions: vec![("f".into(), 25_000_000), ("g".into(), 1)],
        }
    }

    /// One that was measured, and one that failed.
    pub(in super::super) fn rows() -> Vec<Row> {
        let failed = Row {
            outcome: "stack overflow".into(),
            cost: None,
            ..example()
        };
        vec![example(), failed]
    }

    #[test]
    fn values_have_a_column_each_and_failures_have_none() {
        let mut bytes = Vec::new();
        let with = With {
            emulator: "QEMU 7".into(),
            ..With::default()
        };
        let report = Report { with, rows: rows() };
        report.write_csv(&COLUMNS, &mut bytes).unwrap();
        let mut csv = csv::Reader::from_reader(&*bytes);
        let names = csv.headers().unwrap().clone();
        let rows: Vec<_> = csv.records().map(Result::unwrap).collect();
        let at = |name| names.iter().position(|n| n == name).unwrap();
        assert_eq!(&rows[0][at("instructions")], "55674955");
        assert_eq!(&rows[0][at("board")], "m3");
        assert_eq!(&rows[0][at("per_shadow_ray")], "");
        assert_eq!(&rows[0][at("emulator")], "QEMU 7");
        assert_eq!(&rows[1][at("outcome")], "stack overflow");
        assert_eq!(&rows[1][at("instructions")], "");
    }

    #[test]
    fn no_column_is_forgotten() {
        let row = serde_json::to_value(example()).unwrap();
        let mut keys: Vec<_> = row.as_object().unwrap().keys().map(|k| &**k).collect();
        keys.sort_unstable();
        let mut columns = COLUMNS.to_vec();
        columns.sort_unstable();
        assert_eq!(keys, columns);
    }
}
