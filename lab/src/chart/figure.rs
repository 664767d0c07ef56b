//! Points as a chart: accuracy upwards, cheapness to the right, the frontier drawn, every point named.

use super::accuracy::decibels;
use super::axis::{Axis, amount, log_ticks};
use super::label::{self, Label, MARKER, Rect};
use super::point::{Against, Panel, Point};
use crate::canvas::{Area, Drawn, Figure, write, write_in};
use octray_prepare::Arith;
use octray_prepare::format::Family;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Pixels: the plot, and what is around it.
const WIDTH: i32 = 800;
const HEIGHT: i32 = 460;
const LEFT: i32 = 64;
const RIGHT: i32 = 56;
const ABOVE: i32 = 64;
const BELOW: i32 = 58;
const LEGEND: i32 = 34;
/// Height for each point beyond those that the least height has room for.
const CROWDED: i32 = 14;

const GRID: RGBColor = RGBColor(225, 225, 225);
const FAINT: RGBColor = RGBColor(105, 105, 105);
const WISH: RGBColor = RGBColor(150, 150, 150);
const FRONTIER: RGBColor = RGBColor(30, 90, 170);

/// Label of the line of pictures that equal the reference.
const EQUAL: &str = "equal pictures";

/// The chart of some panels, one below the other.
#[derive(Debug)]
pub struct Chart<'a> {
    panels: Vec<&'a Panel>,
}

impl<'a> Chart<'a> {
    /// The chart of all panels that have points.
    pub fn of(panels: &'a [Panel]) -> Self {
        let panels = panels.iter().filter(|panel| !panel.points.is_empty());
        Self {
            panels: panels.collect(),
        }
    }
}

impl Figure for Chart<'_> {
    fn size(&self) -> (u32, u32) {
        let height: i32 = self.panels.iter().map(|panel| tall(panel)).sum();
        ((LEFT + WIDTH + RIGHT) as u32, (height + LEGEND) as u32)
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let mut top = 0;
        for panel in &self.panels {
            Plot::new(panel, top).paint(area)?;
            top += tall(panel);
        }
        legend(area, top)
    }
}

/// The height of a panel, with what is above and below its plot.
fn tall(panel: &Panel) -> i32 {
    let beyond = (panel.points.len() as i32 - 24).max(0);
    ABOVE + HEIGHT + CROWDED * beyond + BELOW
}

/// A panel on its place.
struct Plot<'a> {
    panel: &'a Panel,
    frame: Rect,
    cost: Axis,
    accuracy: Axis,
}

impl<'a> Plot<'a> {
    fn new(panel: &'a Panel, top: i32) -> Self {
        let frame = Rect {
            left: LEFT,
            top: top + ABOVE,
            right: LEFT + WIDTH,
            bottom: top + tall(panel) - BELOW,
        };
        let costs = panel.points.iter().map(|point| point.cost.log10());
        let decibels = panel
            .points
            .iter()
            .map(|point| decibels(panel.difference(point)));
        Self {
            panel,
            frame,
            // Less is to the right.
            cost: Axis::over(costs, 0.5, (frame.right, frame.left)),
            accuracy: Axis::over(decibels, 10.0, (frame.bottom, frame.top)),
        }
    }

    fn spot(&self, point: &Point) -> (i32, i32) {
        (
            self.cost.pixel(point.cost.log10()),
            self.accuracy.pixel(decibels(self.panel.difference(point))),
        )
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        self.heading(area)?;
        self.axes(area)?;
        self.wishes(area)?;
        let steps = self.frontier();
        for pair in steps.windows(2) {
            area.draw(&PathElement::new(pair.to_vec(), FRONTIER.stroke_width(2)))?;
        }
        // Who comes first gets the best place, and is drawn last.
        let mut points: Vec<&Point> = self.panel.points.iter().collect();
        points.sort_by_key(|point| !point.on_frontier);
        let labels = self.labels(area, &points, &steps)?;
        for (point, label) in points.iter().zip(&labels).rev() {
            self.point(area, point, label)?;
        }
        Ok(())
    }

    fn heading<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let panel = self.panel;
        let top = self.frame.top - ABOVE;
        let title = format!("{}: accuracy against {}", panel.scene, panel.kind.words());
        write(area, &title, (LEFT, top + 8), 18, HPos::Left)?;
        let against = match panel.wishes.against {
            Against::Same => "PSNR in dB, from f64 of the same settings",
            Against::Converged => "PSNR in dB, from the converged picture",
        };
        write(area, against, (LEFT - 50, top + 44), 13, HPos::Left)?;
        let right = (LEFT + WIDTH + RIGHT - 6, top + 44);
        write(area, "RMSE in levels", right, 13, HPos::Right)?;
        write(area, &panel.common(), (LEFT, top + 29), 13, HPos::Left)
    }

    fn axes<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let Rect {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        for value in log_ticks(&self.cost) {
            let x = self.cost.pixel(value.log10());
            area.draw(&PathElement::new([(x, top), (x, bottom)], GRID))?;
            write(
                area,
                &amount(value, self.panel.kind.unit()),
                (x, bottom + 6),
                13,
                HPos::Center,
            )?;
        }
        for value in self.accuracy.ticks() {
            let y = self.accuracy.pixel(value);
            area.draw(&PathElement::new([(left, y), (right, y)], GRID))?;
            write(
                area,
                &format!("{value}"),
                (left - 6, y - 7),
                13,
                HPos::Right,
            )?;
        }
        // The same scale in levels.
        let (low, high) = self.accuracy.range();
        for decade in -4..3 {
            for digit in [1.0, 2.0, 5.0] {
                let rmse = digit * 10f64.powi(decade);
                let value = 20.0 * (255.0 / rmse).log10();
                if (low..high).contains(&value) && (digit == 1.0 || high - low < 60.0) {
                    let y = self.accuracy.pixel(value);
                    area.draw(&PathElement::new([(right - 4, y), (right, y)], BLACK))?;
                    write(area, &format!("{rmse}"), (right + 6, y - 7), 13, HPos::Left)?;
                }
            }
        }
        area.draw(&Rectangle::new([(left, top), (right, bottom)], BLACK))?;
        let caption = format!("{}: fewer to the right", self.panel.kind.words());
        let caption = match self.panel.kind.unit() {
            "seconds" => caption.replace("fewer", "less"),
            _ => caption,
        };
        write(
            area,
            &caption,
            ((left + right) / 2, bottom + 26),
            14,
            HPos::Center,
        )
    }

    /// The bounds that were chosen by, where they lie in the plot; and the line of pictures that are equal.
    fn wishes<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let Rect {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let wishes = &self.panel.wishes;
        if self.accuracy.contains(wishes.min_psnr) {
            let y = self.accuracy.pixel(wishes.min_psnr);
            dashes(area, (left, y), (right, y), WISH)?;
        }
        if let Some(budget) = wishes.budget.map(f64::log10)
            && self.cost.contains(budget)
        {
            let x = self.cost.pixel(budget);
            dashes(area, (x, top), (x, bottom), WISH)?;
        }
        if let Some(y) = self.equal() {
            dashes(area, (left, y), (right, y), GRID)?;
            let place = (left + 6, y - 15);
            write_in(area, EQUAL, place, 12, HPos::Left, FAINT)?;
        }
        Ok(())
    }

    /// Where pictures are equal, if one is.
    fn equal(&self) -> Option<i32> {
        let mut points = self.panel.points.iter();
        let equal = points.find(|point| self.panel.difference(point).is_zero())?;
        Some(self.spot(equal).1)
    }

    /// The border of what some point dominates, as steps from the dearest point to the cheapest.
    fn frontier(&self) -> Vec<(i32, i32)> {
        let mut spots: Vec<_> = (self.panel.points.iter())
            .filter(|point| point.on_frontier)
            .map(|point| self.spot(point))
            .collect();
        spots.sort_unstable();
        let mut steps = Vec::new();
        let mut here = (self.frame.left, spots.first().map_or(0, |spot| spot.1));
        for spot in spots {
            steps.extend([here, (here.0, spot.1), spot]);
            here = spot;
        }
        steps.extend([here, (here.0, self.frame.bottom)]);
        steps.dedup();
        steps
    }

    fn labels<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        points: &[&Point],
        steps: &[(i32, i32)],
    ) -> Result<Vec<Label>, DrawingAreaErrorKind<B::ErrorType>> {
        let spots: Vec<_> = points.iter().map(|point| self.spot(point)).collect();
        let mut sizes = Vec::new();
        for point in points {
            let style = ("sans-serif", text_height(point)).into_text_style(area);
            let (width, height) = area.estimate_text_size(&name(point), &style)?;
            sizes.push((width as i32 + 4, height as i32 + 4));
        }
        let lines = steps.windows(2).map(|pair| Rect {
            left: pair[0].0.min(pair[1].0),
            top: pair[0].1.min(pair[1].1),
            right: pair[0].0.max(pair[1].0) + 1,
            bottom: pair[0].1.max(pair[1].1) + 1,
        });
        let mut avoid: Vec<_> = lines.collect();
        if let Some(y) = self.equal() {
            let (left, style) = (self.frame.left, ("sans-serif", 12).into_text_style(area));
            let (width, _) = area.estimate_text_size(EQUAL, &style)?;
            avoid.push(Rect {
                left,
                top: y - 17,
                right: left + 8 + width as i32,
                bottom: y,
            });
        }
        Ok(label::place(&spots, &sizes, self.frame, &avoid))
    }

    fn point<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        point: &Point,
        label: &Label,
    ) -> Drawn<B> {
        let spot = self.spot(point);
        let ink = if point.on_frontier { BLACK } else { FAINT };
        if let Some(end) = label.leader {
            area.draw(&PathElement::new([spot, end], FAINT))?;
        }
        marker(area, spot, point.setting.arith, point.on_frontier)?;
        let place = (label.place.left + 2, label.place.top + 2);
        let height = text_height(point);
        write_in(area, &name(point), place, height, HPos::Left, ink)
    }
}

/// A point's label, and what it is chosen as.
fn name(point: &Point) -> String {
    match &*point.chosen_as {
        [] => point.label.clone(),
        chosen => format!("{} ({})", point.label, chosen.join(", ")),
    }
}

fn text_height(point: &Point) -> i32 {
    if point.on_frontier { 14 } else { 12 }
}

/// A dashed line.
fn dashes<B: DrawingBackend>(
    area: &Area<'_, B>,
    from: (i32, i32),
    to: (i32, i32),
    ink: RGBColor,
) -> Drawn<B> {
    area.draw(&DashedPathElement::new([from, to], 4, 4, ink))
}

/// The family of an arithmetic, by which the shape of its markers goes.
fn family(arith: Arith) -> Family {
    match arith {
        Arith::In(format) => format.family(),
        Arith::Auto => Family::Fixed,
    }
}

/// A marker: full on the frontier, hollow elsewhere.
fn marker<B: DrawingBackend>(
    area: &Area<'_, B>,
    (x, y): (i32, i32),
    arith: Arith,
    full: bool,
) -> Drawn<B> {
    let ink = if full { FRONTIER } else { FAINT };
    let fill = if full { FRONTIER } else { WHITE };
    let near = |dx: i32, dy: i32| (x + dx, y + dy);
    let r = MARKER - 3;
    let corners = match family(arith) {
        Family::Float => {
            area.draw(&Circle::new((x, y), r, fill.filled()))?;
            return area.draw(&Circle::new((x, y), r, ink.stroke_width(1)));
        }
        Family::Approximate => vec![near(0, -r - 1), near(r + 1, r - 1), near(-r - 1, r - 1)],
        Family::Fixed => vec![near(-r, -r), near(r, -r), near(r, r), near(-r, r)],
        Family::Fixed64 => vec![
            near(0, -r - 2),
            near(r + 2, 0),
            near(0, r + 2),
            near(-r - 2, 0),
        ],
    };
    area.draw(&Polygon::new(corners.clone(), fill.filled()))?;
    let closed: Vec<_> = corners.iter().chain(&corners[..1]).copied().collect();
    area.draw(&PathElement::new(closed, ink.stroke_width(1)))
}

/// What markers mean.
fn legend<B: DrawingBackend>(area: &Area<'_, B>, top: i32) -> Drawn<B> {
    let mut x = LEFT;
    let y = top + 12;
    for (arith, full, meaning) in [
        (Arith::F32, true, "floats"),
        (Arith::APPROX1, true, "approximate floats"),
        (Arith::I16F16, true, "32-bit fixed point"),
        (Arith::I32F32, true, "64-bit fixed point"),
        (
            Arith::F32,
            false,
            "hollow: another is more accurate and costs no more",
        ),
    ] {
        marker(area, (x, y), arith, full)?;
        write(area, meaning, (x + 12, y - 7), 13, HPos::Left)?;
        x += 40 + 6 * meaning.len() as i32;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::point::tests::made_up;
    use super::*;
    use crate::canvas;

    #[test]
    fn every_point_is_named_and_the_chart_is_the_same_every_time() {
        let panels = [made_up(), made_up()];
        let chart = Chart::of(&panels);
        let svg = canvas::svg(&chart).unwrap();
        for text in [
            "approx0",
            "approx1 (fastest ≥ 40 dB, knee)",
            "f32 (best within 5,000,000 instructions)",
            "i16f16",
            "equal pictures",
            "16 x 16 pixels, bvh8 tree, 8 bounces, cut-off 1/512, 1 ray per pixel",
        ] {
            assert_eq!(svg.matches(text).count(), 2, "{text}");
        }
        assert_eq!(svg, canvas::svg(&chart).unwrap());
        let (width, height) = chart.size();
        assert_eq!(canvas::picture(&chart).unwrap().size(), (width, height));
    }

    #[test]
    fn dearer_is_to_the_left_and_more_accurate_above() {
        let panel = made_up();
        let plot = Plot::new(&panel, 0);
        let spots: Vec<_> = panel.points.iter().map(|point| plot.spot(point)).collect();
        for pair in [(0, 1), (1, 2), (2, 4)] {
            assert!(spots[pair.0].0 > spots[pair.1].0 && spots[pair.0].1 > spots[pair.1].1);
        }
        // No point is above or to the right of the steps' corners that lie on the same height.
        let steps = plot.frontier();
        assert_eq!(steps.first().unwrap().0, plot.frame.left);
        assert_eq!(steps.last().unwrap().1, plot.frame.bottom);
        for pair in steps.windows(2) {
            assert!(pair[0].0 <= pair[1].0 && pair[0].1 <= pair[1].1);
        }
    }
}
