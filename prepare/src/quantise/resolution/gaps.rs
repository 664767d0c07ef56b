//! Surfaces that lie one close behind the other: a decal on a wall, a ball in a ball, a lining in a tube.

use super::super::camera::{length, unit};
use super::super::extent::shape_box;
use octray_scenes::model::{Point, Scene, Shape};
use octray_scenes::point::{add, cross, dot, times};
use std::collections::BTreeMap;

/// Two objects with surfaces closer to each other than some limit, as places in the scene, and how close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gap {
    pub(super) objects: [usize; 2],
    pub(super) width: f64,
}

/// A pair further apart in the order than this is not looked at, so that many layers do not take forever.
const NEIGHBOURS: usize = 64;
/// Normals that differ by less are taken to be parallel.
const PARALLEL: f64 = 1e-5;

/// Returns two objects with surfaces all along closer to each other than `limit`, if there are some. What is closer than
/// `nothing` is in the same place, which is no gap.
pub(super) fn narrow_gap(scene: &Scene, limit: f64, nothing: f64) -> Option<Gap> {
    let gap = nothing..limit;
    planes(scene, &gap).or_else(|| round(scene, &gap))
}

/// A part of a plane: its object, its distance from the origin and the box around it.
struct Face {
    object: usize,
    offset: f64,
    bounds: [Point; 2],
}

fn planes(scene: &Scene, gap: &std::ops::Range<f64>) -> Option<Gap> {
    let mut by_normal: BTreeMap<[i64; 3], Vec<Face>> = BTreeMap::new();
    let mut add_face = |object, normal: Point, at: Point, bounds| {
        // Either of two opposite normals stands for both.
        let first = normal.into_iter().find(|c| c.abs() > PARALLEL);
        let normal = times(normal, first.unwrap_or(1.0).signum());
        let key = normal.map(|c| (c / PARALLEL).round() as i64);
        by_normal.entry(key).or_default().push(Face {
            object,
            offset: dot(normal, at),
            bounds,
        });
    };
    for (object, shape) in scene.objects.iter().map(|o| &o.shape).enumerate() {
        let bounds = shape_box(scene, shape);
        match *shape {
            Shape::Polygon { first, count } | Shape::Patch { first, count, .. } => {
                let vertices = &scene.vertices[first as usize..][..count as usize];
                let next = vertices.iter().cycle().skip(1);
                let from_first = |v: &Point| add(*v, times(vertices[0], -1.0));
                let normal = vertices.iter().zip(next).fold([0.0; 3], |sum, (a, b)| {
                    add(sum, cross(from_first(a), from_first(b)))
                });
                if length(normal) > 0.0 {
                    add_face(object, unit(normal), vertices[0], bounds);
                }
            }
            Shape::Cuboid { .. } => {
                for axis in 0..3 {
                    for end in 0..2 {
                        let mut normal = [0.0; 3];
                        normal[axis] = 1.0;
                        let mut face = bounds;
                        face[1 - end][axis] = bounds[end][axis];
                        add_face(object, normal, bounds[end], face);
                    }
                }
            }
            Shape::Sphere { .. } | Shape::Cone { .. } => {}
        }
    }
    by_normal.into_values().find_map(|mut faces| {
        faces.sort_by(|a, b| a.offset.total_cmp(&b.offset));
        let apart = |a: &Face, b: &Face| {
            let width = b.offset - a.offset;
            let over = [0, 1, 2].map(|i| {
                let (low, high) = (
                    a.bounds[0][i].max(b.bounds[0][i]),
                    a.bounds[1][i].min(b.bounds[1][i]),
                );
                high - low
            });
            // One behind the other, not edge to edge.
            let over = over.iter().all(|o| *o >= -2.0 * width)
                && over.iter().filter(|o| **o > 2.0 * width).count() >= 2;
            (over && a.object != b.object).then_some(width)
        };
        first_gap(
            &faces,
            gap,
            |face| face.object,
            apart,
            |a, b| b.offset - a.offset < gap.end,
        )
    })
}

/// Balls and cones inside one another. The faces of boxes are planes.
fn round(scene: &Scene, gap: &std::ops::Range<f64>) -> Option<Gap> {
    // The middle of the shape, and a number that shapes in the same place differ in by the distance of their surfaces.
    let mut shapes: Vec<(usize, Vec<Point>, Vec<f64>)> = Vec::new();
    for (object, shape) in scene.objects.iter().map(|o| &o.shape).enumerate() {
        match *shape {
            Shape::Sphere { centre, radius } => shapes.push((object, vec![centre], vec![radius])),
            Shape::Cone {
                base,
                base_radius,
                top,
                top_radius,
            } => shapes.push((object, vec![base, top], vec![base_radius, top_radius])),
            _ => {}
        }
    }
    shapes.sort_by(|a, b| a.1[0][0].total_cmp(&b.1[0][0]));
    let apart = |a: &(usize, Vec<Point>, Vec<f64>), b: &(usize, Vec<Point>, Vec<f64>)| {
        if a.1.len() != b.1.len() {
            return None;
        }
        let moved = (a.1.iter().zip(&b.1)).map(|(p, q)| length(add(*p, times(*q, -1.0))));
        let wider = (a.2.iter().zip(&b.2)).map(|(p, q)| (p - q).abs());
        Some(moved.chain(wider).fold(0.0, f64::max))
    };
    first_gap(
        &shapes,
        gap,
        |shape| shape.0,
        apart,
        |a, b| b.1[0][0] - a.1[0][0] < gap.end,
    )
}

/// Returns the first of neighbours in an order whose distance is in `gap`, as long as they are `near` in the order.
fn first_gap<T>(
    sorted: &[T],
    gap: &std::ops::Range<f64>,
    object: impl Fn(&T) -> usize,
    apart: impl Fn(&T, &T) -> Option<f64>,
    near: impl Fn(&T, &T) -> bool,
) -> Option<Gap> {
    sorted.iter().enumerate().find_map(|(i, a)| {
        let others = sorted[i + 1..].iter().take(NEIGHBOURS);
        others.take_while(|b| near(a, b)).find_map(|b| {
            let width = apart(a, b).filter(|width| gap.contains(width))?;
            let mut objects = [object(a), object(b)];
            objects.sort_unstable();
            Some(Gap { objects, width })
        })
    })
}
