//! Where two pictures differ, as a picture.

use crate::error::Error;
use crate::metric;
use crate::picture::Picture;
use crate::tile::Level;

/// The part of the ramp that is used: its black end could be taken for equal pixels.
const DARKEST: f64 = 0.25;
/// How bright white is where the pictures are equal, out of 255.
const DIMMED: u32 = 72;

/// A heat map of the differences: pixels that are equal show the first picture in dim grey, others a colour
/// from violet over red to yellow that grows with the logarithm of the difference (1 to 255 levels), so that
/// a difference of one level is as easy to see as a large one.
///
/// # Errors
/// [`Error::Sizes`] when the pictures differ in size.
pub fn map(a: &Picture, b: &Picture) -> Result<Picture, Error> {
    let levels = metric::pairs(a, b)?
        .map(|(a, b)| match metric::pixel(a, b) {
            0 => dim_grey(a),
            difference => colour(difference),
        })
        .collect();
    Picture::from_levels(a.width(), a.height(), levels)
        .ok_or_else(|| Error::Sizes(a.size(), b.size()))
}

/// The colour of a difference of 1 to 255 levels, from Inferno: even steps to the eye, and in order of
/// lightness, so that it reads in grey and without red-green vision too.
fn colour(difference: u8) -> Level {
    let share = f64::from(difference).ln() / 255.0_f64.ln();
    let colour = colorous::INFERNO.eval_continuous(DARKEST + (1.0 - DARKEST) * share);
    [colour.r, colour.g, colour.b]
}

fn dim_grey([r, g, b]: Level) -> Level {
    // The weights of Rec. 709, in 1/256.
    let luma = (54 * u32::from(r) + 183 * u32::from(g) + 19 * u32::from(b)) / 256;
    [(luma * DIMMED / 255) as u8; 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pixels_are_grey_and_others_never() {
        let a = Picture::from_levels(256, 1, vec![[200; 3]; 256]).unwrap();
        let levels = (0..=255).map(|i| [i; 3]).collect();
        let b = Picture::from_levels(256, 1, levels).unwrap();
        let map = map(&a, &b).unwrap();
        for (i, [r, g, b]) in map.levels().iter().enumerate() {
            assert_eq!(r == g && g == b, i == 200, "{i}");
        }
    }

    #[test]
    fn a_larger_difference_is_lighter() {
        let luma = |difference| {
            let [r, g, b] = colour(difference).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for difference in [1, 2, 4, 8, 16, 32, 64, 127] {
            assert!(luma(difference) < luma(2 * difference), "{difference}");
        }
    }
}
