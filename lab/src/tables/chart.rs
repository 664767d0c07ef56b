//! The thesis's figures 24 and 25 as charts, a panel for each scene: time against the rows of a tile, and
//! speed-up against processors, static and dynamic. Readable without colour.

use super::shared::{Outcomes, POLICIES, Simulation};
use crate::canvas::{Area, Drawn, Figure, write};
use crate::simulate::Outcome;
use octray_render::counts::thousands;
use plotters::coord::ranged1d::SegmentValue;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Pixels: the heading, a panel, and what is around its plot.
const HEAD: u32 = 44;
const PANEL: (u32, u32) = (344, 276);
const LEFT: i32 = 64;
const RIGHT: i32 = 20;
const ABOVE: i32 = 30;
const BELOW: i32 = 48;

/// Panels to a row.
const COLUMNS: u32 = 3;

/// What the ideal is drawn in, and lines across.
const PALE: RGBColor = RGBColor(110, 110, 110);
const GRID: RGBColor = RGBColor(215, 215, 215);

/// Figure 24 or 25.
#[derive(Debug)]
pub struct Chart<'a> {
    /// What stands above it.
    pub title: String,
    /// What is from left to right.
    pub across: &'static str,
    /// What is upwards.
    pub upwards: &'static str,
    /// What is drawn of an outcome.
    pub value: fn(&Outcome) -> f64,
    /// Whether as much as there are processors is marked.
    pub ideal: bool,
    /// What came out.
    pub outcomes: &'a Outcomes,
}

impl Figure for Chart<'_> {
    fn size(&self) -> (u32, u32) {
        // The legend takes the place of one more panel.
        let panels = self.outcomes.figures.len() as u32 + 1;
        let rows = panels.div_ceil(COLUMNS);
        (COLUMNS * PANEL.0, HEAD + rows * PANEL.1)
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        write(area, &self.title, (14, 12), 19, HPos::Left)?;
        let mut panels = (0..).map(|i: u32| {
            let (x, y) = (i % COLUMNS * PANEL.0, HEAD + i / COLUMNS * PANEL.1);
            area.clone().shrink((x, y), PANEL)
        });
        for ((name, both), panel) in self.outcomes.figures.iter().zip(&mut panels) {
            self.panel(&panel, name, both)?;
        }
        panels.next().map_or(Ok(()), |panel| self.legend(&panel))
    }
}

impl<'a> Chart<'a> {
    /// Figure 24.
    pub fn of_rows(outcomes: &'a Outcomes, simulation: &Simulation) -> Self {
        let processors = simulation.processors;
        Self {
            title: format!(
                "Figure 24: time against H, the rows of a tile, on {processors} processors"
            ),
            across: "H",
            upwards: "time, M instructions",
            value: |outcome| outcome.time / 1e6,
            ideal: false,
            outcomes,
        }
    }

    /// Figure 25.
    pub fn of_processors(outcomes: &'a Outcomes, simulation: &Simulation) -> Self {
        let rows = simulation.rows;
        Self {
            title: format!("Figure 25: speed-up against processors, in tiles of H = {rows} rows"),
            across: "processors",
            upwards: "speed-up",
            value: |outcome| outcome.speed_up,
            ideal: true,
            outcomes,
        }
    }
}

impl Chart<'_> {
    /// A scene's panel.
    fn panel<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        name: &str,
        both: &[[Outcome; 2]],
    ) -> Drawn<B> {
        write(area, name, (LEFT, 8), 16, HPos::Left)?;
        let across = &self.outcomes.across;
        let line = |policy: usize| {
            let values = both.iter().map(move |both| (self.value)(&both[policy]));
            (0..).map(SegmentValue::CenterOf).zip(values)
        };
        let ideal = across.iter().map(|count| f64::from(*count));
        let ideal = (0..)
            .map(SegmentValue::CenterOf)
            .zip(ideal.filter(|_| self.ideal));
        let all = line(0).chain(line(1)).chain(ideal.clone());
        let most = all.map(|(_, value)| value).fold(f64::EPSILON, f64::max);
        let mut chart = ChartBuilder::on(area)
            .margin_top(ABOVE)
            .margin_right(RIGHT)
            .set_label_area_size(LabelAreaPosition::Left, LEFT)
            .set_label_area_size(LabelAreaPosition::Bottom, BELOW)
            .build_cartesian_2d((0..across.len() - 1).into_segmented(), 0.0..1.04 * most)?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .max_light_lines(0)
            .bold_line_style(GRID)
            .x_labels(across.len())
            .x_label_formatter(&|at| match at {
                SegmentValue::CenterOf(i) => across[*i].to_string(),
                _ => String::new(),
            })
            .x_desc(self.across)
            .y_labels(7)
            .y_label_formatter(&|value| label(*value))
            .label_style(("sans-serif", 13))
            .axis_desc_style(("sans-serif", 14))
            .draw()?;
        chart.draw_series(LineSeries::new(ideal, PALE))?;
        chart.draw_series(DashedLineSeries::new(line(0), 6, 4, BLACK.into()))?;
        chart.draw_series(line(0).map(|at| EmptyElement::at(at) + disc(0) + rim(0)))?;
        chart.draw_series(LineSeries::new(line(1), BLACK.stroke_width(2)))?;
        chart.draw_series(line(1).map(|at| EmptyElement::at(at) + square(0)))?;
        Ok(())
    }

    fn legend<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        write(area, self.upwards, (LEFT, 8), 16, HPos::Left)?;
        let area = area.clone().shrink((LEFT, ABOVE), PANEL);
        let mut chart = ChartBuilder::on(&area).build_cartesian_2d(0..1, 0..1)?;
        let nothing = || LineSeries::new(std::iter::empty(), BLACK);
        chart
            .draw_series(nothing())?
            .label(POLICIES[0].name())
            .legend(|at| {
                let line = DashedPathElement::new([(0, 0), (60, 0)], 6, 4, BLACK);
                EmptyElement::at(at) + line + disc(30) + rim(30)
            });
        chart
            .draw_series(nothing())?
            .label(POLICIES[1].name())
            .legend(|at| {
                let line = PathElement::new([(0, 0), (60, 0)], BLACK.stroke_width(2));
                EmptyElement::at(at) + line + square(30)
            });
        if self.ideal {
            chart
                .draw_series(nothing())?
                .label("as many as there are processors")
                .legend(|(x, y)| PathElement::new([(x, y), (x + 60, y)], PALE));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .legend_area_size(74)
            .label_font(("sans-serif", 15))
            .draw()
    }
}

/// What marks static dealing: a white disc with a rim.
fn disc(x: i32) -> Circle<(i32, i32), i32> {
    Circle::new((x, 0), 5, WHITE.filled())
}

/// The rim of the disc.
fn rim(x: i32) -> Circle<(i32, i32), i32> {
    Circle::new((x, 0), 5, BLACK)
}

/// What marks dynamic dealing.
fn square(x: i32) -> Rectangle<(i32, i32)> {
    Rectangle::new([(x - 3, -3), (x + 3, 3)], BLACK.filled())
}

/// A step's value.
fn label(value: f64) -> String {
    match value.fract() == 0.0 {
        true => thousands(value as u64),
        false => format!("{value:.1}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas;
    use crate::simulate::Machine;
    use std::num::NonZeroU32;

    #[test]
    fn a_chart_names_its_scenes_and_policies() {
        let outcome = |time| Outcome {
            time,
            speed_up: 1.0,
            efficiency: 1.0,
        };
        let outcomes = Outcomes {
            across: &[2, 4],
            figures: vec![("figure-19", vec![[outcome(30.0), outcome(20.0)]; 2])],
        };
        let simulation = Simulation {
            processors: NonZeroU32::MIN,
            rows: NonZeroU32::MIN,
            machine: Machine::default(),
        };
        let chart = Chart::of_rows(&outcomes, &simulation);
        let svg = canvas::svg(&chart).unwrap();
        for text in ["on 1 processors", "figure-19", "static", "dynamic", "H"] {
            assert!(svg.contains(text), "{text}");
        }
        assert_eq!(svg, canvas::svg(&chart).unwrap());
    }
}
