//! The outlines of polygons, cut into bands.

use crate::scalar::Scalar;

/// A polygon's extent along the second projected axis, cut into equal bands, each with the edges
/// that pass through it: a point is tested against a few edges even if there are hundreds.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Bands<S: Scalar> {
    /// The first band's place in [`Outlines::bands`].
    pub first: u32,
    /// How many bands there are; none for a polygon of few edges, which is tested edge by edge.
    pub count: u32,
    /// Where the lowest band begins.
    pub low: S,
    /// The reciprocal of the height of all bands together.
    pub scale: S::Reciprocal,
}

impl<S: Scalar> Bands<S> {
    /// No bands, for a polygon of this extent.
    pub(super) fn none(low: S, high: S) -> Self {
        Self {
            first: 0,
            count: 0,
            low,
            scale: (high - low).reciprocal(),
        }
    }

    /// The band that holds height `v`; a higher point is never in a lower band.
    #[inline(always)]
    pub fn of(&self, v: S) -> u32 {
        let share = (v - self.low).times_reciprocal(self.scale);
        let last = self.count.saturating_sub(1);
        share
            .max(S::ZERO)
            .min(S::ONE)
            .scale_to_index(self.count)
            .min(last)
    }
}

/// The outlines of polygons.
#[derive(Clone, Copy, Debug)]
pub struct Outlines<'a, S> {
    /// The vertices of all polygons, each projected along its polygon's axis.
    pub corners: &'a [[S; 2]],
    /// Where each band's edges begin in `edges`, and after a polygon's last band where they end.
    pub bands: &'a [u32],
    /// Edges, band by band, lower end first.
    pub edges: &'a [[[S; 2]; 2]],
}
