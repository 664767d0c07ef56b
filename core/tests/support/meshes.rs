//! Closed meshes and height fields, and rays to the edges and corners that their faces share.

use fastrand::Rng;
use octray_core::quantize::Quantize;
use octray_core::ray::Ray;
use octray_core::world::World;
use octray_scenes::point::{add, times};
use std::f64::consts::TAU;
use std::fmt::Write;

type Point = [f64; 3];

/// Polygons that leave no gap, seen from where none of them hides behind its own edge.
pub(crate) struct Mesh {
    /// The scene file.
    pub(crate) text: String,
    /// Pairs of ends.
    edges: Vec<[Point; 2]>,
    /// Where rays come from: a place, or for a height field a height.
    from: From,
}

enum From {
    Inside(Point),
    Above(f64),
}

impl Mesh {
    /// Another mesh for each seed: rooms, balls of triangles and height fields, of any size, anywhere.
    pub(crate) fn new(seed: u64) -> Self {
        let mut rng = Rng::with_seed(seed);
        let scale = 10f64.powf(6.0 * rng.f64() - 3.0);
        let middle = [(); 3].map(|()| scale * 2.0 * (rng.f64() - 0.5));
        // Turned by any angle, or not at all: then rays run in the planes of axes.
        let turned = seed.is_multiple_of(2);
        let turn = [(); 3].map(|()| if turned { TAU * rng.f64() } else { 0.0 });
        let stretch = [(); 3].map(|()| scale * (0.4 + 0.6 * rng.f64()));
        let place = |p: Point| {
            let p = [0, 1, 2].map(|i| p[i] * stretch[i]);
            add(middle, rotate(p, turn))
        };
        let (faces, from) = match seed % 3 {
            0 => (room(), From::Inside(middle)),
            1 => (ball(&mut rng), From::Inside(middle)),
            _ => return Self::height_field(&mut rng, scale),
        };
        let faces: Vec<Vec<Point>> = (faces.into_iter())
            .map(|face| face.into_iter().map(place).collect())
            .collect();
        Self::of(&faces, from)
    }

    /// Quads of two triangles over whole numbers, times the scale.
    fn height_field(rng: &mut Rng, scale: f64) -> Self {
        const N: usize = 6;
        let heights: Vec<f64> = (0..(N + 1) * (N + 1)).map(|_| rng.f64()).collect();
        let at = |x: usize, y: usize| {
            let height = heights[y * (N + 1) + x];
            [x as f64, y as f64, height].map(|c| c * scale)
        };
        let mut faces = Vec::new();
        for (x, y) in (0..N).flat_map(|y| (0..N).map(move |x| (x, y))) {
            faces.push(vec![at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            faces.push(vec![at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
        }
        let mut mesh = Self::of(&faces, From::Above(3.0 * scale));
        // Along the rim there is a gap.
        let inside = |p: &Point| {
            [p[0], p[1]]
                .iter()
                .all(|c| (0.5..N as f64 - 0.5).contains(&(c / scale)))
        };
        mesh.edges.retain(|ends| ends.iter().all(inside));
        mesh
    }

    fn of(faces: &[Vec<Point>], from: From) -> Self {
        let mut text = String::from("v 0 0 3 at 0 0 0 up 0 1 0 angle 40\nl 2 3 4 1\n");
        text += "f 0.1 0.1 0.1 0.5 0.5 0.5 0.3 0.3 0.3 20 0 0\n";
        let mut edges = Vec::new();
        for face in faces {
            let _ = writeln!(text, "p {}", face.len());
            for (a, b) in face.iter().zip(face.iter().cycle().skip(1)) {
                let _ = writeln!(text, "{} {} {}", a[0], a[1], a[2]);
                edges.push([*a, *b]);
            }
        }
        Self { text, edges, from }
    }

    /// A ray to a point of an edge, to a corner now and then.
    pub(crate) fn ray<S: Quantize>(&self, world: &World, rng: &mut Rng) -> Ray<S> {
        let [a, b] = self.edges[rng.usize(..self.edges.len())];
        let share = match rng.u8(..4) {
            0 => 0.0,
            1 => 0.5,
            _ => rng.f64(),
        };
        let to = add(times(a, 1.0 - share), times(b, share));
        let point = |p: Point| world.place::<S>(p);
        let origin = match self.from {
            From::Inside(p) => add(p, times([0.3, 0.1, -0.2], rng.f64() * self.size() * 0.2)),
            From::Above(height) => [to[0], to[1], height],
        };
        let (origin, to) = (point(origin), point(to));
        Ray::new(origin, (to - origin).unit().0)
    }

    /// The length of an edge.
    fn size(&self) -> f64 {
        let [a, b] = self.edges[0];
        (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
    }
}

/// The faces of a cube.
fn room() -> Vec<Vec<Point>> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            faces.push(
                corners
                    .map(|[u, v]| {
                        let mut p = [side; 3];
                        (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (u, v);
                        p
                    })
                    .to_vec(),
            );
        }
    }
    faces
}

/// Triangles between rings of points on a sphere.
fn ball(rng: &mut Rng) -> Vec<Vec<Point>> {
    let (rings, sides) = (2 + rng.usize(..4), 3 + rng.usize(..6));
    let at = |ring: usize, side: usize| {
        let height = (ring as f64 / (rings + 1) as f64 * TAU / 2.0).cos();
        let around = (side % sides) as f64 / sides as f64 * TAU;
        let radius = (1.0 - height * height).max(0.0).sqrt();
        [radius * around.cos(), radius * around.sin(), height]
    };
    let mut faces = Vec::new();
    for side in 0..sides {
        faces.push(vec![[0.0, 0.0, 1.0], at(1, side), at(1, side + 1)]);
        faces.push(vec![[0.0, 0.0, -1.0], at(rings, side + 1), at(rings, side)]);
        for ring in 1..rings {
            let (a, b) = (at(ring, side), at(ring, side + 1));
            let (c, d) = (at(ring + 1, side), at(ring + 1, side + 1));
            faces.push(vec![a, c, b]);
            faces.push(vec![b, c, d]);
        }
    }
    faces
}

/// Turns about z, y and x.
fn rotate(mut p: Point, turn: Point) -> Point {
    for (axis, angle) in turn.into_iter().enumerate() {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let (sin, cos) = angle.sin_cos();
        (p[u], p[v]) = (p[u] * cos - p[v] * sin, p[u] * sin + p[v] * cos);
    }
    p
}
