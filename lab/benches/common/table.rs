//! Tables for the output of benchmarks.

use comfy_table::{CellAlignment, Table, presets};

/// Returns a Markdown table whose columns are aligned right, except the first.
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
