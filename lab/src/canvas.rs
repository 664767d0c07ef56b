//! What charts and maps are drawn on: SVG or pixels, with the only font there is.

mod raster;
mod widths;

use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::picture::{Format, Picture, RasDepth, Target};
use octray_scenes::name;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::path::Path;
use std::sync::Once;

/// Where to draw, in pixels from the upper left corner.
pub type Area<'a, B> = DrawingArea<B, Shift>;
/// What drawing comes to.
pub type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// Something to be drawn.
pub trait Figure {
    /// Width and height in pixels.
    fn size(&self) -> (u32, u32);

    /// Draws it.
    ///
    /// # Errors
    /// What the backend says.
    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B>;
}

/// The figure as SVG. Where it is shown with another font, its texts keep their widths.
///
/// # Errors
/// When it cannot be drawn.
pub fn svg(figure: &impl Figure) -> Result<String, Error> {
    Ok(widths::held(&drawn(figure)?))
}

/// The figure in pixels.
///
/// # Errors
/// When it cannot be drawn, or there is no memory for it.
pub fn picture(figure: &impl Figure) -> Result<Picture, Error> {
    raster::picture(&drawn(figure)?)
}

/// Whether a chart's file is to be SVG: any other name has to be a picture's.
pub fn is_svg(path: &Path) -> bool {
    path.extension()
        .is_some_and(|end| end.eq_ignore_ascii_case("svg"))
}

/// The formats of charts, by their extensions.
const CHARTS: [&str; 4] = ["svg", "png", "ppm", "ras"];

/// Checks that a chart can have this name; standard output and pipes get PNG.
///
/// # Errors
/// [`Error::Usage`] with the extensions that are known.
pub fn check_name(path: &Path) -> Result<(), Error> {
    let end = path.extension().unwrap_or_default();
    if is_svg(path) {
        return Ok(());
    }
    let target = Target::new(path.into());
    let known = CHARTS.iter().any(|known| end.eq_ignore_ascii_case(known));
    let named = !output::is_stdout(path) && !end.is_empty();
    match target {
        Ok(_) if known || !named => Ok(()),
        Err(why) if output::is_stdout(path) => Err(Error::Usage(why)),
        _ => {
            let known = CHARTS.map(|name| format!(".{name}")).join(", ");
            Err(Error::Usage(match end.is_empty() {
                true => format!("a chart's name ends in one of {known}"),
                false => format!(
                    "'.{}' is no format of charts; expected one of {known}",
                    name::line(&end.to_string_lossy())
                ),
            }))
        }
    }
}

/// Writes the figure as what the file's name says: `.svg`, or a picture.
///
/// # Errors
/// When it cannot be drawn or written, or the name says nothing known.
pub fn write_figure(path: &Path, figure: &impl Figure, interrupt: &Interrupt) -> Result<(), Error> {
    if is_svg(path) {
        let text = svg(figure)?;
        return output::write_file(path, interrupt, |out| out.write_all(text.as_bytes()));
    }
    let target = Target::new(path.into()).map_err(Error::Usage)?;
    let picture = picture(figure)?;
    match target.format {
        Format::Png => {
            let png = picture
                .png()
                .map_err(|cause| Error::Failed(format!("no PNG: {cause}")))?;
            output::write_file(path, interrupt, |out| out.write_all(&png))
        }
        _ => target.write(&picture, RasDepth::default(), interrupt),
    }
}

fn drawn(figure: &impl Figure) -> Result<String, Error> {
    register();
    let failed = |cause| Error::Failed(format!("cannot draw a chart: {cause}"));
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, figure.size()).into_drawing_area();
    area.fill(&WHITE).map_err(failed)?;
    figure.paint(&area).map_err(failed)?;
    area.present().map_err(failed)?;
    drop(area);
    Ok(text)
}

/// What all text is set in; its licence is in THIRD-PARTY-FONTS.md.
const FONT: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;

/// The only font there is, so that figures are the same on every machine.
fn register() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // It fails only on bytes that are no font.
        let _ = register_font("sans-serif", FontStyle::Normal, FONT);
    });
}

/// Writes text of a height in pixels; the place is its upper end, and left, right or middle.
///
/// # Errors
/// What the backend says.
pub fn write<B: DrawingBackend>(
    area: &Area<'_, B>,
    text: &str,
    place: (i32, i32),
    height: i32,
    across: HPos,
) -> Drawn<B> {
    write_in(area, text, place, height, across, BLACK)
}

/// The same in another colour than black.
///
/// # Errors
/// What the backend says.
pub fn write_in<B: DrawingBackend>(
    area: &Area<'_, B>,
    text: &str,
    place: (i32, i32),
    height: i32,
    across: HPos,
    ink: RGBColor,
) -> Drawn<B> {
    let style = ("sans-serif", height)
        .into_text_style(area)
        .color(&ink)
        .pos(Pos::new(across, VPos::Top));
    area.draw(&Text::new(text, place, style))
}
