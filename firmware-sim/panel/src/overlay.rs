//! A line of text at the bottom of the panel: what the picture took.

use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::mono_font::{MonoTextStyleBuilder, ascii::FONT_6X10};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::{Baseline, Text};
use octray_embedded::dither::{PanelColor, Threshold};
use octray_render::counts::thousands;

/// Number format, rays, and seconds of tracing in three digits or more.
pub(crate) fn text(format: &str, rays: u64, seconds: f64) -> String {
    let rays = thousands(rays);
    let milliseconds = seconds * 1e3;
    match milliseconds < 100.0 {
        true => format!("{format}  {rays} rays  {milliseconds:.1} ms"),
        false => format!("{format}  {rays} rays  {milliseconds:.0} ms"),
    }
}

/// Draws the text in white on a black bar; what does not fit is cut off at the right.
///
/// # Errors
/// What the panel says.
pub(crate) fn draw<D>(panel: &mut D, text: &str) -> Result<(), D::Error>
where
    D: DrawTarget<Color: PanelColor>,
{
    let [black, white] =
        [Rgb888::BLACK, Rgb888::WHITE].map(|c| D::Color::rounded(c, Threshold::NEAREST));
    let Size { width, height } = panel.bounding_box().size;
    let line = FONT_6X10.character_size.height + 2;
    let top = height as i32 - line as i32;
    panel.fill_solid(
        &Rectangle::new(Point::new(0, top), Size::new(width, line)),
        black,
    )?;
    let style = MonoTextStyleBuilder::new()
        .font(&FONT_6X10)
        .text_color(white)
        .build();
    Text::with_baseline(text, Point::new(2, top + 1), style, Baseline::Top).draw(panel)?;
    Ok(())
}
