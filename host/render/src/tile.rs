//! Cutting a picture into tiles (rectangles, or strips of whole rows), and the memory that each is traced into.

use octray_core::frame::Region;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::num::NonZeroU32;

/// Red, green and blue in 8 bits, 255 being full intensity.
pub type Level = [u8; 3];

/// Red, green and blue as linear intensities, 1 being full intensity.
pub type Intensity = [f32; 3];

/// One tile, to be written into.
#[derive(Debug)]
pub struct Tile<'a> {
    /// Which pixels of the picture these are.
    pub region: Region,
    /// Their levels, row by row, as many as the region has pixels.
    pub levels: &'a mut [Level],
    /// As many intensities, if the picture has them.
    pub intensities: Option<&'a mut [Intensity]>,
}

/// How large tiles are; those at the right and at the bottom may be smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct TileSize {
    /// Rows.
    pub rows: NonZeroU32,
    /// Columns; whole rows if `None`.
    pub columns: Option<NonZeroU32>,
}

impl TileSize {
    /// Whole rows.
    pub const fn strip(rows: NonZeroU32) -> Self {
        Self {
            rows,
            columns: None,
        }
    }

    /// Squares.
    pub const fn tile(side: NonZeroU32) -> Self {
        Self {
            rows: side,
            columns: Some(side),
        }
    }

    /// How many tiles there are beside each other in a region.
    pub fn across(self, region: &Region) -> usize {
        let width = region.columns.len();
        match self.columns {
            Some(columns) => width.div_ceil(columns.get() as usize),
            None => usize::from(width > 0),
        }
    }

    /// How many rows of tiles there are in a region.
    pub fn down(self, region: &Region) -> usize {
        region.rows.len().div_ceil(self.rows.get() as usize)
    }

    /// How many tiles cover a region.
    pub fn count(self, region: &Region) -> usize {
        self.across(region) * self.down(region)
    }

    /// The tiles that cover a region, row by row from its upper left corner.
    pub fn cut(self, region: &Region) -> impl Iterator<Item = Region> {
        let (rows, columns) = (region.rows.clone(), region.columns.clone());
        let width = self.columns.map_or(u32::MAX, NonZeroU32::get);
        let starts = |start: u32, end, step| (start..end).step_by(step as usize);
        starts(rows.start, rows.end, self.rows.get()).flat_map(move |row| {
            let rows = row..row.saturating_add(self.rows.get()).min(rows.end);
            let end = columns.end;
            starts(columns.start, end, width).map(move |column| Region {
                columns: column..column.saturating_add(width).min(end),
                rows: rows.clone(),
            })
        })
    }
}

/// `4 rows` or `16 x 8 pixels`, the columns first.
impl fmt::Display for TileSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.columns, self.rows.get()) {
            (Some(columns), rows) => write!(f, "{columns} x {rows} pixels"),
            (None, 1) => write!(f, "1 row"),
            (None, rows) => write!(f, "{rows} rows"),
        }
    }
}

/// A part of a picture in memory of its own, so that threads which trace parts beside each other do not write
/// into the same cache lines; [`crate::framebuffer`] makes a picture of them.
#[derive(Clone, Debug, PartialEq)]
pub struct TileBuffer {
    /// Which pixels of the picture these are.
    pub region: Region,
    /// Their levels, row by row.
    pub levels: Vec<Level>,
    /// Their intensities, row by row, if the picture has them.
    pub intensities: Option<Vec<Intensity>>,
}

impl TileBuffer {
    /// A part of a picture, with intensities or without, to be traced.
    pub fn black(region: Region, holds_intensities: bool) -> Self {
        let pixels = region.columns.len() * region.rows.len();
        Self {
            region,
            levels: vec![[0; 3]; pixels],
            intensities: holds_intensities.then(|| vec![[0.0; 3]; pixels]),
        }
    }

    /// The same to be written into.
    pub fn tile(&mut self) -> Tile<'_> {
        Tile {
            region: self.region.clone(),
            levels: &mut self.levels,
            intensities: self.intensities.as_deref_mut(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;

    fn shape(rows: u32, columns: u32) -> TileSize {
        TileSize {
            rows: NonZeroU32::new(rows).unwrap(),
            columns: NonZeroU32::new(columns),
        }
    }

    /// Marks the pixels of each tile with its row, its column and 1; they must not be marked before.
    fn paint(region: &Region, shape: TileSize) -> Picture {
        let mut picture = Picture::black(7, 23, true).unwrap();
        for region in shape.cut(region) {
            let mut part = TileBuffer::black(region, true);
            let (rows, columns) = (part.region.rows.clone(), part.region.columns.clone());
            let places = rows.flat_map(|row| columns.clone().map(move |column| (row, column)));
            for (pixel, (row, column)) in places.enumerate() {
                let before = picture.levels()[(row * 7 + column) as usize];
                assert_eq!(before, [0; 3]);
                part.levels[pixel] = [row as u8, column as u8, 1];
                part.tile().intensities.unwrap()[pixel] = [row as f32, column as f32, 1.0];
            }
            picture.put(&part);
        }
        picture
    }

    #[test]
    fn tiles_cover_their_region_and_nothing_else() {
        let shapes = [(1, 0), (4, 0), (1000, 0), (1, 1), (4, 3), (5, 1000)];
        for (height, width) in shapes {
            for rows in [0..23, 7..20, 22..23, 5..5] {
                for columns in [0..7, 2..5, 6..7, 3..3] {
                    let region = Region {
                        columns: columns.clone(),
                        rows: rows.clone(),
                    };
                    let tiles = shape(height, width);
                    assert_eq!(tiles.count(&region), tiles.cut(&region).count());
                    let picture = paint(&region, tiles);
                    let intensities = picture.intensities().unwrap().chunks(7);
                    for (row, (levels, intensities)) in (0..).zip(picture.rows().zip(intensities)) {
                        for (column, (level, fine)) in (0..).zip(levels.iter().zip(intensities)) {
                            let inside = rows.contains(&row) && columns.contains(&column);
                            let painted = [row as u8, column as u8, 1];
                            let expected = if inside { painted } else { [0; 3] };
                            assert_eq!(*level, expected, "{rows:?} {columns:?} {height} {width}");
                            assert_eq!(*fine, expected.map(f32::from));
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn shapes_are_told_with_the_columns_first() {
        let texts = [shape(1, 0), shape(4, 0), shape(8, 16)].map(|shape| shape.to_string());
        assert_eq!(texts, ["1 row", "4 rows", "16 x 8 pixels"]);
    }
}
