//! The camera: from a place in the picture to a ray.

use crate::quantize::Quantize;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vec3::Vec3;
use crate::world::{World, length, unit, vector};

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

/// A camera in scene units. The picture spans −1 … 1 from left to right and from bottom to top.
///
/// ```
/// use octray_core::camera::{Projection, View};
/// use octray_core::scalar::Fixed;
/// use octray_core::world::World;
///
/// let (eye, at, up) = ([0.0, 3.0, 9.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
/// let view = View::look(eye, at, up, 40.0, (64, 48), Projection::Perspective);
/// let world = World::around::<Fixed<16>>([-9.0, 0.0, -9.0], [9.0, 9.0, 9.0]);
/// let camera = view.camera::<Fixed<16>>(&world);
/// assert_eq!(camera.origin, world.place(eye));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye, or the middle of the plane where parallel rays start.
    pub origin: [f64; 3],
    /// From the eye to the middle of the picture, in the scale of `right` and `up`; parallel: the unit direction of all
    /// rays.
    pub forward: [f64; 3],
    /// From the middle of the picture to its right border.
    pub right: [f64; 3],
    /// From the middle of the picture to its upper border.
    pub up: [f64; 3],
    /// How rays leave.
    pub projection: Projection,
}

impl View {
    /// The camera of NFF: the eye `from` looks at `at`, with `up` to the top of a picture of so many columns and rows.
    /// `angle`, in degrees below 180, lies between the middles of the lowest and the highest row. With parallel rays the
    /// picture is as high as it would be at the distance of `at`.
    ///
    /// `from` and `at` differ, and `up` is not along the line between them.
    pub fn look(
        from: [f64; 3],
        at: [f64; 3],
        up: [f64; 3],
        angle: f64,
        (width, height): (u32, u32),
        projection: Projection,
    ) -> Self {
        let look = Vec3::from(at) - Vec3::from(from);
        let distance = length(look);
        let forward = look * (1.0 / distance);
        let right = unit(forward.cross(up.into()));
        let up = right.cross(forward);
        let rows = f64::from(height.max(2) - 1);
        let scale = match projection {
            Projection::Perspective => 1.0,
            Projection::Parallel => distance,
        };
        let step = 2.0 * libm::tan(angle.to_radians() / 2.0) / rows * scale;
        Self {
            origin: from,
            forward: forward.to_array(),
            right: (right * (step * (f64::from(width) / 2.0))).to_array(),
            up: (up * (step * (f64::from(height) / 2.0))).to_array(),
            projection,
        }
    }

    /// The camera in the numbers of a format.
    pub fn camera<S: Quantize>(&self, world: &World) -> Camera<S> {
        let Self {
            forward, right, up, ..
        } = *self;
        let origin = world.place(self.origin);
        let projection = self.projection;
        let [forward, right, up] = match projection {
            Projection::Parallel => {
                let length = |v: [f64; 3]| vector(v.map(|x| world.length(x)));
                [vector(forward), length(right), length(up)]
            }
            Projection::Perspective => {
                // No component of their sum exceeds [−1, 1].
                let sum = [forward, right, up].map(|v| length(v.into()));
                let fit = 1.0 / (sum[0] + sum[1] + sum[2]);
                [forward, right, up].map(|v| vector(v.map(|x| x * fit)))
            }
        };
        Camera {
            origin,
            forward,
            right,
            up,
            projection,
        }
    }
}

impl<S: Scalar> Camera<S> {
    /// The places where rays of the picture start: the eye, or the corners of the plane.
    pub(crate) fn starts(&self) -> [Vec3<S>; 4] {
        let Self {
            origin, right, up, ..
        } = *self;
        match self.projection {
            Projection::Perspective => [origin; 4],
            Projection::Parallel => {
                [up + right, up - right, right - up, -up - right].map(|to| origin + to)
            }
        }
    }

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
