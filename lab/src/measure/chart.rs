//! Table III as a chart: for each core a panel, for each scene a group, for each arithmetic a bar
//! without and one with the floating-point unit, and over them their ratio.

use super::ratio::{CORES, Pair, THESIS, pairs, per_pixel};
use super::row::FrameRow;
use crate::canvas::{Area, Drawn, Figure, write};
use octray_prepare::Arith;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Pixels: a bar, the panel's plot, and what is around it.
const BAR: i32 = 15;
const HEIGHT: i32 = 240;
const LEFT: i32 = 70;
const MARGIN: i32 = 14;
const PANEL: i32 = HEIGHT + 90;
const HEAD: i32 = 52;

/// Costs without and with a floating-point unit.
#[derive(Debug)]
pub struct Chart<'a> {
    rows: &'a [FrameRow],
    ariths: Vec<Arith>,
    scenes: Vec<&'a str>,
}

impl<'a> Chart<'a> {
    /// The chart of these rows; `None` if no core is among them without and with its unit.
    pub fn of(rows: &'a [FrameRow]) -> Option<Self> {
        let all: Vec<_> = CORES
            .into_iter()
            .flat_map(|core| pairs(rows, core))
            .collect();
        let (mut ariths, mut scenes) = (Vec::new(), Vec::new());
        for Pair { without, .. } in &all {
            if !ariths.contains(&without.arith) {
                ariths.push(without.arith);
            }
            if !scenes.contains(&&*without.scene) {
                scenes.push(&*without.scene);
            }
        }
        (!all.is_empty()).then_some(Self {
            rows,
            ariths,
            scenes,
        })
    }

    fn panels(&self) -> Vec<((&'static str, &'static str), Vec<Pair<'a>>)> {
        (CORES.into_iter())
            .map(|core| (core, pairs(self.rows, core)))
            .filter(|(_, pairs)| !pairs.is_empty())
            .collect()
    }

    /// The width of a scene's group.
    fn group(&self) -> i32 {
        // Room for the scene's name.
        (self.ariths.len() as i32 * (2 * BAR + 12) + 16).max(80)
    }

    /// The decades that hold all values.
    fn decades(&self) -> (i32, i32) {
        let values = || {
            (self.panels().into_iter())
                .flat_map(|(_, pairs)| pairs)
                .flat_map(|pair| [per_pixel(pair.without), per_pixel(pair.with)])
                .map(f64::log10)
        };
        let least = values().fold(f64::INFINITY, f64::min).floor() as i32;
        let most = values().fold(f64::NEG_INFINITY, f64::max).ceil() as i32;
        (least, most.max(least + 1))
    }
}

impl Figure for Chart<'_> {
    fn size(&self) -> (u32, u32) {
        let width = LEFT + self.scenes.len() as i32 * self.group() + MARGIN;
        let height = HEAD + self.panels().len() as i32 * PANEL;
        (width.max(620) as u32, height as u32)
    }

    fn paint<B: DrawingBackend>(&self, area: &Area<'_, B>) -> Drawn<B> {
        let title =
            "Instructions per pixel without and with a floating-point unit, and their ratio";
        write(area, title, (MARGIN, MARGIN), 18, HPos::Left)?;
        let note = format!("The ratio is {THESIS}.");
        write(area, &note, (MARGIN, MARGIN + 21), 14, HPos::Left)?;
        for (i, (core, pairs)) in self.panels().into_iter().enumerate() {
            self.panel(area, core, &pairs, HEAD + i as i32 * PANEL)?;
        }
        Ok(())
    }
}

impl Chart<'_> {
    fn panel<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        (without, with): (&str, &str),
        pairs: &[Pair<'_>],
        top: i32,
    ) -> Drawn<B> {
        self.legend(area, without, with, top + 6)?;
        let floor = top + 40 + HEIGHT;
        let (low, high) = self.decades();
        let right = LEFT + self.scenes.len() as i32 * self.group();
        let height = |value: f64| {
            let share = (value.log10() - f64::from(low)) / f64::from(high - low);
            (share * f64::from(HEIGHT)).round() as i32
        };
        for decade in low..=high {
            let y = floor - height(10f64.powi(decade));
            let line = [(LEFT, y), (right, y)];
            area.draw(&PathElement::new(line, RGBColor(200, 200, 200)))?;
            let label = octray_render::counts::thousands(10u64.pow(decade.max(0) as u32));
            write(area, &label, (LEFT - 6, y - 7), 13, HPos::Right)?;
        }
        for (g, scene) in self.scenes.iter().enumerate() {
            let start = LEFT + g as i32 * self.group() + 8;
            let middle = start + self.group() / 2 - 8;
            write(area, scene, (middle, floor + 22), 14, HPos::Center)?;
            for (a, arith) in self.ariths.iter().enumerate() {
                let here = |pair: &&Pair<'_>| {
                    pair.without.scene == **scene && pair.without.arith == *arith
                };
                let Some(pair) = pairs.iter().find(here) else {
                    continue;
                };
                let x = start + a as i32 * (2 * BAR + 12);
                let tall = height(per_pixel(pair.without)).max(height(per_pixel(pair.with)));
                bar(area, (x, floor), height(per_pixel(pair.without)), true)?;
                bar(area, (x + BAR, floor), height(per_pixel(pair.with)), false)?;
                let ratio = format!("{:.2}", pair.ratio());
                write(area, &ratio, (x + BAR, floor - tall - 15), 13, HPos::Center)?;
                write(area, arith.name(), (x + BAR, floor + 5), 12, HPos::Center)?;
            }
        }
        Ok(())
    }

    fn legend<B: DrawingBackend>(
        &self,
        area: &Area<'_, B>,
        without: &str,
        with: &str,
        y: i32,
    ) -> Drawn<B> {
        bar(area, (LEFT, y + 13), 12, true)?;
        let text = format!("{without}, without");
        write(area, &text, (LEFT + BAR + 6, y), 14, HPos::Left)?;
        bar(area, (LEFT + 150, y + 13), 12, false)?;
        let text = format!("{with}, with");
        write(area, &text, (LEFT + 150 + BAR + 6, y), 14, HPos::Left)
    }
}

/// A bar from its lower left corner: full, or hollow.
fn bar<B: DrawingBackend>(
    area: &Area<'_, B>,
    (x, floor): (i32, i32),
    height: i32,
    full: bool,
) -> Drawn<B> {
    let corners = [(x, floor - height), (x + BAR - 1, floor)];
    let fill = if full { RGBColor(60, 60, 60) } else { WHITE };
    area.draw(&Rectangle::new(corners, fill.filled()))?;
    area.draw(&Rectangle::new(corners, BLACK))
}

#[cfg(test)]
mod tests {
    use super::super::ratio::tests::rows;
    use super::*;
    use crate::canvas;

    #[test]
    fn the_chart_tells_every_ratio() {
        let rows = rows();
        let svg = canvas::svg(&Chart::of(&rows).unwrap()).unwrap();
        for text in [
            "9.00",
            "1.50",
            "8.00",
            "1.00",
            "figure-22",
            "auto",
            "m4f, with",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        assert_eq!(svg, canvas::svg(&Chart::of(&rows).unwrap()).unwrap());
        assert!(Chart::of(&rows[..2]).is_none());
    }
}
