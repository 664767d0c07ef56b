//! Finds options with which a plan that does not fit would fit.

use super::decision::Cost;
use super::job::{PlanJob, PlanLimits};
use super::report::PlanReport;
use octray_render::error::Error;

/// Returns options with which a plan that exceeds its limits fits; each text alone is sufficient. They are more memory,
/// or, if RAM fails, a picture so narrow that the strip fits; `plan` confirms the second. Empty if the plan fits, or if
/// nothing is accurate enough.
///
/// # Errors
/// Those of `plan`.
pub(super) fn options(
    job: &PlanJob,
    report: &PlanReport,
    plan: impl FnOnce(&PlanJob) -> Result<PlanReport, Error>,
) -> Result<Vec<String>, Error> {
    let (Some(cost), Some(planned)) = (&report.cost, &report.plan) else {
        return Ok(Vec::new());
    };
    let PlanLimits { flash, ram, .. } = job.limits;
    let more_flash = (cost.flash > flash).then(|| format!("--flash {}", cost.flash));
    let Some(more_ram) = (cost.ram > ram).then(|| format!("--ram {}", cost.ram)) else {
        return Ok(more_flash.into_iter().collect());
    };
    let with = |option: String| match &more_flash {
        Some(more_flash) => format!("{more_flash} {option}"),
        None => option,
    };
    let mut options = vec![with(more_ram)];
    if let Some(size) = narrower(planned.size, cost, ram) {
        let smaller = PlanJob {
            size: Some(size),
            limits: PlanLimits {
                flash: flash.max(cost.flash),
                ..job.limits
            },
            ..job.clone()
        };
        if plan(&smaller)?.failures.is_empty() {
            options.push(with(format!("--size {}x{}", size.0, size.1)));
        }
    }
    Ok(options)
}

/// Returns the largest picture of these proportions whose strip is smaller by the missing RAM.
fn narrower((width, height): (u32, u32), cost: &Cost, ram: u64) -> Option<(u32, u32)> {
    let strip = cost.detail.lent.strip as u64;
    let room = (ram + strip).checked_sub(cost.ram)?;
    let columns = room * u64::from(width) / strip.max(1);
    let rows = columns * u64::from(height) / u64::from(width);
    let size = (u32::try_from(columns).ok()?, u32::try_from(rows).ok()?);
    (size.0 > 0 && size.1 > 0).then_some(size)
}
