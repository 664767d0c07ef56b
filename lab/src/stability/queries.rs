//! Points in a star, as each form decides them.

use crate::canvas::{Area, Drawn, Figure, write};
use octray_stability::method::Sweep;
use octray_stability::sweep::polygon::{Answer, Polygon, REACH, STAR, square};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Pixels: a point's cell, the lines of text, and the space around panels.
const CELL: i32 = 6;
const LINE: i32 = 18;
const MARGIN: i32 = 12;
const SIDE: i32 = (4 * REACH + 1) * CELL;

const INSIDE: RGBColor = RGBColor(206, 206, 206);
const OUTSIDE: RGBColor = RGBColor(244, 246, 243);
const FALSE_IN: RGBColor = RGBColor(230, 85, 13);
const FALSE_OUT: RGBColor = RGBColor(8, 69, 148);

/// The plane around the star, a panel for each form. A false in is a pale ring, a false out a dark
/// disc: they can be told apart without their colours.
pub(crate) struct Queries(Vec<Answer>);

impl Queries {
    /// In 32-bit floats, which hold the star and all points exactly.
    pub(crate) fn new() -> Self {
        Self(square::<f32>())
    }
}

impl Figure for Queries {
    fn size(&self) -> (u32, u32) {
        (
            (4 * MARGIN + 3 * SIDE) as u32,
            (2 * MARGIN + 3 * LINE + 10 + SIDE) as u32,
        )
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let about = Polygon::ABOUT;
        let title = format!("{}: every point is asked for", about.title);
        write(area, &title, (MARGIN, MARGIN), 18, HPos::Left)?;
        let top = MARGIN + LINE + 6;
        for (form, named) in about.forms.iter().enumerate() {
            let left = MARGIN + form as i32 * (SIDE + MARGIN);
            let label = format!("{}: {}", named.name, named.label);
            write(area, &label, (left, top), 14, HPos::Left)?;
            self.paint_form(area, form, (left, top + LINE))?;
        }
        let mut x = MARGIN;
        let entries = [(true, true), (false, false), (false, true), (true, false)];
        let texts = ["inside", "outside", "false in", "false out"];
        for ((truth, found), text) in entries.into_iter().zip(texts) {
            let y = top + LINE + SIDE + 8;
            paint_point(area, (x, y), truth, found)?;
            write(area, text, (x + CELL + 5, y - 2), 13, HPos::Left)?;
            x += CELL + 24 + 6 * text.len() as i32;
        }
        Ok(())
    }
}

impl Queries {
    fn paint_form<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        form: usize,
        (left, top): (i32, i32),
    ) -> Drawn<B> {
        let place = |[x, y]: [f64; 2]| {
            let cells = |x: f64| ((x + f64::from(REACH)) * 2.0) as i32 * CELL;
            (left + cells(x), top + cells(-y))
        };
        for answer in &self.0 {
            let corner = place(answer.point);
            let found = answer.found[form];
            paint_point(area, corner, answer.truth.unwrap_or(found), found)?;
        }
        let mut outline = STAR
            .map(|corner| {
                let (x, y) = place(corner);
                (x + CELL / 2, y + CELL / 2)
            })
            .to_vec();
        outline.push(outline[0]);
        area.draw(&PathElement::new(outline, RGBColor(120, 120, 120)))
    }
}

fn paint_point<B: DrawingBackend>(
    area: &Area<'_, B>,
    (x, y): (i32, i32),
    truth: bool,
    found: bool,
) -> Drawn<B> {
    let fill = if truth { INSIDE } else { OUTSIDE };
    let frame = [(x, y), (x + CELL - 1, y + CELL - 1)];
    area.draw(&Rectangle::new(frame, fill.filled()))?;
    let middle = (x + CELL / 2, y + CELL / 2);
    match (truth, found) {
        (false, true) => area.draw(&Circle::new(middle, 2, FALSE_IN.stroke_width(2))),
        (true, false) => area.draw(&Circle::new(middle, 3, FALSE_OUT.filled())),
        _ => Ok(()),
    }
}
