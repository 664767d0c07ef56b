//! The sweep against all pairs, and the tests of pairs against points strewn over the surfaces.

use super::body::{length, minus};
use super::*;
use octray_scenes::point::{add, times};
use std::f64::consts::TAU;

fn scene(objects: &str) -> Scene {
    octray_scenes::parse(&format!("v 0 0 9 f 1 1 1 0 0 0 0 0 0 1 0 0 {objects}")).unwrap()
}

/// The pairs of a scene as text, objects counted from 0: `0x1` cross, `0<1` is inside.
fn pairs(objects: &str) -> String {
    let pairs = sweep(&scene(objects), &Interrupt::new()).unwrap();
    let told = pairs.iter().map(|(a, b, relation)| match relation {
        Relation::Cross => format!("{a}x{b}"),
        _ => format!("{a}<{b}"),
    });
    told.collect::<Vec<_>>().join(" ")
}

#[test]
fn every_kind_of_pair_crosses_lies_inside_or_apart() {
    let cases = [
        // Spheres.
        ("s 0 0 0 1 s 1 0 0 1", "0x1"),
        ("s 0 0 0 1 s 0.2 0 0 0.5", "1<0"),
        ("s 0 0 0 1 s 2 0 0 1", ""),
        ("s 0 0 0 1 s 0.5 0 0 0.5", "1<0"),
        ("s 0 0 0 1 s 3 0 0 1", ""),
        // Spheres and boxes.
        ("s 0 0 0 1 box 1 0 0 1 1 1", "0x1"),
        ("s 0 0 0 1 box 0 0 0 1 1 1", "1<0"),
        ("s 0 0 0 1 box 0 0 0 3 3 3", "0<1"),
        ("s 0 0 0 1 box 2 0 0 2 2 2", ""),
        ("s 0 0 0 1 box 1.2 1.2 0 1 1 1", "0x1"),
        ("s 0 0 0 1 box 1.3 1.3 0 1 1 1", ""),
        // Spheres and polygons: the plane crosses, the triangle does not.
        ("s 0 0 0 1 p 3 -9 0 -9 9 0 -9 0 0 9", "0x1"),
        ("s 0 0 0 1 p 3 0.9 0.9 0 9 0.9 0 0.9 9 0", ""),
        ("s 0 0 0 1 p 3 -0.1 0 0 0.1 0 0 0 0.1 0", "1<0"),
        ("s 0 1 0 1 p 4 -9 0 -9 9 0 -9 9 0 9 -9 0 9", ""),
        // Spheres and cones.
        ("s 0 0 0 1 c 0 -5 0 0.5 0 5 0 0.5", "0x1"),
        ("s 0 0 0 1 c 0 -5 0 1.5 0 5 0 1.5", ""),
        ("s 0 0 0 1 c 0 -0.5 0 0.5 0 0.5 0 0", "1<0"),
        // Boxes.
        ("box 0 0 0 2 2 2 box 1 1 1 2 2 2", "0x1"),
        ("box 0 0 0 2 2 2 box 0 0 0 1 1 1", "1<0"),
        ("box 0 0 0 2 2 2 box 2 0 0 2 2 2", ""),
        ("box 0 0 0 2 2 2 box 0 0 0 1 1 9", "0x1"),
        // Boxes and polygons: through the middle, on a face, around the box, from edge to edge.
        ("box 0 0 0 2 2 2 p 3 -9 0 -9 9 0 -9 0 0 9", "0x1"),
        ("box 0 1 0 2 2 2 p 4 -9 0 -9 9 0 -9 9 0 9 -9 0 9", ""),
        (
            "box 0 0 0 2 2 2 p 8 -9 0 -9 -2 0 -9 -2 0 2 2 0 2 2 0 -9 9 0 -9 9 0 9 -9 0 9",
            "",
        ),
        ("box 0 0 0 2 2 2 p 4 -1 -1 -1 1 1 -1 1 1 1 -1 -1 1", "1<0"),
        ("box 0 0 0 2 2 2 p 3 0 0 0 0.5 0 0 0 0.5 0", "1<0"),
        // Boxes and cones.
        ("box 0 0 0 2 2 2 c 0 -5 0 0.5 0 5 0 0.5", "0x1"),
        ("box 0 0 0 2 2 2 c 0 -5 0 3 0 5 0 3", ""),
        ("box 0 0 0 2 2 2 c 0 -0.5 0 0.5 0 0.5 0 0.2", "1<0"),
        ("box 0 0 0 2 2 2 c 0 1 0 0.5 0 3 0 0.5", ""),
        ("box 0 0 0 2 2 2 c 0 0.9 0 0.5 0 3 0 0.5", "0x1"),
        // Polygons: across each other, along an edge, in a plane, equal squares.
        (
            "p 4 -1 -1 0 1 -1 0 1 1 0 -1 1 0 p 4 0 -1 -1 0 -1 1 0 1 1 0 1 -1",
            "0x1",
        ),
        (
            "p 4 -1 0 0 1 0 0 1 1 0 -1 1 0 p 4 -1 0 0 1 0 0 1 0 1 -1 0 1",
            "",
        ),
        ("p 3 0 0 0 1 0 0 0 1 0 p 3 0.1 0.1 0 1 0 0 0 1 0", ""),
        ("p 3 -1 0 0 1 0 0 0 1 0 p 3 0 0.5 -1 0 0.5 1 5 0.6 0", "0x1"),
        ("p 3 -1 0 0 1 0 0 0 1 0 p 3 0 2.5 -1 0 2.5 1 5 2.6 0", ""),
        // Polygons and cones: through the side, on the floor, all around, at an end.
        ("p 3 -9 0 -9 9 0 -9 0 0 9 c 0 -1 0 0.5 0 1 0 0.5", "0x1"),
        ("p 4 -9 0 -9 9 0 -9 9 0 9 -9 0 9 c 0 0 0 0.5 0 1 0 0", ""),
        (
            "p 3 -9 0.5 -9 9 0.7 -9 0 0.5 9 c 0 0 0 0.5 0 1 0 0.5",
            "0x1",
        ),
        (
            "p 3 0.4 0.2 -9 0.4 0.2 9 5 0.2 0 c 0 0 0 0.5 0 1 0 0.5",
            "0x1",
        ),
        (
            "p 3 -0.2 0.5 -0.2 0.2 0.5 -0.2 0 0.5 0.2 c 0 0 0 0.5 0 1 0 0.5",
            "",
        ),
        (
            "p 4 -3 0 0.5 3 0 0.5 3 4 0.5 -3 4 0.5 c 0 0 0 1 0 4 0 1",
            "0x1",
        ),
        ("p 4 -3 0 1 3 0 1 3 4 1 -3 4 1 c 0 0 0 1 0 4 0 1", ""),
        // Cones.
        ("c 0 -1 0 0.5 0 1 0 0.5 c -3 0 0 0.2 3 0 0 0.2", "0x1"),
        ("c 0 -1 0 0.5 0 1 0 0.5 c -3 0 0.6 0.2 3 0 0.6 0.2", "0x1"),
        ("c 0 -1 0 0.5 0 1 0 0.5 c -3 0 0.8 0.2 3 0 0.8 0.2", ""),
        ("c 0 -1 0 0.5 0 1 0 0.5 c 0 -1 0 0.3 0 1 0 0.3", ""),
        ("c 0 0 0 0.5 0 1 0 0.5 c 0 1 0 0.5 0 2 0 0", ""),
        // Parallel cylinders, whose lines never meet: side by side, of other sizes, touching, the same, one in the other.
        ("c 0 0 0 1 0 4 0 1 c 1 0 0 1 1 4 0 1", "0x1"),
        ("c 0 0 0 1 0 4 0 1 c 0.9 1 0 0.2 0.9 3 0 0.2", "0x1"),
        ("c 0 0 0 1 0 4 0 1 c 1 -1 0 1 1 5 0 1", "0x1"),
        ("c 0 0 0 1 0 4 0 1 c 1 0 0 1 1.0004 4 0 1", "0x1"),
        ("c 0 0 0 1 0 4 0 1 c 2 0 0 1 2 4 0 1", ""),
        ("c 0 0 0 1 0 4 0 1 c 0 1 0 1 0 5 0 1", ""),
        ("c 0 0 0 1 0 4 0 1 c 0.5 1 0 0.2 0.5 3 0 0.2", ""),
    ];
    for (objects, expected) in cases {
        assert_eq!(pairs(objects), expected, "{objects}");
        // The other way round the numbers are, too.
        let second = objects[1..]
            .find(|c: char| c.is_ascii_alphabetic())
            .map(|at| at + 1);
        let box_length = if objects.starts_with("box") { 3 } else { 1 };
        let second = match box_length {
            3 => objects[3..]
                .find(|c: char| c.is_ascii_alphabetic())
                .map(|at| at + 3),
            _ => second,
        };
        let (first, second) = objects.split_at(second.unwrap());
        let turned = match expected {
            "0<1" => "1<0",
            "1<0" => "0<1",
            other => other,
        };
        assert_eq!(
            pairs(&format!("{second} {first}")),
            turned,
            "{objects} turned"
        );
    }
}

/// Numbers as good as random, from 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005))
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self, reach: f64) -> Point {
        [0; 3].map(|_| reach * (2.0 * self.next() - 1.0))
    }

    /// An object of any kind, in the format of scene files.
    fn object(&mut self, reach: f64) -> String {
        let words = |numbers: &[f64]| {
            let words = numbers.iter().map(f64::to_string);
            words.collect::<Vec<_>>().join(" ")
        };
        let centre = self.point(reach);
        let size = 0.1 + self.next();
        let near = |random: &mut Self| add(centre, random.point(size));
        match (4.0 * self.next()) as u32 {
            0 => format!("s {} {size}", words(&centre)),
            1 => {
                let sides = self.point(size).map(|side| 0.1 + side.abs());
                format!("box {} {}", words(&centre), words(&sides))
            }
            2 => {
                let (top, radius) = (near(self), self.next());
                format!("c {} {size} {} {radius}", words(&centre), words(&top))
            }
            _ => {
                let (a, b) = (near(self), near(self));
                format!("p 3 {} {} {}", words(&centre), words(&a), words(&b))
            }
        }
    }
}

#[test]
fn the_sweep_finds_what_all_pairs_have() {
    let mut random = Random(1);
    for reach in [1.0, 2.0, 4.0] {
        let objects: Vec<_> = (0..120).map(|_| random.object(reach)).collect();
        let scene = scene(&objects.join("\n"));
        let bodies: Vec<_> = (scene.objects.iter())
            .map(|object| Body::of(&scene, &object.shape).unwrap())
            .collect();
        let slack = SLACK * diagonal(bodies.iter().map(Body::bounds));
        let mut expected = Vec::new();
        for (i, a) in bodies.iter().enumerate() {
            for (j, b) in bodies.iter().enumerate().skip(i + 1) {
                expected.extend(pair((i as u32, a), (j as u32, b), slack));
            }
        }
        expected.sort_unstable_by_key(|&(a, b, _)| (a, b));
        assert!(expected.len() > 10, "{reach}: {}", expected.len());
        assert_eq!(sweep(&scene, &Interrupt::new()).unwrap(), expected);
    }
}

/// Points all over a surface, the next ones near each other.
fn strewn(body: &Body) -> Vec<Vec<Point>> {
    const STEPS: u32 = 48;
    let share = |i: u32| f64::from(i) / f64::from(STEPS);
    let grid = |at: &dyn Fn(f64, f64) -> Point| -> Vec<Vec<Point>> {
        let row = |i| (0..=STEPS).map(|j| at(share(i), share(j))).collect();
        (0..=STEPS).map(row).collect()
    };
    match body {
        Body::Sphere(centre, radius) => grid(&|u, v| {
            let (height, around) = (2.0 * u - 1.0, TAU * v);
            let out = (1.0 - height * height).sqrt();
            let direction = [out * around.cos(), height, out * around.sin()];
            add(*centre, times(direction, *radius))
        }),
        Body::Cone(cone) => grid(&|u, v| {
            let [a, b] = cone.line(TAU * v);
            add(a, times(minus(b, a), u))
        }),
        Body::Polygon(polygon) => grid(&|u, v| {
            let [a, b, c] = [0, 1, 2].map(|i| polygon.vertices[i]);
            let edge = add(b, times(minus(c, b), v));
            add(a, times(minus(edge, a), u))
        }),
        Body::Cuboid(low, high) => (0..6)
            .flat_map(|face| {
                let (axis, side) = (face / 2, face % 2);
                grid(&|u, v| {
                    let mut p = *low;
                    p[axis] = [low, high][side][axis];
                    for (i, share) in [((axis + 1) % 3, u), ((axis + 2) % 3, v)] {
                        p[i] += (high[i] - low[i]) * share;
                    }
                    p
                })
            })
            .collect(),
    }
}

/// Whether the line between two points near each other goes through a surface, from the surface's definition.
fn parts(body: &Body, a: Point, b: Point) -> bool {
    let side = |p: Point| match body {
        Body::Sphere(centre, radius) => length(minus(p, *centre)) < *radius,
        Body::Cuboid(low, high) => (0..3).all(|i| low[i] < p[i] && p[i] < high[i]),
        Body::Polygon(polygon) => polygon.height(p) > 0.0,
        Body::Cone(cone) => {
            let from = minus(p, cone.base);
            let height = octray_scenes::point::dot(from, cone.axis);
            length(minus(from, times(cone.axis, height))) < cone_radius(cone, height)
        }
    };
    if side(a) == side(b) {
        return false;
    }
    let (middle, far) = (times(add(a, b), 0.5), length(minus(a, b)));
    match body {
        Body::Sphere(..) | Body::Cuboid(..) => true,
        // The surface ends; near its end the points tell nothing.
        Body::Polygon(polygon) => polygon.contains(middle) && polygon.rim_distance(middle) > far,
        Body::Cone(cone) => {
            let height = octray_scenes::point::dot(minus(middle, cone.base), cone.axis);
            (far..cone.height - far).contains(&height) && cone_radius(cone, height) > far
        }
    }
}

fn cone_radius(cone: &body::Cone, height: f64) -> f64 {
    let share = height / cone.height;
    cone.radii[0] * (1.0 - share) + cone.radii[1] * share
}

/// Whether points strewn over one surface lie on both sides of the other.
fn seen_to_cross(a: &Body, b: &Body) -> bool {
    let rows = strewn(a);
    let mut neighbours = rows
        .iter()
        .flat_map(|row| row.windows(2).map(|two| [two[0], two[1]]));
    neighbours.any(|[p, q]| parts(b, p, q))
}

#[test]
fn pairs_of_strewn_points_on_both_sides_cross_and_others_do_not_by_much() {
    let mut random = Random(7);
    let (mut crossing, mut unseen) = (0, 0);
    for _ in 0..3000 {
        let scene = scene(&[random.object(0.7), random.object(0.7)].join(" "));
        let body = |i: usize| Body::of(&scene, &scene.objects[i].shape).unwrap();
        let (a, b) = (body(0), body(1));
        let seen = seen_to_cross(&a, &b) || seen_to_cross(&b, &a);
        let told = relation(&a, &b, 1e-9);
        if seen {
            assert_eq!(told, Some(Relation::Cross), "{a:?} {b:?}");
            crossing += 1;
        } else if told == Some(Relation::Cross) {
            unseen += 1;
        }
        let inside = |inner: &Body, outer: &Body| {
            let mut points = strewn(inner).into_iter().flatten();
            match outer {
                Body::Sphere(centre, radius) => {
                    points.all(|p| length(minus(p, *centre)) <= *radius)
                }
                Body::Cuboid(low, high) => {
                    points.all(|p| (0..3).all(|i| low[i] <= p[i] && p[i] <= high[i]))
                }
                _ => false,
            }
        };
        match told {
            Some(Relation::Inside) => assert!(inside(&a, &b), "{a:?} {b:?}"),
            Some(Relation::Around) => assert!(inside(&b, &a), "{a:?} {b:?}"),
            None => assert!(!inside(&a, &b) && !inside(&b, &a), "{a:?} {b:?}"),
            Some(Relation::Cross) => {}
        }
    }
    // A grid of 48 x 48 points misses small pieces, but few.
    assert!(
        crossing > 600 && unseen * 4 < crossing,
        "{crossing} {unseen}"
    );
}
