//! The polygon of any number of vertices.

use super::bands::{Bands, Outlines};
use super::even_odd::{Outline, meets_edge};
use super::plane::Plane;
use crate::observe::Observer;
use crate::ray::{Aabb, Ray};
use crate::scalar::{Scalar, Tolerance};

/// A polygon of any number of vertices, convex or not.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Polygon<S: Scalar> {
    /// Its plane.
    pub plane: Plane<S>,
    /// Its first vertex in [`Outlines::corners`].
    pub first: u32,
    /// How many vertices it has.
    pub count: u32,
    /// The box that all hits lie in.
    pub bounds: Aabb<S>,
    /// Which of its edges can matter at a given height.
    pub bands: Bands<S>,
}

impl<S: Tolerance> Polygon<S> {
    #[inline(always)]
    pub(super) fn hit<O: Observer>(
        &self,
        ray: &Ray<S>,
        limit: S,
        slack: S,
        outlines: &Outlines<'_, S>,
        observer: &mut O,
    ) -> Option<S> {
        let t = self.plane.hit(ray, limit)?;
        let point = ray.at(t);
        if !self.bounds.contains(point) {
            return None;
        }
        let p = self.plane.project(point);
        let outline = if self.bands.count == 0 {
            Outline::Corners(self.corners(outlines.corners)?)
        } else {
            let band = (self.bands.first + self.bands.of(p[1])) as usize;
            let (start, end) = (outlines.bands.get(band)?, outlines.bands.get(band + 1)?);
            Outline::Band(outlines.edges.get(*start as usize..*end as usize)?)
        };
        observer.edges(outline.len());
        let meets = outline.encloses(p) || meets_edge(&self.plane, outline, ray, t, slack);
        meets.then_some(t)
    }

    /// Its vertices, projected.
    #[inline(always)]
    pub(crate) fn corners<'a>(&self, corners: &'a [[S; 2]]) -> Option<&'a [[S; 2]]> {
        corners
            .get(self.first as usize..)?
            .get(..self.count as usize)
    }
}
