//! Whether the settings of a rendering are in their ranges: the command's arguments are, a program's may not be.

use crate::samples::Adaptive;
use crate::settings::{PixelsPerRay, RenderSettings};
use std::ops::RangeInclusive;
use thiserror::Error;

/// A setting outside its range.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("setting {name} {found}: expected {expected}")]
pub struct OutOfRange {
    /// Its name in [`RenderSettings`].
    pub name: &'static str,
    /// What it is.
    pub found: String,
    /// What it should be.
    pub expected: String,
}

impl RenderSettings {
    /// Checks that every setting is in the range that its description names.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self) -> Result<(), OutOfRange> {
        if let Some((width, height)) = self.size {
            whole("size (columns)", width, 1..=65_535)?;
            whole("size (rows)", height, 1..=65_535)?;
        }
        let finite = self.orbit.is_finite();
        ensure(finite, "orbit", self.orbit, "finite degrees")?;
        whole("samples", self.samples, 1..=64)?;
        let one_pixel = self.pixels_per_ray == PixelsPerRay::One;
        let one_of_both = self.samples == 1 || one_pixel;
        let alone = "1 with several pixels per ray";
        ensure(one_of_both, "samples", self.samples, alone)?;
        if let Some(Adaptive { levels, .. }) = self.adaptive {
            whole("adaptive.levels", levels, 1..=Adaptive::MOST_LEVELS)?;
            let alone = "1 with adaptive samples";
            ensure(self.samples == 1, "samples", self.samples, alone)?;
            let pixels = self.pixels_per_ray.number();
            ensure(one_pixel, "pixels_per_ray", pixels, alone)?;
        }
        whole("max_depth", self.max_depth, 0..=Self::DEEPEST)?;
        let share = (0.0..=1.0).contains(&self.cut_off);
        ensure(share, "cut_off", self.cut_off, "0 to 1")
    }
}

fn whole(name: &'static str, found: u32, range: RangeInclusive<u32>) -> Result<(), OutOfRange> {
    let expected = format!("{} to {}", range.start(), range.end());
    ensure(range.contains(&found), name, found, &expected)
}

fn ensure(
    holds: bool,
    name: &'static str,
    found: impl ToString,
    expected: &str,
) -> Result<(), OutOfRange> {
    match holds {
        true => Ok(()),
        false => Err(OutOfRange {
            name,
            found: found.to_string(),
            expected: expected.to_owned(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_out_of_its_range_is_told_and_the_ends_are_in_it() {
        const OK: RenderSettings = RenderSettings::DEFAULT;
        let adaptive = |levels| {
            Some(Adaptive {
                levels,
                threshold: 0,
            })
        };
        let ends = [
            OK,
            RenderSettings {
                size: Some((1, 65_535)),
                samples: 64,
                max_depth: 64,
                cut_off: 1.0,
                ..OK
            },
            RenderSettings {
                adaptive: adaptive(6),
                max_depth: 0,
                cut_off: 0.0,
                orbit: -1e9,
                ..OK
            },
        ];
        for settings in ends {
            assert_eq!(settings.check(), Ok(()));
        }
        let wrong = [
            (
                RenderSettings {
                    size: Some((0, 1)),
                    ..OK
                },
                "size (columns) 0: expected 1 to 65535",
            ),
            (
                RenderSettings {
                    size: Some((1, 65_536)),
                    ..OK
                },
                "size (rows) 65536: expected 1 to 65535",
            ),
            (
                RenderSettings {
                    orbit: f64::NAN,
                    ..OK
                },
                "orbit NaN: expected finite degrees",
            ),
            (
                RenderSettings { samples: 0, ..OK },
                "samples 0: expected 1 to 64",
            ),
            (
                RenderSettings {
                    samples: 2,
                    pixels_per_ray: PixelsPerRay::Four,
                    ..OK
                },
                "samples 2: expected 1 with several pixels per ray",
            ),
            (
                RenderSettings {
                    adaptive: adaptive(7),
                    ..OK
                },
                "adaptive.levels 7: expected 1 to 6",
            ),
            (
                RenderSettings {
                    adaptive: adaptive(1),
                    samples: 2,
                    ..OK
                },
                "samples 2: expected 1 with adaptive samples",
            ),
            (
                RenderSettings {
                    adaptive: adaptive(1),
                    pixels_per_ray: PixelsPerRay::Four,
                    ..OK
                },
                "pixels_per_ray 4: expected 1 with adaptive samples",
            ),
            (
                RenderSettings {
                    max_depth: 65,
                    ..OK
                },
                "max_depth 65: expected 0 to 64",
            ),
            (
                RenderSettings {
                    cut_off: f64::NAN,
                    ..OK
                },
                "cut_off NaN: expected 0 to 1",
            ),
        ];
        for (settings, told) in wrong {
            let error = settings.check().unwrap_err().to_string();
            assert_eq!(error, format!("setting {told}"));
        }
    }
}
