//! Accuracy against cost: the charts, and their choices.

use crate::canvas;
use crate::chart::cost::Meter;
use crate::chart::figure::Chart;
use crate::chart::point::Panel;
use crate::chart::{self, ChartJob};
use crate::measure::frames::NamedScene;
use crate::page::{self, Section};
use maud::{Markup, html};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use std::path::{Path, PathBuf};

/// Returns the section. If costs cannot be counted, it states why.
///
/// # Errors
/// If a chart cannot be drawn, or the work is interrupted.
pub(super) fn section(
    scenes: Vec<(PathBuf, NamedScene)>,
    job: &ChartJob,
    interrupt: &Interrupt,
) -> Result<Section, Error> {
    let judged = chart::judge(scenes, job, interrupt)?;
    let mut parts = Vec::new();
    for cost in &job.costs {
        let only = std::slice::from_ref(cost);
        let measured = Meter::new(job, only, interrupt)
            .and_then(|meter| chart::panels(&judged, job, only, &meter));
        match measured {
            Err(Error::Interrupted) => return Err(Error::Interrupted),
            Err(failed) => parts.push(html! {
                h3 { (cost.words()) }
                p { "Not measured: " (failed) }
            }),
            Ok(panels) => {
                for panel in &panels {
                    parts.push(of_panel(panel, job)?);
                }
            }
        }
    }
    Ok(Section {
        id: "costs".into(),
        title: "Speed against accuracy".into(),
        body: html! {
            p {
                "Up is more accurate, right is cheaper; the line joins the settings that no other beats in both. "
                "Below each chart are its choices, each with its command, and the command that draws the chart."
            }
            @for part in &parts { (part) }
        },
        // One command per chart: a chart of many scenes at once would be too large.
        commands: Vec::new(),
    })
}

/// Returns a chart, its choices, and its command.
fn of_panel(panel: &Panel, job: &ChartJob) -> Result<Markup, Error> {
    let says = format!("{}: {}", panel.scene, panel.kind.words());
    let svg = canvas::svg(&Chart::of(std::slice::from_ref(panel)))?;
    let choices = panel.choices.iter().map(|choice| {
        let point = choice.point.map(|i| &panel.points[i]);
        html! {
            p { (choice.name) ": " strong { (point.map_or("none", |point| &point.label)) } }
            @if let Some(point) = point {
                pre { code { (counted(panel, panel.command(&point.setting))) } }
            }
        }
    });
    Ok(html! {
        h3 { (says) }
        (page::chart(&svg, &says))
        @for refused in &panel.refused {
            p { "No point for " (refused.label) ": " (refused.why) }
        }
        @for choice in choices { (choice) }
        (page::commands(&[command(panel, job)]))
    })
}

/// Extends a command so that it prints the cost too.
fn counted(panel: &Panel, command: String) -> String {
    match panel.counting() {
        Some(counting) => format!("{counting} {command}"),
        None => command,
    }
}

/// Returns the command that draws a chart.
fn command(panel: &Panel, job: &ChartJob) -> String {
    let list = |names: Vec<&str>| names.join(",");
    let scene = page::quoted(&panel.path);
    let cost = panel.kind.name();
    let (width, height) = job.size;
    let file = page::quoted(Path::new(&format!("{}-{cost}.svg", panel.scene)));
    format!(
        "octray chart {scene} --arith {} --tree {} --cost {cost} --size {width}x{height} -o {file}",
        list(job.grid.ariths.iter().map(|arith| arith.name()).collect()),
        list(job.grid.trees.iter().map(|tree| tree.name()).collect()),
    )
}
