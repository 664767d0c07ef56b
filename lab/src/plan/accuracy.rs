//! Finds by rendering what a picture needs to be accurate enough on any machine: bounces, pixels per ray, and in each
//! family of numbers the narrowest format.

use super::events::{Events, Probe};
use super::job::Numbers;
use crate::budget;
use octray_core::accel::{self, COMPACT_MAX_DEPTH};
use octray_prepare::format::{Family, Format};
use octray_prepare::plan::{Plan, fingerprint};
use octray_prepare::quantise::{Bound, bounds};
use octray_prepare::{PixelsPerRay, RenderSettings};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::metric::Difference;
use octray_render::picture::Picture;
use octray_scenes::model::Scene;
use serde::Serialize;
use strum::VariantArray;

/// The tree with which pictures are compared; all trees give the same picture.
const TREE: accel::BuildOptions = accel::BuildOptions {
    depth: COMPACT_MAX_DEPTH,
    leaf_size: 2,
};

/// Returns the 32-bit fixed-point formats, the fewest fraction bits first.
pub fn fixed_point() -> impl DoubleEndedIterator<Item = Format> {
    let all = Format::VARIANTS.iter().copied();
    all.filter(|format| format.family() == Family::Fixed)
}

/// The scene, and the requirements on its picture.
#[derive(Debug)]
pub struct Scope<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Columns and rows.
    pub size: (u32, u32),
    /// The least distance from the exact picture (PSNR), in dB.
    pub min_psnr: f64,
    /// Requests a stop.
    pub interrupt: &'a Interrupt,
}

/// The requirements of the picture.
#[derive(Clone, Debug)]
pub struct Accuracy {
    /// The picture in 64-bit floats with the largest number of bounces that was explored.
    pub exact: Picture,
    /// The fewest bounces that give the exact picture.
    pub depth: u32,
    /// The bounces that were not explored, in words, if any: with them the picture takes too many rays.
    pub unexplored: Option<String>,
    /// The events with these bounces, in 64-bit floats.
    pub full: Events,
    /// The events with one bounce less, and the distance in dB; `None` without bounces.
    pub shallower: Option<(Events, f64)>,
    /// The events with one ray for four pixels, and the distance in dB.
    pub coarse: (Events, f64),
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// The largest number that can occur.
    pub largest: Bound,
    /// The bits before the point that it needs.
    pub integer_bits: u32,
    /// The requested least distance, in dB.
    pub min_psnr: f64,
    /// Why the scene does not fit fixed point, if it was tried and does not.
    pub refused: Option<String>,
    /// Every tried arithmetic, the finest first.
    pub tried: Vec<Tried>,
}

/// A tried arithmetic, and the distance of its picture from the exact one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tried {
    /// Its format.
    pub format: Format,
    /// Fraction bits; `None` for floats.
    pub fraction_bits: Option<u32>,
    /// In dB; `None` if the pictures are equal.
    pub psnr: Option<f64>,
    /// What is too fine for the format, if anything.
    pub too_fine: Option<String>,
    /// Whether it is accurate enough, nothing is too fine, and nothing overflows.
    pub does: bool,
}

impl Scope<'_> {
    /// Finds what the picture needs, considering only some arithmetics.
    ///
    /// # Errors
    /// [`Error::Failed`] if the scene is too large for a compact BVH; [`Error::Interrupted`]; [`Error::TooManyRays`] if
    /// the picture takes too many even without bounces.
    pub fn accuracy(&self, numbers: Numbers) -> Result<Accuracy, Error> {
        let (explored, exact) = budget::deepest(RenderSettings::DEEPEST, |depth| {
            let plan = self.plan(Format::F64, PixelsPerRay::One, depth);
            Ok(self.render(&plan)?.picture)
        })?;
        let depth = self.depth(&exact, explored)?;
        let full = self
            .render(&self.plan(Format::F64, PixelsPerRay::One, depth))?
            .events;
        let shallower = match depth.checked_sub(1) {
            None => None,
            Some(less) => {
                let probe = self.render(&self.plan(Format::F64, PixelsPerRay::One, less))?;
                Some((probe.events, psnr(&exact, &probe.picture)?))
            }
        };
        let coarse = self.render(&self.plan(Format::F64, PixelsPerRay::Four, depth))?;
        let coarse_psnr = psnr(&exact, &coarse.picture)?;
        let all = bounds(self.scene, depth).into_iter();
        let largest = all
            .max_by(|a, b| a.value.total_cmp(&b.value))
            .unwrap_or(Bound {
                what: "a direction".into(),
                value: 1.0,
            });
        let mut accuracy = Accuracy {
            exact,
            depth,
            unexplored: budget::unexplored(explored, RenderSettings::DEEPEST, self.budget()),
            full,
            shallower,
            coarse: (coarse.events, coarse_psnr),
            pixels_per_ray: PixelsPerRay::One,
            integer_bits: integer_bits(largest.value),
            largest,
            min_psnr: self.min_psnr,
            refused: None,
            tried: Vec::new(),
        };
        if coarse_psnr >= self.min_psnr {
            accuracy.pixels_per_ray = PixelsPerRay::Four;
            self.formats(&mut accuracy, numbers)?;
        }
        if !accuracy.tried.iter().any(|tried| tried.does) {
            accuracy.pixels_per_ray = PixelsPerRay::One;
            self.formats(&mut accuracy, numbers)?;
        }
        Ok(accuracy)
    }

    /// Returns a plan with the default tree and capacity for all rays.
    pub fn plan(&self, format: Format, pixels_per_ray: PixelsPerRay, max_depth: u32) -> Plan {
        Plan {
            scene: fingerprint(self.scene),
            format,
            size: self.size,
            pixels_per_ray,
            max_depth,
            cut_off: RenderSettings::DEFAULT.cut_off,
            tree: Some(TREE),
            on_device: false,
            rays: max_depth as usize + 1,
        }
    }

    /// Renders a plan.
    ///
    /// # Errors
    /// Those of [`Probe::render`].
    pub fn render(&self, plan: &Plan) -> Result<Probe, Error> {
        // Another arithmetic than f64 may find some more rays.
        let rays = match plan.format {
            Format::F64 => self.budget(),
            _ => 2 * self.budget(),
        };
        Probe::render(self.scene, plan, &self.interrupt.with_budget(rays))
    }

    /// Returns the most rays of a picture.
    fn budget(&self) -> u64 {
        budget::rays(self.size, 1)
    }

    /// Returns the fewest bounces that give the exact picture, which has no more than `explored`.
    fn depth(&self, exact: &Picture, explored: u32) -> Result<u32, Error> {
        let is_exact = |depth| -> Result<bool, Error> {
            let probe = self.render(&self.plan(Format::F64, PixelsPerRay::One, depth))?;
            Ok(Difference::between(exact, &probe.picture)?.is_zero())
        };
        // A surface that transmits more light than it receives subtracts light of its own.
        if (self.scene.surfaces.iter()).any(|surface| surface.refract > 1.0) {
            let mut depth = explored;
            while depth > 0 && is_exact(depth - 1)? {
                depth -= 1;
            }
            return Ok(depth);
        }
        // Otherwise more bounces only add light, so no level decreases, and a picture that equals the exact one stays
        // equal with more bounces.
        let (mut low, mut high) = (0, explored);
        // Few scenes need many bounces: the steps grow before they shrink.
        let mut step = 1;
        while low < high {
            let middle = (low + step - 1).min((low + high) / 2);
            match is_exact(middle)? {
                true => high = middle,
                false => (low, step) = (middle + 1, 2 * step),
            }
        }
        Ok(low)
    }

    /// Tries floats, and fixed point from the finest format to the first one that is not accurate enough.
    fn formats(&self, accuracy: &mut Accuracy, numbers: Numbers) -> Result<(), Error> {
        accuracy.tried.clear();
        accuracy.refused = None;
        if numbers != Numbers::Fixed {
            match self.attempt(accuracy, Format::F32) {
                Err(Error::TooManyRays(rays)) => {
                    accuracy.refused = Some(too_many(Format::F32, rays));
                }
                tried => accuracy.tried.push(tried?),
            }
        }
        let fixed = fixed_point().rev().filter(|_| numbers != Numbers::F32);
        for format in fixed {
            match self.attempt(accuracy, format) {
                // A value that overflows this format may fit the next.
                Err(Error::Failed(why)) => accuracy.refused = Some(why),
                Err(Error::TooManyRays(rays)) => accuracy.refused = Some(too_many(format, rays)),
                tried => {
                    let tried = tried?;
                    let does = tried.does;
                    accuracy.tried.push(tried);
                    accuracy.refused = None;
                    if !does {
                        break;
                    }
                }
            }
        }
        Ok(())
    }

    fn attempt(&self, accuracy: &Accuracy, format: Format) -> Result<Tried, Error> {
        let probe = self.render(&self.plan(format, accuracy.pixels_per_ray, accuracy.depth))?;
        let psnr = psnr(&accuracy.exact, &probe.picture)?;
        Ok(Tried {
            format,
            fraction_bits: format.fraction_bits(),
            psnr: psnr.is_finite().then_some(psnr),
            does: psnr >= self.min_psnr && probe.too_fine.is_none() && probe.saturations == 0,
            too_fine: probe.too_fine,
        })
    }
}

impl Accuracy {
    /// Returns the narrowest sufficient format of each family.
    pub fn narrowest(&self) -> impl Iterator<Item = &Tried> {
        let of = |fixed: bool| {
            let mut tried = self.tried.iter();
            tried.rfind(|tried| tried.fraction_bits.is_some() == fixed && tried.does)
        };
        [of(true), of(false)].into_iter().flatten()
    }

    /// Returns the format closest to the exact picture, preferably one for which nothing is too fine.
    pub fn closest(&self) -> Option<&Tried> {
        let distance = |tried: &Tried| tried.psnr.unwrap_or(f64::INFINITY);
        (self.tried.iter()).max_by(|a, b| {
            let resolves = [a, b].map(|tried| tried.too_fine.is_none());
            let further = distance(a).total_cmp(&distance(b));
            resolves[0].cmp(&resolves[1]).then(further)
        })
    }
}

/// Says why a format is not taken in which rays multiply that do not in others.
fn too_many(format: Format, rays: u64) -> String {
    format!("in {format}, {}", Error::TooManyRays(rays))
}

/// Returns the fewest bits before the point with which a format holds a number.
fn integer_bits(largest: f64) -> u32 {
    (0..31)
        .find(|bits| largest < f64::from(1u32 << bits) * (1.0 - 1e-6))
        .unwrap_or(31)
}

fn psnr(exact: &Picture, picture: &Picture) -> Result<f64, Error> {
    Difference::between(exact, picture).map(|difference| difference.psnr())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_before_the_point_hold_what_is_below_their_power() {
        for (largest, bits) in [
            (0.0, 0),
            (0.5, 0),
            (1.0, 1),
            (1.5, 1),
            (5.2, 3),
            (8.0, 4),
            (1e12, 31),
        ] {
            assert_eq!(integer_bits(largest), bits, "{largest}");
        }
    }

    /// A white sky before a mirror. Through the mirror panes are seen, of which the third subtracts three times the
    /// light that it emits: the first bounce makes the picture white, the second makes it black again.
    #[test]
    fn bounces_that_subtract_light_are_not_skipped() {
        let pane =
            |z: i32, surface: &str| format!("f {surface} p 4 -9 -9 {z} 9 -9 {z} 9 9 {z} -9 9 {z} ");
        let black = "0 0 0 0 0 0 0 0 0 0";
        let text = [
            "v 0 0 9 resolution 4 4 b 1 1 1 ".into(),
            pane(-1, &format!("{black} 1 1 1")),
            pane(-2, &format!("{black} 0 1 1")),
            pane(-3, "1 1 1 0 0 0 0 0 0 0 0 3 1"),
            pane(-4, &format!("{black} 0 0")),
        ];
        let scene = octray_scenes::parse(&text.concat()).unwrap();
        let scope = Scope {
            scene: &scene,
            size: (4, 4),
            min_psnr: 40.0,
            interrupt: &Interrupt::default(),
        };
        let picture = |depth| {
            scope
                .render(&scope.plan(Format::F64, PixelsPerRay::One, depth))
                .unwrap()
                .picture
        };
        let exact = picture(RenderSettings::DEEPEST);
        assert_eq!(
            [0, 1, 2].map(|depth| picture(depth) == exact),
            [true, false, true]
        );
        assert_eq!(scope.depth(&exact, RenderSettings::DEEPEST).unwrap(), 2);
    }
}
