//! How the work on a picture is shared among threads.

use crate::scheduler::Policy;
use crate::tile::TileSize;
use octray_core::frame::{RUN, Region};
use std::num::{NonZeroU32, NonZeroUsize};
use std::thread::available_parallelism;

/// How the work is shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schedule {
    /// How many threads trace.
    pub threads: NonZeroUsize,
    /// Which thread gets which tile.
    pub policy: Policy,
    /// How large tiles are, rows multiples of the side of the pixels of a ray, columns of [`Schedule::columns`]; [`Schedule::tile`] if `None`.
    pub tile: Option<TileSize>,
    /// Whether each thread stays on one core.
    pub pin: bool,
}

/// One thread for each core, dynamic.
impl Default for Schedule {
    fn default() -> Self {
        Self {
            threads: available_parallelism().unwrap_or(NonZeroUsize::MIN),
            policy: Policy::Dynamic,
            tile: None,
            pin: false,
        }
    }
}

/// Rows and columns of tiles, and how many tiles each thread should get: in the five figures the loss at the end is then
/// about as large as what more tiles would cost. Rays that are near each other find the same objects, so of larger
/// tiles none takes fewer instructions than 16 x 16 pixels. Columns are whole [runs](RUN).
const SIZES: [(TileSize, usize); 3] = [(size(16, 16), 64), (size(8, 8), 24), (size(4, 8), 0)];

const fn size(rows: u32, columns: u32) -> TileSize {
    TileSize {
        rows: NonZeroU32::new(rows).unwrap(),
        columns: NonZeroU32::new(columns),
    }
}

impl Schedule {
    /// The tiles of a picture where nothing else is asked for: squares of 16 x 16 pixels, unless there are many threads.
    pub const TILE: TileSize = SIZES[0].0;

    /// [`Schedule::TILE`] where one ray colours `block` × `block` pixels, which no tile may cut.
    pub fn largest(block: u32) -> TileSize {
        uncut(Self::TILE, block)
    }

    /// Columns of tiles are multiples of this many where one ray colours `block` × `block` pixels: whole
    /// [runs](RUN), whole squares.
    pub fn columns(block: u32) -> u32 {
        let squares = |runs: &u32| (runs * RUN).is_multiple_of(block.max(1));
        RUN * (1..=block).find(squares).unwrap_or(1)
    }

    /// The size of tiles: the one that was asked for, else 16 x 16, 8 x 8 or 8 x 4 pixels, so that each thread gets a
    /// good many; a little larger where squares of `block` pixels, which one ray colours, would be cut.
    pub fn tile(&self, region: &Region, block: u32) -> TileSize {
        let fits = |(size, tiles): (TileSize, usize)| {
            let shape = uncut(size, block);
            (shape.count(region) / self.threads >= tiles).then_some(shape)
        };
        match self.tile {
            Some(shape) => shape,
            None if self.threads.get() == 1 => Self::largest(block),
            None => (SIZES.into_iter().find_map(fits)).unwrap_or_else(|| Self::largest(block)),
        }
    }
}

/// A tile of at least this size that does not cut squares of `block` pixels.
fn uncut(size: TileSize, block: u32) -> TileSize {
    let whole = |side: NonZeroU32, unit: u32| side.get().next_multiple_of(unit.max(1));
    TileSize {
        rows: NonZeroU32::new(whole(size.rows, block)).unwrap_or(size.rows),
        columns: (size.columns)
            .and_then(|side| NonZeroU32::new(whole(side, Schedule::columns(block)))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_thread_gets_a_good_many_tiles() {
        let side = |threads, size| {
            let work = Schedule {
                threads: NonZeroUsize::new(threads).unwrap(),
                ..Schedule::default()
            };
            let region = Region {
                columns: 0..size,
                rows: 0..size,
            };
            work.tile(&region, 1).rows.get()
        };
        assert_eq!(side(1, 8), 16);
        assert_eq!(side(2, 512), 16);
        assert_eq!(side(64, 512), 8);
        assert_eq!(side(1000, 512), 4);
    }

    #[test]
    fn what_is_asked_for_is_taken() {
        let strip = TileSize::strip(NonZeroU32::MIN);
        let work = Schedule {
            tile: Some(strip),
            ..Schedule::default()
        };
        let region = Region {
            columns: 0..9,
            rows: 0..9,
        };
        assert_eq!(work.tile(&region, 1), strip);
    }

    #[test]
    fn tiles_do_not_cut_the_pixels_of_a_ray() {
        let region = Region {
            columns: 0..200,
            rows: 0..200,
        };
        for threads in [1, 2, 64, 1000] {
            let work = Schedule {
                threads: NonZeroUsize::new(threads).unwrap(),
                ..Schedule::default()
            };
            for block in 1..=8 {
                let tile = work.tile(&region, block);
                let columns = tile.columns.unwrap().get();
                let whole = |side: u32, unit: u32| side.is_multiple_of(unit);
                assert!(
                    whole(tile.rows.get(), block) && whole(columns, block) && whole(columns, RUN),
                    "{tile} {block}"
                );
            }
        }
    }
}
