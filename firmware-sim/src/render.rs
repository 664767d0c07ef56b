//! From packets of rays to strips of pixels to a display.

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb888;
use embedded_graphics_core::primitives::Rectangle;
use octray_core::needs::Needs;
use octray_core::observe::Observer;
use octray_core::octree::Accelerator;
use octray_core::packet::Frame;
use octray_core::scalar::Scalar;
use octray_core::trace::{Tracer, Workspace};

/// Red, green and blue in 8 bits.
pub type Level = [u8; 3];

/// Renders a picture into `target`, from top to bottom. `strip` is the only picture memory: as many
/// whole rows as it has room for are rendered, then drawn. It needs room for one row, two if a ray
/// colours more than one pixel; with less, nothing is drawn.
///
/// # Errors
/// What the display says.
pub fn render<S, A, O, D, const NEEDS: Needs>(
    target: &mut D,
    frame: &Frame<S>,
    tracer: &Tracer<'_, S, A, NEEDS>,
    workspace: &mut Workspace<'_, S, A::Stack>,
    strip: &mut [Level],
    observer: &mut O,
) -> Result<(), D::Error>
where
    S: Scalar,
    A: Accelerator<S, NEEDS>,
    O: Observer,
    D: DrawTarget<Color: From<Rgb888>>,
{
    let (width, height) = (frame.parts().width, frame.parts().height);
    let background = tracer.scene.background;
    let background = [background.x, background.y, background.z].map(S::level);
    // Blocks of two rows must not be cut.
    let rows = (strip.len() as u32 / width.max(1)) & !(frame.block() - 1);
    if rows == 0 {
        return Ok(());
    }
    let mut top = 0;
    while top < height {
        let bottom = (top + rows).min(height);
        let Some(pixels) = strip.get_mut(..((bottom - top) * width) as usize) else {
            break;
        };
        pixels.fill(background);
        frame.render(top..bottom, tracer, workspace, observer, |x, y, colour| {
            if let Some(pixel) = pixels.get_mut(((y - top) * width + x) as usize) {
                *pixel = [colour.x, colour.y, colour.z].map(S::level);
            }
        });
        let area = Rectangle::new(Point::new(0, top as i32), Size::new(width, bottom - top));
        let colours = pixels.iter().map(|&[r, g, b]| Rgb888::new(r, g, b).into());
        target.fill_contiguous(&area, colours)?;
        top = bottom;
    }
    Ok(())
}
