//! Light as a number.

use super::Scalar;

/// A number format that light is computed in: 0 is dark, 1 full intensity.
pub trait Intensity: Scalar {
    /// The 8-bit level of an intensity: ⌊255 · clamp(self, 0, 1) + ½⌋.
    fn level(self) -> u8;

    /// The sum of a pixel's light so far and one more contribution. Fixed point stops at 1, where
    /// the result is clamped anyway, so that any number of contributions ≥ 0 has room.
    fn accumulate(self, light: Self) -> Self;

    /// `self` raised to `exponent`, for 0 ≤ `self` ≤ 1; 0⁰ is 1.
    fn power(self, exponent: Exponent<Self>) -> Self;
}

/// An exponent ≥ 0, split so that the whole part is done by repeated squaring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exponent<S> {
    /// ⌊exponent⌋.
    pub whole: u32,
    /// What is left, in [0, 1).
    pub fraction: S,
}
