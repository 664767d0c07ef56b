//! The sphere flake.

use super::random::{Random, around, unit};
use super::stage::{PALETTE, Stage, glossy};
use crate::model::{Point, Surface};
use crate::point::{add, dot, times};

struct Ball {
    centre: Point,
    radius: f64,
    /// The direction away from the sphere that carries this one.
    axis: Point,
}

pub(super) fn build(stage: &mut Stage, objects: usize, mut random: Random) {
    let ground = stage.surface(Surface::matt(PALETTE[2]));
    let slots = slots();
    let mut left = objects;
    let mut generation = vec![Ball {
        centre: [0.0; 3],
        radius: 0.5,
        axis: [0.0, 0.0, 1.0],
    }];
    generation.truncate(left);
    let mut colour = random.below(PALETTE.len());
    while !generation.is_empty() {
        let surface = stage.surface(glossy(PALETTE[colour], 0.3));
        colour = (colour + 3) % PALETTE.len(); // 3 and 8 are coprime: every colour is used.
        for ball in &generation {
            stage.sphere(surface, ball.centre, ball.radius);
        }
        left -= generation.len();
        let turn = random.between(0.0, 1.0);
        let children = slots.iter().flat_map(|&slot| {
            generation.iter().map(move |ball| {
                let axis = around(ball.axis, turn, slot);
                let centre = add(ball.centre, times(axis, ball.radius * 4.0 / 3.0));
                Ball {
                    centre,
                    radius: ball.radius / 3.0,
                    axis,
                }
            })
        });
        generation = children.take(left).collect();
    }
    stage.ground(ground, -0.5, 6.0);
}

/// Returns where a sphere with its carrier below (−z) carries others: the corners of a cuboctahedron on the equator and
/// above. Three corners above it come first.
fn slots() -> [Point; 9] {
    let x = unit([1.0, -1.0, 0.0]);
    let y = unit([1.0, 1.0, -2.0]);
    let z = unit([1.0, 1.0, 1.0]);
    let corners = [
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, -1.0, 0.0],
        [-1.0, 1.0, 0.0],
        [0.0, 1.0, -1.0],
        [0.0, -1.0, 1.0],
        [1.0, 0.0, -1.0],
        [-1.0, 0.0, 1.0],
    ];
    corners.map(|corner| {
        let corner = unit(corner);
        [x, y, z].map(|axis| dot(corner, axis))
    })
}
