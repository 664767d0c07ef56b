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
    /// How large tiles are, rows and columns even with four pixels per ray; [`Schedule::tile`] if `None`.
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
/// tiles none takes fewer instructions than 16 x 16 pixels. Columns are whole [runs](octray_core::frame::RUN).
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

    /// The size of tiles: the one that was asked for, else 16 x 16, 8 x 8 or 8 x 4 pixels, so that each thread gets a
    /// good many.
    pub fn tile(&self, region: &Region) -> TileSize {
        let fits = |(shape, tiles): (TileSize, usize)| {
            (shape.count(region) / self.threads >= tiles).then_some(shape)
        };
        match self.tile {
            Some(shape) => shape,
            None if self.threads.get() == 1 => Self::TILE,
            None => SIZES.into_iter().find_map(fits).unwrap_or(Self::TILE),
        }
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
            work.tile(&region).rows.get()
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
        assert_eq!(work.tile(&region), strip);
    }
}
