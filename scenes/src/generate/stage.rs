//! A scene under construction.

use super::random::unit;
use crate::model::{Camera, Colour, Light, Object, Point, Projection, Scene, Shape, Surface};
use crate::point::{add, dot, times};

/// Collects objects in any order; [`Stage::finish`] sorts them by surface and sets up the rest.
#[derive(Default)]
pub(super) struct Stage {
    surfaces: Vec<Surface>,
    objects: Vec<Object>,
    vertices: Vec<Point>,
    normals: Vec<Point>,
    /// Corners of the box around all points except those of grounds.
    bounds: Option<[Point; 2]>,
}

impl Stage {
    /// Adds a surface and returns its index.
    pub(super) fn surface(&mut self, surface: Surface) -> u32 {
        self.surfaces.push(surface);
        self.surfaces.len() as u32 - 1
    }

    pub(super) fn sphere(&mut self, surface: u32, centre: Point, radius: f64) {
        self.see(centre, radius);
        let shape = Shape::Sphere {
            centre: rounded(centre),
            radius: round(radius),
        };
        self.objects.push(Object { shape, surface });
    }

    pub(super) fn cone(&mut self, surface: u32, base: (Point, f64), top: (Point, f64)) {
        self.see(base.0, base.1);
        self.see(top.0, top.1);
        let shape = Shape::Cone {
            base: rounded(base.0),
            base_radius: round(base.1),
            top: rounded(top.0),
            top_radius: round(top.1),
        };
        self.objects.push(Object { shape, surface });
    }

    pub(super) fn cuboid(&mut self, surface: u32, centre: Point, size: Point) {
        self.see(centre, size.into_iter().fold(0.0, f64::max) / 2.0);
        let shape = Shape::Cuboid {
            centre: rounded(centre),
            size: rounded(size),
        };
        self.objects.push(Object { shape, surface });
    }

    pub(super) fn polygon(&mut self, surface: u32, vertices: &[Point]) {
        vertices.iter().for_each(|&vertex| self.see(vertex, 0.0));
        self.unseen_polygon(surface, vertices);
    }

    pub(super) fn patch(&mut self, surface: u32, corners: &[(Point, Point)]) {
        corners.iter().for_each(|corner| self.see(corner.0, 0.0));
        let (first, first_normal) = (self.vertices.len() as u32, self.normals.len() as u32);
        self.vertices
            .extend(corners.iter().map(|corner| rounded(corner.0)));
        self.normals
            .extend(corners.iter().map(|corner| rounded(corner.1)));
        let shape = Shape::Patch {
            first,
            count: corners.len() as u32,
            first_normal,
        };
        self.objects.push(Object { shape, surface });
    }

    /// Adds a square at height `z` that extends `half` to each side. The camera need not see all of it.
    pub(super) fn ground(&mut self, surface: u32, z: f64, half: f64) {
        let corners = [
            [-half, -half, z],
            [half, -half, z],
            [half, half, z],
            [-half, half, z],
        ];
        self.unseen_polygon(surface, &corners);
    }

    /// Returns the scene, seen from the direction (0.52, −0.74, 0.42), in afternoon light.
    pub(super) fn finish(self) -> Scene {
        let [low, high] = self.bounds.unwrap_or([[-1.0; 3], [1.0; 3]]);
        let centre = times(add(low, high), 0.5);
        let half = times(add(high, times(low, -1.0)), 0.5);
        let radius = dot(half, half).sqrt();
        let away = |direction: Point, distance: f64| {
            rounded(add(centre, times(unit(direction), distance * radius)))
        };
        let light = |direction, brightness| Light {
            position: away(direction, 6.0),
            colour: [brightness; 3],
        };
        let mut scene = Scene {
            camera: Camera::Nff {
                from: away([0.52, -0.74, 0.42], 2.3),
                at: rounded(centre),
                up: [0.0, 0.0, 1.0],
                angle: 45.0,
                projection: Projection::Perspective,
            },
            width: 512,
            height: 512,
            background: [0.35, 0.52, 0.72],
            zenith: None,
            room: None,
            lights: vec![
                light([0.8, -0.3, 1.0], 0.7),
                light([-0.7, -0.8, 0.9], 0.35),
                light([0.1, 0.9, 1.2], 0.25),
            ],
            surfaces: self.surfaces,
            objects: self.objects,
            vertices: Vec::with_capacity(self.vertices.len()),
            normals: Vec::with_capacity(self.normals.len()),
        };
        // In a file, an object's surface is the last one before it.
        scene.objects.sort_by_key(|object| object.surface);
        for object in &mut scene.objects {
            let (vertices, normals) = (&mut scene.vertices, &mut scene.normals);
            match &mut object.shape {
                Shape::Polygon { first, count } => move_to(vertices, &self.vertices, first, *count),
                Shape::Patch {
                    first,
                    count,
                    first_normal,
                } => {
                    move_to(vertices, &self.vertices, first, *count);
                    move_to(normals, &self.normals, first_normal, *count);
                }
                _ => {}
            }
        }
        scene
    }

    fn unseen_polygon(&mut self, surface: u32, vertices: &[Point]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(vertices.iter().copied().map(rounded));
        let shape = Shape::Polygon {
            first,
            count: vertices.len() as u32,
        };
        self.objects.push(Object { shape, surface });
    }

    fn see(&mut self, point: Point, radius: f64) {
        let [low, high] = self.bounds.get_or_insert([point; 2]);
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis] - radius);
            high[axis] = high[axis].max(point[axis] + radius);
        }
    }
}

/// Returns a glossy surface with a highlight of medium size, which mirrors the share `reflect`.
pub(super) fn glossy(colour: Colour, reflect: f64) -> Surface {
    Surface::glossy(colour, 40.0, reflect)
}

/// A palette: brick, ochre, sand, leaf, sea, sky, plum and chalk.
pub(super) const PALETTE: [Colour; 8] = [
    [0.78, 0.27, 0.2],
    [0.9, 0.6, 0.15],
    [0.87, 0.79, 0.58],
    [0.32, 0.6, 0.28],
    [0.12, 0.5, 0.55],
    [0.25, 0.42, 0.8],
    [0.5, 0.26, 0.5],
    [0.9, 0.9, 0.87],
];

/// Rounds to the `f64` nearest to `number` in six significant digits; to 0 below 1e-16.
fn round(number: f64) -> f64 {
    let size = number.abs();
    let mut shift = 1.0;
    if size < 1e-16 {
        return 0.0;
    }
    while size * shift < 1e5 {
        shift *= 10.0; // Powers of ten are exact up to 1e22.
    }
    // Both are integers, so their quotient is the `f64` nearest to the decimal number.
    (number * shift).round() / shift
}

fn rounded(point: Point) -> Point {
    point.map(round)
}

/// Copies `count` points of `from`, starting at `first`, to the end of `to`, and updates `first`.
fn move_to(to: &mut Vec<Point>, from: &[Point], first: &mut u32, count: u32) {
    let old = *first as usize;
    *first = to.len() as u32;
    to.extend_from_slice(&from[old..old + count as usize]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_digits() {
        let cases = [
            (1.0 / 3.0, "0.333333"),
            (-2.0 / 3.0e4, "-0.0000666667"),
            (123.456789, "123.457"),
            (99999.96, "100000"),
            (1e-20, "0"),
        ];
        for (number, text) in cases {
            assert_eq!(round(number).to_string(), text);
        }
    }
}
