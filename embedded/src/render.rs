//! From packets of rays to strips of pixels to a display.

use core::ops::Range;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::Rgb888;
use embedded_graphics_core::primitives::Rectangle;
use octray_core::accel::Accelerator;
use octray_core::features::FeatureSet;
use octray_core::frame::Frame;
use octray_core::observe::RayObserver;
use octray_core::trace::{TraceScalar, Tracer, Workspace};
use octray_core::vec3::Vec3;

/// Red, green and blue in 8 bits.
pub type Level = [u8; 3];

/// Rows of a strip, on the boards and on the simulated panel.
pub const ROWS: u32 = 4;

/// Renders a picture into `target`, from top to bottom. `strip` is the only picture memory: as many
/// whole rows as it has room for are rendered, then drawn. It needs room for one row, two if a ray
/// colours more than one pixel; with less, nothing is drawn.
///
/// # Errors
/// What the display says.
pub fn render<S, A, O, D, const FEATURES: FeatureSet>(
    target: &mut D,
    frame: &Frame<S>,
    tracer: &Tracer<'_, S, A, FEATURES>,
    workspace: &mut Workspace<'_, S, A::Stack>,
    strip: &mut [Level],
    observer: &mut O,
) -> Result<(), D::Error>
where
    S: TraceScalar,
    A: Accelerator<S, FEATURES>,
    O: RayObserver<S>,
    D: DrawTarget<Color: From<Rgb888>>,
{
    Strips::of(frame).draw(target, strip, |rows, pixels| {
        render_rows(rows, frame, tracer, workspace, pixels, observer);
    })
}

/// Renders some rows of a picture into `pixels`, row by row, where there is room for them.
pub(crate) fn render_rows<S, A, O, const FEATURES: FeatureSet>(
    rows: Range<u32>,
    frame: &Frame<S>,
    tracer: &Tracer<'_, S, A, FEATURES>,
    workspace: &mut Workspace<'_, S, A::Stack>,
    pixels: &mut [Level],
    observer: &mut O,
) where
    S: TraceScalar,
    A: Accelerator<S, FEATURES>,
    O: RayObserver<S>,
{
    let (width, top) = (frame.params().width, rows.start);
    pixels.fill(levels(tracer.scene.background));
    frame.render(rows, tracer, workspace, observer, |x, y, colour| {
        if let Some(pixel) = pixels.get_mut(((y - top) * width + x) as usize) {
            *pixel = levels(colour);
        }
    });
}

/// A colour in 8 bits.
pub(crate) fn levels<S: TraceScalar>(colour: Vec3<S>) -> Level {
    [colour.x, colour.y, colour.z].map(S::level)
}

/// A picture that is cut into strips of whole rows, whoever traces them.
#[derive(Clone, Copy, Debug)]
pub struct Strips {
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// The side of the square of pixels that one ray colours: such squares are not cut.
    pub block: u32,
}

impl Strips {
    /// Those of a frame.
    pub fn of<S: TraceScalar>(frame: &Frame<S>) -> Self {
        Self {
            width: frame.params().width,
            height: frame.params().height,
            block: frame.block(),
        }
    }

    /// The rows of a strip of so many pixels: whole ones, and whole squares of what one ray colours.
    pub(crate) fn rows(self, pixels: usize) -> u32 {
        let rows = pixels as u32 / self.width.max(1);
        rows - rows % self.block.max(1)
    }

    /// Draws the picture into `target`, from top to bottom. `trace` fills the pixels of some rows,
    /// row by row; they are in `strip`, as many whole rows as it has room for. With less room than
    /// for `block` rows, nothing is drawn.
    ///
    /// # Errors
    /// What the display says.
    pub fn draw<D: DrawTarget<Color: From<Rgb888>>>(
        self,
        target: &mut D,
        strip: &mut [Level],
        mut trace: impl FnMut(Range<u32>, &mut [Level]),
    ) -> Result<(), D::Error> {
        let rows = self.rows(strip.len());
        if rows == 0 {
            return Ok(());
        }
        let mut top = 0;
        while top < self.height {
            let bottom = (top + rows).min(self.height);
            let Some(pixels) = strip.get_mut(..((bottom - top) * self.width) as usize) else {
                break;
            };
            trace(top..bottom, pixels);
            let size = Size::new(self.width, bottom - top);
            let area = Rectangle::new(Point::new(0, top as i32), size);
            let colours = pixels.iter().map(|&[r, g, b]| Rgb888::new(r, g, b).into());
            target.fill_contiguous(&area, colours)?;
            top = bottom;
        }
        Ok(())
    }
}
