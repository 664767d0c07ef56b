//! A tree as lines for a terminal.

use super::node::{Cost, Node};
use super::{Report, Trace, pair};
use octray_scenes::name;
use std::fmt;

/// Displays a report, each line with a line end.
pub(super) struct Tree<'a>(pub(super) &'a Report);

/// A line of a tree: its first cell is drawn beside the branches.
#[derive(Default)]
struct Row {
    cells: Vec<String>,
    /// Whether two arithmetics differ here.
    differs: bool,
}

impl fmt::Display for Tree<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let report = self.0;
        let ((column, row), (width, height)) = (report.pixel, report.size);
        let scene = name::line(&report.scene);
        writeln!(f, "{scene}, pixel {column},{row} of {width} x {height}")?;
        for trace in &report.traces {
            writeln!(f, "{}", colour(trace))?;
        }
        if report.traces.iter().all(|trace| trace.rays.is_empty()) {
            return writeln!(f, "no ray is traced: nothing but background is there");
        }
        writeln!(f)?;
        match &*report.traces {
            [one] => table(f, &single(&one.rays), ""),
            [a, b] => {
                table(f, &double(a, b), "  ")?;
                writeln!(f)?;
                partings(f, report)
            }
            _ => Ok(()),
        }
    }
}

/// `i16f16: colour 12 34 56 (0.0471 0.1333 0.2196)`.
fn colour(trace: &Trace) -> String {
    let name = trace.arith.with_format(Some(trace.format));
    let [r, g, b] = trace.level;
    let [x, y, z] = trace.intensity;
    format!("{name}: colour {r} {g} {b} ({x:.4} {y:.4} {z:.4})")
}

fn single(rays: &[Node]) -> Vec<Row> {
    let mut rows = vec![row([
        "ray", "meets", "distance", "weight", "nodes", "tests",
    ])];
    for (i, ray) in rays.iter().enumerate() {
        let label = numbered(ray.kind, i, rays.len());
        ray_rows(ray, label, "", &mut rows);
    }
    rows
}

fn ray_rows(ray: &Node, label: String, indent: &str, rows: &mut Vec<Row>) {
    let distance = ray.distance.map(short).unwrap_or_default();
    let weight = format!("{:.4}", ray.weight);
    let [nodes, tests] = costs(ray.cost);
    rows.push(row([label, ray.meets(), distance, weight, nodes, tests]));
    let mut left = ray.lights.len() + ray.rays.len() + ray.not_traced.len();
    let mut branch = || {
        left -= 1;
        branches(indent, left == 0)
    };
    for light in &ray.lights {
        let (here, _) = branch();
        let label = format!("{here}light {}", light.light);
        let [nodes, tests] = costs(light.cost);
        let none = String::new;
        rows.push(row([label, light.state(), none(), none(), nodes, tests]));
    }
    for ray in &ray.rays {
        let (here, below) = branch();
        ray_rows(ray, here + ray.kind, &below, rows);
    }
    for ray in &ray.not_traced {
        let (here, _) = branch();
        rows.push(row([here + ray.kind, ray.reason()]));
    }
}

/// The branch to a line and the indentation of what is below it.
fn branches(indent: &str, is_last: bool) -> (String, String) {
    match is_last {
        true => (format!("{indent}└ "), format!("{indent}  ")),
        false => (format!("{indent}├ "), format!("{indent}│ ")),
    }
}

fn double(a: &Trace, b: &Trace) -> Vec<Row> {
    let names = [a, b].map(|trace| trace.format.name().to_owned());
    let [first, second] = names;
    let mut rows = vec![row(["ray".into(), first, second])];
    let count = a.rays.len().max(b.rays.len());
    for i in 0..count {
        let pair = [a.rays.get(i), b.rays.get(i)];
        let kind = pair[0].or(pair[1]).map_or("", |ray| ray.kind);
        pair_rows(pair, numbered(kind, i, count), "", &mut rows);
    }
    rows
}

fn pair_rows(pair: [Option<&Node>; 2], label: String, indent: &str, rows: &mut Vec<Row>) {
    let meets = |node: &Node| match node.distance {
        Some(distance) => format!("{} at {}", node.meets(), short(distance)),
        None => node.meets(),
    };
    let [a, b] = pair.map(|node| node.map_or_else(|| "-".into(), meets));
    rows.push(Row {
        cells: vec![label, a, b],
        differs: pair::rays_differ(pair),
    });
    let (lights, followers) = (pair::lights(pair), pair::followers(pair));
    let mut left = lights.len() + followers.len();
    let mut branch = || {
        left -= 1;
        branches(indent, left == 0)
    };
    for (number, lights) in lights {
        let (here, _) = branch();
        let state = |light: Option<&super::node::Light>| {
            light.map_or_else(|| "-".into(), super::node::Light::state)
        };
        let [a, b] = lights.map(state);
        rows.push(Row {
            cells: vec![format!("{here}light {number}"), a, b],
            differs: pair::lights_differ(lights),
        });
    }
    for pair in followers {
        let (here, below) = branch();
        let kind = pair[0].or(pair[1]).map_or("", |ray| ray.kind);
        pair_rows(pair, here + kind, &below, rows);
    }
}

/// One sentence for each place where the trees part.
fn partings(f: &mut fmt::Formatter<'_>, report: &Report) -> fmt::Result {
    let partings = report.differences.as_deref().unwrap_or_default();
    if partings.is_empty() {
        return writeln!(f, "the same objects and lights in both");
    }
    for parting in partings {
        let path = parting.path.join(" > ");
        let (light, missing) = match parting.light {
            Some(number) => (format!(" > light {number}"), "behind the surface"),
            None => (String::new(), "no ray"),
        };
        let [a, b] = (parting.found.clone()).map(|found| found.unwrap_or_else(|| missing.into()));
        writeln!(f, "they part at {path}{light}: {a} or {b}")?;
    }
    Ok(())
}

fn row<const N: usize>(cells: [impl Into<String>; N]) -> Row {
    Row {
        cells: cells.map(Into::into).into(),
        differs: false,
    }
}

/// `primary`, or `primary 2 of 4`.
fn numbered(kind: &str, i: usize, count: usize) -> String {
    match count {
        1 => kind.into(),
        _ => format!("{kind} {} of {count}", i + 1),
    }
}

fn costs(cost: Cost) -> [String; 2] {
    [cost.nodes.to_string(), cost.tests.to_string()]
}

/// A distance in at most seven characters, if it has not more digits before the point.
fn short(distance: f64) -> String {
    let digits = 4_i32.saturating_sub(distance.abs().max(1.0).log10() as i32);
    format!("{distance:.0$}", digits.max(0) as usize)
}

/// Columns two spaces apart; numbers, in the third column and beyond, to the right if there are more than three. Rows that
/// differ begin with a mark if others begin with `margin`.
fn table(f: &mut fmt::Formatter<'_>, rows: &[Row], margin: &str) -> fmt::Result {
    let columns = rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
    // What spans the rest of its row does not make a column wider.
    let whole = rows.iter().filter(|row| row.cells.len() == columns);
    let mut widths = vec![0; columns];
    for row in whole {
        for (width, cell) in widths.iter_mut().zip(&row.cells) {
            *width = (*width).max(cell.chars().count());
        }
    }
    for row in rows.iter().filter(|row| row.cells.len() < columns) {
        widths[0] = widths[0].max(row.cells[0].chars().count());
    }
    for row in rows {
        let mark = match row.differs {
            true if !margin.is_empty() => "≠ ",
            _ => margin,
        };
        let mut line = mark.to_owned();
        for (i, (cell, width)) in row.cells.iter().zip(&widths).enumerate() {
            let gap = if i == 0 { "" } else { "  " };
            line += gap;
            let space = " ".repeat(width.saturating_sub(cell.chars().count()));
            match i >= 2 && columns > 3 {
                true => line += &(space + cell),
                false => line += &(cell.clone() + &space),
            }
        }
        writeln!(f, "{}", line.trim_end())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_short() {
        let cases = [
            (0.0, "0.0000"),
            (2.5, "2.5000"),
            (512.25, "512.25"),
            (1e6, "1000000"),
        ];
        for (distance, text) in cases {
            assert_eq!(short(distance), text);
        }
    }
}
