//! Where methods fail: a map of each, and the limits.

use super::ReportJob;
use crate::canvas;
use crate::page::{self, Section};
use crate::stability::map::Map;
use crate::stability::queries::Queries;
use crate::stability::{overview, table};
use maud::{Markup, html};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::progress::{Bar, Progress};
use octray_stability::method::Sweep;
use octray_stability::number::ARITHMETICS;
use octray_stability::survey::{self, Outcome, survey};
use octray_stability::sweep::polygon::Polygon;

/// The arithmetics of the table of limits.
const LIMITS_OF: [&str; 3] = ["f32", "i8f24", "i16f16"];
/// The description of the picture of queries of polygons.
const QUERIES: &str = "every point around a star, with the decision of each form";

/// Returns the section: the maps, and the table of limits.
///
/// # Errors
/// If a map cannot be drawn, or the work is interrupted.
pub(super) fn section(job: &ReportJob, interrupt: &Interrupt) -> Result<Section, Error> {
    let progress = Bar::new("finding limits");
    progress.start(survey::steps(&job.methods));
    let proceed = || {
        progress.step();
        !interrupt.requested()
    };
    let survey = survey(&job.methods, job.threads, &proceed).ok_or(Error::Interrupted)?;
    let maps = (survey.outcomes.iter())
        .map(of_method)
        .collect::<Result<Vec<_>, _>>()?;
    let numbers = LIMITS_OF.map(|name| ARITHMETICS.iter().position(|other| *other == name));
    let limits = overview::of(&survey, &numbers.into_iter().flatten().collect::<Vec<_>>());
    Ok(Section {
        id: "limits".into(),
        title: "Where methods fail".into(),
        body: html! {
            p {
                "Each form of a method in every arithmetic, from easy values to those where it fails, against references of "
                "512 bits. A dot means holds, a symbol on a pale ground degrades, one on a dark ground breaks; the symbol "
                "shows why. A bar ends the admitted values: those that octray renders without reporting that the arithmetic is too "
                "coarse."
            }
            @for map in &maps { (map) }
            h3 { "Limits" }
            pre { (limits) }
        },
        commands: vec![
            "octray stability -o maps".into(),
            format!("octray stability --limits {}", LIMITS_OF.join(",")),
        ],
    })
}

/// Returns the map of a method under its limits; for polygons also every query around a star.
fn of_method(outcome: &Outcome) -> Result<Markup, Error> {
    let about = &outcome.about;
    let says = format!("{}: {}", about.title, about.axis);
    let (holds, degrades) = table::limits(about);
    let queries = match about.name == Polygon::ABOUT.name {
        true => Some(page::image(&canvas::picture(&Queries::new())?, QUERIES)?),
        false => None,
    };
    Ok(html! {
        (page::chart(&canvas::svg(&Map(outcome))?, &says))
        p.bounds { "Holds: " (holds) ". Degrades: " (degrades) ". Breaks: beyond that." }
        @if let Some(queries) = queries {
            figure.chart { (queries) }
        }
    })
}
