//! Where methods fail: the map of each.

use super::ReportJob;
use super::page::{self, Section};
use crate::canvas;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::stability::map::Map;
use maud::html;
use octray_stability::survey::{self, survey};

/// The section.
///
/// # Errors
/// When a map cannot be drawn, or the work is interrupted.
pub(super) fn section(job: &ReportJob, interrupt: &Interrupt) -> Result<Section, Error> {
    let progress = Progress::new("finding limits");
    progress.start(survey::steps(&job.methods));
    let proceed = || {
        progress.step();
        !interrupt.requested()
    };
    let survey = survey(&job.methods, job.threads, &proceed).ok_or(Error::Interrupted)?;
    let maps = (survey.outcomes.iter())
        .map(|outcome| {
            let says = format!("{}: {}", outcome.about.title, outcome.about.axis);
            Ok(page::chart(&canvas::svg(&Map(outcome))?, &says))
        })
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(Section {
        id: "limits".into(),
        title: "Where methods fail".into(),
        body: html! {
            p {
                "Each form of a method in every arithmetic, from where it is easy to where it fails, against truth of "
                "512 bits. A dot holds, a pale symbol degrades, a dark one breaks; the symbol says why."
            }
            div.maps { @for map in &maps { (map) } }
        },
        commands: vec!["octray stability -o maps".into()],
    })
}
