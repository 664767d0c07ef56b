//! A soup of all shapes.

use super::random::{Random, across, circle};
use super::stage::{PALETTE, Stage, glossy};
use crate::model::{Point, Surface};
use crate::point::{add, times};

pub(super) fn build(stage: &mut Stage, objects: usize, mut random: Random) {
    let ground = stage.surface(Surface::matt(PALETTE[2]));
    let mut surfaces: Vec<u32> = PALETTE
        .iter()
        .map(|&colour| stage.surface(Surface::matt(colour)))
        .collect();
    surfaces.extend(PALETTE.map(|colour| stage.surface(glossy(colour, 0.3))));
    surfaces.push(stage.surface(Surface::glass(1.5)));

    // Each object is about as large as the space that is available to it.
    let cells = (1..).find(|&n: &usize| n * n * n >= objects).unwrap_or(1);
    let space = 1.0 / cells as f64;
    for index in 0..objects {
        let surface = surfaces[random.below(surfaces.len())];
        let centre = [(); 3].map(|()| random.between(-1.0, 1.0));
        let size = space * random.between(0.4, 1.0);
        // The shapes take turns, so that even a few objects contain all of them.
        match index % 7 {
            0 => stage.sphere(surface, centre, size * 0.7),
            1 => cone(stage, surface, centre, size, 0.5, &mut random),
            2 => cone(stage, surface, centre, size, 0.0, &mut random),
            3 => {
                let sides = [(); 3].map(|()| size * random.between(0.5, 1.5));
                stage.cuboid(surface, centre, sides);
            }
            4 => {
                let corners = 3 + random.below(6);
                let [u, v] = across(random.direction());
                let polygon: Vec<Point> = ring(corners, &mut random)
                    .map(|[x, y]| add(centre, add(times(u, x * size), times(v, y * size))))
                    .collect();
                stage.polygon(surface, &polygon);
            }
            5 => {
                let corners = 2 * (3 + random.below(4));
                let [u, v] = across(random.direction());
                let star: Vec<Point> = ring(corners, &mut random)
                    .enumerate()
                    .map(|(corner, [x, y])| {
                        let reach = if corner % 2 == 0 { size } else { size * 0.4 };
                        add(centre, add(times(u, x * reach), times(v, y * reach)))
                    })
                    .collect();
                stage.polygon(surface, &star);
            }
            _ => {
                let axis = random.direction();
                let [u, v] = across(axis);
                let corners = 3 + random.below(3);
                let patch: Vec<(Point, Point)> = ring(corners, &mut random)
                    .map(|[x, y]| {
                        let outward = add(times(u, x), times(v, y));
                        let normal = add(axis, times(outward, 0.6));
                        (add(centre, times(outward, size)), normal)
                    })
                    .collect();
                stage.patch(surface, &patch);
            }
        }
    }
    stage.ground(ground, -1.6, 12.0);
}

/// A truncated cone or cylinder, or a pointed cone if `top` is 0.
fn cone(stage: &mut Stage, surface: u32, centre: Point, size: f64, top: f64, random: &mut Random) {
    let half = times(random.direction(), size * 0.8);
    let base_radius = size * 0.5;
    let top_radius = size * if random.below(2) == 0 { top } else { top * 0.5 };
    let base = add(centre, times(half, -1.0));
    stage.cone(
        surface,
        (base, base_radius),
        (add(centre, half), top_radius),
    );
}

/// Returns `corners` points on the unit circle, in order, no two of them close to each other.
fn ring(corners: usize, random: &mut Random) -> impl Iterator<Item = [f64; 2]> {
    let start = random.between(0.0, 1.0);
    (0..corners).map(move |corner| {
        circle(start + (corner as f64 + random.between(-0.3, 0.3)) / corners as f64)
    })
}
