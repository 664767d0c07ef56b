//! The extent of a scene.

use super::camera::starts;
use octray_core::camera::View;
use octray_core::quantize::Quantize;
use octray_core::shape::cone_box;
use octray_core::world::World;
use octray_scenes::model::{Light, Point, Scene, Shape};

/// The box around all objects and the room in which they can move, and the box around everything that takes part in the arithmetic: objects, the places where
/// rays start, and lights that are not far away. In scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Low and high corner of the objects' box; inverted if there are none.
    pub objects: [Point; 2],
    /// Low and high corner of everything.
    pub everything: [Point; 2],
}

impl Extent {
    /// Returns the extent of a scene and its view.
    pub(super) fn of(scene: &Scene, rays: &View) -> Self {
        let nothing = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let mut objects = nothing;
        for object in &scene.objects {
            let [low, high] = shape_box(scene, &object.shape);
            include(&mut objects, low);
            include(&mut objects, high);
        }
        for corner in scene.room.iter().flatten() {
            include(&mut objects, *corner);
        }
        let mut everything = objects;
        for start in starts(rays) {
            include(&mut everything, start);
        }
        let seen = Self {
            objects,
            everything,
        };
        let (middle, reach) = (seen.middle(true), FAR * seen.diagonal());
        for light in &scene.lights {
            let [x, y, z] = [0, 1, 2].map(|i| light.position[i] - middle[i]);
            if reach == 0.0 || x.hypot(y).hypot(z) <= reach {
                include(&mut everything, light.position);
            }
        }
        Self {
            objects,
            everything,
        }
    }

    /// Returns the extent of boxes of objects.
    pub(super) fn around(boxes: impl Iterator<Item = [Point; 2]>) -> Self {
        let mut all = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for [low, high] in boxes {
            include(&mut all, low);
            include(&mut all, high);
        }
        Self {
            objects: all,
            everything: all,
        }
    }

    /// Whether a light is so far away that its place takes no part in the arithmetic.
    pub(super) fn is_far(&self, light: &Light) -> bool {
        let [low, high] = self.everything;
        (0..3).any(|i| !(low[i]..=high[i]).contains(&light.position[i]))
    }

    /// Returns the largest distance between two points.
    pub fn diagonal(&self) -> f64 {
        let [low, high] = self.everything;
        let [x, y, z] = [0, 1, 2].map(|i| high[i] - low[i]);
        x.hypot(y).hypot(z)
    }

    /// Returns the place of everything in the numbers of format `S`. In floating point, the middle of the objects is where
    /// numbers are finest.
    pub fn world<S: Quantize>(&self) -> World {
        let [low, high] = self.everything;
        World {
            centre: self.middle(S::FRACTION_BITS.is_some()),
            ..World::around::<S>(low, high)
        }
    }

    /// Returns the middle of the objects; that of everything if asked for or if there are no objects.
    pub fn middle(&self, everything: bool) -> Point {
        let [low, high] = if everything || self.objects[0][0] > self.objects[1][0] {
            self.everything
        } else {
            self.objects
        };
        [0, 1, 2].map(|i| low[i] / 2.0 + high[i] / 2.0)
    }
}

/// A light is far away at this many diagonals of what is seen: nearer, its place takes three bits at most.
const FAR: f64 = 8.0;

fn include(bounds: &mut [Point; 2], p: Point) {
    for (i, x) in p.into_iter().enumerate() {
        bounds[0][i] = bounds[0][i].min(x);
        bounds[1][i] = bounds[1][i].max(x);
    }
}

/// Returns the box around a shape.
pub(super) fn shape_box(scene: &Scene, shape: &Shape) -> [Point; 2] {
    match *shape {
        Shape::Sphere { centre, radius } => {
            [centre.map(|c| c - radius), centre.map(|c| c + radius)]
        }
        Shape::Cuboid { centre, size } => [
            [0, 1, 2].map(|i| centre[i] - size[i] / 2.0),
            [0, 1, 2].map(|i| centre[i] + size[i] / 2.0),
        ],
        Shape::Cone {
            base,
            base_radius,
            top,
            top_radius,
        } => cone_box(base, base_radius, top, top_radius),
        Shape::Polygon { first, count } | Shape::Patch { first, count, .. } => {
            let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
            for vertex in &scene.vertices[first as usize..][..count as usize] {
                include(&mut bounds, *vertex);
            }
            bounds
        }
    }
}
