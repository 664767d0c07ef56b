//! Quotients of whole numbers.

use super::Scalar;

/// A number format that divides whole numbers: for the place of a sample in a picture.
pub trait Ratio: Scalar {
    /// The reciprocal of a whole number, 1 ≤ `n` < 2³¹, for [`Ratio::ratio`].
    fn whole_reciprocal(n: u32) -> Self::Reciprocal;

    /// `numerator / n` for |numerator| ≤ 8 n, rounded to nearest, given `n`'s
    /// [`Ratio::whole_reciprocal`].
    fn ratio(numerator: i32, n: Self::Reciprocal) -> Self;
}
