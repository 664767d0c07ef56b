//! Rays along the faces of an octree's cells and through their corners.

use super::sphere;
use crate::exact::{Exact, near};
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::number::{self, Number, counted, floats};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::accel::{Accelerator, BuildOptions, LinkBy, OctreeVariant};
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::ray::Ray;
use octray_core::scene::Scene;
use octray_core::shape::{self, Shapes};
use octray_core::vec3::{Axis, Vec3};
use octray_prepare::quantise::Prepared;
use octray_prepare::tree::{Growth, OwnedBvh8, OwnedOctree};
use octray_scenes::model::Shape;

/// Rays along axes and diagonals, or at a slope of 1 to 10⁻⁷ to them, through corners of cells or the same distance
/// beside them. There is a sphere at every other corner. A hit means the right sphere.
#[derive(Debug)]
pub struct Voxel;

/// The octree's root extends from −`HALF` to `HALF` along each axis, in sides of its cells.
const HALF: i32 = 4;
const RADIUS: f64 = 0.3;

impl Sweep for Voxel {
    const ABOUT: About = About {
        name: "voxel",
        title: "Along cells and through corners",
        axis: "1 / slope against the cells' faces",
        unit: "radii in t",
        values: SEVEN_DECADES,
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "boxes of the BVH, entry and exit",
            },
            Form {
                name: "octants",
                label: "cells of the octree, entry and exit",
            },
            Form {
                name: "thesis",
                label: "next cell from the exit point",
            },
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            error: Some(limit(0.01, 0.25)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        lattice().in_pixels_of(1.0 / value)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 3];
        let Some(prepared) = lattice().prepare::<S>() else {
            return all_errors;
        };
        let growth = Growth {
            options: BuildOptions {
                depth: 3,
                leaf_size: 1,
            },
            arena: None,
        };
        // Building a tree sorts the objects.
        let (mut in_bvh, mut in_octree) = (prepared.scene.clone(), prepared.scene.clone());
        let (tight, _) = OwnedBvh8::build(&mut in_bvh, &growth);
        let (octants, _) =
            OwnedOctree::build(&mut in_octree, &growth, OctreeVariant::Plain, LinkBy::Box);
        let (in_bvh, in_octree) = (in_bvh.scene(), in_octree.scene());
        let (tight, octants) = (tight.tree(), octants.tree());
        let grid = Grid::new(&prepared);
        for ray in rays(&prepared, value) {
            let truth = truth(&prepared.scene.spheres, &ray);
            let found = [
                counted(|| nearest(&tight, &in_bvh, &ray)),
                counted(|| nearest(&octants, &in_octree, &ray)),
                counted(|| grid.walk(&prepared.scene.shapes(), &ray)),
            ];
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.saturations += saturations;
                let Some((t, id)) = &truth else {
                    errors.decide(false, found.is_some());
                    continue;
                };
                let right = found.filter(|(_, other)| other == id);
                if let Some((found, _)) = right {
                    let radius = prepared.scene.spheres[*id as usize].radius.exact();
                    errors.err(near(&((found.exact() - t) / radius)));
                }
                errors.decide(true, right.is_some());
            }
        }
        all_errors
    }
}

/// Returns spheres at every other corner of the cells inside the root, and in its eight corners, which set its size.
fn lattice() -> Setting {
    let far = f64::from(HALF) - RADIUS;
    let sphere = |centre| Shape::Sphere {
        centre,
        radius: RADIUS,
    };
    let mut setting = Setting::of(sphere([far; 3]), [2.0 * f64::from(HALF), 0.5, 0.0]);
    for corner in 1..8 {
        setting = setting.and(sphere(
            [0, 1, 2].map(|i| if corner >> i & 1 == 0 { far } else { -far }),
        ));
    }
    for centre in corners().filter(|[x, y, z]| (x + y + z) % 2 == 0) {
        setting = setting.and(sphere(centre.map(f64::from)));
    }
    setting
}

/// Returns the corners of cells inside the root, except those next to its faces.
fn corners() -> impl Iterator<Item = [i32; 3]> {
    let range = || 2 - HALF..HALF - 1;
    range().flat_map(move |x| range().flat_map(move |y| range().map(move |z| [x, y, z])))
}

/// Returns rays from outside of the root.
fn rays<S: Number>(prepared: &Prepared<S>, value: f64) -> Vec<Ray<S>> {
    const ALONG: [[f64; 3]; 6] = [
        [1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 1.0],
        [-1.0, -1.0, -1.0],
    ];
    let mut random = Random::new(13);
    let mut aim = |(i, corner): (usize, [i32; 3])| {
        let along = ALONG[i % ALONG.len()];
        let slope = match i % 4 {
            0 => 0.0,
            _ => 1.0 / value,
        };
        let off = random::times(
            random.direction(),
            if i % 3 == 0 { 0.0 } else { 0.1 * slope },
        );
        let towards = random::add(along, random::times(random.direction(), 0.5 * slope));
        let direction = number::direction::<S>(towards);
        let target = prepared
            .world
            .point(random::add(corner.map(f64::from), off));
        let length = prepared.world.length(2.0 * f64::from(HALF));
        number::ray(
            random::add(target, random::times(floats(direction), -length)),
            direction,
        )
    };
    corners().enumerate().step_by(2).map(&mut aim).collect()
}

/// Returns the first sphere's t and number, computed exactly; skips spheres far from the ray.
fn truth<S: Number>(spheres: &[shape::Sphere<S>], ray: &Ray<S>) -> Option<(Exact, u32)> {
    let apart = |sphere: &shape::Sphere<S>| {
        let to_centre = random::add(floats(sphere.centre), floats(-ray.origin));
        let direction = floats(ray.direction);
        let along = random::dot(to_centre, direction);
        let apart = random::add(to_centre, random::times(direction, -along));
        random::dot(apart, apart).sqrt() / sphere.radius.to_f64()
    };
    (spheres.iter().zip(0..))
        .filter(|(sphere, _)| apart(sphere) < 2.0)
        .filter_map(|(sphere, id)| Some((sphere::truth(sphere, ray)?.0, id)))
        .reduce(|a, b| if b.0 < a.0 { b } else { a })
}

fn nearest<S: Number, A: Accelerator<S>>(
    tree: &A,
    scene: &Scene<'_, S>,
    ray: &Ray<S>,
) -> Option<(S, u32)> {
    let hit = tree.nearest(scene, ray, &mut A::Stack::default(), &mut ())?;
    Some((hit.t, scene.attributes_of(hit.object).id))
}

/// An octree whose leaves all have the same depth, with the spheres that each may hold.
struct Grid<S> {
    side: S,
    cells: Vec<Vec<u32>>,
}

impl<S: Number> Grid<S> {
    const ROW: i32 = 2 * HALF;

    fn new(prepared: &Prepared<S>) -> Self {
        let side = prepared.world.length(1.0);
        let mut cells = vec![Vec::new(); Self::ROW.pow(3) as usize];
        for (sphere, id) in prepared.scene.spheres.iter().zip(0..) {
            let of = |x: f64| ((x / side).floor() as i32 + HALF).clamp(0, Self::ROW - 1);
            let (centre, reach) = (floats(sphere.centre), sphere.radius.to_f64());
            let [xs, ys, zs] = centre.map(|c| of(c - reach)..=of(c + reach));
            for x in xs {
                for y in ys.clone() {
                    for z in zs.clone() {
                        cells[Self::index([x, y, z])].push(id);
                    }
                }
            }
        }
        Self {
            side: S::from_f64(side),
            cells,
        }
    }

    const fn index([x, y, z]: [i32; 3]) -> usize {
        ((x * Self::ROW + y) * Self::ROW + z) as usize
    }

    /// Returns the cell of the octree that contains a point, and its least corner, or `None` outside of the root.
    fn locate(&self, p: Vec3<S>) -> Option<([i32; 3], [S; 3])> {
        let mut at = [0; 3];
        let mut low = [S::ZERO; 3];
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            let mut size = (0..2).fold(self.side, |size, _| size + size);
            low[i] = -size;
            if p[axis] < low[i] || p[axis] >= size {
                return None;
            }
            for cells in [4, 2, 1] {
                let middle = low[i] + size;
                if p[axis] >= middle {
                    (at[i], low[i]) = (at[i] + cells, middle);
                }
                size = size * S::from_f64(0.5);
            }
        }
        Some((at, low))
    }

    /// Returns the distance at which the ray leaves a cube or, with `enter`, enters it.
    fn pass(&self, ray: &Ray<S>, low: [S; 3], size: S, enter: bool) -> S {
        let mut passed = if enter { S::ZERO } else { S::MAX };
        for (axis, low) in Axis::ALL.into_iter().zip(low) {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            if d == S::ZERO {
                continue;
            }
            let face = if (d > S::ZERO) == enter {
                low
            } else {
                low + size
            };
            let t = (face - o).quotient(d);
            passed = if enter { passed.max(t) } else { passed.min(t) };
        }
        passed
    }

    /// Searches for the next cell from the root, at a point slightly beyond the exit from the current cell. A ray that
    /// stays in its cell is lost.
    fn walk(&self, shapes: &Shapes<'_, S>, ray: &Ray<S>) -> Option<(S, u32)> {
        let beyond = self.side * S::from_f64(1.0 / 256.0);
        let half = (0..2).fold(self.side, |size, _| size + size);
        let mut t = self.pass(ray, [-half; 3], half + half, true);
        for _ in 0..4 * Self::ROW {
            let (cell, low) = self.locate(ray.at(t + beyond))?;
            t = self.pass(ray, low, self.side, false);
            let ids = &self.cells[Self::index(cell)];
            let first = ids
                .iter()
                .filter_map(|&id| {
                    let hit =
                        shapes.hit(ObjectRef::new(ObjectKind::Sphere, id), ray, t, &mut ())?;
                    Some((hit, id))
                })
                .reduce(|a, b| if b.0 < a.0 { b } else { a });
            if first.is_some() {
                return first;
            }
        }
        None
    }
}
