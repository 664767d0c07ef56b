//! Speed against accuracy: the charts, and what they choose.

use super::page::{self, Section, table};
use crate::canvas;
use crate::chart::cost::{CostKind, Meter};
use crate::chart::figure::Chart;
use crate::chart::point::Panel;
use crate::chart::{self, ChartJob};
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::measure::frames::Named;
use maud::{Markup, html};
use std::path::PathBuf;

/// The section. Where costs cannot be counted it says why.
///
/// # Errors
/// When a chart cannot be drawn, or the work is interrupted.
pub(super) fn section(
    scenes: Vec<(PathBuf, Named)>,
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
                    parts.push(of_panel(panel)?);
                }
            }
        }
    }
    Ok(Section {
        id: "costs".into(),
        title: "Speed against accuracy".into(),
        body: html! {
            p {
                "Up is more accurate, right is cheaper; the line joins the settings that no other one beats in both. "
                "Under each chart stand its choices, and the command of each."
            }
            @for part in &parts { (part) }
        },
        commands: job.costs.iter().map(|cost| command(job, *cost)).collect(),
    })
}

/// What draws the charts of one kind of cost.
fn command(job: &ChartJob, cost: CostKind) -> String {
    let list = |names: Vec<&str>| names.join(",");
    let scenes: String = (job.scenes.iter())
        .map(|path| format!(" {}", page::quoted(path)))
        .collect();
    let (width, height) = job.size;
    let cost = cost.name();
    format!(
        "octray chart{scenes} --arith {} --tree {} --cost {cost} --size {width}x{height} -o {cost}.svg",
        list(job.grid.ariths.iter().map(|arith| arith.name()).collect()),
        list(job.grid.trees.iter().map(|tree| tree.name()).collect()),
    )
}

fn of_panel(panel: &Panel) -> Result<Markup, Error> {
    let says = format!("{}: {}", panel.scene, panel.kind.words());
    let svg = canvas::svg(&Chart::of(std::slice::from_ref(panel)))?;
    let head = ["choice", "setting", "command"].map(String::from);
    let rows: Vec<_> = (panel.choices.iter())
        .map(|choice| {
            let point = choice.point.map(|i| &panel.points[i]);
            let label = point.map_or("none".into(), |point| point.label.clone());
            let command = point.map(|point| panel.command(&point.setting));
            vec![choice.name.clone(), label, command.unwrap_or_default()]
        })
        .collect();
    Ok(html! {
        h3 { (says) }
        (page::chart(&svg, &says))
        (table(&head, &rows))
        @if let Some(counting) = panel.counting() {
            p { "Instructions are counted by " code { (counting) } " before such a command." }
        }
    })
}
