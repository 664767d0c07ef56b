//! A map of a method: for each form, a cell for each arithmetic and value.
//!
//! How dark a cell is says how bad its state is, and its symbol says why, so that the map can be
//! read without its colours.

use super::table::number;
use crate::canvas::{Area, Drawn, Figure, write};
use octray_stability::number::ARITHMETICS;
use octray_stability::state::{Cause, State};
use octray_stability::survey::{Cell, Outcome};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Pixels: a cell, the names left of the cells, and the lines of text above and below them.
const CELL: (i32, i32) = (20, 19);
const NAMES: i32 = 62;
const LINE: i32 = 18;
const MARGIN: i32 = 12;

/// The map of a method.
pub(crate) struct Map<'a>(pub(crate) &'a Outcome);

impl Figure for Map<'_> {
    fn size(&self) -> (u32, u32) {
        let (across, down) = panels(self.0);
        let (width, height) = panel(self.0);
        let width = (MARGIN + across * width).max(880);
        (
            width as u32,
            (2 * MARGIN + 2 * LINE + 8 + down * height) as u32,
        )
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        paint(area, self.0)
    }
}

/// Panels side by side, two to a row.
fn panels(outcome: &Outcome) -> (i32, i32) {
    let forms = outcome.about.forms.len() as i32;
    (forms.min(2), (forms + 1) / 2)
}

fn panel(outcome: &Outcome) -> (i32, i32) {
    let columns = outcome.about.values.len() as i32;
    // The label needs its width, too.
    let width = (NAMES + columns * CELL.0).max(360) + MARGIN;
    let height = ARITHMETICS.len() as i32 * CELL.1 + 3 * LINE + MARGIN;
    (width, height)
}

fn paint<B: DrawingBackend>(area: &Area<'_, B>, outcome: &Outcome) -> Drawn<B> {
    let about = &outcome.about;
    let title = format!("{}: {}", about.title, about.axis);
    write(area, &title, (MARGIN, MARGIN), 18, HPos::Left)?;
    let (across, down) = panels(outcome);
    let (width, height) = panel(outcome);
    let top = MARGIN + LINE + 10;
    for form in 0..about.forms.len() {
        let (column, row) = (form as i32 % across, form as i32 / across);
        let corner = (MARGIN + column * width, top + row * height);
        paint_form(area, outcome, form, corner)?;
    }
    paint_legend(area, (MARGIN, top + down * height))
}

fn paint_form<B: DrawingBackend>(
    area: &Area<'_, B>,
    outcome: &Outcome,
    form: usize,
    (left, top): (i32, i32),
) -> Drawn<B> {
    let about = &outcome.about;
    let named = about.forms[form];
    let label = format!("{}: {}", named.name, named.label);
    write(area, &label, (left, top + 4), 14, HPos::Left)?;
    let top = top + LINE + 6;
    for (a, arithmetic) in ARITHMETICS.iter().enumerate() {
        let y = top + a as i32 * CELL.1;
        let beside = (left + NAMES - 6, y + 3);
        write(area, arithmetic, beside, 13, HPos::Right)?;
        for (v, cell) in outcome.row(form, a).iter().enumerate() {
            paint_cell(area, cell, (left + NAMES + v as i32 * CELL.0, y))?;
        }
        if let Some(range) = outcome.admitted(a).filter(|_| form == 0) {
            let last = about.values.iter().position(|v| v == range.end());
            let x = left + NAMES + last.map_or(0, |v| v as i32 + 1) * CELL.0 - 1;
            area.draw(&bar(x, y))?;
        }
    }
    let bottom = top + ARITHMETICS.len() as i32 * CELL.1 + 3;
    // A value needs the width of two or three cells.
    let mut free = i32::MIN;
    for (v, value) in about.values.iter().enumerate() {
        let middle = left + NAMES + v as i32 * CELL.0 + CELL.0 / 2;
        let text = number(*value);
        let half = 4 * text.chars().count() as i32;
        let round = is_round(*value) || about.values.len() < 12;
        if round && middle - half > free {
            write(area, &text, (middle, bottom), 12, HPos::Center)?;
            free = middle + half;
        }
    }
    Ok(())
}

/// A power of ten, or nothing.
fn is_round(x: f64) -> bool {
    x == 0.0 || format!("{x:e}").starts_with("1e")
}

fn paint_cell<B: DrawingBackend>(area: &Area<'_, B>, cell: &Cell, (x, y): (i32, i32)) -> Drawn<B> {
    let (fill, ink) = colours(cell);
    let frame = [(x, y), (x + CELL.0 - 1, y + CELL.1 - 1)];
    area.draw(&Rectangle::new(frame, fill.filled()))?;
    let middle = (x + CELL.0 / 2, y + CELL.1 / 2);
    let ink = ink.filled();
    let near = |dx: i32, dy: i32| (middle.0 + dx, middle.1 + dy);
    match cell.cause {
        Cause::None => area.draw(&Circle::new(middle, 1, ink)),
        Cause::FalseHits => area.draw(&Polygon::new([near(-5, 4), near(5, 4), near(0, -5)], ink)),
        Cause::FalseMisses => {
            area.draw(&Polygon::new([near(-5, -4), near(5, -4), near(0, 5)], ink))
        }
        Cause::Side => area.draw(&Circle::new(middle, 5, ink)),
        Cause::Refused => area.draw(&PathElement::new(
            [near(-5, 0), near(5, 0)],
            ink.stroke_width(2),
        )),
        Cause::Error => {
            area.draw(&PathElement::new(
                [near(-5, -5), near(5, 5)],
                ink.stroke_width(2),
            ))?;
            area.draw(&PathElement::new(
                [near(-5, 5), near(5, -5)],
                ink.stroke_width(2),
            ))
        }
        Cause::Angle => {
            let angle = [near(5, -4), near(-5, 4), near(6, 4)];
            area.draw(&PathElement::new(angle, ink.stroke_width(2)))
        }
        Cause::Saturations => {
            area.draw(&PathElement::new(
                [near(-5, -5), near(5, -5)],
                ink.stroke_width(2),
            ))?;
            area.draw(&PathElement::new(
                [near(0, -5), near(0, 5)],
                ink.stroke_width(2),
            ))
        }
    }
}

/// Fill and ink: the state is in the lightness, the cause in the hue. Orange is for what is found
/// where nothing is, blue for what is lost.
fn colours(cell: &Cell) -> (RGBColor, RGBColor) {
    let dark = cell.state == State::Breaks;
    let pick = |pale: (u8, u8, u8), deep: (u8, u8, u8)| {
        let (r, g, b) = if dark { deep } else { pale };
        RGBColor(r, g, b)
    };
    let fill = match cell.cause {
        Cause::None => return (RGBColor(244, 246, 243), RGBColor(120, 120, 120)),
        Cause::FalseHits => pick((253, 205, 150), (166, 54, 3)),
        Cause::FalseMisses => pick((180, 210, 240), (8, 69, 148)),
        _ => pick((206, 206, 206), (70, 70, 70)),
    };
    (fill, if dark { WHITE } else { BLACK })
}

/// Ends what is admitted of an arithmetic.
fn bar(x: i32, y: i32) -> Rectangle<(i32, i32)> {
    Rectangle::new([(x - 1, y - 1), (x + 1, y + CELL.1)], BLACK.filled())
}

fn paint_legend<B: DrawingBackend>(area: &Area<'_, B>, (left, y): (i32, i32)) -> Drawn<B> {
    let mut x = left;
    let sample = |state, cause| Cell {
        errors: Default::default(),
        state,
        cause,
        admitted: false,
    };
    let entries = [
        (sample(State::Holds, Cause::None), "holds"),
        (sample(State::Degrades, Cause::Error), "degrades"),
        (sample(State::Breaks, Cause::Error), "breaks: error"),
        (sample(State::Breaks, Cause::Angle), "angle"),
        (sample(State::Breaks, Cause::FalseHits), "false hits"),
        (sample(State::Breaks, Cause::FalseMisses), "false misses"),
        (sample(State::Breaks, Cause::Side), "wrong side"),
        (sample(State::Degrades, Cause::Saturations), "saturations"),
    ];
    for (cell, text) in entries {
        paint_cell(area, &cell, (x, y))?;
        write(area, text, (x + CELL.0 + 4, y + 3), 13, HPos::Left)?;
        x += CELL.0 + 16 + 6 * text.len() as i32;
    }
    area.draw(&bar(x, y))?;
    write(area, "admitted to here", (x + 6, y + 3), 13, HPos::Left)
}
