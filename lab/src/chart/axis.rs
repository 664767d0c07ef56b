//! Scales: from values to pixels, and where to mark them.

/// A scale from values to pixels.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    low: f64,
    high: f64,
    /// The pixels of `low` and of `high`, in either order.
    pixels: (i32, i32),
}

impl Axis {
    /// A scale that holds all values with some room around them, and spans at least `least`. `pixels` are those
    /// of its lower and of its upper end.
    pub fn over(values: impl Iterator<Item = f64> + Clone, least: f64, pixels: (i32, i32)) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let span = (high - low).max(least);
        let room = span * 0.07 + (span - (high - low)) / 2.0;
        Self {
            low: low - room,
            high: high + room,
            pixels,
        }
    }

    /// Where a value is.
    pub fn pixel(&self, value: f64) -> i32 {
        let share = (value - self.low) / (self.high - self.low);
        let (from, to) = self.pixels;
        from + (share * f64::from(to - from)).round() as i32
    }

    /// Its ends.
    pub fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// Whether a value lies on it.
    pub fn contains(&self, value: f64) -> bool {
        (self.low..self.high).contains(&value)
    }

    /// Round values on it, at most about fifteen.
    pub fn ticks(&self) -> Vec<f64> {
        let span = self.high - self.low;
        let step = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .find(|step| span / step < 15.0)
            .unwrap_or(20.0);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last).map(|tick| tick as f64 * step).collect()
    }
}

/// Values to mark on a scale of logarithms to the base of ten: 1, 2 and 5 of each decade, or only 1 if there are
/// many.
pub fn log_ticks(axis: &Axis) -> Vec<f64> {
    let (low, high) = axis.range();
    let digits: &[f64] = if high - low < 4.0 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let mut ticks = Vec::new();
    for decade in low.floor() as i32..=high.ceil() as i32 {
        let all = digits.iter().map(|digit| digit * 10f64.powi(decade));
        ticks.extend(all.filter(|value| axis.contains(value.log10())));
    }
    ticks
}

/// An amount as short as can be: `20 M`, or `5 ms` where the unit is seconds.
pub fn amount(value: f64, unit: &str) -> String {
    let (prefixes, unit): (&[(f64, &str)], _) = match unit {
        "seconds" => (&[(1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n")], "s"),
        _ => (&[(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, "")], ""),
    };
    // What a rounding error leaves just below is meant.
    let fits = |(size, _): &&(f64, &str)| value * 1.000_001 >= *size;
    let (size, prefix) = prefixes.iter().find(fits).copied().unwrap_or((1.0, ""));
    let number = (value / size * 1e3).round() / 1e3;
    format!("{number} {prefix}{unit}").trim_end().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_holds_its_values_in_their_order() {
        let values = [3.0, 17.0, 40.0];
        let axis = Axis::over(values.into_iter(), 10.0, (500, 100));
        let pixels = values.map(|value| axis.pixel(value));
        assert!(500 > pixels[0] && pixels[0] > pixels[1]);
        assert!(pixels[1] > pixels[2] && pixels[2] > 100);
        assert_eq!(
            axis.ticks(),
            [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0]
        );
        let one = Axis::over([7.0].into_iter(), 10.0, (0, 100));
        assert_eq!(one.pixel(7.0), 50);
    }

    #[test]
    fn decades_are_marked() {
        let axis = Axis::over([5.9, 7.1].into_iter(), 0.5, (0, 800));
        assert_eq!(log_ticks(&axis), [1e6, 2e6, 5e6, 1e7]);
        let wide = Axis::over([0.0, 6.0].into_iter(), 0.5, (0, 800));
        assert_eq!(log_ticks(&wide).len(), 7);
    }

    #[test]
    fn amounts_are_short() {
        for (value, unit, text) in [
            (20e6, "instructions", "20 M"),
            (500.0, "instructions", "500"),
            (1e3 - 1e-9, "instructions", "1 k"),
            (0.005, "seconds", "5 ms"),
            (0.2, "seconds", "200 ms"),
            (2.0, "seconds", "2 s"),
        ] {
            assert_eq!(amount(value, unit), text);
        }
    }
}
