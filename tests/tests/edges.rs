//! Polygons at their edges: rays through pixel centres that lie exactly there, in pictures of every arithmetic.

use fastrand::Rng;
use octray_core::observe::RayKind;
use octray_prepare::Arith;
use octray_prepare::choice::Choice;
use octray_prepare::format::Format;
use octray_tests::shot::Shot;
use std::fmt::Write;

/// A view from above in which the middles of 33 x 33 pixels are at whole numbers.
const ABOVE: &str =
    "b 1 0 1\nv 0 0 40\nview parallel\nresolution 33 33\nf 0.5 0.5 0.5 0 0 0 0 0 0 1 0 0\n";

/// How many rays of the eye hit something.
fn hits(arith: Arith, text: &str) -> u64 {
    let scene = octray_scenes::parse(text).unwrap_or_else(|e| panic!("{}", e.draw("edges", text)));
    Shot::new(arith).take(&scene).counters.hits[RayKind::Primary as usize]
}

/// Whether as many rays hit as there are pixel centres on polygons. Coarse arithmetics miss edges by some pixels, and never
/// to the inside.
fn covers(arith: Arith, hits: u64, right: u64) -> bool {
    let coarse = [Arith::APPROX0, Arith::I24F8, Arith::In(Format::I22F10)].contains(&arith);
    hits == right || coarse && hits > right
}

fn polygon(text: &mut String, corners: &[[f64; 3]]) {
    let _ = writeln!(text, "p {}", corners.len());
    for [x, y, z] in corners {
        let _ = writeln!(text, "{x} {y} {z}");
    }
}

/// Triangles over whole numbers from −8 to 8: on every one of 17 x 17 pixel centres corners meet, and elsewhere nothing is.
#[test]
fn a_height_field_covers_its_corners_in_every_arithmetic() {
    let mut rng = Rng::with_seed(5);
    let mut text = ABOVE.to_string();
    let heights = [(); 17 * 17].map(|()| 6.0 * rng.f64() - 3.0);
    let at = |x: usize, y: usize| [x as f64 - 8.0, y as f64 - 8.0, heights[17 * y + x]];
    for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
        polygon(&mut text, &[at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
        polygon(&mut text, &[at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
    }
    for arith in Arith::all() {
        let hits = hits(arith, &text);
        assert!(covers(arith, hits, 17 * 17), "{}: {hits}", arith.name());
    }
}

/// A rectangle of 8 x 4 and what hangs from its rim: its outline belongs to it, in every arithmetic alike.
#[test]
fn pixel_centres_on_an_outline_are_covered_in_every_arithmetic() {
    for tilt in [0.0, 0.25, 3.0] {
        let mut text = ABOVE.to_string();
        let at = |x: f64, y: f64| [x, y, tilt * x];
        polygon(
            &mut text,
            &[at(-4.0, -2.0), at(4.0, -2.0), at(4.0, 2.0), at(-4.0, 2.0)],
        );
        for arith in Arith::all() {
            let hits = hits(arith, &text);
            assert!(
                covers(arith, hits, 9 * 5),
                "{} at {tilt}: {hits}",
                arith.name()
            );
        }
    }
}

/// Two steep quads that meet over a line of pixel centres.
#[test]
fn a_ridge_has_no_holes_in_any_arithmetic() {
    for seed in 0..12 {
        let mut rng = Rng::with_seed(seed);
        let mut height = || 2.0 * rng.f64() - 1.0;
        let (low, high) = ([0.0, -12.0, height()], [0.0, 12.0, height()]);
        let mut text = ABOVE.to_string();
        for side in [-1.0, 1.0] {
            let (a, b) = (
                [side * 3.5, -12.0, -6.0 + height()],
                [side * 3.5, 12.0, -5.5],
            );
            // Of three corners each, as four are seldom in one plane.
            polygon(&mut text, &[low, a, b]);
            polygon(&mut text, &[low, b, high]);
        }
        for arith in Arith::all() {
            let hits = hits(arith, &text);
            assert!(
                covers(arith, hits, 7 * 25),
                "{} with seed {seed}: {hits}",
                arith.name()
            );
        }
    }
}

/// Lobes that cancel in Newell's sum, with as many digits as files have: the same picture as of its two triangles.
#[test]
fn a_rectangle_in_z_order_is_two_triangles() {
    for seed in 0..12 {
        let mut rng = Rng::with_seed(seed);
        let mut random = |size: f64| (size * (2.0 * rng.f64() - 1.0) * 1e3).round() / 1e3;
        let (o, u, v) = (
            [random(2.0), random(2.0), 0.0],
            [9.0, random(3.0), random(4.0)],
            [random(3.0), 7.0, random(4.0)],
        );
        let at =
            |a: f64, b: f64| [0, 1, 2].map(|i| ((o[i] + a * u[i] + b * v[i]) * 1e4).round() / 1e4);
        let (a, b, c, d, middle) = (
            at(0.0, 0.0),
            at(1.0, 0.0),
            at(0.0, 1.0),
            at(1.0, 1.0),
            at(0.5, 0.5),
        );
        let (mut crossed, mut parts) = (ABOVE.to_string(), ABOVE.to_string());
        polygon(&mut crossed, &[a, b, c, d]);
        polygon(&mut parts, &[a, b, middle]);
        polygon(&mut parts, &[middle, c, d]);
        for arith in [Arith::F64, Arith::F32, Arith::Auto] {
            let (crossed, parts) = (hits(arith, &crossed), hits(arith, &parts));
            assert!(
                crossed > 20 && crossed.abs_diff(parts) <= 2,
                "{crossed}, not {parts}"
            );
        }
    }
}
