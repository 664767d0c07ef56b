//! Pictures: 8-bit levels, float intensities where asked for, and the files that hold them.

mod dither;
mod format;
mod intensity;
mod malformed;
mod netpbm;
mod palette;
mod pfm;
mod png;
mod ppm;
mod ras;

pub use self::png::Animation;
pub use dither::Dither;
pub use format::{Format, Target, decode, read, read_first};
pub use ras::RasDepth;

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::tile::TileBuffer;
use crate::tile::{Intensity, Level};
use fnv::FnvHasher;
use std::hash::Hasher;
use std::io;
use std::ops::{Range, RangeFrom};
use std::path::Path;

/// A picture, rows from top to bottom, columns from left to right.
///
/// The levels are the picture: whoever traces computes them in the scene's own arithmetic as
/// ⌊255·c + ½⌋ of the clamped intensity. Intensities are there only for formats that can hold them.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    levels: Vec<Level>,
    intensities: Option<Vec<Intensity>>,
}

impl Picture {
    /// A black picture, with room for intensities if `intensities`; `None` when there is not enough memory.
    pub fn black(width: u32, height: u32, intensities: bool) -> Option<Self> {
        let pixels = usize::try_from(u64::from(width) * u64::from(height)).ok()?;
        Some(Self {
            width,
            height,
            levels: zeroed(pixels)?,
            intensities: match intensities {
                true => Some(zeroed(pixels)?),
                false => None,
            },
        })
    }

    /// A picture of these levels; `None` unless there are width × height of them.
    pub fn from_levels(width: u32, height: u32, levels: Vec<Level>) -> Option<Self> {
        (levels.len() as u64 == u64::from(width) * u64::from(height)).then_some(Self {
            width,
            height,
            levels,
            intensities: None,
        })
    }

    /// A picture of these intensities, its levels computed here by [`level`]; `None` unless there are
    /// width × height of them.
    pub fn from_intensities(width: u32, height: u32, intensities: Vec<Intensity>) -> Option<Self> {
        let levels = intensities.iter().map(|rgb| rgb.map(level)).collect();
        let picture = Self::from_levels(width, height, levels)?;
        Some(Self {
            intensities: Some(intensities),
            ..picture
        })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Columns and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// All levels, row by row.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// All intensities, row by row, if the picture has them.
    pub fn intensities(&self) -> Option<&[Intensity]> {
        self.intensities.as_deref()
    }

    /// Put a part in its place, which must lie in the picture. Intensities are put if both have them.
    pub fn put(&mut self, part: &TileBuffer) {
        let rows = part.region.rows.start as usize..;
        let (width, left) = (self.width as usize, part.region.columns.start as usize);
        let columns = left..left + part.region.columns.len();
        put_rows(
            &mut self.levels,
            &part.levels,
            width,
            rows.clone(),
            &columns,
        );
        if let (Some(whole), Some(part)) = (&mut self.intensities, &part.intensities) {
            put_rows(whole, part, width, rows, &columns);
        }
    }

    /// Fill the rows that are not among `rows` with a level, and with an intensity if there are any.
    pub fn fill_outside(&mut self, rows: Range<u32>, (level, intensity): (Level, Intensity)) {
        let width = self.width as usize;
        let pixel = |row: u32| row.min(self.height) as usize * width;
        let (above, below) = (..pixel(rows.start), pixel(rows.end.max(rows.start))..);
        self.levels[above].fill(level);
        self.levels[below.clone()].fill(level);
        if let Some(intensities) = &mut self.intensities {
            intensities[above].fill(intensity);
            intensities[below].fill(intensity);
        }
    }

    /// The levels, a row at a time from the top.
    pub fn rows(&self) -> std::slice::ChunksExact<'_, Level> {
        self.levels.chunks_exact(self.width.max(1) as usize)
    }

    /// FNV-1a, 64 bits, of the width and the height (32 bits each, little-endian) and then of all levels,
    /// row by row: the same on every machine for the same picture.
    pub fn hash(&self) -> u64 {
        let mut hasher = FnvHasher::default();
        hasher.write(&self.width.to_le_bytes());
        hasher.write(&self.height.to_le_bytes());
        hasher.write(self.levels.as_flattened());
        hasher.finish()
    }

    /// Writes the picture in the format that the file's ending names (`.png`, `.ppm`, `.pfm`, `.ras` or `.int`), whole or
    /// not at all: what was there before stays until the new file is complete. `-` is standard output, as PNG.
    ///
    /// `.pfm` and `.int` hold intensities; of a picture without them, the levels divided by 255. A `.ras` has 256
    /// colours; [`Target::write`] has its other depths, and stops when asked to.
    ///
    /// # Errors
    /// [`Error::Usage`] if the ending is unknown, [`Error::Write`] with the file and the system's reason.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        Target::new(path.as_ref().to_owned())
            .map_err(Error::Usage)?
            .write(self, RasDepth::default(), &Interrupt::new())
    }

    /// The levels as the bytes of a PNG file, as small as is worth the time. [`Target::write`] is faster, and compresses less.
    ///
    /// # Errors
    /// If the encoder refuses the picture's size.
    pub fn png(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        png::write(self, png::Compression::Balanced, &mut bytes)?;
        Ok(bytes)
    }
}

/// ⌊255·c + ½⌋ of `c` clamped to [0, 1], computed in `f64`; 0 for NaN.
pub fn level(c: f32) -> u8 {
    // In f32, so that what was rounded to it, such as 0.9, is rounded as it was before. The cast saturates, truncates
    // towards zero, and takes NaN to 0.
    (255.0 * c.clamp(0.0, 1.0) + 0.5) as u8
}

/// Memory of zeros that nobody has touched yet: the threads that fill it do that side by side. `None` when
/// there is not enough.
fn zeroed<T: Clone + Default>(count: usize) -> Option<Vec<T>> {
    // Only a try: `vec!` alone takes untouched zeros from the system, but ends the process without memory.
    Vec::<T>::new().try_reserve_exact(count).ok()?;
    Some(vec![T::default(); count])
}

/// Puts a part's pixels into rows and columns of the whole, which is `width` pixels wide.
fn put_rows<T: Copy>(
    whole: &mut [T],
    part: &[T],
    width: usize,
    rows: RangeFrom<usize>,
    columns: &Range<usize>,
) {
    for (row, pixels) in rows.zip(part.chunks_exact(columns.len().max(1))) {
        whole[row * width..][columns.clone()].copy_from_slice(pixels);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_round_half_up_and_clamp() {
        let cases = [
            (0.0, 0),
            (0.5 / 255.0 - 1e-6, 0),
            (0.5 / 255.0 + 1e-6, 1),
            (0.5, 128),
            (1.0, 255),
            (7.0, 255),
            (-1.0, 0),
            (f32::NAN, 0),
            (f32::INFINITY, 255),
        ];
        for (c, expected) in cases {
            assert_eq!(level(c), expected, "{c}");
        }
    }

    #[test]
    fn a_picture_needs_as_many_pixels_as_it_has_places() {
        assert!(Picture::from_levels(2, 2, vec![[0; 3]; 3]).is_none());
        assert!(Picture::from_levels(2, 2, vec![[0; 3]; 4]).is_some());
        assert!(Picture::black(u32::MAX, u32::MAX, true).is_none());
    }

    #[test]
    fn what_is_outside_of_some_rows_is_filled() {
        let fill = |rows| {
            let mut picture = Picture::black(1, 4, true).unwrap();
            picture.fill_outside(rows, ([9; 3], [0.5; 3]));
            let filled = picture
                .intensities()
                .unwrap()
                .iter()
                .map(|i| *i == [0.5; 3]);
            let levels = picture.levels().iter().map(|level| *level == [9; 3]);
            assert!(filled.clone().eq(levels));
            filled.collect::<Vec<_>>()
        };
        assert_eq!(fill(1..3), [true, false, false, true]);
        assert_eq!(fill(0..4), [false; 4]);
        assert_eq!(fill(0..0), [true; 4]);
        assert_eq!(fill(9..12), [true; 4]);
    }

    #[test]
    fn the_hash_is_the_published_fnv_1a_of_size_and_levels() {
        // Computed by hand from the definition: offset basis cbf29ce484222325, prime 100000001b3.
        let bytes = [1, 0, 0, 0, 2, 0, 0, 0, 10, 20, 30, 40, 50, 60u8];
        let expected = bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
        });
        let picture = Picture::from_levels(1, 2, vec![[10, 20, 30], [40, 50, 60]]).unwrap();
        assert_eq!(picture.hash(), expected);
        let turned = Picture::from_levels(2, 1, picture.levels().to_vec()).unwrap();
        assert_ne!(turned.hash(), expected);
    }
}
