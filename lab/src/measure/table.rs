//! The results as a table.

use super::row::{Cost, FrameRow};
use comfy_table::{CellAlignment, Table, presets};
use octray_render::counts::thousands;

/// Formats the table, the text `below`, and the most expensive functions of each row.
pub fn text(rows: &[FrameRow], below: &str, functions: usize) -> String {
    let mut text = frames(rows) + below;
    for row in rows.iter().filter(|_| functions > 0) {
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

/// Formats the table: a line per row.
fn frames(rows: &[FrameRow]) -> String {
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
        let format = row.cost.as_ref().map(|cost| cost.format);
        let arith = row.arith.with_format(format);
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

/// Returns a table with these columns, all for numbers.
pub(crate) fn table(columns: &[&str]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::ASCII_MARKDOWN)
        .set_header(columns);
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Aligns the first columns to the left, for words.
pub(crate) fn left(table: &mut Table, columns: usize) {
    for column in table.column_iter_mut().take(columns) {
        column.set_cell_alignment(CellAlignment::Left);
    }
}

#[cfg(test)]
mod tests {
    use super::super::report::tests::rows;
    use super::*;

    #[test]
    fn a_failure_takes_the_place_of_numbers() {
        let text = text(&rows(), "", 0);
        let last = text.lines().last().unwrap();
        assert!(last.contains("| stack overflow "), "{text}");
        assert!(!last.contains("55,"), "{text}");
    }

    #[test]
    fn the_most_expensive_functions_are_printed_on_request() {
        let text = text(&rows(), "", 1);
        assert!(text.contains("figure-22 m3 auto\n   44.9 %       25,000,000  f\n"));
        assert!(!text.contains("  g"), "{text}");
    }
}
