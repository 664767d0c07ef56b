//! How far results can be off.

use super::Scalar;

/// A number format whose rounding is known.
///
/// All bounds are the format's own: floats round relatively to a value, fixed point to steps of one
/// size.
pub trait Tolerance: Scalar {
    /// Whether roots and reciprocals, and with them the lengths of unit vectors, are exact but for
    /// rounding.
    const EXACT_ROOTS: bool;

    /// Whether hits always lie within [`Quantize::SLACK`](crate::quantize::Quantize::SLACK) of the
    /// true surface. Where they do not, a hit's point has to be looked for in its object's box, and
    /// an octree that links objects by exact shape would miss hits that brute force finds.
    const HITS_WITHIN_SLACK: bool;

    /// A bound on how far a computed surface point, refined onto its shape, can lie from that
    /// shape, with a margin for the next ray's own rounding; in lengths of the scene, as are the
    /// operands. `position` is the largest coordinate of the point, `curvature_extent` the size of a
    /// curved shape (0 for flat ones); both ≥ 0.
    ///
    /// New rays start that far off the surface along its normal: an offset that follows from an
    /// error bound holds at every scale (Pharr, Jakob and Humphreys, "Physically Based Rendering",
    /// 3rd edition, section 3.9.5; Wächter and Binder, "A Fast and Robust Method for Avoiding
    /// Self-Intersection", Ray Tracing Gems, 2019).
    fn surface_error(position: Self, curvature_extent: Self) -> Self;

    /// A bound on how far a computed point of a ray can lie from the ray, in each coordinate. `reach` is the largest
    /// coordinate of the ray's origin and of the point.
    fn coordinate_error(reach: Self) -> Self;

    /// A bound on how far from a plane, measured across it, the computed point can lie at which a ray meets it. It
    /// holds for [`Tolerance::rounded_quotient`].
    fn plane_error(reach: Self) -> Self;

    /// `self / divisor`, saturating; exact but for rounding even where [`Scalar::quotient`] is approximate.
    #[inline(always)]
    fn rounded_quotient(self, divisor: Self) -> Self {
        self.quotient(divisor)
    }

    /// The scene's slack; less of it near the origin where rounding is relative. `reach` is the largest coordinate that
    /// takes part.
    #[inline(always)]
    fn slack_near(_reach: Self, slack: Self) -> Self {
        slack
    }

    /// Rounds a distance ≥ 0 up by the maximum rounding error, where rounding is relative (Ize,
    /// "Robust BVH Ray Traversal", JCGT 2013): which of two planes is met first does not hang on a
    /// last bit then. In fixed point quotients are rounded to absolute steps, and two that differ by
    /// less are equal already.
    #[inline(always)]
    fn with_rounding_margin(self) -> Self {
        self
    }
}
