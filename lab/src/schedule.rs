//! `octray schedule`: simulates how well processors share a picture, over schedules, tiles and numbers of processors.

mod chart;

use crate::canvas;
use crate::simulate::{Machine, Outcome, simulate_messages};
use chart::Chart;
use comfy_table::{CellAlignment, Table, presets};
use octray_core::frame::Region;
use octray_prepare::RenderSettings;
use octray_render::cost::{CostMap, most_expensive_first};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::renderer;
use octray_render::scene_file;
use octray_render::scheduler::{Policy, Scheduler};
use octray_render::tile::TileSize;
use octray_scenes::reduce::Reduction;
use serde::Serialize;
use std::io;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

/// Everything that `octray schedule` was asked to do.
#[derive(Clone, Debug, PartialEq)]
pub struct ScheduleJob {
    /// The scene file.
    pub scene: PathBuf,
    /// What is left out of it.
    pub reduction: Reduction,
    /// Numbers of processors.
    pub processors: Vec<NonZeroUsize>,
    /// Sizes of tiles.
    pub shapes: Vec<TileSize>,
    /// The schedules.
    pub policies: Vec<Policy>,
    /// What to trace, and with which tree.
    pub settings: RenderSettings,
    /// The machine.
    pub machine: Machine,
    /// Instructions in addition to [`Machine::hand_out`] for each pixel of a tile from a shared queue.
    pub per_pixel: f64,
    /// Whether tiles are handed out in messages by the first processor ([`Scheduler::in_messages`]).
    pub messages: bool,
    /// Whether to print JSON.
    pub json: bool,
    /// Where to write every combination as CSV.
    pub csv: Option<PathBuf>,
    /// Where to draw the charts.
    pub chart: Option<PathBuf>,
}

/// One combination, and its result.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Run {
    /// The schedule.
    pub policy: Policy,
    /// The size of tiles.
    pub tile: TileSize,
    /// The number of tiles.
    pub tiles: usize,
    /// The number of processors.
    pub processors: NonZeroUsize,
    /// The result.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Simulates every combination, and prints all of them or the best.
///
/// # Errors
/// If the scene is refused or does not fit the arithmetic, on an interrupt, or if standard output cannot be written.
pub fn run(job: &ScheduleJob, interrupt: &Interrupt) -> Result<(), Error> {
    for path in job.csv.iter().chain(&job.chart) {
        output::probe(path)?;
    }
    let scene = scene_file::read_reduced(&job.scene, job.reduction)?;
    let renderer = renderer::prepare(&scene, &job.settings)?;
    let map = CostMap::probe(&*renderer, NonZeroU32::MIN, interrupt)?;
    let region = renderer.built().region();
    let runs = sweep(job, &map, &region, interrupt)?;
    if let Some(path) = &job.csv {
        output::write_file(path, interrupt, |out| write_csv(&runs, out))?;
    }
    if let Some(path) = &job.chart {
        let (width, height) = renderer.built().size;
        let name = job.scene.file_stem().unwrap_or_default().to_string_lossy();
        let title = format!("How well {name} at {width} x {height} is shared");
        let chart = Chart::new(title, &runs, &job.policies, &job.shapes, &job.processors);
        canvas::write_figure(path, &chart, interrupt)?;
    }
    let results = job.csv.iter().chain(&job.chart);
    output::write_report(results, interrupt, |out| match job.json {
        true => {
            let total = map.total();
            let scene = job.scene.display().to_string();
            let (peak, worth) = (best(&runs, |_| true), worth(job, &runs));
            let object = serde_json::json!({
                "scene": scene, "instructions": total, "peak": peak, "worth": worth, "runs": runs
            });
            writeln!(out, "{object}")
        }
        false if map.total() > 0.0 => {
            writeln!(out, "{}", table(job, &runs))?;
            write_answer(job, &runs, out)
        }
        false => writeln!(out, "nothing to share: {}", scene_file::NOTHING_IN_SIGHT),
    })
}

/// Simulates every combination.
fn sweep(
    job: &ScheduleJob,
    map: &CostMap,
    region: &Region,
    interrupt: &Interrupt,
) -> Result<Vec<Run>, Error> {
    let mut runs = Vec::new();
    for &tile in &job.shapes {
        let parts: Vec<Region> = tile.cut(region).collect();
        let costs: Vec<f64> = parts.iter().map(|part| map.cost(part)).collect();
        let order = most_expensive_first(&costs);
        let pixels = |part: &Region| part.columns.len() as f64 * part.rows.len() as f64;
        for &policy in &job.policies {
            for &processors in &job.processors {
                interrupt.check()?;
                let mut deal = Scheduler::new(policy, costs.len(), processors, order.clone());
                if job.messages {
                    deal = deal.in_messages();
                }
                runs.push(Run {
                    policy,
                    tile,
                    tiles: costs.len(),
                    processors,
                    outcome: simulate_messages(&costs, &deal, &job.machine, |tile| {
                        job.per_pixel * pixels(&parts[tile])
                    }),
                });
            }
        }
    }
    Ok(runs)
}

/// Writes one line per combination.
fn write_csv(runs: &[Run], out: &mut dyn io::Write) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record([
        "policy",
        "rows",
        "columns",
        "tiles",
        "processors",
        "time",
        "speed_up",
        "efficiency",
    ])?;
    for run in runs {
        let Outcome {
            time,
            speed_up,
            efficiency,
        } = run.outcome;
        let columns = run.tile.columns;
        csv.write_record([
            run.policy.name().to_owned(),
            run.tile.rows.to_string(),
            columns.map_or(String::new(), |columns| columns.to_string()),
            run.tiles.to_string(),
            run.processors.to_string(),
            time.to_string(),
            speed_up.to_string(),
            efficiency.to_string(),
        ])?;
    }
    csv.flush()
}

/// Returns the run with the highest speed-up among those that fit; of equal ones the first.
fn best(runs: &[Run], fits: impl Fn(&Run) -> bool) -> Option<&Run> {
    let runs = runs.iter().filter(|run| fits(run)).rev();
    runs.max_by(|a, b| f64::total_cmp(&a.outcome.speed_up, &b.outcome.speed_up))
}

/// A further processor must add at least this share of a processor to be worth it.
const WORTH: f64 = 0.5;

/// Returns the run with the most processors that are worth it: up to them, each further one adds at least [`WORTH`] to
/// the best speed-up, on average since the number before.
fn worth<'a>(job: &ScheduleJob, runs: &'a [Run]) -> Option<&'a Run> {
    let mut numbers = job.processors.clone();
    numbers.sort_unstable();
    let with = |processors| best(runs, |run| run.processors == processors);
    let mut found: Option<&Run> = None;
    for run in numbers.into_iter().filter_map(with) {
        if let Some(before) = found {
            let further = run.processors.get() - before.processors.get();
            let gain = run.outcome.speed_up - before.outcome.speed_up;
            if gain < WORTH * further as f64 {
                break;
            }
        }
        found = Some(run);
    }
    found
}

/// Answers how many processors are worth it.
fn write_answer(job: &ScheduleJob, runs: &[Run], out: &mut dyn io::Write) -> io::Result<()> {
    let (Some(peak), Some(worth)) = (best(runs, |_| true), worth(job, runs)) else {
        return Ok(());
    };
    let told = |run: &Run| {
        format!(
            "{} processors, {:.2} times as fast as one ({}, {})",
            run.processors,
            run.outcome.speed_up,
            run.policy.name(),
            run.tile
        )
    };
    let more = match job.processors.iter().any(|n| *n > worth.processors) {
        true => "",
        false => "; more were not tried",
    };
    writeln!(out, "worth it: {}{more}", told(worth))?;
    if peak.processors > worth.processors {
        writeln!(
            out,
            "fastest:  {}; of those beyond {}, each adds less than half a processor",
            told(peak),
            worth.processors
        )?;
    }
    Ok(())
}

/// Formats a table: per number of processors the best speed-up of each schedule, in strips and in tiles, and the size.
fn table(job: &ScheduleJob, runs: &[Run]) -> Table {
    let mut table = Table::new();
    let names = job.policies.iter().map(|policy| policy.name());
    let heading = ["processors", "tiles"].into_iter().chain(names);
    table
        .load_style(presets::ASCII_MARKDOWN)
        .set_header(heading);
    for &processors in &job.processors {
        for (kind, tiles) in [("strips", false), ("tiles", true)] {
            let of = |policy| {
                best(runs, |run| {
                    (run.policy, run.processors) == (policy, processors)
                        && run.tile.columns.is_some() == tiles
                })
            };
            let cell = |policy| {
                of(policy).map_or(String::new(), |run| {
                    format!("{:.2} ({})", run.outcome.speed_up, run.tile)
                })
            };
            let cells = job.policies.iter().map(|policy| cell(*policy));
            let first = [processors.to_string(), kind.to_owned()];
            table.add_row(first.into_iter().chain(cells));
        }
    }
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
