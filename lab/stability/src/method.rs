//! A tested method: its description, and its measurement in every arithmetic.

use crate::number::{ARITHMETICS, Number};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits};
use octray_core::scalar::{Approx, Fixed, Fixed64};
use octray_prepare::saturation::PerThread;
use serde::Serialize;

/// One way to compute a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Form {
    /// A short name, for records and files.
    pub name: &'static str,
    /// A description in a few words.
    pub label: &'static str,
}

/// The name of the form that octray ships, which is the first of each method.
pub const SHIPPED: &str = "shipped";

/// The description of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct About {
    /// The method's name on the command line.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// The swept quantity, as label of an axis.
    pub axis: &'static str,
    /// The unit of the error; empty if there is no error.
    pub unit: &'static str,
    /// The swept values.
    #[serde(skip)]
    pub values: &'static [f64],
    /// The easiest value for the method: limits are searched from here.
    pub home: f64,
    /// The forms, the shipped one first.
    pub forms: &'static [Form],
    /// The limits of holding, degrading and breaking.
    #[serde(rename = "bounds")]
    pub limits: StateLimits,
}

/// A method, measured at one value of its sweep in one arithmetic: one set of measures per form.
pub trait Sweep {
    /// The description.
    const ABOUT: About;

    /// Returns the scene and the view that belong to a value.
    fn setting(value: f64) -> Setting;

    /// Measures all forms at `value`.
    fn measure<S: Number>(value: f64) -> Vec<ErrorStats>;
}

/// A sweep as a value, without its type.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// The description.
    pub about: About,
    setting: fn(f64) -> Setting,
    runners: [Runner; ARITHMETICS.len()],
}

impl Method {
    /// Returns the method of a sweep.
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
    pub fn measure(&self, arithmetic: usize, value: f64) -> Vec<ErrorStats> {
        (self.runners[arithmetic].measure)(value)
    }

    /// Returns whether that arithmetic admits the scene that belongs to `value`.
    pub fn admits(&self, arithmetic: usize, value: f64) -> bool {
        (self.runners[arithmetic].admits)(&(self.setting)(value))
    }
}

/// A sweep in one arithmetic.
#[derive(Clone, Copy, Debug)]
struct Runner {
    measure: fn(f64) -> Vec<ErrorStats>,
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

/// 1 to 10⁷, three values per decade.
pub const SEVEN_DECADES: &[f64] = &[
    1.0, 2.0, 5.0, 1e1, 2e1, 5e1, 1e2, 2e2, 5e2, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6,
    2e6, 5e6, 1e7,
];
