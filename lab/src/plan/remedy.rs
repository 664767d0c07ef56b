//! What would fit, where a plan does not.

use super::decision::Cost;
use super::job::{Bounds, PlanJob};
use super::report::Report;
use octray_render::error::Error;

/// Options with which the scene of a plan that takes too much fits, each text enough alone: as much memory as it
/// takes; or, if it is RAM that fails, a picture so narrow that the strip leaves room. The second is planned to be
/// sure, by `plan`. None if the plan fits, or if nothing is accurate enough.
///
/// # Errors
/// Those of `plan`.
pub(super) fn options(
    job: &PlanJob,
    report: &Report,
    plan: impl FnOnce(&PlanJob) -> Result<Report, Error>,
) -> Result<Vec<String>, Error> {
    let (Some(cost), Some(planned)) = (&report.cost, &report.plan) else {
        return Ok(Vec::new());
    };
    let Bounds { flash, ram, .. } = job.bounds;
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
            bounds: Bounds {
                flash: flash.max(cost.flash),
                ..job.bounds
            },
            ..job.clone()
        };
        if plan(&smaller)?.failures.is_empty() {
            options.push(with(format!("--size {}x{}", size.0, size.1)));
        }
    }
    Ok(options)
}

/// The largest picture of these proportions whose strip is as much smaller as RAM is short.
fn narrower((width, height): (u32, u32), cost: &Cost, ram: u64) -> Option<(u32, u32)> {
    let strip = cost.detail.lent.strip as u64;
    let room = (ram + strip).checked_sub(cost.ram)?;
    let columns = room * u64::from(width) / strip.max(1);
    let rows = columns * u64::from(height) / u64::from(width);
    let size = (u32::try_from(columns).ok()?, u32::try_from(rows).ok()?);
    (size.0 > 0 && size.1 > 0).then_some(size)
}
