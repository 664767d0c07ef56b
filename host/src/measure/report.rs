//! The results as a table to read, as JSON, and as comma-separated values.

use super::ratio;
use super::row::{Cost, Row};
use crate::facts::thousands;
use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;
use std::io;

/// Everything that was measured, and with what.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The commit of the sources.
    pub commit: String,
    /// The compiler.
    pub toolchain: String,
    /// The emulator.
    pub emulator: String,
    /// A line for each combination.
    pub rows: Vec<Row>,
}

/// The columns of comma-separated values: those of every row, in order.
const COLUMNS: [&str; 39] = [
    "scene",
    "objects",
    "width",
    "height",
    "max_depth",
    "board",
    "target",
    "core",
    "arith",
    "format",
    "tree",
    "optimize",
    "outcome",
    "instructions",
    "per_pixel",
    "rays",
    "per_ray",
    "closest_rays",
    "per_closest_ray",
    "shadow_rays",
    "per_shadow_ray",
    "load_store",
    "branch",
    "multiply",
    "divide",
    "float",
    "other",
    "float_library",
    "estimated_cycles_least",
    "estimated_cycles_most",
    "estimate_source",
    "computed_pixels_per_s_mhz",
    "flash",
    "ram",
    "stack",
    "psnr",
    "hash",
    // The same in every row.
    "commit",
    "toolchain",
];

impl Report {
    /// Writes one JSON object.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_json(&self, out: &mut dyn io::Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, self)?;
        writeln!(out)
    }

    /// Writes comma-separated values, with a line of names. What is not known is empty.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_csv(&self, out: &mut dyn io::Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        csv.write_record(COLUMNS.iter().chain(&["emulator"]))?;
        for row in &self.rows {
            let mut value = serde_json::to_value(row)?;
            value["commit"] = (&*self.commit).into();
            value["toolchain"] = (&*self.toolchain).into();
            value["emulator"] = (&*self.emulator).into();
            csv.write_record(
                COLUMNS
                    .iter()
                    .chain(&["emulator"])
                    .map(|name| match &value[name] {
                        serde_json::Value::Null => String::new(),
                        serde_json::Value::String(text) => text.clone(),
                        other => other.to_string(),
                    }),
            )?;
        }
        csv.flush()
    }

    /// The table, and the costliest functions of each row.
    pub fn text(&self, functions: usize) -> String {
        let mut text = frames(&self.rows) + &ratio::text(&self.rows);
        for row in self.rows.iter().filter(|_| functions > 0) {
            let Some(all) = row.instructions() else {
                continue;
            };
            text += &format!("\n{} {} {}\n", row.scene, row.board.name, row.arith.name());
            for (name, n) in row.functions.iter().take(functions) {
                let share = percent(*n, all);
                text += &format!("{share:>7} %  {:>15}  {name}\n", thousands(*n));
            }
        }
        text
    }
}

/// The table: a line for each row.
fn frames(rows: &[Row]) -> String {
    let mut table = table(&[
        "scene",
        "board",
        "arithmetic",
        "instructions",
        "per pixel",
        "per ray",
        "closest hit",
        "load/store %",
        "branch %",
        "mul %",
        "div %",
        "FPU %",
        "float library %",
        "Mcycles, estimated",
        "flash",
        "RAM",
        "stack",
        "PSNR",
    ]);
    left(&mut table, 3);
    for row in rows {
        let arith = match &row.cost {
            Some(cost) if cost.format != row.arith.name() => {
                format!("{}: {}", row.arith.name(), cost.format)
            }
            _ => row.arith.name().into(),
        };
        let mut cells = vec![row.scene.clone(), row.board.name.into(), arith];
        match &row.cost {
            Some(cost) => cells.extend(numbers(cost)),
            None => cells.push(row.outcome.clone()),
        }
        table.add_row(cells);
    }
    format!("{table}\n")
}

fn numbers(cost: &Cost) -> impl Iterator<Item = String> {
    let count = |n: f64| thousands(n.round() as u64);
    let share = |n| percent(n, cost.instructions);
    let cycles = match (cost.estimated_cycles_least, cost.estimated_cycles_most) {
        (Some(least), Some(most)) if least == most => millions(least),
        (Some(least), Some(most)) => format!("{} to {}", millions(least), millions(most)),
        _ => "–".into(),
    };
    [
        thousands(cost.instructions),
        count(cost.per_pixel),
        count(cost.per_ray),
        cost.per_closest_ray.map_or("–".into(), count),
        share(cost.load_store),
        share(cost.branch),
        share(cost.multiply),
        share(cost.divide),
        share(cost.float),
        share(cost.float_library),
        cycles,
        thousands(cost.flash),
        thousands(cost.ram),
        thousands(cost.stack),
        cost.psnr
            .map_or("equal".into(), |psnr| format!("{psnr:.1}")),
    ]
    .into_iter()
}

fn percent(n: u64, of: u64) -> String {
    format!("{:.1}", 100.0 * n as f64 / of.max(1) as f64)
}

fn millions(n: u64) -> String {
    format!("{:.1}", n as f64 / 1e6)
}

/// A table with these columns, all of numbers.
pub(super) fn table(columns: &[&str]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::ASCII_MARKDOWN)
        .set_header(columns);
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// The first columns hold words.
pub(super) fn left(table: &mut Table, columns: usize) {
    for column in table.column_iter_mut().take(columns) {
        column.set_cell_alignment(CellAlignment::Left);
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::board::BOARDS;
    use super::super::job::{Goal, TreeKind};
    use super::*;
    use crate::job::Arith;

    /// A row in which every number is another.
    pub(in super::super) fn example() -> Row {
        Row {
            scene: "figure-22".into(),
            objects: 45,
            width: 64,
            height: 48,
            max_depth: 8,
            board: &BOARDS[1],
            arith: Arith::Auto,
            tree: TreeKind::Packed,
            optimize: Goal::Speed,
            outcome: "ok".into(),
            cost: Some(Cost {
                target: BOARDS[1].target,
                core: BOARDS[1].core,
                format: "i4f28".into(),
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

    fn report() -> Report {
        let failed = Row {
            outcome: "stack overflow".into(),
            cost: None,
            ..example()
        };
        Report {
            commit: "0123456789ab".into(),
            toolchain: "rustc 1".into(),
            emulator: "QEMU 7".into(),
            rows: vec![example(), failed],
        }
    }

    #[test]
    fn a_failure_stands_where_numbers_would() {
        let text = report().text(0);
        let last = text.lines().last().unwrap();
        assert!(last.contains("| stack overflow "), "{text}");
        assert!(!last.contains("55,"), "{text}");
    }

    #[test]
    fn the_costliest_functions_are_told_if_asked_for() {
        let text = report().text(1);
        assert!(text.contains("figure-22 m3 auto\n   44.9 %       25,000,000  f\n"));
        assert!(!text.contains("  g"), "{text}");
    }

    #[test]
    fn values_have_a_column_each_and_failures_have_none() {
        let mut bytes = Vec::new();
        report().write_csv(&mut bytes).unwrap();
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
        keys.extend(["commit", "toolchain"]);
        keys.sort_unstable();
        let mut columns = COLUMNS.to_vec();
        columns.sort_unstable();
        assert_eq!(keys, columns);
    }
}
