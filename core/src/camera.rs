//! The camera: from a place in the picture to a ray.

use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// How rays leave the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// From one point.
    #[default]
    Perspective,
    /// Side by side.
    Parallel,
}

/// A camera. The picture spans −1 … 1 from left to right and from bottom to top.
///
/// ```
/// use octray_core::camera::{Camera, Projection};
/// use octray_core::vec3::vec3;
///
/// let camera = Camera {
///     origin: vec3(0.0, 0.0, 5.0),
///     forward: vec3(0.0, 0.0, -1.0),
///     right: vec3(0.5, 0.0, 0.0),
///     up: vec3(0.0, 0.5, 0.0),
///     projection: Projection::Perspective,
/// };
/// let middle = camera.row(0.0).ray(0.0);
/// assert_eq!(middle.direction, camera.forward);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Camera<S> {
    /// The eye, or the middle of the plane where parallel rays start.
    pub origin: Vec3<S>,
    /// From the eye to the middle of the picture, in the scale of `right` and `up`; parallel: the
    /// unit direction of all rays.
    pub forward: Vec3<S>,
    /// From the middle of the picture to its right border. In perspective the three are scaled
    /// together so that they fit the format; in parallel this is a length of the scene.
    pub right: Vec3<S>,
    /// From the middle of the picture to its upper border.
    pub up: Vec3<S>,
    /// How rays leave.
    pub projection: Projection,
}

impl<S: Scalar> Camera<S> {
    /// The rays at height `y`, in (−1, 1).
    #[inline(always)]
    pub fn row(&self, y: S) -> RayRow<'_, S> {
        let middle = match self.projection {
            Projection::Perspective => self.forward,
            Projection::Parallel => self.origin,
        };
        RayRow {
            camera: self,
            middle: middle + self.up * y,
        }
    }
}

/// The rays at one height of the picture.
#[derive(Clone, Copy, Debug)]
pub struct RayRow<'a, S> {
    camera: &'a Camera<S>,
    /// From the eye to the middle of the row; parallel: where its middle ray starts.
    middle: Vec3<S>,
}

impl<S: Scalar> RayRow<'_, S> {
    /// The ray through `x`, in (−1, 1).
    #[inline(always)]
    pub fn ray(&self, x: S) -> Ray<S> {
        let place = self.middle + self.camera.right * x;
        match self.camera.projection {
            Projection::Perspective => Ray::new(self.camera.origin, place.unit().0),
            Projection::Parallel => Ray::new(place, self.camera.forward),
        }
    }
}
