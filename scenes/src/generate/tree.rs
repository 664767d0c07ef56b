//! A tree with branches.

use super::random::{Random, around, unit};
use super::stage::{PALETTE, Stage, glossy};
use crate::model::{Point, Surface};
use crate::point::{add, times};

/// Number of branches on each branch.
const FORKS: usize = 3;

struct Branch {
    base: Point,
    direction: Point,
    length: f64,
    /// Radius at the base; at the tip it is [`TAPER`] times that.
    radius: f64,
}

/// Ratio of a branch's radii at its tip and its base.
const TAPER: f64 = 0.62;

impl Branch {
    fn tip(&self) -> Point {
        add(self.base, times(self.direction, self.length))
    }
}

pub(super) fn build(stage: &mut Stage, objects: usize, mut random: Random) {
    let ground = stage.surface(Surface::matt([0.45, 0.6, 0.3]));
    let bark = stage.surface(Surface::matt([0.45, 0.3, 0.2]));
    let leaves = [PALETTE[3], [0.5, 0.68, 0.2], PALETTE[1], PALETTE[0]]
        .map(|colour| stage.surface(glossy(colour, 0.1)));

    let mut left = objects / 2;
    let trunk = Branch {
        base: [0.0; 3],
        direction: [0.0, 0.0, 1.0],
        length: 1.0,
        radius: 0.1,
    };
    let mut generation = vec![trunk];
    generation.truncate(left);
    while !generation.is_empty() {
        left -= generation.len();
        let bearing = left.min(generation.len() * FORKS);
        let mut next = Vec::with_capacity(bearing);
        for fork in 0..FORKS {
            for branch in generation.iter().take(bearing - next.len()) {
                next.push(grow(branch, fork, &mut random));
            }
        }
        for (index, branch) in generation.iter().enumerate() {
            let tip_radius = branch.radius * TAPER;
            stage.cone(
                bark,
                (branch.base, branch.radius),
                (branch.tip(), tip_radius),
            );
            if index < bearing {
                stage.sphere(bark, branch.tip(), tip_radius);
            } else {
                let leaf = leaves[random.below(leaves.len())];
                let radius = tip_radius.max(branch.length * random.between(0.14, 0.26));
                stage.sphere(leaf, branch.tip(), radius);
            }
        }
        generation = next;
    }
    stage.ground(ground, 0.0, 12.0);
}

fn grow(parent: &Branch, fork: usize, random: &mut Random) -> Branch {
    let turn = (fork as f64 + random.between(-0.3, 0.3)) / FORKS as f64;
    let lean = random.between(0.45, 0.9);
    // Branches grow towards the light.
    let direction = add(
        around(parent.direction, turn, [lean, 0.0, 1.0]),
        [0.0, 0.0, 0.1],
    );
    Branch {
        base: parent.tip(),
        direction: unit(direction),
        length: parent.length * random.between(0.66, 0.82),
        radius: parent.radius * TAPER,
    }
}
