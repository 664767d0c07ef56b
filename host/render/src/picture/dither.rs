//! Pictures in black and white, the mean of which is that of the grey they stand for.

use super::Picture;
use crate::tile::Level;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// How grey becomes black and white.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Dither {
    /// What a pixel is off goes to its neighbours (Floyd and Steinberg 1976).
    #[default]
    Diffusion,
    /// A pattern of 8 x 8 thresholds (Bayer 1973).
    Ordered,
}

/// White and black.
const WHITE: i32 = 255;

impl Dither {
    /// Gives every pixel black or white, by its luma. A picture that has only these keeps them.
    pub fn apply(self, picture: &Picture) -> Picture {
        let (width, height) = picture.size();
        let bits = self.bits(picture);
        let levels = bits.iter().map(|white| [if *white { 255 } else { 0 }; 3]);
        // There are as many pixels as before.
        Picture::from_levels(width, height, levels.collect()).unwrap_or_else(|| picture.clone())
    }

    /// Whether each pixel is white, row by row.
    pub(super) fn bits(self, picture: &Picture) -> Vec<bool> {
        match self {
            Self::Diffusion => diffused(picture),
            Self::Ordered => ordered(picture),
        }
    }
}

/// Rows run to and fro, so that what is off does not wander to one side.
fn diffused(picture: &Picture) -> Vec<bool> {
    let width = picture.width() as usize;
    let mut bits = Vec::with_capacity(picture.levels().len());
    // What the pixels of this row and the next are off, in sixteenths of a level; one place more at either end.
    let (mut here, mut below) = (vec![0; width + 2], vec![0; width + 2]);
    for (y, row) in picture.rows().enumerate() {
        let start = bits.len();
        bits.resize(start + width, false);
        for i in 0..width {
            let (x, ahead) = match y % 2 {
                0 => (i, 1),
                _ => (width - 1 - i, -1),
            };
            let at = |step: isize| (x + 1).wrapping_add_signed(step);
            let wanted = 16 * i32::from(luma(row[x])) + here[x + 1];
            let white = wanted >= 8 * WHITE;
            bits[start + x] = white;
            let off = wanted - if white { 16 * WHITE } else { 0 };
            // What is left over by the divisions goes straight on.
            let (down, behind, beyond) = (off * 5 / 16, off * 3 / 16, off / 16);
            below[x + 1] += down;
            below[at(-ahead)] += behind;
            below[at(ahead)] += beyond;
            here[at(ahead)] += off - down - behind - beyond;
        }
        std::mem::swap(&mut here, &mut below);
        below.fill(0);
    }
    bits
}

fn ordered(picture: &Picture) -> Vec<bool> {
    let rows = (0_u32..).zip(picture.rows());
    rows.flat_map(|(y, row)| {
        let pixels = (0_u32..).zip(row);
        pixels.map(move |(x, level)| 128 * u32::from(luma(*level)) >= 255 * (128 - threshold(x, y)))
    })
    .collect()
}

/// Bayer's threshold for a pixel: an odd number from 1 to 127, each once in 8 × 8 pixels.
fn threshold(x: u32, y: u32) -> u32 {
    // The lowest bits of the place decide most.
    let rank = (0..3).fold(0, |rank, bit| {
        rank << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1)
    });
    2 * rank + 1
}

/// Luma by the weights of ITU-R BT.601, in 1/256, rounded to nearest.
fn luma([r, g, b]: Level) -> u8 {
    let [r, g, b] = [r, g, b].map(u32::from);
    ((77 * r + 150 * g + 29 * b + 128) >> 8) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(level: u8) -> Picture {
        Picture::from_levels(64, 64, vec![[level; 3]; 64 * 64]).unwrap()
    }

    fn white(bits: &[bool]) -> f64 {
        bits.iter().filter(|white| **white).count() as f64
    }

    #[test]
    fn the_mean_of_a_grey_is_kept_by_either_way() {
        for level in 0..=255 {
            let share = f64::from(level) / 255.0;
            let ordered = white(&Dither::Ordered.bits(&grey(level))) / 4096.0;
            assert!(
                (ordered - share).abs() <= 1.0 / 128.0 + 1e-9,
                "{level}: {ordered}"
            );
            // What is off at the borders is lost.
            let diffused = white(&Dither::Diffusion.bits(&grey(level))) / 4096.0;
            assert!((diffused - share).abs() < 0.02, "{level}: {diffused}");
        }
    }

    #[test]
    fn diffusion_keeps_the_mean_of_every_small_square_of_a_ramp() {
        let levels: Vec<Level> = (0..256 * 64).map(|i| [(i % 256) as u8; 3]).collect();
        let ramp = Picture::from_levels(256, 64, levels).unwrap();
        let bits = &Dither::Diffusion.bits(&ramp);
        for left in (8..240).step_by(8) {
            let square = (24..32).flat_map(|y| (left..left + 8).map(move |x| bits[y * 256 + x]));
            let found = white(&square.collect::<Vec<_>>()) / 64.0;
            let expected = (left as f64 + 3.5) / 255.0;
            assert!((found - expected).abs() < 0.1, "{left}: {found} {expected}");
        }
    }

    #[test]
    fn black_and_white_stay_where_they_are() {
        let levels: Vec<Level> = (0..64 * 64)
            .map(|i| [if i * i % 7 < 3 { 255 } else { 0 }; 3])
            .collect();
        let picture = Picture::from_levels(64, 64, levels).unwrap();
        for dither in [Dither::Diffusion, Dither::Ordered] {
            assert_eq!(dither.apply(&picture), picture);
        }
    }
}
