//! How the work on a picture is shared among threads.

use crate::scheduler::Policy;
use crate::tile::TileSize;
use octray_core::frame::Region;
use std::num::{NonZeroU32, NonZeroUsize};
use std::thread::available_parallelism;

/// How the work is shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schedule {
    /// How many threads trace.
    pub threads: NonZeroUsize,
    /// Which thread gets which tile.
    pub policy: Policy,
    /// How large tiles are, rows and columns multiples of the side of the pixels of a ray; [`Schedule::tile`] if `None`.
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

/// Sides of tiles, and how many tiles each thread should get: in the five figures the loss at the end is then about as
/// large as what more tiles would cost. Rays that are near each other find the same objects, so of larger tiles none
/// takes fewer instructions than 16 x 16 pixels.
const SIDES: [(u32, usize); 3] = [(16, 64), (8, 24), (4, 0)];

impl Schedule {
    /// The tiles of a picture where nothing else is asked for: squares of 16 x 16 pixels, unless there are many threads.
    pub const TILE: TileSize = TileSize::tile(NonZeroU32::new(SIDES[0].0).unwrap());

    /// [`Schedule::TILE`] where one ray colours `block` × `block` pixels, which no tile may cut.
    pub fn largest(block: u32) -> TileSize {
        square(SIDES[0].0, block)
    }

    /// The size of tiles: the one that was asked for, else squares of 16, 8 or 4 pixels, so that each thread gets a
    /// good many; a little larger where squares of `block` pixels, which one ray colours, would be cut.
    pub fn tile(&self, region: &Region, block: u32) -> TileSize {
        let fits = |(side, tiles): (u32, usize)| {
            let shape = square(side, block);
            (shape.count(region) / self.threads >= tiles).then_some(shape)
        };
        match self.tile {
            Some(shape) => shape,
            None if self.threads.get() == 1 => Self::largest(block),
            None => (SIDES.into_iter().find_map(fits)).unwrap_or_else(|| Self::largest(block)),
        }
    }
}

/// A square tile of at least this side that does not cut squares of `block` pixels.
fn square(side: u32, block: u32) -> TileSize {
    let side = side.next_multiple_of(block.max(1));
    NonZeroU32::new(side).map_or(Schedule::TILE, TileSize::tile)
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
                let side = work.tile(&region, block).rows.get();
                assert!(side.is_multiple_of(block), "{side} {block}");
            }
        }
    }
}
