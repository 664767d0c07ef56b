//! What parts of a picture cost to trace: a weighted sum of counted events, which unlike time is the same
//! every time.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::renderer::Renderer;
use octray_core::frame::Region;
use octray_core::object::ObjectKind;
use octray_core::observe::{Counters, RayKind};
use std::num::NonZeroU32;
use std::ops::Range;

/// How many events there are weights for.
pub const EVENTS: usize = 11;

/// What is counted, in the order of [`events`] and [`WEIGHTS`]; the kinds of objects in that of [`ObjectKind::ALL`].
pub const NAMES: [&str; EVENTS] = [
    "primary ray",
    "reflected or transmitted ray",
    "shadow ray",
    "light in sight",
    "hit",
    "step",
    "sphere tested",
    "triangle tested",
    "polygon tested",
    "cone tested",
    "box tested",
];

/// Machine instructions for each event, on x86-64 in f32 with the tight tree: what
/// the binary `fit-weights` of `octray-lab` fits to instructions counted by Callgrind. Other arithmetics and
/// trees cost more or less, but in much the same places.
pub const WEIGHTS: [f64; EVENTS] = [
    411.0, 375.0, 116.0, 188.0, 326.0, 117.0, 95.0, 120.0, 106.0, 162.0, 251.0,
];

/// The events that make up the cost of what was counted.
pub fn events(counters: &Counters) -> [u64; EVENTS] {
    let rays = |kind| counters.rays_of(kind);
    let tested = |kind: ObjectKind| {
        let searches = counters.queries.iter();
        searches.map(|search| search.tests[kind as usize]).sum()
    };
    let [sphere, triangle, polygon, cone, cuboid] = ObjectKind::ALL.map(tested);
    [
        rays(RayKind::Primary),
        rays(RayKind::Reflected) + rays(RayKind::Transmitted),
        rays(RayKind::Shadow),
        rays(RayKind::Shadow) - counters.blocked,
        counters.hits.iter().sum(),
        counters.steps(),
        sphere,
        triangle,
        polygon,
        cone,
        cuboid,
    ]
}

/// The cost of what was counted, in instructions.
pub fn cost(counters: &Counters) -> f64 {
    let weighed = events(counters).into_iter().zip(WEIGHTS);
    weighed.map(|(count, weight)| count as f64 * weight).sum()
}

/// What each part of a picture costs, in instructions.
#[derive(Clone, Debug, PartialEq)]
pub struct CostMap {
    /// Where the cells begin, and where the pixels end that cost anything.
    region: Region,
    /// Cells to a row.
    across: usize,
    /// The side of a cell in pixels.
    cell: u32,
    /// For every corner of cells the cost of all to its left and above it; `across` + 1 to a row.
    sums: Vec<f64>,
}

impl CostMap {
    /// Traces one pixel of each `cell` × `cell`, which stands for all of them. With cells of the block that one
    /// ray colours this is exact, and takes as long as the picture.
    ///
    /// # Errors
    /// [`Error::Interrupted`] if it was.
    pub fn probe(
        renderer: &dyn Renderer,
        cell: NonZeroU32,
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let built = renderer.built();
        let block = built.block;
        let cell = cell.get().next_multiple_of(block);
        let middle = cell / 2 / block * block;
        let rays = f64::from(cell / block).powi(2);
        let mut worker = renderer.worker(interrupt);
        let mut before = 0.0;
        let Region { columns, rows } = built.active.clone();
        // Rays start where blocks do.
        let starts = |start: u32, end| (start / block * block..end).step_by(cell as usize);
        let costs = starts(rows.start, rows.end).map(|row| {
            interrupt.check()?;
            let of_cell = |column| {
                // The middle of a cell that is cut off may be outside.
                let inside = |pixel: u32, end: u32| pixel.min((end - 1) / block * block);
                let x = inside(column + middle, columns.end);
                let y = inside(row + middle, rows.end);
                worker.probe(&Region {
                    columns: x..x + block,
                    rows: y..y + block,
                });
                let after = cost(worker.counters());
                rays * (after - std::mem::replace(&mut before, after))
            };
            Ok(starts(columns.start, columns.end).map(of_cell).collect())
        });
        let costs: Vec<Vec<f64>> = costs.collect::<Result<_, Error>>()?;
        drop(worker);
        interrupt.check()?;
        let region = Region {
            columns: columns.start / block * block..columns.end,
            rows: rows.start / block * block..rows.end,
        };
        Ok(Self::new(region, cell, &costs))
    }

    /// The same for at most about a thousand pixels: enough to tell expensive tiles from cheap ones.
    ///
    /// # Errors
    /// [`Error::Interrupted`] if it was.
    pub fn coarse(renderer: &dyn Renderer, interrupt: &Interrupt) -> Result<Self, Error> {
        const MOST: f64 = 1024.0;
        let Region { columns, rows } = &renderer.built().active;
        let pixels = columns.len() as f64 * rows.len() as f64;
        let side = (pixels / MOST).sqrt().ceil() as u32;
        Self::probe(
            renderer,
            NonZeroU32::new(side).unwrap_or(NonZeroU32::MIN),
            interrupt,
        )
    }

    /// The numbers of tiles from the most expensive to the cheapest.
    pub fn most_expensive_first(&self, tiles: &[Region]) -> Vec<u32> {
        let costs: Vec<_> = tiles.iter().map(|tile| self.cost(tile)).collect();
        most_expensive_first(&costs)
    }

    /// The map of a region whose cells cost what is given, row by row.
    pub fn new(region: Region, cell: u32, costs: &[Vec<f64>]) -> Self {
        let across = costs.first().map_or(0, Vec::len);
        let mut sums = vec![0.0; across + 1];
        for row in costs {
            let above = sums.len() - across - 1;
            let mut so_far = 0.0;
            sums.push(0.0);
            for (column, cost) in row.iter().enumerate() {
                so_far += cost;
                sums.push(sums[above + column + 1] + so_far);
            }
        }
        Self {
            region,
            across,
            cell,
            sums,
        }
    }

    /// What a region costs; a cell that lies in it in part counts in part.
    pub fn cost(&self, region: &Region) -> f64 {
        let down = self.sums.len() / (self.across + 1) - 1;
        let ends = |part: &Range<u32>, start, cells| {
            [part.start, part.end].map(|pixel| self.place(pixel, start, cells))
        };
        let [left, right] = ends(&region.columns, self.region.columns.start, self.across);
        let [above, below] = ends(&region.rows, self.region.rows.start, down);
        self.up_to(right, below) - self.up_to(left, below) - self.up_to(right, above)
            + self.up_to(left, above)
    }

    /// What the whole picture costs.
    pub fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or_default()
    }

    /// The cost of all to the left of and above a place.
    fn up_to(&self, x: Place, y: Place) -> f64 {
        let sum = |row: usize, column: usize| self.sums[row * (self.across + 1) + column];
        let between = |a: f64, b: f64, share: f64| a + (b - a) * share;
        between(
            between(sum(y.cell, x.cell), sum(y.cell, x.next), x.share),
            between(sum(y.next, x.cell), sum(y.next, x.next), x.share),
            y.share,
        )
    }

    /// Where a pixel lies along a side of so many cells.
    fn place(&self, pixel: u32, start: u32, cells: usize) -> Place {
        let offset = pixel.saturating_sub(start);
        let cell = (offset / self.cell) as usize;
        match cell < cells {
            true => Place {
                cell,
                next: cell + 1,
                share: f64::from(offset % self.cell) / f64::from(self.cell),
            },
            false => Place {
                cell: cells,
                next: cells,
                share: 0.0,
            },
        }
    }
}

/// A place along a side of a [`CostMap`].
#[derive(Clone, Copy)]
struct Place {
    /// The cell in which it lies, or the number of cells.
    cell: usize,
    /// The one after that, or the number of cells.
    next: usize,
    /// How far inside, from 0 to 1.
    share: f64,
}

/// The numbers of tiles from the dearest to the cheapest; equally dear ones keep their order.
pub fn most_expensive_first(costs: &[f64]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..costs.len() as u32).collect();
    order.sort_by(|a, b| f64::total_cmp(&costs[*b as usize], &costs[*a as usize]));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    fn region(columns: Range<u32>, rows: Range<u32>) -> Region {
        Region { columns, rows }
    }

    #[test]
    fn a_region_costs_what_its_cells_do() {
        let costs = [vec![1.0, 2.0, 4.0], vec![8.0, 16.0, 32.0]];
        let map = CostMap::new(region(10..13, 20..22), 1, &costs);
        assert_eq!(map.total(), 63.0);
        assert_eq!(map.cost(&region(0..99, 0..99)), 63.0);
        assert_eq!(map.cost(&region(11..12, 20..22)), 18.0);
        assert_eq!(map.cost(&region(11..13, 21..22)), 48.0);
        assert_eq!(map.cost(&region(0..10, 0..99)), 0.0);
        assert_eq!(map.cost(&region(13..99, 0..99)), 0.0);
    }

    #[test]
    fn a_cell_in_part_counts_in_part() {
        let map = CostMap::new(region(0..8, 0..4), 4, &[vec![16.0, 32.0]]);
        assert_eq!(map.cost(&region(0..8, 0..1)), 12.0);
        assert_eq!(map.cost(&region(2..6, 0..4)), 24.0);
    }

    #[test]
    fn without_objects_nothing_costs_anything() {
        let map = CostMap::new(region(0..0, 0..0), 1, &[]);
        assert_eq!((map.total(), map.cost(&region(0..9, 0..9))), (0.0, 0.0));
    }

    #[test]
    fn the_dearest_tiles_come_first() {
        assert_eq!(most_expensive_first(&[2.0, 5.0, 1.0, 5.0]), [1, 3, 0, 2]);
    }
}
