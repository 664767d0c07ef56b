//! `octray diff`: measures how far apart two pictures are, and checks limits.

use crate::convert;
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::heat;
use octray_render::interrupt::Interrupt;
use octray_render::metric::Difference;
use octray_render::output;
use octray_render::picture::{RasDepth, Target};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// What to compare, and what to print.
#[derive(Clone, Debug, PartialEq)]
pub struct DiffJob {
    /// The first picture.
    pub a: PathBuf,
    /// The second one.
    pub b: PathBuf,
    /// Where to write a heat map.
    pub heat: Option<Target>,
    /// Its bits per pixel if it is a Sun rasterfile.
    pub ras_depth: RasDepth,
    /// Whether to print JSON rather than text.
    pub json: bool,
    /// How far apart the pictures may be.
    pub limits: DiffLimits,
}

/// Limits on the difference of two pictures; `None` means no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DiffLimits {
    /// The largest root-mean-square error, in levels.
    pub rmse: Option<f64>,
    /// The smallest peak signal-to-noise ratio, in dB.
    pub psnr: Option<f64>,
    /// The largest difference of any pixel, in levels.
    pub largest: Option<u8>,
    /// The most pixels that differ by more than one level.
    pub beyond_1: Option<Share>,
    /// The most pixels that differ by more than eight levels.
    pub beyond_8: Option<Share>,
}

/// A number of pixels, absolute or relative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Share {
    /// A number of pixels.
    Pixels(u64),
    /// Per cent of all pixels, 0 to 100.
    Percent(f64),
}

/// Compares the pictures, prints the result, and writes the heat map.
///
/// # Errors
/// If a picture cannot be read, the sizes differ, something cannot be written, or a limit is exceeded
/// ([`Error::Bounds`], after the result was printed).
pub fn run(job: &DiffJob, interrupt: &Interrupt) -> Result<(), Error> {
    let (a, b) = (convert::read(&job.a)?, convert::read(&job.b)?);
    let difference = Difference::between(&a, &b)?;
    if let Some(target) = &job.heat {
        interrupt.check()?;
        target.write(&heat::map(&a, &b)?, job.ras_depth, interrupt)?;
    }
    let exceeded = job.limits.exceeded(&difference);
    let heat = job.heat.iter().map(|target| &target.path);
    output::write_report(heat, interrupt, |out| {
        if job.json {
            let report = DiffReport::new(job, a.size(), &difference, exceeded.is_empty());
            serde_json::to_writer(&mut *out, &report)?;
            writeln!(out)
        } else {
            write!(out, "{}", DiffTable(&difference))
        }
    })?;
    if exceeded.is_empty() {
        Ok(())
    } else {
        Err(Error::Bounds(exceeded))
    }
}

impl DiffLimits {
    /// Returns a sentence for each limit that `difference` exceeds.
    pub fn exceeded(&self, difference: &Difference) -> Vec<String> {
        let (rmse, psnr, pixels) = (difference.rmse(), difference.psnr(), difference.pixels);
        let most = |what: &str, bound: Option<Share>, found: u64| {
            bound
                .filter(|bound| !bound.allows(found, pixels))
                .map(|bound| {
                    format!(
                        "pixels that differ by more than {what}: {found}, at most {bound} allowed"
                    )
                })
        };
        let sentences = [
            self.rmse
                .filter(|bound| rmse > *bound)
                .map(|bound| format!("the RMSE is {rmse:.4} levels, at most {bound} allowed")),
            self.psnr
                .filter(|bound| psnr < *bound)
                .map(|bound| format!("the PSNR is {psnr:.2} dB, at least {bound} demanded")),
            self.largest
                .filter(|bound| difference.largest > *bound)
                .map(|bound| {
                    let largest = difference.largest;
                    format!("the largest difference is {largest} levels, at most {bound} allowed")
                }),
            most("one level", self.beyond_1, difference.beyond_1),
            most("eight levels", self.beyond_8, difference.beyond_8),
        ];
        sentences.into_iter().flatten().collect()
    }
}

impl Share {
    /// Returns whether `found` of `all` pixels is within this limit.
    pub fn allows(self, found: u64, all: u64) -> bool {
        match self {
            Self::Pixels(most) => found <= most,
            Self::Percent(most) => found as f64 * 100.0 <= most * all as f64,
        }
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pixels(pixels) => write!(f, "{pixels}"),
            Self::Percent(percent) => write!(f, "{percent} %"),
        }
    }
}

/// The JSON object of `--json`.
#[derive(Serialize)]
struct DiffReport {
    a: String,
    b: String,
    size: (u32, u32),
    /// `null` for equal pictures: their PSNR is infinite.
    psnr: Option<f64>,
    rmse: f64,
    largest: u8,
    beyond_1: u64,
    beyond_8: u64,
    within_bounds: bool,
}

impl DiffReport {
    fn new(job: &DiffJob, size: (u32, u32), difference: &Difference, within_bounds: bool) -> Self {
        Self {
            a: job.a.display().to_string(),
            b: job.b.display().to_string(),
            size,
            psnr: (!difference.is_zero()).then(|| difference.psnr()),
            rmse: difference.rmse(),
            largest: difference.largest,
            beyond_1: difference.beyond_1,
            beyond_8: difference.beyond_8,
            within_bounds,
        }
    }
}

/// Displays a difference as aligned lines, each with a line end.
struct DiffTable<'a>(&'a Difference);

impl fmt::Display for DiffTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let difference = self.0;
        let psnr = match difference.is_zero() {
            true => "infinite: the pictures are equal".into(),
            false => format!("{:.2} dB", difference.psnr()),
        };
        let all = thousands(difference.pixels);
        let pixels = |count: u64| {
            let percent = 100.0 * count as f64 / difference.pixels.max(1) as f64;
            format!("{} of {all} pixels ({percent:.3} %)", thousands(count))
        };
        writeln!(f, "PSNR                {psnr}")?;
        writeln!(f, "RMSE                {:.4} levels", difference.rmse())?;
        writeln!(f, "largest difference  {} levels", difference.largest)?;
        writeln!(f, "beyond 1 level      {}", pixels(difference.beyond_1))?;
        writeln!(f, "beyond 8 levels     {}", pixels(difference.beyond_8))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIFFERENCE: Difference = Difference {
        pixels: 1000,
        squares: 3000 * 4,
        largest: 9,
        beyond_1: 10,
        beyond_8: 1,
    };

    #[test]
    fn a_limit_that_is_just_met_is_not_exceeded() {
        let met = DiffLimits {
            rmse: Some(2.0),
            psnr: Some(42.11),
            largest: Some(9),
            beyond_1: Some(Share::Percent(1.0)),
            beyond_8: Some(Share::Pixels(1)),
        };
        assert!(met.exceeded(&DIFFERENCE).is_empty());
        assert!(DiffLimits::default().exceeded(&DIFFERENCE).is_empty());
    }

    #[test]
    fn each_exceeded_limit_is_reported() {
        let tight = DiffLimits {
            rmse: Some(1.9),
            psnr: Some(42.12),
            largest: Some(8),
            beyond_1: Some(Share::Percent(0.99)),
            beyond_8: Some(Share::Pixels(0)),
        };
        let sentences = [
            "the RMSE is 2.0000 levels, at most 1.9 allowed",
            "the PSNR is 42.11 dB, at least 42.12 demanded",
            "the largest difference is 9 levels, at most 8 allowed",
            "pixels that differ by more than one level: 10, at most 0.99 % allowed",
            "pixels that differ by more than eight levels: 1, at most 0 allowed",
        ];
        assert_eq!(tight.exceeded(&DIFFERENCE), sentences);
    }

    #[test]
    fn equal_pictures_meet_every_psnr() {
        let equal = Difference {
            squares: 0,
            largest: 0,
            ..DIFFERENCE
        };
        let bounds = DiffLimits {
            psnr: Some(f64::MAX),
            ..DiffLimits::default()
        };
        assert!(bounds.exceeded(&equal).is_empty());
    }
}
