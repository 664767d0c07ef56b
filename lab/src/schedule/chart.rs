//! A sweep as a chart: for each policy a heat map of efficiency over tiles and processors, the best tile for
//! each number of processors framed; below them, for each policy, the efficiency with that tile.

use super::Run;
use crate::canvas::{Area, Drawn, Figure, write};
use octray_render::scheduler::Policy;
use octray_render::tile::TileSize;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use std::num::NonZeroUsize;

/// Pixels: a cell, what is around a heat map, and the plot of the curves.
const CELL: (i32, i32) = (40, 16);
const LEFT: i32 = 120;
const MARGIN: i32 = 16;
/// From the top of a cell to the top of its text, so that digits are in its middle.
const DROP: i32 = 4;
const HEAD: i32 = 56;
const TITLE: i32 = 26;
const FOOT: i32 = 42;
const CURVES: i32 = 260;

const BLACK_LINE: RGBColor = RGBColor(0, 0, 0);
const GREY: RGBColor = RGBColor(205, 205, 205);

/// What came of every combination.
#[derive(Debug)]
pub(super) struct Chart<'a> {
    title: String,
    runs: &'a [Run],
    policies: &'a [Policy],
    shapes: &'a [TileSize],
    processors: &'a [NonZeroUsize],
}

impl<'a> Chart<'a> {
    /// The chart of these runs, which hold every combination of the rest.
    pub(super) fn new(
        title: String,
        runs: &'a [Run],
        policies: &'a [Policy],
        shapes: &'a [TileSize],
        processors: &'a [NonZeroUsize],
    ) -> Self {
        Self {
            title,
            runs,
            policies,
            shapes,
            processors,
        }
    }

    fn run(&self, policy: Policy, shape: TileSize, processors: NonZeroUsize) -> Option<&'a Run> {
        let key = (policy, shape, processors);
        let mut runs = self.runs.iter();
        runs.find(|run| (run.policy, run.tile, run.processors) == key)
    }

    fn best(&self, policy: Policy, processors: NonZeroUsize) -> Option<&'a Run> {
        super::best(self.runs, |run| {
            (run.policy, run.processors) == (policy, processors)
        })
    }

    /// The width and height of a heat map with what is around it.
    fn panel(&self) -> (i32, i32) {
        let (width, height) = CELL;
        (
            LEFT + self.processors.len() as i32 * width + MARGIN,
            TITLE + self.shapes.len() as i32 * height + FOOT,
        )
    }

    /// Heat maps beside each other, and above each other.
    fn grid(&self) -> (i32, i32) {
        let across = (self.policies.len() as i32).clamp(1, 3);
        (across, (self.policies.len() as i32 + across - 1) / across)
    }
}

impl Figure for Chart<'_> {
    fn size(&self) -> (u32, u32) {
        let ((width, height), (across, down)) = (self.panel(), self.grid());
        let width = (across * width).max(LEFT + 560);
        (
            width as u32,
            (HEAD + down * height + TITLE + CURVES + FOOT) as u32,
        )
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        write(area, &self.title, (MARGIN, MARGIN), 18, HPos::Left)?;
        let note = "Efficiency in percent: speed-up by processors. Framed: the best tile for each number of processors.";
        write(area, note, (MARGIN, MARGIN + 21), 14, HPos::Left)?;
        let ((width, height), (across, down)) = (self.panel(), self.grid());
        for (i, policy) in (0..).zip(self.policies) {
            let corner = (i % across * width, HEAD + i / across * height);
            self.heat(area, *policy, corner)?;
        }
        self.curves(area, HEAD + down * height)
    }
}

impl Chart<'_> {
    fn heat<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        policy: Policy,
        (left, top): (i32, i32),
    ) -> Drawn<B> {
        let (left, top) = (left + LEFT, top + TITLE);
        write(area, policy.name(), (left, top - 20), 15, HPos::Left)?;
        for (row, shape) in (0..).zip(self.shapes) {
            let y = top + row * CELL.1;
            write(
                area,
                &shape.to_string(),
                (left - 6, y + DROP),
                13,
                HPos::Right,
            )?;
        }
        let floor = top + self.shapes.len() as i32 * CELL.1;
        for (column, processors) in (0..).zip(self.processors) {
            let x = left + column * CELL.0;
            let middle = x + CELL.0 / 2;
            let label = processors.to_string();
            write(area, &label, (middle, floor + 3), 13, HPos::Center)?;
            let best = self.best(policy, *processors);
            for (row, shape) in (0..).zip(self.shapes) {
                let Some(run) = self.run(policy, *shape, *processors) else {
                    continue;
                };
                let y = top + row * CELL.1;
                let corners = [(x, y), (x + CELL.0, y + CELL.1)];
                let share = run.outcome.efficiency.clamp(0.0, 1.0);
                let shade = colorous::VIRIDIS.eval_continuous(share);
                let fill = RGBColor(shade.r, shade.g, shade.b);
                area.draw(&Rectangle::new(corners, fill.filled()))?;
                let text = format!("{:.0}", 100.0 * share);
                // Viridis is light in its upper half.
                let ink = if share > 0.55 { BLACK_LINE } else { WHITE };
                number(area, &text, (middle, y + DROP), ink)?;
                if best.is_some_and(|best| best.tile == *shape) {
                    let inner = [(x + 1, y + 1), (x + CELL.0 - 2, y + CELL.1 - 2)];
                    area.draw(&Rectangle::new(corners, BLACK_LINE))?;
                    area.draw(&Rectangle::new(inner, RED.stroke_width(2)))?;
                }
            }
        }
        let middle = left + self.processors.len() as i32 * CELL.0 / 2;
        write(area, "processors", (middle, floor + 18), 13, HPos::Center)
    }

    fn curves<B: DrawingBackend>(&self, area: &Area<'_, B>, top: i32) -> Drawn<B> {
        let (left, top) = (LEFT, top + TITLE);
        write(
            area,
            "Efficiency with the best tile",
            (left, top - 20),
            15,
            HPos::Left,
        )?;
        let (steps, floor) = (self.processors.len().max(2) as i32 - 1, top + CURVES);
        let step = 400 / steps;
        let (right, x) = (left + step * steps, |column: i32| left + column * step);
        for percent in [0, 25, 50, 75, 100] {
            let y = floor - CURVES * percent / 100;
            area.draw(&PathElement::new([(left, y), (right, y)], GREY))?;
            let label = format!("{percent} %");
            write(area, &label, (left - 6, y - 7), 13, HPos::Right)?;
        }
        for (column, processors) in (0..).zip(self.processors) {
            let label = processors.to_string();
            write(area, &label, (x(column), floor + 5), 13, HPos::Center)?;
        }
        let middle = (left + right) / 2;
        write(area, "processors", (middle, floor + 20), 13, HPos::Center)?;
        for (i, policy) in (0..).zip(self.policies) {
            let shade = colorous::TABLEAU10[i as usize % 10];
            let ink = RGBColor(shade.r, shade.g, shade.b);
            let points: Vec<_> = (0..)
                .zip(self.processors)
                .filter_map(|(column, processors)| {
                    let best = self.best(*policy, *processors)?;
                    let share = best.outcome.efficiency.clamp(0.0, 1.0);
                    let y = floor - (f64::from(CURVES) * share).round() as i32;
                    Some((x(column), y))
                })
                .collect();
            area.draw(&PathElement::new(points.clone(), ink.stroke_width(2)))?;
            for point in points {
                area.draw(&Circle::new(point, 3, ink.filled()))?;
            }
            let y = top + 18 * i;
            let key = [(right + 20, y + 7), (right + 44, y + 7)];
            area.draw(&PathElement::new(key, ink.stroke_width(2)))?;
            write(area, policy.name(), (right + 50, y), 14, HPos::Left)?;
        }
        Ok(())
    }
}

/// A number in a cell.
fn number<B: DrawingBackend>(
    area: &Area<'_, B>,
    text: &str,
    place: (i32, i32),
    ink: RGBColor,
) -> Drawn<B> {
    use plotters::style::text_anchor::{Pos, VPos};
    let style = ("sans-serif", 13).into_text_style(area).color(&ink);
    let style = style.pos(Pos::new(HPos::Center, VPos::Top));
    area.draw(&Text::new(text.to_owned(), place, style))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas;
    use crate::simulate::Outcome;
    use std::num::NonZeroU32;

    #[test]
    fn the_chart_tells_every_efficiency_and_names_every_axis() {
        let shapes = [3, 5].map(|rows| TileSize::strip(NonZeroU32::new(rows).unwrap()));
        let processors = [2, 64].map(|count| NonZeroUsize::new(count).unwrap());
        let policies = [Policy::Dynamic, Policy::Static];
        let mut runs = Vec::new();
        for policy in policies {
            for tile in shapes {
                for processors in processors {
                    let efficiency = 0.11 + 0.1 * runs.len() as f64;
                    runs.push(Run {
                        policy,
                        tile,
                        tiles: 1,
                        processors,
                        outcome: Outcome {
                            time: 1.0,
                            speed_up: efficiency * processors.get() as f64,
                            efficiency,
                        },
                    });
                }
            }
        }
        let chart = Chart::new("A title".into(), &runs, &policies, &shapes, &processors);
        let svg = canvas::svg(&chart).unwrap();
        for text in [
            "A title", "3 rows", "5 rows", "dynamic", "static", "64", "11", "81",
        ] {
            assert!(svg.contains(&format!("\n{text}\n")), "{text}");
        }
        assert_eq!(svg, canvas::svg(&chart).unwrap());
        let best = chart.best(Policy::Static, processors[0]).unwrap();
        assert_eq!(best.tile, shapes[1]);
    }
}
