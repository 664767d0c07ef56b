//! Error diffusion: a display in black and white that shows the mean of greys, without a pattern.

use crate::dither::luma;
use core::fmt::{self, Display, Formatter};
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point};
use embedded_graphics_core::pixelcolor::{BinaryColor, Rgb888};
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use heapless::Vec;

/// A panel in black and white, of at most `WIDTH` columns, that is drawn on in 24-bit colours. What a pixel is off goes
/// to its neighbours (R. W. Floyd and L. Steinberg, "An adaptive algorithm for spatial greyscale", 1976).
///
/// Strips have to come from top to bottom, as wide as the panel; drawn pixel by pixel, colours are rounded to the nearest.
/// Takes two bytes for each column.
///
/// ```
/// # use embedded_graphics_core::{draw_target::DrawTarget, geometry::{OriginDimensions, Size}, Pixel};
/// # use embedded_graphics_core::pixelcolor::{BinaryColor, Rgb888};
/// # use embedded_graphics_core::primitives::Rectangle;
/// # struct Panel(u32);
/// # impl OriginDimensions for Panel {
/// #     fn size(&self) -> Size { Size::new(100, 2) }
/// # }
/// # impl DrawTarget for Panel {
/// #     type Color = BinaryColor;
/// #     type Error = core::convert::Infallible;
/// #     fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
/// #         self.0 += pixels.into_iter().filter(|pixel| pixel.1.is_on()).count() as u32;
/// #         Ok(())
/// #     }
/// # }
/// # let mut panel = Panel(0);
/// use octray_embedded::diffusion::Diffused;
///
/// let mut diffused = Diffused::<_, 100>::new(&mut panel)?;
/// // A grey of one quarter, on 100 x 2 pixels.
/// diffused.fill_solid(&Rectangle::new(Default::default(), Size::new(100, 2)), Rgb888::new(64, 64, 64))?;
/// assert!((48..=52).contains(&panel.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Diffused<'a, D, const WIDTH: usize> {
    panel: &'a mut D,
    /// What reaches each pixel of the row that comes next, in sixteenths of a level.
    off: Vec<i16, WIDTH>,
}

/// A panel of more columns than there is room for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooWide {
    /// The panel's columns.
    pub columns: u32,
}

impl Display for TooWide {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "the panel has {} columns", self.columns)
    }
}

impl core::error::Error for TooWide {}

impl<'a, D: DrawTarget<Color = BinaryColor>, const WIDTH: usize> Diffused<'a, D, WIDTH> {
    /// The panel, on which nothing has been drawn yet.
    ///
    /// # Errors
    /// If it has more than `WIDTH` columns.
    pub fn new(panel: &'a mut D) -> Result<Self, TooWide> {
        let columns = panel.bounding_box().size.width;
        let mut off = Vec::new();
        match off.resize_default(columns as usize) {
            Ok(()) => Ok(Self { panel, off }),
            Err(_) => Err(TooWide { columns }),
        }
    }
}

impl<D: DrawTarget<Color = BinaryColor>, const WIDTH: usize> Dimensions for Diffused<'_, D, WIDTH> {
    fn bounding_box(&self) -> Rectangle {
        self.panel.bounding_box()
    }
}

impl<D: DrawTarget<Color = BinaryColor>, const WIDTH: usize> DrawTarget for Diffused<'_, D, WIDTH> {
    type Color = Rgb888;
    type Error = D::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), D::Error> {
        let nearest = |Pixel(place, colour)| Pixel(place, (luma(colour) >= 128).into());
        self.panel.draw_iter(pixels.into_iter().map(nearest))
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb888>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), D::Error> {
        let first = self.panel.bounding_box().top_left;
        if area.top_left.y <= first.y {
            self.off.fill(0);
        }
        let mut row = Row::default();
        let off = &mut *self.off;
        let colours = area.points().zip(colours).map(|(place, colour)| {
            if place.x == area.top_left.x {
                row = Row::default();
            }
            row.next(off, place - first, luma(colour))
        });
        self.panel.fill_contiguous(area, colours)
    }
}

/// What the pixels of a row pass on, in sixteenths of a level.
#[derive(Default)]
struct Row {
    /// To the next pixel.
    ahead: i16,
    /// To the pixel below that one.
    below_ahead: i16,
}

impl Row {
    /// The next pixel of a row, black or white.
    fn next(&mut self, off: &mut [i16], place: Point, level: u8) -> BinaryColor {
        let x = place.x as usize;
        let above = off.get(x).copied().unwrap_or_default();
        let wanted = 16 * i16::from(level) + above + self.ahead;
        let white = wanted >= 8 * 255;
        let rest = wanted - if white { 16 * 255 } else { 0 };
        let (down, behind, beyond) = (rest * 5 / 16, rest * 3 / 16, rest / 16);
        if let Some(behind_below) = off.get_mut(x.wrapping_sub(1)) {
            *behind_below += behind;
        }
        if let Some(below) = off.get_mut(x) {
            *below = self.below_ahead + down;
        }
        self.below_ahead = beyond;
        // What is left over by the divisions goes straight on.
        self.ahead = rest - down - behind - beyond;
        white.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of 64 x 64 pixels of a grey are white.
    fn white(level: u8) -> u32 {
        let mut off = [0; 64];
        let mut sum = 0;
        for y in 0..64 {
            let mut row = Row::default();
            for x in 0..64 {
                sum += u32::from(row.next(&mut off, Point::new(x, y), level).is_on());
            }
        }
        sum
    }

    #[test]
    fn every_grey_keeps_its_mean() {
        for level in 0..=255 {
            let mean = f64::from(white(level)) / 4096.0 * 255.0;
            // What is still to be passed on at the last row and column.
            assert!((mean - f64::from(level)).abs() < 2.5, "{level}: {mean}");
        }
        assert_eq!((white(0), white(255)), (0, 4096));
    }

    #[test]
    fn nothing_overflows_whatever_the_picture() {
        let mut off = [0; 7];
        let mut seed = 1u32;
        for y in 0..1000 {
            let mut row = Row::default();
            for x in 0..7 {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let level = if seed >> 31 == 0 { 0 } else { 255 };
                row.next(&mut off, Point::new(x, y), level);
                assert!(row.ahead.abs() <= 16 * 255 && off[x as usize].abs() <= 16 * 255);
            }
        }
    }
}
