//! Adaptive antialiasing (T. Whitted, "An Improved Illumination Model for Shaded Display", 1980; thesis, chapter IV).
//!
//! A ray goes through every corner of a pixel. Where the four of a pixel are nearly equal, their mean is its colour. Where
//! they differ the pixel is quartered, rays go through the corners of the quarters, and the same is asked of each of them.
//! Neighbours share the rays through their common corners and edges, so that all rays of one level are collected, in the
//! whole picture, before any of them is traced. Hence neither the picture nor the number of rays depends on tiles or threads.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::picture::{Picture, level};
use crate::progress::Progress;
use crate::render::blank;
use crate::renderer::Renderer;
use crate::schedule::Schedule;
use crate::scheduler::Scheduler;
use crate::stats::Work;
use crate::threads::{self, idle, run_tiles};
use crate::tile::{Intensity, TileBuffer, TileSize};
use fnv::FnvHashMap;
use octray_core::frame::Region;
use octray_core::observe::Counters;
use octray_prepare::Adaptive;
use std::num::{NonZeroU32, NonZeroUsize};
use std::sync::Mutex;

/// A place in the picture, in sides of the smallest quarters from its upper left corner.
type Place = (u32, u32);

/// A square of the picture whose corners have been traced: its upper left corner, and its side.
#[derive(Clone, Copy)]
struct Cell {
    corner: Place,
    side: u32,
}

/// Renders the picture as [`render_tiles`](crate::render::render_tiles) does.
///
/// # Errors
/// Those of that function.
pub fn render(
    renderer: &dyn Renderer,
    how: Adaptive,
    schedule: &Schedule,
    holds_intensities: bool,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<(Picture, Counters, Work, u64), Error> {
    let (mut picture, rows) = blank(renderer, holds_intensities)?;
    let active = &renderer.built().active;
    let mut tracing = Tracing::new(renderer, how, schedule, progress, interrupt);
    let corners = (active.rows.start..=active.rows.end).flat_map(|y| {
        let columns = active.columns.start..=active.columns.end;
        columns.map(move |x| (x * how.side(), y * how.side()))
    });
    let is_empty = active.rows.is_empty() || active.columns.is_empty();
    tracing.trace(if is_empty {
        Vec::new()
    } else {
        corners.collect()
    })?;

    let mut part = TileBuffer::black(rows.clone(), holds_intensities);
    let background = renderer.built().background;
    part.levels.fill(background.0);
    if let Some(intensities) = &mut part.intensities {
        intensities.fill(background.1);
    }
    // Pixels, each of which has the weight of its smallest quarters.
    let mut sums = vec![[0.0; 3]; active.columns.len() * active.rows.len()];
    let mut cells: Vec<_> = pixels(active)
        .map(|(x, y)| Cell {
            corner: (x * how.side(), y * how.side()),
            side: how.side(),
        })
        .collect();
    while !cells.is_empty() {
        interrupt.check()?;
        let mut divided = Vec::new();
        for cell in cells {
            let corners = cell.corners().map(|place| tracing.colours[&place]);
            if cell.side > 1 && differ(&corners, how.threshold) {
                divided.push(cell);
            } else {
                let pixel = (cell.corner.0 / how.side(), cell.corner.1 / how.side());
                add(&mut sums[index(active, pixel)], &corners, cell.side);
            }
        }
        let places = divided.iter().flat_map(|cell| cell.inner_places());
        tracing.trace(places.collect())?;
        cells = (divided.iter()).flat_map(|cell| cell.quarters()).collect();
    }
    let whole = f64::from(how.side() * how.side());
    for (x, y) in pixels(active) {
        let colour = sums[index(active, (x, y))].map(|sum| (sum / whole) as f32);
        let at = index(&rows, (x, y));
        part.levels[at] = colour.map(level);
        if let Some(intensities) = &mut part.intensities {
            intensities[at] = colour;
        }
    }
    picture.put(&part);
    let Tracing {
        counters,
        saturations,
        work,
        ..
    } = tracing;
    Ok((picture, counters, work, saturations))
}

/// The pixels of a region, row by row.
fn pixels(region: &Region) -> impl Iterator<Item = Place> {
    let columns = region.columns.clone();
    (region.rows.clone()).flat_map(move |y| columns.clone().map(move |x| (x, y)))
}

/// Where a pixel is in a region's pixels, row by row.
fn index(region: &Region, (x, y): Place) -> usize {
    let row = (y - region.rows.start) as usize;
    row * region.columns.len() + (x - region.columns.start) as usize
}

/// Whether any channel of any two corners differs by more than so many of 255 levels.
fn differ(corners: &[Intensity; 4], threshold: u8) -> bool {
    (0..3).any(|channel| {
        let levels = corners.map(|corner| level(corner[channel]));
        let (least, most) = (levels.iter().min(), levels.iter().max());
        most.zip(least)
            .is_some_and(|(most, least)| most - least > threshold)
    })
}

/// Adds the mean of four corners, weighted by the area of their square.
fn add(sum: &mut [f64; 3], corners: &[Intensity; 4], side: u32) {
    let weight = f64::from(side * side) / 4.0;
    for (channel, sum) in sum.iter_mut().enumerate() {
        let all: f64 = corners
            .iter()
            .map(|corner| f64::from(corner[channel]))
            .sum();
        *sum += weight * all;
    }
}

impl Cell {
    fn corners(self) -> [Place; 4] {
        let (x, y) = self.corner;
        let (right, below) = (x + self.side, y + self.side);
        [(x, y), (right, y), (x, below), (right, below)]
    }

    fn quarters(self) -> [Self; 4] {
        let side = self.side / 2;
        let (x, y) = self.corner;
        [(x, y), (x + side, y), (x, y + side), (x + side, y + side)]
            .map(|corner| Self { corner, side })
    }

    /// The corners of its quarters that are not its own: the middles of its edges, and its own.
    fn inner_places(self) -> [Place; 5] {
        let half = self.side / 2;
        let (x, y) = self.corner;
        let (right, below) = (x + self.side, y + self.side);
        [
            (x + half, y),
            (x, y + half),
            (x + half, y + half),
            (right, y + half),
            (x + half, below),
        ]
    }
}

/// Traces places, and knows those that were traced.
struct Tracing<'a> {
    renderer: &'a dyn Renderer,
    how: Adaptive,
    schedule: &'a Schedule,
    progress: &'a dyn Progress,
    interrupt: &'a Interrupt,
    colours: FnvHashMap<Place, Intensity>,
    counters: Counters,
    saturations: u64,
    work: Work,
}

impl<'a> Tracing<'a> {
    fn new(
        renderer: &'a dyn Renderer,
        how: Adaptive,
        schedule: &'a Schedule,
        progress: &'a dyn Progress,
        interrupt: &'a Interrupt,
    ) -> Self {
        Self {
            renderer,
            how,
            schedule,
            progress,
            interrupt,
            colours: FnvHashMap::default(),
            counters: Counters::default(),
            saturations: 0,
            work: Work {
                threads: 0,
                schedule: schedule.policy,
                tile: schedule.tile(&renderer.built().region(), 1),
                tiles: 0,
                messages: None,
                idle: Vec::new(),
            },
        }
    }

    /// Traces the places that have not been, those of a tile after each other.
    fn trace(&mut self, mut places: Vec<Place>) -> Result<(), Error> {
        places.retain(|place| !self.colours.contains_key(place));
        let TileSize { rows, columns } = self.work.tile;
        let (rows, columns) = (rows.get(), columns.map_or(u32::MAX, NonZeroU32::get));
        let side = self.how.side();
        let tile = |&(x, y): &Place| (y / side / rows, x / side / columns);
        places.sort_unstable_by_key(|place| (tile(place), (place.1, place.0)));
        places.dedup();
        let tiles: Vec<_> = places.chunk_by(|a, b| tile(a) == tile(b)).collect();
        if tiles.is_empty() {
            return Ok(());
        }
        self.work.tiles += tiles.len();
        self.progress.start(self.work.tiles);
        let traced: Vec<Mutex<Vec<Intensity>>> = tiles.iter().map(|_| Mutex::default()).collect();
        let count = NonZeroUsize::new(tiles.len()).unwrap_or(NonZeroUsize::MIN);
        let threads = self.schedule.threads.min(count);
        let finished = run_tiles(
            &Scheduler::new(self.schedule.policy, tiles.len(), threads, Vec::new()),
            self.interrupt,
            |thread| {
                if self.schedule.pin {
                    threads::pin(thread)?;
                }
                Ok(self.renderer.worker(self.interrupt))
            },
            |worker, tile| {
                // The frame's unit is half a smallest quarter's side.
                let places: Vec<_> = (tiles[tile].iter()).map(|(x, y)| (2 * x, 2 * y)).collect();
                let colours = worker.trace_places(&places);
                if let Ok(mut place) = traced[tile].lock() {
                    *place = colours;
                }
            },
            || self.progress.step(),
        )?;
        for thread in &finished {
            self.counters.add(thread.state.counters());
            self.saturations += thread.state.saturations();
        }
        self.work.threads = self.work.threads.max(finished.len());
        self.work.idle.resize(self.work.threads, 0.0);
        for (sum, idle) in self.work.idle.iter_mut().zip(idle(&finished)) {
            *sum += idle.as_secs_f64();
        }
        // Every ray is off the budget now.
        drop(finished);
        self.interrupt.check()?;
        for (places, colours) in tiles.iter().zip(traced) {
            let colours = colours.into_inner().unwrap_or_default();
            self.colours.extend(places.iter().copied().zip(colours));
        }
        Ok(())
    }
}
