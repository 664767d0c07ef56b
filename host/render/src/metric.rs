//! How far one picture is from another, in 8-bit levels.

use crate::error::Error;
use crate::picture::Picture;
use crate::tile::Level;

/// The distance between two pictures of the same size.
///
/// A pixel's difference is the largest of its channels' differences; squares are summed over all channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// How many pixels were compared.
    pub pixels: u64,
    /// Sum of the squared differences of all channels of all pixels.
    pub squares: u64,
    /// The largest difference.
    pub largest: u8,
    /// Pixels that differ by more than one level.
    pub beyond_1: u64,
    /// Pixels that differ by more than eight levels.
    pub beyond_8: u64,
}

impl Difference {
    /// Compare two pictures.
    ///
    /// # Errors
    /// [`Error::Sizes`] when they differ in size.
    pub fn between(a: &Picture, b: &Picture) -> Result<Self, Error> {
        let mut difference = Self {
            pixels: 0,
            squares: 0,
            largest: 0,
            beyond_1: 0,
            beyond_8: 0,
        };
        for (a, b) in pairs(a, b)? {
            let channels = [0, 1, 2].map(|i| a[i].abs_diff(b[i]));
            let largest = pixel(a, b);
            difference.pixels += 1;
            difference.squares += channels.map(|d| u64::from(d).pow(2)).iter().sum::<u64>();
            difference.largest = difference.largest.max(largest);
            difference.beyond_1 += u64::from(largest > 1);
            difference.beyond_8 += u64::from(largest > 8);
        }
        Ok(difference)
    }

    /// Root of the mean squared difference over all channels of all pixels, in levels; 0 for equal pictures.
    pub fn rmse(&self) -> f64 {
        let samples = 3 * self.pixels.max(1);
        (self.squares as f64 / samples as f64).sqrt()
    }

    /// Peak signal-to-noise ratio in dB, 20·log₁₀(255/RMSE); infinite for equal pictures.
    pub fn psnr(&self) -> f64 {
        20.0 * (255.0 / self.rmse()).log10()
    }

    /// Whether the pictures are equal.
    pub fn is_zero(&self) -> bool {
        self.largest == 0
    }
}

/// The difference of two pixels: the largest of the channels' differences.
pub fn pixel(a: Level, b: Level) -> u8 {
    let [r, g, b] = [0, 1, 2].map(|i| a[i].abs_diff(b[i]));
    r.max(g).max(b)
}

/// The pixels of two pictures side by side, row by row.
///
/// # Errors
/// [`Error::Sizes`] when the pictures differ in size.
pub fn pairs<'a>(
    a: &'a Picture,
    b: &'a Picture,
) -> Result<impl Iterator<Item = (Level, Level)> + 'a, Error> {
    if a.size() != b.size() {
        return Err(Error::Sizes(a.size(), b.size()));
    }
    Ok(a.levels().iter().copied().zip(b.levels().iter().copied()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(levels: &[Level]) -> Picture {
        Picture::from_levels(levels.len() as u32, 1, levels.to_vec()).unwrap()
    }

    #[test]
    fn equal_pictures_are_infinitely_alike() {
        let a = picture(&[[1, 2, 3], [4, 5, 6]]);
        let difference = Difference::between(&a, &a).unwrap();
        assert!(difference.is_zero());
        assert_eq!(difference.rmse(), 0.0);
        assert_eq!(difference.psnr(), f64::INFINITY);
    }

    #[test]
    fn the_measures_are_those_of_the_definitions() {
        let a = picture(&[[0, 0, 0], [10, 10, 10], [100, 100, 100], [255, 0, 0]]);
        let b = picture(&[[1, 0, 0], [10, 12, 10], [91, 100, 100], [0, 0, 0]]);
        let difference = Difference::between(&a, &b).unwrap();
        assert_eq!(difference.pixels, 4);
        assert_eq!(difference.squares, 1 + 4 + 81 + 255 * 255);
        assert_eq!(difference.largest, 255);
        assert_eq!(difference.beyond_1, 3);
        assert_eq!(difference.beyond_8, 2);
        let mean = (1.0 + 4.0 + 81.0 + 65025.0) / 12.0;
        assert!((difference.rmse() - f64::sqrt(mean)).abs() < 1e-12);
        assert!((difference.psnr() - 10.0 * (65025.0 / mean).log10()).abs() < 1e-12);
    }

    #[test]
    fn different_sizes_are_no_numbers_but_an_error() {
        let a = picture(&[[0; 3]; 2]);
        let b = Picture::from_levels(1, 2, vec![[0; 3]; 2]).unwrap();
        let text = Difference::between(&a, &b).unwrap_err().to_string();
        assert_eq!(text, "the pictures differ in size: 2x1 and 1x2");
    }
}
