//! Converts the parsed camera to the tracer's, and finds the pixels that can show anything.

use super::Extent;
use super::extent::shape_box;
use crate::samples::Adaptive;
use crate::settings::RenderSettings;
use octray_core::camera::{Projection, View};
use octray_core::frame::{Frame, Region};
use octray_core::quantize::Quantize;
use octray_core::world::World;
use octray_scenes::model::{self, Point, Scene};
use octray_scenes::point::{add, cross, dot, times};

/// Returns a projection as the core has it.
const fn of_core(projection: model::Projection) -> Projection {
    match projection {
        model::Projection::Perspective => Projection::Perspective,
        model::Projection::Parallel => Projection::Parallel,
    }
}

const CORNERS: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

/// Whether the rays are parallel.
pub(super) fn is_parallel(view: &View) -> bool {
    view.projection == Projection::Parallel
}

/// Returns the least distance between neighbouring rays of a picture of this many columns and rows: in radians, or
/// in scene units if the rays are parallel.
pub(super) fn pixel(view: &View, (width, height): (u32, u32)) -> f64 {
    let steps = [
        times(view.right, 2.0 / f64::from(width)),
        times(view.up, 2.0 / f64::from(height)),
    ];
    if is_parallel(view) {
        return length(steps[0]).min(length(steps[1]));
    }
    // The least angle is in a corner.
    let mut least = f64::INFINITY;
    for [x, y] in CORNERS {
        let ray = add(view.forward, add(times(view.right, x), times(view.up, y)));
        for step in steps {
            least = least.min(length(cross(step, ray)) / dot(ray, ray));
        }
    }
    least
}

/// Returns the places where rays can start.
pub(super) fn starts(view: &View) -> Vec<Point> {
    if !is_parallel(view) {
        return vec![view.origin];
    }
    CORNERS
        .into_iter()
        .map(|[x, y]| add(view.origin, add(times(view.right, x), times(view.up, y))))
        .collect()
}

/// Returns the same camera turned by an angle, anticlockwise as seen from above, about a unit axis through a point.
fn turned(view: View, angle: f64, centre: Point, axis: Point) -> View {
    let (sine, cosine) = angle.sin_cos();
    // Rodrigues' formula.
    let turn = |v: Point| {
        let along = times(axis, dot(axis, v) * (1.0 - cosine));
        add(add(times(v, cosine), times(cross(axis, v), sine)), along)
    };
    let away = add(view.origin, times(centre, -1.0));
    View {
        origin: add(centre, turn(away)),
        forward: turn(view.forward),
        right: turn(view.right),
        up: turn(view.up),
        projection: view.projection,
    }
}

impl RenderSettings {
    /// Returns the columns and rows of the picture of a scene.
    pub fn size_of(&self, scene: &Scene) -> (u32, u32) {
        self.size.unwrap_or((scene.width, scene.height))
    }

    pub(super) fn rays(&self, scene: &Scene) -> View {
        let rays = self.still_rays(scene);
        if self.orbit == 0.0 {
            return rays;
        }
        let (centre, axis) = match scene.camera {
            model::Camera::Nff { at, up, .. } => (at, up),
            model::Camera::Thesis { .. } => (median(scene), [0.0, 1.0, 0.0]),
        };
        turned(rays, self.orbit.to_radians(), centre, unit(axis))
    }

    /// Returns the camera as it is in the file.
    fn still_rays(&self, scene: &Scene) -> View {
        let (width, height) = self.size_of(scene);
        let (half_width, half_height) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
        match scene.camera {
            model::Camera::Thesis {
                viewpoint,
                projection,
            } => {
                let pixel = f64::from(scene.height) / f64::from(height);
                let (origin, forward) = if projection == model::Projection::Parallel {
                    ([0.0, 0.0, viewpoint[2]], [0.0, 0.0, -viewpoint[2].signum()])
                } else {
                    (viewpoint, times(viewpoint, -1.0))
                };
                View {
                    origin,
                    forward,
                    right: [half_width * pixel, 0.0, 0.0],
                    up: [0.0, half_height * pixel, 0.0],
                    projection: of_core(projection),
                }
            }
            model::Camera::Nff {
                from,
                at,
                up,
                angle,
                projection,
            } => View::look(from, at, up, angle, (width, height), of_core(projection)),
        }
    }

    pub(super) fn frame<S: Quantize>(
        &self,
        rays: &View,
        scene: &Scene,
        extent: &Extent,
        world: &World,
    ) -> Frame<S> {
        let (width, height) = self.size_of(scene);
        let block = self.pixels_per_ray.side();
        let camera = rays.camera(world);
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
    rays: &View,
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
        let depth = if is_parallel(rays) { 1.0 } else { a };
        let (x, y) = (b / depth, c / depth);
        least = [least[0].min(x), least[1].min(y)];
        most = [most[0].max(x), most[1].max(y)];
    }
    if before == 0 {
        return nothing;
    }
    if behind > 0 && !is_parallel(rays) {
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
