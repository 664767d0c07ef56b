//! Wire frames: lines where the object that is seen changes.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::renderer::Renderer;
use crate::schedule::Schedule;
use crate::scheduler::Scheduler;
use crate::stats::Work;
use crate::threads::{self, idle, run_tiles};
use crate::tile::{Level, TileSize};
use octray_core::observe::{Counters, RayKind};
use std::num::{NonZeroU32, NonZeroUsize};
use std::sync::Mutex;

/// Lines are black, all else is white.
const LINE: Level = [0; 3];
const PAPER: Level = [255; 3];

/// The object that each pixel of a row shows.
type Row = Vec<Option<u32>>;

/// Draws a scene as lines: a pixel is on one if the pixel to its right or the one below it shows another object. Only rays
/// of the camera are traced, a row after the other.
///
/// # Errors
/// Those of [`render_tiles`](crate::render::render_tiles).
pub fn render(
    renderer: &dyn Renderer,
    schedule: &Schedule,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<(Picture, Counters, Work, u64), Error> {
    let built = renderer.built();
    let (width, height) = built.size;
    let starts: Vec<u32> = (0..height).step_by(built.block as usize).collect();
    let rows: Vec<Mutex<Row>> = starts.iter().map(|_| Mutex::default()).collect();
    let count = NonZeroUsize::new(rows.len()).unwrap_or(NonZeroUsize::MIN);
    let threads = schedule.threads.min(count);
    progress.start(rows.len());
    let finished = run_tiles(
        &Scheduler::new(schedule.policy, rows.len(), threads, Vec::new()),
        interrupt,
        |thread| {
            if schedule.pin {
                threads::pin(thread)?;
            }
            Ok((renderer.worker(interrupt), 0, 0))
        },
        |(worker, rays, met), row| {
            if !built.active.rows.contains(&starts[row]) {
                return;
            }
            let seen: Row = worker
                .first_hits(starts[row])
                .into_iter()
                .map(|hit| hit.map(|hit| hit.object))
                .collect();
            *rays += seen.len() as u64;
            *met += seen.iter().flatten().count() as u64;
            if let Ok(mut place) = rows[row].lock() {
                *place = seen;
            }
        },
        || progress.step(),
    )?;
    let (mut counters, mut saturations) = (Counters::default(), 0);
    for thread in &finished {
        let (worker, rays, met) = &thread.state;
        counters.add(worker.counters());
        counters.rays[RayKind::Primary as usize] += rays;
        counters.hits[RayKind::Primary as usize] += met;
        saturations += worker.saturations();
    }
    let work = Work {
        threads: finished.len(),
        schedule: schedule.policy,
        tile: TileSize::strip(NonZeroU32::new(built.block).unwrap_or(NonZeroU32::MIN)),
        tiles: rows.len(),
        messages: None,
        idle: idle(&finished).map(|idle| idle.as_secs_f64()).collect(),
    };
    drop(finished);
    interrupt.check()?;
    let rows: Vec<Row> = rows
        .into_iter()
        .map(|row| row.into_inner().unwrap_or_default())
        .collect();
    let block = built.block;
    let seen = |x: u32, y: u32| {
        let row = rows.get((y.min(height - 1) / block) as usize)?;
        *row.get((x.min(width - 1) / block) as usize)?
    };
    let level = |x, y| {
        let here = seen(x, y);
        match here == seen(x + 1, y) && here == seen(x, y + 1) {
            true => PAPER,
            false => LINE,
        }
    };
    let levels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let levels = levels.map(|(x, y)| level(x, y)).collect();
    let picture = Picture::from_levels(width, height, levels);
    let picture =
        picture.ok_or_else(|| Error::Failed("the picture does not fit into memory".into()))?;
    Ok((picture, counters, work, saturations))
}
