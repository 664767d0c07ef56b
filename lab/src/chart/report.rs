//! Points and choices as a table to read, as JSON, and as comma-separated values.

use super::accuracy::Accuracy;
use super::point::{Against, Panel, Point};
use crate::measure::table;
use comfy_table::Table;
use octray_prepare::{Arith, RenderSettings, Samples};
use octray_render::metric::Difference;
use serde::Serialize;
use std::fmt::Write;
use std::io;

/// A point, or why there is none, as it is written down.
#[derive(Serialize)]
struct Row<'a> {
    scene: &'a str,
    width: u32,
    height: u32,
    label: &'a str,
    arith: &'a str,
    format: &'a str,
    tree: &'a str,
    max_depth: u32,
    cut_off: f64,
    pixels_per_ray: u32,
    samples: Samples,
    cost_kind: &'a str,
    unit: &'a str,
    cost: Option<f64>,
    cost_per_pixel: Option<f64>,
    /// `None` for equal pictures.
    psnr: Option<f64>,
    rmse: Option<f64>,
    psnr_converged: Option<f64>,
    rmse_converged: Option<f64>,
    other_object_share: Option<f64>,
    worst_depth_error: Option<f64>,
    on_frontier: bool,
    chosen_as: String,
    outcome: &'a str,
    command: String,
}

impl<'a> Row<'a> {
    fn of_point(panel: &'a Panel, point: &'a Point) -> Self {
        let pixels = f64::from(panel.size.0) * f64::from(panel.size.1);
        let Accuracy {
            format,
            same,
            converged,
            sight,
        } = &point.accuracy;
        let psnr =
            |difference: &Difference| Some(difference.psnr()).filter(|psnr| psnr.is_finite());
        Self {
            format: format.name(),
            cost: Some(point.cost),
            cost_per_pixel: Some(point.cost / pixels),
            psnr: psnr(same),
            rmse: Some(same.rmse()),
            psnr_converged: psnr(converged),
            rmse_converged: Some(converged.rmse()),
            other_object_share: Some(sight.other),
            worst_depth_error: Some(sight.depth),
            on_frontier: point.on_frontier,
            chosen_as: point.chosen_as.join("; "),
            ..Self::without_point(panel, &point.setting, &point.label, "ok")
        }
    }

    fn without_point(
        panel: &'a Panel,
        setting: &RenderSettings,
        label: &'a str,
        outcome: &'a str,
    ) -> Self {
        Self {
            scene: &panel.scene,
            width: panel.size.0,
            height: panel.size.1,
            label,
            arith: setting.arith.name(),
            format: "",
            tree: setting.tree.kind.name(),
            max_depth: setting.max_depth,
            cut_off: setting.cut_off,
            pixels_per_ray: setting.pixels_per_ray.number(),
            samples: setting.rays_per_pixel(),
            cost_kind: panel.kind.name(),
            unit: panel.kind.unit(),
            cost: None,
            cost_per_pixel: None,
            psnr: None,
            rmse: None,
            psnr_converged: None,
            rmse_converged: None,
            other_object_share: None,
            worst_depth_error: None,
            on_frontier: false,
            chosen_as: String::new(),
            outcome,
            command: panel.command(setting),
        }
    }
}

fn rows(panel: &Panel) -> impl Iterator<Item = Row<'_>> {
    let points = panel.points.iter().map(|point| Row::of_point(panel, point));
    let refused = panel
        .refused
        .iter()
        .map(|refused| Row::without_point(panel, &refused.setting, &refused.label, &refused.why));
    points.chain(refused)
}

/// A panel as JSON.
#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    cost_kind: &'a str,
    unit: &'a str,
    against: Against,
    /// What comes before a command to count its cost.
    counting: Option<String>,
    /// The bounces that the converged picture lacks, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    unexplored: Option<&'a str>,
    choices: Vec<Chosen<'a>>,
    points: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Chosen<'a> {
    name: &'a str,
    label: Option<&'a str>,
    command: Option<String>,
}

/// Writes an array of panels.
///
/// # Errors
/// If it cannot be written.
pub fn write_json(panels: &[Panel], out: &mut dyn io::Write) -> io::Result<()> {
    let documents: Vec<_> = (panels.iter())
        .map(|panel| Document {
            scene: &panel.scene,
            cost_kind: panel.kind.name(),
            unit: panel.kind.unit(),
            against: panel.wishes.against,
            counting: panel.counting(),
            unexplored: panel.unexplored.as_deref(),
            choices: (panel.choices.iter())
                .map(|choice| {
                    let point = choice.point.map(|i| &panel.points[i]);
                    Chosen {
                        name: &choice.name,
                        label: point.map(|point| &*point.label),
                        command: point.map(|point| panel.command(&point.setting)),
                    }
                })
                .collect(),
            points: rows(panel).collect(),
        })
        .collect();
    serde_json::to_writer_pretty(&mut *out, &documents)?;
    writeln!(out)
}

/// Writes comma-separated values, with a line of names. What is not known is empty; so is the ratio of equal
/// pictures, whose RMSE is 0.
///
/// # Errors
/// If it cannot be written.
pub fn write_csv(panels: &[Panel], out: &mut dyn io::Write) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    for row in panels.iter().flat_map(rows) {
        csv.serialize(row)?;
    }
    csv.flush()
}

/// For each panel a table of its points, the cheapest first, and the choices with their commands.
pub fn text(panels: &[Panel]) -> String {
    let mut text = String::new();
    for panel in panels {
        if !text.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(text, "{}: {}", panel.scene, panel.kind.words());
        let _ = writeln!(text, "{}\n", panel.common());
        let _ = writeln!(text, "{}\n", table(panel));
        if let Some(unexplored) = &panel.unexplored {
            let _ = writeln!(text, "converged picture: {unexplored}");
        }
        for refused in &panel.refused {
            let _ = writeln!(text, "no point: {}: {}", refused.label, refused.why);
        }
        for choice in &panel.choices {
            match choice.point.map(|i| &panel.points[i]) {
                None => {
                    let _ = writeln!(text, "{}: none", choice.name);
                }
                Some(point) => {
                    let command = panel.command(&point.setting);
                    let _ = writeln!(text, "{}: {}\n    {command}", choice.name, point.label);
                }
            }
        }
        if let Some(counting) = panel.counting() {
            let _ = writeln!(
                text,
                "Instructions are counted by '{counting}' before such a command."
            );
        }
    }
    text
}

/// A line for each point; a star for those on the frontier.
fn table(panel: &Panel) -> Table {
    let mut table = table::table(&[
        "frontier",
        "setting",
        panel.kind.unit(),
        "PSNR, dB",
        "RMSE, levels",
        "PSNR, converged",
        "RMSE, converged",
        "other object first, %",
        "worst depth error",
    ]);
    table::left(&mut table, 2);
    let mut points: Vec<&Point> = panel.points.iter().collect();
    points.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    for point in points {
        let Accuracy {
            format,
            same,
            converged,
            sight,
        } = &point.accuracy;
        let label = match Arith::In(*format) == point.setting.arith {
            true => point.label.clone(),
            false => format!("{}: {format}", point.label),
        };
        let psnr = |difference: &Difference| match difference.is_zero() {
            true => "equal".into(),
            false => format!("{:.2}", difference.psnr()),
        };
        table.add_row([
            if point.on_frontier { "*" } else { "" }.into(),
            label,
            panel.kind.figure(point.cost),
            psnr(same),
            format!("{:.4}", same.rmse()),
            psnr(converged),
            format!("{:.4}", converged.rmse()),
            format!("{:.3}", 100.0 * sight.other),
            format!("{:.1e}", sight.depth),
        ]);
    }
    table
}
