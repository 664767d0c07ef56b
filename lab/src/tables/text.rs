//! Formats a table as text.

use super::table::{Compare, Quantity, Table, TableLine};
use comfy_table::{CellAlignment, presets};
use octray_render::counts::thousands;
use std::fmt::Write;

/// Formats the table with its title and remarks.
pub fn of(table: &Table) -> String {
    let title = format!("Table {}: {}", table.table.name(), table.title);
    let mut text = format!("{title}\n\n{}\n\n", grid(table));
    for note in notes(table) {
        let _ = writeln!(text, "- {note}");
    }
    text
}

/// Returns the remarks of a table.
pub fn notes(table: &Table) -> Vec<String> {
    (table.also.iter())
        .map(|datum| format!("The thesis also has, for no line above: {datum}."))
        .chain(table.notes.iter().cloned())
        .collect()
}

/// The number of columns with words, which come first.
pub const WORDS: usize = 2;

/// Returns the headings of the columns, and the cells of each line.
pub fn cells(table: &Table) -> (Vec<String>, Vec<Vec<String>>) {
    let mut columns = vec![
        Column {
            heading: "scene".into(),
            cell: Box::new(|line| line.scene.clone()),
        },
        Column {
            heading: table.variants.into(),
            cell: Box::new(|line| line.variant.clone()),
        },
    ];
    for (i, quantity) in table.quantities.iter().enumerate() {
        columns.extend(columns_of(table, i, quantity));
    }
    let cells = (table.lines.iter())
        .map(|line| columns.iter().map(|column| (column.cell)(line)).collect())
        .collect();
    let headings = columns.into_iter().map(|column| column.heading).collect();
    (headings, cells)
}

/// Formats only the lines and columns.
fn grid(table: &Table) -> String {
    let (headings, lines) = cells(table);
    let mut drawn = comfy_table::Table::new();
    drawn
        .load_style(presets::ASCII_MARKDOWN)
        .set_header(headings)
        .add_rows(lines);
    for column in drawn.column_iter_mut().skip(WORDS) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    drawn.to_string()
}

struct Column<'a> {
    heading: String,
    cell: Box<dyn Fn(&TableLine) -> String + 'a>,
}

/// Returns the columns of our value, its ratio, and the thesis's values.
fn columns_of<'a>(table: &'a Table, i: usize, quantity: &'a Quantity) -> Vec<Column<'a>> {
    let heading = match quantity.unit {
        "" => quantity.name.into(),
        unit => format!("{}, {unit}", quantity.name),
    };
    let mut columns = vec![Column {
        heading,
        cell: Box::new(move |line| number(line.values[i].ours, quantity.decimals)),
    }];
    if quantity.ratio {
        columns.push(Column {
            heading: "ratio".into(),
            cell: Box::new(move |line| line.values[i].ratio.map_or(String::new(), ratio)),
        });
    }
    let machines = table
        .lines
        .first()
        .map_or(&[][..], |line| &line.values[i].thesis);
    for (m, machine) in machines.iter().enumerate() {
        let thesis = match &*machine.machine {
            "" => "thesis".into(),
            machine => format!("thesis, {machine}"),
        };
        columns.push(Column {
            heading: thesis.clone(),
            cell: Box::new(move |line| {
                let given = &line.values[i].thesis[m];
                match given.value {
                    Some(value) if given.unit.is_empty() => plain(value),
                    Some(value) => format!("{} {}", plain(value), given.unit),
                    None => String::new(),
                }
            }),
        });
        if matches!(quantity.compare, Compare::Value(_)) {
            columns.push(Column {
                heading: "ours / thesis".into(),
                cell: Box::new(move |line| {
                    let given = &line.values[i].thesis[m];
                    given.ours_over_thesis.map_or(String::new(), ratio)
                }),
            });
        }
        if quantity.ratio {
            columns.push(Column {
                heading: "thesis, ratio".into(),
                cell: Box::new(move |line| {
                    let given = &line.values[i].thesis[m];
                    given.ratio.map_or(String::new(), ratio)
                }),
            });
        }
    }
    columns
}

fn ratio(ratio: f64) -> String {
    format!("{ratio:.2}")
}

/// Formats the thesis's number with the decimals it has.
fn plain(value: f64) -> String {
    match value.fract() == 0.0 && (0.0..1e15).contains(&value) {
        true => thousands(value as u64),
        false => value.to_string(),
    }
}

/// Formats a non-negative number with commas and `decimals` decimals; what there is not as nothing.
fn number(value: f64, decimals: usize) -> String {
    if value.is_nan() {
        return String::new();
    }
    let text = format!("{value:.decimals$}");
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    whole
        .parse()
        .map_or(text.clone(), |whole| thousands(whole) + rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_commas_and_decimals() {
        assert_eq!(number(1234.56, 1), "1,234.6");
        assert_eq!(number(1234.56, 0), "1,235");
        assert_eq!(number(f64::NAN, 1), "");
        assert_eq!(plain(2.5), "2.5");
        assert_eq!(plain(12000.0), "12,000");
    }
}
