//! The polygon of any number of vertices.

use super::bands::{Bands, Outlines};
use super::even_odd::{Outline, meets_edge};
use super::plane::Plane;
use crate::observe::Observer;
use crate::quantize::Quantize;
use crate::ray::{Aabb, Ray};
use crate::scalar::{Scalar, Tolerance};
use crate::world::{World, box_of};

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

impl<S: Quantize> Polygon<S> {
    /// The polygon of these vertices, in scene units and in order, three or more. Its projected vertices are written to
    /// `corners`, which has as many elements, and are [`Outlines::corners`] from `first` on. It has no bands: every test
    /// looks at all of its edges.
    ///
    /// Vertices that are off their plane widen the box. Of vertices in one line it is a polygon that no ray meets.
    pub fn new(world: &World, vertices: &[[f64; 3]], first: u32, corners: &mut [[S; 2]]) -> Self {
        let (plane, off_plane) = Plane::through(world, vertices);
        for (corner, vertex) in corners.iter_mut().zip(vertices) {
            *corner = plane.corner(world, vertex);
        }
        // Rounding tilts the plane by up to one step per unit of length.
        let bounds = world.bounds(box_of(vertices), 2.0 * off_plane);
        let (_, v) = plane.axis.others();
        Self {
            plane,
            first,
            count: vertices.len() as u32,
            bounds,
            bands: Bands::none(bounds.low[v], bounds.high[v]),
        }
    }
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
