//! Fractal mountains.

use super::random::Random;
use super::stage::{PALETTE, Stage, glossy};
use crate::model::{Point, Surface};

pub(super) fn build(stage: &mut Stage, objects: usize, mut random: Random) {
    let lake = stage.surface(glossy([0.1, 0.25, 0.4], 0.45));
    let [sand, grass, rock, snow] = [
        PALETTE[2],
        PALETTE[3],
        [0.45, 0.4, 0.36],
        [0.95, 0.95, 0.97],
    ]
    .map(|colour| stage.surface(Surface::matt(colour)));

    let cells = (objects / 2).max(1);
    let columns = cells.isqrt();
    let rows = cells / columns;
    let heights = Heights::new(rows.max(columns), &mut random);
    let (low, high) = heights.range(rows, columns);
    let corner = |row: usize, column: usize| -> Point {
        let x = column as f64 / columns as f64 * 2.0 - 1.0;
        let y = row as f64 / rows as f64 * 2.0 - 1.0;
        // From 0 to 1, flatter towards the shore on all sides.
        let height = (heights.at(row, column) - low) / (high - low);
        [x, y, 0.9 * height * (1.0 - x * x) * (1.0 - y * y) - 0.06]
    };
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [corner(row, column), corner(row, column + 1)];
            let [c, d] = [corner(row + 1, column + 1), corner(row + 1, column)];
            for triangle in [[a, b, c], [a, c, d]] {
                let height = triangle.iter().map(|vertex| vertex[2]).sum::<f64>() / 3.0;
                let surface = match height {
                    _ if height < 0.02 => sand,
                    _ if height < 0.18 => grass,
                    _ if height < 0.36 => rock,
                    _ => snow,
                };
                stage.polygon(surface, &triangle);
            }
        }
    }
    stage.ground(lake, 0.0, 6.0);
}

/// A square of heights.
struct Heights {
    /// A power of two: one less than the number of points along a side.
    side: usize,
    heights: Vec<f64>,
}

impl Heights {
    /// Computes the heights of a square of at least `cells` × `cells` cells with the diamond-square algorithm
    /// (Fournier, Fussell and Carpenter 1982; Miller 1986).
    fn new(cells: usize, random: &mut Random) -> Self {
        let side = cells.next_power_of_two();
        let mut this = Self {
            side,
            heights: vec![0.0; (side + 1) * (side + 1)],
        };
        for (row, column) in [(0, 0), (0, side), (side, 0), (side, side)] {
            this.set(row, column, random.between(-0.1, 0.2));
        }
        let mut step = side;
        let mut amplitude = 0.4;
        while step > 1 {
            let half = step / 2;
            let odd = || (half..side).step_by(step);
            for row in odd() {
                for column in odd() {
                    let mean = this.mean(row, column, half, [(-1, -1), (-1, 1), (1, -1), (1, 1)]);
                    this.set(row, column, mean + random.between(-0.7, 1.0) * amplitude);
                }
            }
            for row in (0..=side).step_by(half) {
                let first = if (row / half).is_multiple_of(2) {
                    half
                } else {
                    0
                };
                for column in (first..=side).step_by(step) {
                    let mean = this.mean(row, column, half, [(-1, 0), (1, 0), (0, -1), (0, 1)]);
                    this.set(
                        row,
                        column,
                        mean + random.between(-1.0, 1.0) * amplitude * 0.7,
                    );
                }
            }
            step = half;
            amplitude *= 0.47;
        }
        this
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        self.heights[row * (self.side + 1) + column]
    }

    /// Returns the lowest and the highest point of the first cells; they differ.
    fn range(&self, rows: usize, columns: usize) -> (f64, f64) {
        let points = (0..=rows).flat_map(|row| (0..=columns).map(move |column| (row, column)));
        let heights = points.map(|(row, column)| self.at(row, column));
        let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), height| {
            (low.min(height), high.max(height))
        });
        (low, high.max(low + f64::MIN_POSITIVE))
    }

    fn set(&mut self, row: usize, column: usize, height: f64) {
        self.heights[row * (self.side + 1) + column] = height;
    }

    /// Returns the mean of those of the four points at distance `reach` that are on the map.
    fn mean(&self, row: usize, column: usize, reach: usize, towards: [(isize, isize); 4]) -> f64 {
        let along = |from: usize, sign: isize| {
            from.checked_add_signed(sign * reach as isize)
                .filter(|&to| to <= self.side)
        };
        let heights = towards
            .into_iter()
            .filter_map(|(down, right)| Some(self.at(along(row, down)?, along(column, right)?)));
        let (sum, count) = heights.fold((0.0, 0.0), |(sum, count), h| (sum + h, count + 1.0));
        sum / count
    }
}
