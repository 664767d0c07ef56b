//! Lights far beyond the scene, and floors that are huge beside what stands on them.

use octray_prepare::Arith;
use octray_render::metric::Difference;
use octray_render::picture::Picture;
use octray_tests::oracle::{self, Options};
use octray_tests::shot::Shot;

const SIZE: (u32, u32) = (96, 72);

/// Balls, a cone, a box and a leaning tile on a square floor that reaches so far, under two lights.
fn scene(middle: [f64; 3], floor: f64, lights: [[f64; 3]; 2]) -> String {
    let [x, y, z] = middle;
    let at = |a: f64, b: f64, c: f64| format!("{} {} {}", x + a, y + b, z + c);
    let [first, second] = lights.map(|[a, b, c]| at(a, b, c));
    let corner = |u: f64, w: f64| at(u * floor, 0.0, w * floor);
    format!(
        "b 0.2 0.3 0.5\nv {}\nat {}\nup 0 1 0\nangle 42\nresolution 72 96\nl {first} 0.6\nl {second} 0.4\n\
         f 0.05 0.05 0.05 0.6 0.55 0.4 0 0 0 1 0.1 0\np 4 {} {} {} {}\n\
         f 0 0 0 0.7 0.2 0.1 0.5 0.5 0.5 30 0.3 0\ns {} 1\ns {} 0.4\n\
         f 0 0 0 0.1 0.5 0.2 0.2 0.2 0.2 9 0 0\nc {} 0.8 {} 0\nbox {} 1 1.2 1\n\
         f 0 0 0 0.2 0.3 0.7 0 0 0 1 0 0\np 3 {} {} {}\n",
        at(4.0, 3.0, 6.0),
        at(0.0, 0.8, 0.0),
        corner(-1.0, -1.0),
        corner(-1.0, 1.0),
        corner(1.0, 1.0),
        corner(1.0, -1.0),
        at(0.0, 1.0, 0.0),
        at(1.5, 0.4, 1.4),
        at(-1.9, 0.0, 0.9),
        at(-1.9, 1.7, 0.9),
        at(0.6, 0.6, -2.2),
        at(-1.0, 0.0, 2.0),
        at(0.2, 0.0, 2.4),
        at(-0.4, 1.1, 2.1),
    )
}

fn picture(text: &str, arith: Arith) -> Picture {
    let scene = octray_scenes::parse(text).unwrap_or_else(|e| panic!("{}", e.draw("far", text)));
    Shot::new(arith).size(SIZE.0, SIZE.1).take(&scene).picture
}

/// The decibels by which pictures of some arithmetics differ from that in f64, and that from the oracle's.
fn compare(name: &str, text: &str, least: &[(Arith, f64)]) -> Vec<String> {
    let exact = picture(text, Arith::F64);
    let theirs = oracle::render(text, &Options::default());
    let (expected, _) = theirs.rgb.as_chunks::<3>();
    let off = exact.levels().iter().zip(expected);
    let off = off
        .filter(|(a, b)| (0..3).any(|i| a[i].abs_diff(b[i]) > 1))
        .count();
    let mut wrong = Vec::new();
    if off > 7 {
        wrong.push(format!("{name}: {off} pixels are not the oracle's"));
    }
    for &(arith, least) in least {
        let psnr = Difference::between(&exact, &picture(text, arith))
            .unwrap()
            .psnr();
        if psnr < least {
            wrong.push(format!("{name}: {} has {psnr:.1} dB", arith.name()));
        }
    }
    wrong
}

#[test]
fn a_light_s_distance_is_no_part_of_the_scene() {
    let least = [
        (Arith::F32, 55.0),
        (Arith::Auto, 50.0),
        (Arith::I16F16, 40.0),
        (Arith::APPROX2, 45.0),
    ];
    let mut wrong = Vec::new();
    for away in [20.0, 70.0, 200.0, 1e4, 1e6, 1e9, 1e15] {
        for middle in [[0.0; 3], [300.0, -40.0, 7.0]] {
            let lights = [[0.5, 0.7, 0.4], [-0.6, 0.6, 0.1]].map(|l| l.map(|c| c * away));
            let text = scene(middle, 8.0, lights);
            wrong.extend(compare(&format!("lights at {away:e}"), &text, &least));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_floor_s_size_is_no_matter_where_rounding_is_relative() {
    let lights = [[5.0, 7.0, 4.0], [-6.0, 6.0, 1.0]];
    let mut wrong = Vec::new();
    for floor in [1e2, 1e4, 1e6, 2e7] {
        let text = scene([0.0; 3], floor, lights);
        wrong.extend(compare(
            &format!("floor of {floor:e}"),
            &text,
            &[(Arith::F32, 55.0)],
        ));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
