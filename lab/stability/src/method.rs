//! A method under test: what it is about, and how it is measured in every arithmetic.

use crate::number::{ARITHMETICS, Number};
use crate::setting::Setting;
use crate::tally::{Bounds, Tally};
use octray_core::scalar::{Approx, Fixed, Fixed64};
use octray_prepare::saturation::PerThread;
use serde::Serialize;

/// One way to compute the same thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Form {
    /// A short name, for records and files.
    pub name: &'static str,
    /// What it is, in a few words.
    pub label: &'static str,
}

/// The form that octray ships is the first of each method, and has this name.
pub const SHIPPED: &str = "shipped";

/// What a sweep is about.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct About {
    /// The method's name on the command line.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What is swept, as an axis has it.
    pub axis: &'static str,
    /// What one error is measured in; empty where none is.
    pub unit: &'static str,
    /// The values swept.
    #[serde(skip)]
    pub values: &'static [f64],
    /// The value that is most gentle to the method: limits are looked for from there.
    pub home: f64,
    /// The forms: the shipped one first.
    pub forms: &'static [Form],
    /// What holds, degrades and breaks.
    pub bounds: Bounds,
}

/// A method, measured at one value of its sweep in one arithmetic: one tally for each form.
pub trait Sweep {
    /// What it is about.
    const ABOUT: About;

    /// The scene and the view that a value stands for.
    fn setting(value: f64) -> Setting;

    /// Measures all forms at `value`.
    fn measure<S: Number>(value: f64) -> Vec<Tally>;
}

/// A sweep whose type has been forgotten.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// What it is about.
    pub about: About,
    setting: fn(f64) -> Setting,
    runners: [Runner; ARITHMETICS.len()],
}

impl Method {
    /// The method of a sweep.
    pub const fn of<W: Sweep>() -> Self {
        Self {
            about: W::ABOUT,
            setting: W::setting,
            runners: [
                Runner::of::<W, f64>(),
                Runner::of::<W, f32>(),
                Runner::of::<W, Approx<2>>(),
                Runner::of::<W, Approx<1>>(),
                Runner::of::<W, Approx<0>>(),
                Runner::of::<W, Fixed64<PerThread>>(),
                Runner::of::<W, Fixed<28, PerThread>>(),
                Runner::of::<W, Fixed<24, PerThread>>(),
                Runner::of::<W, Fixed<20, PerThread>>(),
                Runner::of::<W, Fixed<16, PerThread>>(),
                Runner::of::<W, Fixed<12, PerThread>>(),
                Runner::of::<W, Fixed<8, PerThread>>(),
            ],
        }
    }

    /// Measures all forms at `value` in arithmetic number `arithmetic` of [`ARITHMETICS`].
    pub fn measure(&self, arithmetic: usize, value: f64) -> Vec<Tally> {
        (self.runners[arithmetic].measure)(value)
    }

    /// Whether that arithmetic admits the scene that `value` stands for.
    pub fn admits(&self, arithmetic: usize, value: f64) -> bool {
        (self.runners[arithmetic].admits)(&(self.setting)(value))
    }
}

/// A sweep in one arithmetic.
#[derive(Clone, Copy, Debug)]
struct Runner {
    measure: fn(f64) -> Vec<Tally>,
    admits: fn(&Setting) -> bool,
}

impl Runner {
    const fn of<W: Sweep, S: Number>() -> Self {
        Self {
            measure: W::measure::<S>,
            admits: Setting::admitted::<S>,
        }
    }
}

/// 1 to 10⁷, three values a decade.
pub const SEVEN_DECADES: &[f64] = &[
    1.0, 2.0, 5.0, 1e1, 2e1, 5e1, 1e2, 2e2, 5e2, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6,
    2e6, 5e6, 1e7,
];
