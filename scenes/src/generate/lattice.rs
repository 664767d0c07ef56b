//! The lattice of spheres and rods.

use super::random::{Random, circle};
use super::stage::{PALETTE, Stage, glossy};
use crate::model::{Point, Surface};

pub(super) fn build(stage: &mut Stage, objects: usize, mut random: Random) {
    let ground = stage.surface(Surface::matt(PALETTE[2]));
    let rod = stage.surface(glossy(PALETTE[7], 0.25));
    let mut balls: Vec<u32> = PALETTE[..7]
        .iter()
        .map(|&colour| stage.surface(glossy(colour, 0.15)))
        .collect();
    balls.push(stage.surface(Surface::glass(1.5)));

    // The layers that the objects fill, in a cube from -1 to 1, slightly rotated.
    let layers = layers(objects);
    let spacing = 2.0 / layers as f64;
    let [cos, sin] = circle(random.between(0.02, 0.08));
    let place = |node: [usize; 3]| -> Point {
        let [x, y, z] = node.map(|step| (step as f64 + 0.5) * spacing - 1.0);
        [cos * x - sin * y, sin * x + cos * y, z]
    };
    let rod_radius = 0.07 * spacing;
    let mut left = objects;
    for node in (0..layers).flat_map(shell) {
        if left == 0 {
            break;
        }
        let ball = balls[random.below(balls.len())];
        stage.sphere(ball, place(node), spacing * random.between(0.16, 0.3));
        left -= 1;
        for axis in 0..3 {
            if left > 0 && node[axis] > 0 {
                let mut neighbour = node;
                neighbour[axis] -= 1;
                let [from, to] = [place(neighbour), place(node)];
                stage.cone(rod, (from, rod_radius), (to, rod_radius));
                left -= 1;
            }
        }
    }
    stage.ground(ground, -1.05, 10.0);
}

/// Returns the least n for which the n³ spheres and 3n²(n − 1) rods of a cube are enough.
fn layers(objects: usize) -> usize {
    (1..)
        .find(|&n: &usize| n * n * n + 3 * n * n * (n - 1) >= objects)
        .unwrap_or(1)
}

/// Returns the nodes whose largest coordinate is `layer`. Each neighbour nearer to the origin is in an earlier shell or
/// earlier in this one.
fn shell(layer: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=layer).flat_map(move |x| {
        (0..=layer).flat_map(move |y| {
            let low = if x == layer || y == layer { 0 } else { layer };
            (low..=layer).map(move |z| [x, y, z])
        })
    })
}
