//! Tables that benchmarks print.

use comfy_table::{CellAlignment, Table, presets};

/// A Markdown table, numbers to the right of the first column.
pub(crate) fn table(heading: &[&str]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::ASCII_MARKDOWN)
        .set_header(heading);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
