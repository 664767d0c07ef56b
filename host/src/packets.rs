//! Cutting a picture into packets that threads write into without getting in each other's way: strips of
//! rows, or tiles.

use crate::picture::Picture;
use octray_core::packet::Region;
use octray_engine::packet::Packet;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::num::NonZeroU32;
use std::sync::Mutex;

/// How large packets are; those at the right and at the bottom may be smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Shape {
    /// Rows.
    pub rows: NonZeroU32,
    /// Columns; whole rows if `None`.
    pub columns: Option<NonZeroU32>,
}

impl Shape {
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

    /// How many packets cover a region.
    pub fn count(self, region: &Region) -> usize {
        let width = region.columns.len();
        let across = match self.columns {
            Some(columns) => width.div_ceil(columns.get() as usize),
            None => usize::from(width > 0),
        };
        across * region.rows.len().div_ceil(self.rows.get() as usize)
    }

    /// The packets that cover a region, row by row from its upper left corner.
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
impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.columns, self.rows.get()) {
            (Some(columns), rows) => write!(f, "{columns} x {rows} pixels"),
            (None, 1) => write!(f, "1 row"),
            (None, rows) => write!(f, "{rows} rows"),
        }
    }
}

/// All packets of a picture, each to be taken once by whichever thread works on it.
#[derive(Debug)]
pub struct Packets<'a>(Vec<Mutex<Option<Packet<'a>>>>);

impl<'a> Packets<'a> {
    /// Cut a region of a picture into packets, in the order of [`Shape::cut`]. Pixels that the picture does not
    /// have are left out.
    pub fn cut(picture: &'a mut Picture, region: &Region, shape: Shape) -> Self {
        let (width, height) = picture.size();
        let region = Region {
            columns: region.columns.start..region.columns.end.min(width),
            rows: region.rows.start..region.rows.end.min(height),
        };
        let (levels, intensities) = picture.pixels_mut();
        let mut levels = Rows::new(levels, width, &region);
        let mut intensities = intensities.map(|pixels| Rows::new(pixels, width, &region));
        let packets = shape.cut(&region).map(|region| {
            let levels = levels.take(&region);
            let intensities = intensities.as_mut().map(|rows| rows.take(&region));
            Mutex::new(Some(Packet {
                region,
                levels,
                intensities,
            }))
        });
        Self(packets.collect())
    }

    /// How many packets there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Take a packet; `None` if it was taken before or is not there.
    pub fn take(&self, index: usize) -> Option<Packet<'a>> {
        self.0.get(index)?.lock().ok()?.take()
    }
}

/// What is left of each row of a region.
struct Rows<'a, T> {
    first: u32,
    rows: Vec<&'a mut [T]>,
}

impl<'a, T> Rows<'a, T> {
    fn new(pixels: &'a mut [T], width: u32, region: &Region) -> Self {
        let Region { columns, rows } = region;
        let inside = |row: &'a mut [T]| {
            row.get_mut(columns.start as usize..columns.end as usize)
                .unwrap_or_default()
        };
        let rows_of = pixels.chunks_exact_mut(width.max(1) as usize);
        Self {
            first: rows.start,
            rows: rows_of
                .skip(rows.start as usize)
                .take(rows.len())
                .map(inside)
                .collect(),
        }
    }

    /// Cut the next packet off, all to the left of it being gone.
    fn take(&mut self, region: &Region) -> Vec<&'a mut [T]> {
        let rows = region.rows.clone().map(|row| (row - self.first) as usize);
        let width = region.columns.len();
        rows.filter_map(|row| self.rows.get_mut(row)?.split_off_mut(..width))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::Range;

    fn shape(rows: u32, columns: u32) -> Shape {
        Shape {
            rows: NonZeroU32::new(rows).unwrap(),
            columns: NonZeroU32::new(columns),
        }
    }

    /// Marks the pixels of each packet with its row, its column and 1; they must not be marked before.
    fn paint(columns: Range<u32>, rows: Range<u32>, shape: Shape) -> Picture {
        let mut picture = Picture::black(7, 23, true).unwrap();
        let packets = Packets::cut(&mut picture, &Region { columns, rows }, shape);
        for index in 0..packets.len() {
            let packet = packets.take(index).unwrap();
            let intensities = packet.intensities.unwrap();
            assert_eq!(packet.levels.len(), packet.region.rows.len());
            assert_eq!(intensities.len(), packet.region.rows.len());
            for (row, levels) in packet.region.rows.zip(packet.levels) {
                assert_eq!(levels.len(), packet.region.columns.len());
                for (column, level) in packet.region.columns.clone().zip(levels) {
                    assert_eq!(*level, [0; 3]);
                    *level = [row as u8, column as u8, 1];
                }
            }
            assert!(packets.take(index).is_none());
        }
        picture
    }

    #[test]
    fn packets_cover_their_region_and_nothing_else() {
        let shapes = [(1, 0), (4, 0), (1000, 0), (1, 1), (4, 3), (5, 1000)];
        for (height, width) in shapes {
            for rows in [0..23, 7..20, 22..23, 20..99, 30..99, 5..5] {
                for columns in [0..7, 2..5, 6..99, 9..99, 3..3] {
                    let region = Region {
                        columns: columns.clone(),
                        rows: rows.clone(),
                    };
                    let tiles = shape(height, width);
                    assert_eq!(tiles.count(&region), tiles.cut(&region).count());
                    let picture = paint(columns.clone(), rows.clone(), tiles);
                    for (row, levels) in (0..).zip(picture.rows()) {
                        for (column, level) in (0..).zip(levels) {
                            let inside = rows.contains(&row) && columns.contains(&column);
                            let painted = [row as u8, column as u8, 1];
                            let expected = if inside { painted } else { [0; 3] };
                            assert_eq!(*level, expected, "{rows:?} {columns:?} {height} {width}");
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
