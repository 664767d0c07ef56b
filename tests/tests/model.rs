//! In `f64` octray renders the oracle's picture: at least 99.9 % of the pixels are within one level, and the numbers of
//! rays of each kind are nearly equal.

use octray_prepare::choice::Choice;
use octray_prepare::{Arith, PixelsPerRay};
use octray_render::stats::Rays;
use octray_tests::oracle::{self, Counts};
use octray_tests::shot::{self, Shot};
use octray_tests::strew;
use std::fs;

/// The seeds of random scenes; `OCTRAY_SEEDS=from..to` selects others.
fn seeds() -> std::ops::Range<u64> {
    let chosen = std::env::var("OCTRAY_SEEDS").ok().map(|text| {
        let (from, to) = text.split_once("..").expect("from..to");
        from.parse().expect("a number")..to.parse().expect("a number")
    });
    chosen.unwrap_or(0..80)
}

#[test]
fn random_scenes_match_the_model() {
    let mut failures = Vec::new();
    for seed in seeds() {
        let source = strew::picture(seed);
        let mut shot = Shot::new(Arith::F64);
        if seed % 3 == 1 {
            shot = shot.size(77, 53);
        }
        match seed % 5 {
            1 => shot.settings.pixels_per_ray = PixelsPerRay::all()[(seed / 5 % 8) as usize],
            2 => shot.settings.samples = 2,
            3 => shot.settings.max_depth = (seed / 5 % 4) as u32,
            4 => shot.settings.cut_off = 0.0,
            _ => {}
        }
        failures.extend(compare(&format!("seed {seed}"), &source, &shot));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn the_scenes_match_the_model() {
    let mut failures = Vec::new();
    for path in shot::scene_files() {
        let source = fs::read_to_string(&path).unwrap();
        let shot = Shot::new(Arith::F64).size(100, 100);
        failures.extend(compare(&shot::stem(&path), &source, &shot));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Returns what is wrong with octray's picture of a scene.
fn compare(name: &str, source: &str, shot: &Shot) -> Option<String> {
    let scene = octray_scenes::parse(source)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.draw(name, source)));
    let ours = shot.take(&scene);
    let options = oracle::Options {
        size: shot.settings.size,
        pixels_per_ray: shot.settings.pixels_per_ray.number(),
        samples: shot.settings.samples,
        max_depth: shot.settings.max_depth,
        cut_off: shot.settings.cut_off,
    };
    let theirs = oracle::render(source, &options);
    assert_eq!(ours.picture.size(), (theirs.width, theirs.height), "{name}");
    let (expected, _) = theirs.rgb.as_chunks::<3>();
    let width = theirs.width as usize;
    let off: Vec<String> = ours
        .picture
        .levels()
        .iter()
        .zip(expected)
        .enumerate()
        .filter(|(_, (a, b))| (0..3).any(|i| a[i].abs_diff(b[i]) > 1))
        .map(|(i, (a, b))| format!("({}, {}): {a:?} not {b:?}", i % width, i / width))
        .collect();
    let rays = unlike(&Rays::of(&ours.counters), &theirs.counts);
    if off.len() * 1000 <= expected.len() && rays.is_none() {
        return None;
    }
    Some(format!(
        "{name}: {} of {} pixels differ{}; {}",
        off.len(),
        expected.len(),
        rays.unwrap_or_default(),
        off[..off.len().min(8)].join(", ")
    ))
}

/// Returns which numbers of rays differ by more than a few. Octray traces no rays for pixels that cannot show an
/// object, so it may have fewer primary rays.
fn unlike(ours: &Rays, theirs: &Counts) -> Option<String> {
    let kinds = [
        ("shadow", ours.shadow, theirs.shadow),
        ("blocked", ours.blocked, theirs.blocked),
        ("reflected", ours.reflected, theirs.reflected),
        ("transmitted", ours.transmitted, theirs.transmitted),
    ];
    let off: Vec<String> = kinds
        .into_iter()
        .filter(|(_, a, b)| a.abs_diff(*b) > 10 + b / 500)
        .map(|(kind, a, b)| format!(", {a} {kind} rays not {b}"))
        .collect();
    let primary = ours.primary > theirs.primary || ours.primary < theirs.eye_hits;
    (!off.is_empty() || primary).then(|| off.concat())
}
