//! The thesis's figures 24 and 25 as charts, a panel for each scene: time against the rows of a tile, and
//! speed-up against processors, static and dynamic. Readable without colour.

use super::shared::{Outcomes, POLICIES, Simulation};
use crate::canvas::{Area, Drawn, Figure, write};
use crate::simulate::Outcome;
use octray_render::counts::thousands;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Pixels: a panel's plot, what is around it, and the heading.
const WIDTH: i32 = 260;
const HEIGHT: i32 = 190;
const LEFT: i32 = 64;
const RIGHT: i32 = 20;
const ABOVE: i32 = 30;
const BELOW: i32 = 56;
const HEAD: i32 = 44;
const PANEL: (i32, i32) = (LEFT + WIDTH + RIGHT, ABOVE + HEIGHT + BELOW);

/// Panels to a row.
const COLUMNS: i32 = 3;

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
    /// Whether it is a speed-up: then as much as there are processors is drawn, and the peak is marked.
    pub speed_up: bool,
    /// What came out.
    pub outcomes: &'a Outcomes,
}

impl Figure for Chart<'_> {
    fn size(&self) -> (u32, u32) {
        // The legend takes the place of one more panel.
        let panels = self.outcomes.figures.len() as i32 + 1;
        let rows = panels.unsigned_abs().div_ceil(COLUMNS.unsigned_abs());
        let width = COLUMNS * PANEL.0;
        (
            width.unsigned_abs(),
            HEAD.unsigned_abs() + rows * PANEL.1.unsigned_abs(),
        )
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        write(area, &self.title, (14, 12), 19, HPos::Left)?;
        let places = (0..).map(|i| (i % COLUMNS * PANEL.0, HEAD + i / COLUMNS * PANEL.1));
        let mut places = places.map(|(x, y)| (x + LEFT, y + ABOVE));
        for ((name, both), place) in self.outcomes.figures.iter().zip(&mut places) {
            self.panel(area, name, both, place)?;
        }
        match places.next() {
            Some(place) => self.legend(area, place),
            None => Ok(()),
        }
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
            speed_up: false,
            outcomes,
        }
    }

    /// Figure 25.
    pub fn of_processors(outcomes: &'a Outcomes, simulation: &Simulation) -> Self {
        let rows = simulation.rows;
        Self {
            title: format!(
                "Figure 25: speed-up rises, peaks and falls; tiles of H = {rows} rows, coherence {}",
                simulation.machine.coherence
            ),
            across: "processors",
            upwards: "speed-up",
            value: |outcome| outcome.speed_up,
            speed_up: true,
            outcomes,
        }
    }
}

impl Chart<'_> {
    /// A scene's panel; the place is the upper left corner of its plot.
    fn panel<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        name: &str,
        both: &[[Outcome; 2]],
        (left, top): (i32, i32),
    ) -> Drawn<B> {
        let across = &self.outcomes.across;
        let values = |policy: usize| both.iter().map(move |both| (self.value)(&both[policy]));
        let most = values(0).chain(values(1)).fold(0.0, f64::max);
        let (step, steps) = scale(most);
        let floor = top + HEIGHT;
        let height = |value: f64| {
            let share = value / (step * f64::from(steps));
            floor - (share * f64::from(HEIGHT)).round() as i32
        };
        let last = across.len().max(2) as f64 - 1.0;
        // Speed-ups stand where their number of processors is, the others one beside the other.
        let place = |i: usize| left + 12 + (i as f64 / last * f64::from(WIDTH - 24)).round() as i32;
        write(area, name, (left, top - 22), 16, HPos::Left)?;
        for i in 0..=steps {
            let value = f64::from(i) * step;
            let y = height(value);
            area.draw(&PathElement::new([(left, y), (left + WIDTH, y)], GRID))?;
            write(area, &label(value), (left - 6, y - 7), 13, HPos::Right)?;
        }
        let labelled = |i: usize| !self.speed_up || across[i] == 1 || across[i].is_multiple_of(16);
        for (i, across) in across.iter().enumerate().filter(|(i, _)| labelled(*i)) {
            let x = place(i);
            area.draw(&PathElement::new([(x, floor), (x, floor + 4)], BLACK))?;
            write(area, &across.to_string(), (x, floor + 6), 13, HPos::Center)?;
        }
        area.draw(&PathElement::new(
            [(left, floor), (left + WIDTH, floor)],
            BLACK,
        ))?;
        let middle = left + WIDTH / 2;
        write(area, self.across, (middle, floor + 24), 14, HPos::Center)?;
        let line = |values: &mut dyn Iterator<Item = f64>| -> Vec<(i32, i32)> {
            values
                .enumerate()
                .map(|(i, value)| (place(i), height(value)))
                .collect()
        };
        if self.speed_up {
            let shown = across.iter().map(|n| f64::from(*n));
            let shown = shown.take_while(|n| *n <= step * f64::from(steps));
            area.draw(&PathElement::new(line(&mut shown.into_iter()), PALE))?;
        }
        for policy in 0..POLICIES.len() {
            curve(area, policy, line(&mut values(policy)), !self.speed_up)?;
        }
        if self.speed_up
            && let Some((best, value)) = Outcomes::best(both, across, 1)
            && let Some(i) = across.iter().position(|n| *n == best)
        {
            let (x, y) = (place(i), height(value));
            area.draw(&PathElement::new([(x, y), (x, floor)], PALE))?;
            area.draw(&Circle::new((x, y), 5, BLACK.filled()))?;
            let text = format!("{value:.1} with {best}");
            write(area, &text, (x, y - 22), 14, HPos::Center)?;
        }
        Ok(())
    }

    fn legend<B: DrawingBackend>(&self, area: &Area<'_, B>, (left, top): (i32, i32)) -> Drawn<B> {
        write(area, self.upwards, (left, top - 22), 16, HPos::Left)?;
        for (policy, y) in (0..POLICIES.len()).zip((top + 16..).step_by(28)) {
            let points = [0, 30, 60].map(|x| (left + x, y)).to_vec();
            curve(area, policy, points, !self.speed_up)?;
            write(
                area,
                POLICIES[policy].name(),
                (left + 74, y - 8),
                15,
                HPos::Left,
            )?;
        }
        if self.speed_up {
            let y = top + 16 + 28 * POLICIES.len() as i32;
            area.draw(&PathElement::new([(left, y), (left + 60, y)], PALE))?;
            write(
                area,
                "as many as there are processors",
                (left + 74, y - 8),
                15,
                HPos::Left,
            )?;
        }
        Ok(())
    }
}

/// Static dealing is dashed with hollow circles, dynamic dealing has full squares; without `marks` only the lines.
fn curve<B: DrawingBackend>(
    area: &Area<'_, B>,
    policy: usize,
    points: Vec<(i32, i32)>,
    marks: bool,
) -> Drawn<B> {
    let marked = || points.iter().copied().filter(|_| marks);
    if policy == 0 {
        area.draw(&DashedPathElement::new(points.clone(), 6, 4, BLACK))?;
        for point in marked() {
            area.draw(&Circle::new(point, 5, WHITE.filled()))?;
            area.draw(&Circle::new(point, 5, BLACK))?;
        }
        return Ok(());
    }
    area.draw(&PathElement::new(points.clone(), BLACK.stroke_width(2)))?;
    for (x, y) in marked() {
        area.draw(&Rectangle::new(
            [(x - 3, y - 3), (x + 3, y + 3)],
            BLACK.filled(),
        ))?;
    }
    Ok(())
}

/// A round step (1, 2 or 5 times a power of ten), and how many of them hold a value: 4 to 10.
fn scale(most: f64) -> (f64, u32) {
    if most <= 0.0 {
        return (1.0, 1);
    }
    let decade = 10f64.powf((most / 4.0).log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|digit| digit * decade);
    let fits = |step: &f64| most / step >= 4.0 - 1e-9;
    let step = steps.into_iter().find(fits).unwrap_or(decade);
    (step, (most / step - 1e-9).ceil() as u32)
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
    fn steps_are_round_and_enough() {
        assert_eq!(scale(8.0), (2.0, 4));
        assert_eq!(scale(7.0), (1.0, 7));
        assert_eq!(scale(123.0), (20.0, 7));
        assert_eq!(scale(0.0), (1.0, 1));
        for i in 1..2000 {
            let most = f64::from(i) * 0.37;
            let (step, steps) = scale(most);
            assert!((4..=10).contains(&steps), "{most}: {steps} of {step}");
            assert!(step * f64::from(steps) >= most * (1.0 - 1e-9), "{most}");
        }
    }

    #[test]
    fn a_chart_names_its_scenes_and_policies() {
        let outcome = |time| Outcome {
            time,
            speed_up: 1.0,
            efficiency: 1.0,
        };
        let outcomes = Outcomes {
            across: vec![2, 4],
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
