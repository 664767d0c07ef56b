//! A display that keeps nothing but the picture's hash: it stands in for a panel in tests and
//! measurements.

use core::convert::Infallible;
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics_core::primitives::Rectangle;

/// FNV-1a, 64 bits, of width and height (32 bits each, little-endian) and then of all levels in the
/// order in which they are drawn: the hash that `octray render` tells, if strips come from top to
/// bottom and as wide as the picture.
#[derive(Clone, Debug)]
pub struct HashPanel {
    size: Size,
    hash: u64,
}

impl HashPanel {
    /// A panel of this size on which nothing has been drawn yet.
    pub fn new(width: u32, height: u32) -> Self {
        let mut panel = Self {
            size: Size::new(width, height),
            hash: 0xcbf2_9ce4_8422_2325,
        };
        for side in [width, height] {
            panel.write(side.to_le_bytes());
        }
        panel
    }

    /// The hash of what has been drawn.
    pub const fn hash(&self) -> u64 {
        self.hash
    }

    fn write<const N: usize>(&mut self, bytes: [u8; N]) {
        for byte in bytes {
            self.hash = (self.hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }
}

impl OriginDimensions for HashPanel {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for HashPanel {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(_, colour) in pixels {
            self.write([colour.r(), colour.g(), colour.b()]);
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb888>>(
        &mut self,
        _: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        for colour in colours {
            self.write([colour.r(), colour.g(), colour.b()]);
        }
        Ok(())
    }
}
