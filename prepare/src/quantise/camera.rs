//! Converts the parsed camera to the tracer's, and finds the pixels that can show anything.

use super::extent::shape_box;
use super::{Extent, Placement, vector};
use crate::samples::Adaptive;
use crate::settings::RenderSettings;
use octray_core::camera::{Camera, Projection};
use octray_core::frame::{Frame, Region};
use octray_core::quantize::Quantize;
use octray_scenes::model::{self, Point, Scene};
use octray_scenes::point::{add, cross, dot, times};

/// The camera in scene units; the picture spans −1 … 1 in both directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rays {
    origin: Point,
    forward: Point,
    right: Point,
    up: Point,
    parallel: bool,
}

const CORNERS: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

impl Rays {
    /// Whether the rays are parallel.
    pub(super) const fn is_parallel(&self) -> bool {
        self.parallel
    }

    /// Returns the least distance between neighbouring rays of a picture of this many columns and rows: in radians, or
    /// in scene units if the rays are parallel.
    pub(super) fn pixel(&self, (width, height): (u32, u32)) -> f64 {
        let steps = [
            times(self.right, 2.0 / f64::from(width)),
            times(self.up, 2.0 / f64::from(height)),
        ];
        if self.parallel {
            return length(steps[0]).min(length(steps[1]));
        }
        // The least angle is in a corner.
        let mut least = f64::INFINITY;
        for [x, y] in CORNERS {
            let ray = add(self.forward, add(times(self.right, x), times(self.up, y)));
            for step in steps {
                least = least.min(length(cross(step, ray)) / dot(ray, ray));
            }
        }
        least
    }

    /// Returns the same camera turned by an angle, anticlockwise as seen from above, about a unit axis through a point.
    fn turned(self, angle: f64, centre: Point, axis: Point) -> Self {
        let (sine, cosine) = angle.sin_cos();
        // Rodrigues' formula.
        let turn = |v: Point| {
            let along = times(axis, dot(axis, v) * (1.0 - cosine));
            add(add(times(v, cosine), times(cross(axis, v), sine)), along)
        };
        let away = add(self.origin, times(centre, -1.0));
        Self {
            origin: add(centre, turn(away)),
            forward: turn(self.forward),
            right: turn(self.right),
            up: turn(self.up),
            parallel: self.parallel,
        }
    }

    /// Returns the places where rays can start.
    pub(super) fn starts(&self) -> Vec<Point> {
        if !self.parallel {
            return vec![self.origin];
        }
        CORNERS
            .into_iter()
            .map(|[x, y]| add(self.origin, add(times(self.right, x), times(self.up, y))))
            .collect()
    }
}

impl RenderSettings {
    /// Returns the columns and rows of the picture of a scene.
    pub fn size_of(&self, scene: &Scene) -> (u32, u32) {
        self.size.unwrap_or((scene.width, scene.height))
    }

    pub(super) fn rays(&self, scene: &Scene) -> Rays {
        let rays = self.still_rays(scene);
        if self.orbit == 0.0 {
            return rays;
        }
        let (centre, axis) = match scene.camera {
            model::Camera::Nff { at, up, .. } => (at, up),
            model::Camera::Thesis { .. } => (median(scene), [0.0, 1.0, 0.0]),
        };
        rays.turned(self.orbit.to_radians(), centre, unit(axis))
    }

    /// Returns the camera as it is in the file.
    fn still_rays(&self, scene: &Scene) -> Rays {
        let (width, height) = self.size_of(scene);
        let (half_width, half_height) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
        match scene.camera {
            model::Camera::Thesis {
                viewpoint,
                projection,
            } => {
                let pixel = f64::from(scene.height) / f64::from(height);
                let parallel = projection == model::Projection::Parallel;
                let (origin, forward) = if parallel {
                    ([0.0, 0.0, viewpoint[2]], [0.0, 0.0, -viewpoint[2].signum()])
                } else {
                    (viewpoint, times(viewpoint, -1.0))
                };
                Rays {
                    origin,
                    forward,
                    right: [half_width * pixel, 0.0, 0.0],
                    up: [0.0, half_height * pixel, 0.0],
                    parallel,
                }
            }
            model::Camera::Nff {
                from,
                at,
                up,
                angle,
                projection,
            } => {
                let look = add(at, times(from, -1.0));
                let distance = length(look);
                let forward = times(look, 1.0 / distance);
                let right = unit(cross(forward, up));
                let up = cross(right, forward);
                let rows = f64::from(height.max(2) - 1);
                let parallel = projection == model::Projection::Parallel;
                let step = 2.0 * (angle.to_radians() / 2.0).tan() / rows
                    * if parallel { distance } else { 1.0 };
                Rays {
                    origin: from,
                    forward,
                    right: times(right, step * half_width),
                    up: times(up, step * half_height),
                    parallel,
                }
            }
        }
    }

    pub(super) fn frame<S: Quantize>(
        &self,
        rays: &Rays,
        scene: &Scene,
        extent: &Extent,
        placement: &Placement,
    ) -> Frame<S> {
        let (width, height) = self.size_of(scene);
        let block = self.pixels_per_ray.side();
        let camera = if rays.parallel {
            Camera {
                origin: vector(placement.point(rays.origin)),
                forward: vector(rays.forward),
                right: vector(rays.right.map(|c| placement.length(c))),
                up: vector(rays.up.map(|c| placement.length(c))),
                projection: Projection::Parallel,
            }
        } else {
            // No component of their sum exceeds [−1, 1].
            let fit = 1.0 / (length(rays.forward) + length(rays.right) + length(rays.up));
            Camera {
                origin: vector(placement.point(rays.origin)),
                forward: vector(times(rays.forward, fit)),
                right: vector(times(rays.right, fit)),
                up: vector(times(rays.up, fit)),
                projection: Projection::Perspective,
            }
        };
        // Directions rounded to a few bits can miss their pixel by several pixels.
        let margin = |pixels: u32| {
            let bits = S::FRACTION_BITS.unwrap_or(20) as i32;
            1.0 + (f64::from(pixels) * 2f64.powi(3 - bits)).ceil()
        };
        let region = match scene.zenith {
            Some(_) => whole(width, height),
            None => active(
                rays,
                extent,
                width,
                height,
                margin(width),
                margin(height),
                block,
            ),
        };
        let samples = self.adaptive.map_or(self.samples, Adaptive::side);
        Frame::new(camera, width, height, block, samples, region)
    }
}

/// Returns the place that has as many objects' middles on either side, along each axis. Other than the middle of all, it
/// does not depend on how far a floor reaches.
fn median(scene: &Scene) -> Point {
    [0, 1, 2].map(|axis| {
        let boxes = scene
            .objects
            .iter()
            .map(|object| shape_box(scene, &object.shape));
        let mut middles: Vec<_> = boxes
            .map(|[low, high]| f64::midpoint(low[axis], high[axis]))
            .collect();
        middles.sort_by(f64::total_cmp);
        middles.get(middles.len() / 2).copied().unwrap_or(0.0)
    })
}

/// Returns all pixels.
fn whole(width: u32, height: u32) -> Region {
    Region {
        columns: 0..width,
        rows: 0..height,
    }
}

/// Returns the rectangle of pixels onto which the objects' box is projected; all pixels if the box extends behind the
/// eye's plane.
fn active(
    rays: &Rays,
    extent: &Extent,
    width: u32,
    height: u32,
    margin_x: f64,
    margin_y: f64,
    block: u32,
) -> Region {
    let nothing = Region {
        columns: 0..0,
        rows: 0..0,
    };
    let all = whole(width, height);
    let [low, high] = extent.objects;
    if low[0] > high[0] {
        return nothing;
    }
    // p − origin = a forward + b right + c up by Cramer's rule.
    let volume = dot(cross(rays.right, rays.up), rays.forward);
    let slack = extent.diagonal() * 1e-6;
    let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let (mut before, mut behind) = (0, 0);
    for corner in 0..8 {
        let p = [0, 1, 2].map(|i| {
            let side = if corner >> i & 1 == 0 {
                low[i] - slack
            } else {
                high[i] + slack
            };
            side - rays.origin[i]
        });
        let a = dot(cross(rays.right, rays.up), p) / volume;
        let b = dot(cross(rays.up, rays.forward), p) / volume;
        let c = dot(cross(rays.forward, rays.right), p) / volume;
        if a <= 0.0 {
            behind += 1;
        } else {
            before += 1;
        }
        let depth = if rays.parallel { 1.0 } else { a };
        let (x, y) = (b / depth, c / depth);
        least = [least[0].min(x), least[1].min(y)];
        most = [most[0].max(x), most[1].max(y)];
    }
    if before == 0 {
        return nothing;
    }
    if behind > 0 && !rays.parallel {
        return all;
    }
    let (w, h) = (f64::from(width), f64::from(height));
    let start = |x: f64, size: f64, margin: f64| {
        let pixel = ((x + 1.0) / 2.0 * size - margin).floor().clamp(0.0, size) as u32;
        pixel - pixel % block
    };
    let end = |x: f64, size: f64, margin: f64| {
        let pixel = ((x + 1.0) / 2.0 * size + margin).ceil().clamp(0.0, size) as u32;
        pixel.next_multiple_of(block).min(size as u32)
    };
    Region {
        columns: start(least[0], w, margin_x)..end(most[0], w, margin_x),
        rows: start(-most[1], h, margin_y)..end(-least[1], h, margin_y),
    }
}

pub(super) fn length(a: Point) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

pub(super) fn unit(a: Point) -> Point {
    times(a, 1.0 / length(a))
}
