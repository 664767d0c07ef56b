//! The tested arithmetics.

use crate::exact::{Exact, Exact3, exact};
use octray_core::quantize::Quantize;
use octray_core::ray::Ray;
use octray_core::scalar::{Approx, Fixed, Fixed64};
use octray_core::vec3::Vec3;
use octray_prepare::saturation::{self, PerThread};

/// A number with a known exact value.
pub trait Number: Quantize {
    /// Returns its exact value.
    fn exact(self) -> Exact {
        exact(self.to_f64())
    }
}

impl Number for f64 {}
impl Number for f32 {}
impl<const N: u32> Number for Approx<N> {}
impl<const F: u32> Number for Fixed<F, PerThread> {}
impl Number for Fixed64<PerThread> {
    // This format has more digits than an `f64`.
    fn exact(self) -> Exact {
        let bits = self.to_bits();
        let (high, low) = (bits >> 32, bits & 0xffff_ffff);
        exact(high as f64) + exact(low as f64 / (1u64 << 32) as f64)
    }
}

/// The names of all arithmetics, in the order of `runners` in [`crate::method`].
pub const ARITHMETICS: [&str; 12] = [
    f64::NAME,
    f32::NAME,
    Approx::<2>::NAME,
    Approx::<1>::NAME,
    Approx::<0>::NAME,
    Fixed64::<PerThread>::NAME,
    Fixed::<28, PerThread>::NAME,
    Fixed::<24, PerThread>::NAME,
    Fixed::<20, PerThread>::NAME,
    Fixed::<16, PerThread>::NAME,
    Fixed::<12, PerThread>::NAME,
    Fixed::<8, PerThread>::NAME,
];

/// Returns the size of a scene in a format's numbers, as quantisation would scale it: a power of two, half of the limit
/// of fixed point; 1 in floats.
pub fn span<S: Number>() -> f64 {
    match S::FRACTION_BITS {
        None => 1.0,
        Some(_) => libm::exp2(libm::round(libm::log2(S::MAX.to_f64())) - 1.0),
    }
}

/// Returns how far hits may be off their shapes in a scene of size [`span`].
pub fn slack<S: Number>() -> S {
    S::from_f64(S::SLACK * span::<S>())
}

/// Returns the nearest vector of a format.
pub fn vector<S: Number>(v: [f64; 3]) -> Vec3<S> {
    v.map(S::from_f64).into()
}

/// Returns the exact values of a vector.
pub fn exactly<S: Number>(v: Vec3<S>) -> Exact3 {
    v.to_array().map(S::exact)
}

/// Returns a vector as `f64`.
pub fn floats<S: Number>(v: Vec3<S>) -> [f64; 3] {
    v.to_array().map(S::to_f64)
}

/// Returns a unit vector of a format, computed by the format's own normalisation, as all directions are.
pub fn direction<S: Number>(v: [f64; 3]) -> Vec3<S> {
    // Directions are normalised from lengths of the scene, for which a format has all its digits.
    let scale = span::<S>() / 4.0;
    vector::<S>(v.map(|c| c * scale)).unit().0
}

/// Returns the ray from `origin` along `direction`.
pub fn ray<S: Number>(origin: [f64; 3], direction: Vec3<S>) -> Ray<S> {
    Ray::new(vector(origin), direction)
}

/// Returns the result of `work` and the number of its saturations on this thread.
pub fn counted<T>(work: impl FnOnce() -> T) -> (T, u32) {
    let (result, count) = saturation::counted(work);
    (result, u32::try_from(count).unwrap_or(u32::MAX))
}
