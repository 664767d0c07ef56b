//! Writes the results as JSON and as comma-separated values.

use super::board::Board;
use super::emulate;
use super::job::MeasureJob;
use super::source_tree::SourceTree;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use serde::Serialize;
use std::io;

/// The software of the measurement.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct With {
    /// The sources' commit, marked if the sources have been changed since.
    pub commit: String,
    /// The compiler.
    pub toolchain: String,
    /// The emulators.
    pub emulator: String,
}

/// All results, and the software of the measurement.
#[derive(Clone, Debug, Serialize)]
pub struct MeasureReport<R> {
    /// The software of the measurement.
    #[serde(flatten)]
    pub with: With,
    /// One row per combination.
    pub rows: Vec<R>,
}

impl With {
    /// Returns the versions of the software that builds firmware and runs these boards.
    pub fn of(sources: &SourceTree, boards: &[&Board]) -> Self {
        let mut emulators: Vec<_> = boards.iter().map(|board| emulate::version(board)).collect();
        emulators.sort();
        emulators.dedup();
        let versions = sources.versions();
        Self {
            commit: versions.commit,
            toolchain: versions.toolchain,
            emulator: emulators.join(", "),
        }
    }
}

impl<R: Serialize> MeasureReport<R> {
    /// Writes the requested files.
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

    /// Writes comma-separated values with a header: these columns, and the software in every row. Unknown values are
    /// empty.
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
    use super::super::row::{COLUMNS, Cost, FrameRow};
    use super::*;
    use octray_prepare::{Arith, FirmwareTree, Format};

    /// A row in which all numbers are different.
    pub(in super::super) fn example() -> FrameRow {
        FrameRow {
            scene: "figure-22".into(),
            objects: 45,
            lights: 46,
            opaque: false,
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

    /// A successful and a failed row.
    pub(in super::super) fn rows() -> Vec<FrameRow> {
        let failed = FrameRow {
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
        let report = MeasureReport { with, rows: rows() };
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
    fn every_field_has_a_column() {
        let row = serde_json::to_value(example()).unwrap();
        let mut keys: Vec<_> = row.as_object().unwrap().keys().map(|k| &**k).collect();
        keys.sort_unstable();
        let mut columns = COLUMNS.to_vec();
        columns.sort_unstable();
        assert_eq!(keys, columns);
    }
}
