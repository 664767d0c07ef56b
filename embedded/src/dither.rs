//! Ordered dithering: a display of few colours that shows the mean of more.
//!
//! Bayer's matrix of 8 × 8 thresholds (B. E. Bayer, "An optimum method for two-level rendition of
//! continuous-tone pictures", ICC 1973). A level is rounded down or up to a step of the display;
//! over 8 × 8 pixels of one level, the mean is off by at most 1/128 of a step.

use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point};
use embedded_graphics_core::pixelcolor::{
    BinaryColor, Gray8, PixelColor, Rgb565, Rgb888, RgbColor,
};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};

/// How far above a step a level must be to be rounded up: 1 to 127, in units of 1/128 of a step
/// below the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Threshold(u32);

impl Threshold {
    /// Rounds to the nearest step.
    pub const NEAREST: Self = Self(64);

    /// Bayer's threshold for a pixel.
    pub const fn bayer(pixel: Point) -> Self {
        let (x, y) = (pixel.x as u32, pixel.y as u32);
        let mut rank = 0;
        let mut bit = 0;
        // The lowest bits of the place decide most.
        while bit < 3 {
            rank = rank << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
            bit += 1;
        }
        Self(2 * rank + 1)
    }

    /// The step, from 0 to `last`, of a level from 0 to 255; 0 and 255 are met exactly.
    pub const fn step(self, level: u8, last: u8) -> u8 {
        ((level as u32 * last as u32 * 128 + 255 * self.0) / (255 * 128)) as u8
    }
}

/// What a panel can show.
pub trait PanelColor: PixelColor {
    /// A colour as the panel shows it, each channel rounded by the threshold.
    fn rounded(colour: Rgb888, threshold: Threshold) -> Self;
}

impl PanelColor for Rgb888 {
    fn rounded(colour: Rgb888, _: Threshold) -> Self {
        colour
    }
}

impl PanelColor for Rgb565 {
    fn rounded(colour: Rgb888, threshold: Threshold) -> Self {
        Self::new(
            threshold.step(colour.r(), Self::MAX_R),
            threshold.step(colour.g(), Self::MAX_G),
            threshold.step(colour.b(), Self::MAX_B),
        )
    }
}

impl PanelColor for Gray8 {
    fn rounded(colour: Rgb888, _: Threshold) -> Self {
        Self::new(luma(colour))
    }
}

impl PanelColor for BinaryColor {
    fn rounded(colour: Rgb888, threshold: Threshold) -> Self {
        (threshold.step(luma(colour), 1) == 1).into()
    }
}

/// Luma by the weights of ITU-R BT.601, in 1/256, rounded to nearest.
pub(crate) fn luma(colour: Rgb888) -> u8 {
    let [r, g, b] = [colour.r(), colour.g(), colour.b()].map(u32::from);
    ((77 * r + 150 * g + 29 * b + 128) >> 8) as u8
}

/// A panel that is drawn on in 24-bit colours.
#[derive(Debug)]
pub struct Dithered<'a, D> {
    /// The panel.
    pub panel: &'a mut D,
    /// Whether thresholds are Bayer's; otherwise colours are rounded to the nearest.
    pub ordered: bool,
}

impl<D: DrawTarget<Color: PanelColor>> Dimensions for Dithered<'_, D> {
    fn bounding_box(&self) -> Rectangle {
        self.panel.bounding_box()
    }
}

impl<D: DrawTarget<Color: PanelColor>> DrawTarget for Dithered<'_, D> {
    type Color = Rgb888;
    type Error = D::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), D::Error> {
        let ordered = self.ordered;
        let rounded = |Pixel(place, colour)| Pixel(place, rounded(ordered, place, colour));
        self.panel.draw_iter(pixels.into_iter().map(rounded))
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb888>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), D::Error> {
        let ordered = self.ordered;
        let pixels = area.points().zip(colours);
        let colours = pixels.map(|(place, colour)| rounded(ordered, place, colour));
        self.panel.fill_contiguous(area, colours)
    }
}

fn rounded<C: PanelColor>(ordered: bool, place: Point, colour: Rgb888) -> C {
    let threshold = match ordered {
        true => Threshold::bayer(place),
        false => Threshold::NEAREST,
    };
    C::rounded(colour, threshold)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thresholds() -> impl Iterator<Item = Threshold> {
        (0..64).map(|i| Threshold::bayer(Point::new(i % 8, i / 8)))
    }

    #[test]
    fn every_threshold_is_there_once() {
        let mut seen = 0u64;
        thresholds().for_each(|Threshold(odd)| seen |= 1 << (odd / 2));
        assert_eq!(seen, u64::MAX);
    }

    #[test]
    fn neighbours_differ_by_half_a_step_or_more_on_average() {
        let at = |x, y| Threshold::bayer(Point::new(x, y)).0;
        assert_eq!([at(0, 0), at(1, 0), at(1, 1), at(0, 1)], [1, 65, 33, 97]);
        assert_eq!(at(3, 6), at(11, 14));
    }

    #[test]
    fn flat_areas_keep_their_mean() {
        for last in [1, 31, 63] {
            for level in 0..=u8::MAX {
                let sum: u32 = thresholds().map(|t| u32::from(t.step(level, last))).sum();
                let wanted = f64::from(level) * f64::from(last) / 255.0;
                let error = (f64::from(sum) / 64.0 - wanted).abs();
                assert!(error <= 1.0 / 128.0 + 1e-9, "{level} of {last}: {error}");
            }
        }
    }

    #[test]
    fn no_level_is_off_by_a_step() {
        for last in [1, 31, 63] {
            for level in 0..=u8::MAX {
                let wanted = f64::from(level) * f64::from(last) / 255.0;
                let error = |t: Threshold| (f64::from(t.step(level, last)) - wanted).abs();
                assert!(thresholds().all(|t| error(t) < 1.0), "{level} of {last}");
                assert!(error(Threshold::NEAREST) <= 0.5, "{level} of {last}");
            }
        }
    }

    #[test]
    fn black_and_white_stay() {
        for threshold in thresholds() {
            for (colour, on) in [(Rgb888::BLACK, false), (Rgb888::WHITE, true)] {
                assert_eq!(BinaryColor::rounded(colour, threshold), on.into());
            }
            assert_eq!(Rgb565::rounded(Rgb888::WHITE, threshold), Rgb565::WHITE);
            assert_eq!(Gray8::rounded(Rgb888::WHITE, threshold), Gray8::new(255));
        }
    }
}
