//! Both cameras: they turn a point of the picture into a ray.

use super::read::View;
use super::vector::{Ray, V3};

/// A camera for a picture of a given size.
#[derive(Debug)]
pub(super) struct Camera {
    width: u32,
    height: u32,
    parallel: bool,
    /// The viewpoint (perspective), or the start of the ray through the middle of the picture
    /// (parallel).
    origin: V3,
    /// From the viewpoint to the middle of the picture.
    forward: V3,
    /// From a pixel to its right neighbour.
    right: V3,
    /// From a pixel to its upper neighbour.
    up: V3,
}

impl Camera {
    /// Returns the camera of a view, with another size than the file's if given.
    pub(super) fn new(view: &View, size: Option<(u32, u32)>) -> Self {
        let (width, height) = size.unwrap_or((view.width, view.height));
        assert!(width > 0 && height > 0, "the picture has no pixels");
        let from = view.from;
        let (origin, forward, right, up) = if let Some(aim) = &view.aim {
            let f = (aim.at - from).unit();
            let r = f.cross(aim.up).unit();
            let u = r.cross(f);
            let rows = if height == 1 {
                1.0
            } else {
                f64::from(height - 1)
            };
            let mut s = 2.0 * (aim.angle.to_radians() / 2.0).tan() / rows;
            if view.parallel {
                s *= (aim.at - from).length();
            }
            (from, f, r * s, u * s)
        } else {
            assert!(from.z != 0.0, "the viewpoint lies in the picture plane");
            let unit = f64::from(view.height) / f64::from(height);
            let (right, up) = (V3::new(unit, 0.0, 0.0), V3::new(0.0, unit, 0.0));
            if view.parallel {
                (
                    V3::new(0.0, 0.0, from.z),
                    V3::new(0.0, 0.0, -from.z.signum()),
                    right,
                    up,
                )
            } else {
                (from, -from, right, up)
            }
        };
        Self {
            width,
            height,
            parallel: view.parallel,
            origin,
            forward,
            right,
            up,
        }
    }

    /// Returns width and height in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Returns the ray through a point of the picture: `x` from the left edge, `y` from the top, in pixels. The centre
    /// of the first pixel is (½, ½).
    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let across = self.right * (x - f64::from(self.width) / 2.0)
            + self.up * (f64::from(self.height) / 2.0 - y);
        if self.parallel {
            Ray::new(self.origin + across, self.forward)
        } else {
            Ray::new(self.origin, self.forward + across)
        }
    }
}
