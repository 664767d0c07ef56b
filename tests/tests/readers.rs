//! All that is read from files, on files that somebody has damaged: the fuzz targets, with a fixed seed.

#[path = "../../fuzz/src/lib.rs"]
pub mod fuzz;

use fastrand::Rng;
use octray_prepare::choice::Choice;
use octray_render::picture::{Picture, RasDepth, Target};
use std::fs;
use std::path::{Path, PathBuf};

/// As many damaged files for each reader.
const RUNS: usize = 10_000;

/// Words that have broken readers elsewhere.
const WORDS: [&str; 14] = [
    "0",
    "-1",
    "-0.0",
    "1e308",
    "-1e400",
    "1e-320",
    "nan",
    "inf",
    "65536",
    "4294967296",
    "18446744073709551616",
    "\u{feff}",
    "\"",
    "#",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The files of a folder whose names end so, none of them large, always in the same order.
fn files(folder: &str, end: &str) -> Vec<Vec<u8>> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let named = |path: &&PathBuf| path.extension().is_some_and(|found| found == end);
    let files = paths
        .iter()
        .filter(named)
        .map(|path| fs::read(path).unwrap());
    files.filter(|bytes| bytes.len() < 20_000).collect()
}

/// One to eight small damages.
fn damaged(rng: &mut Rng, seeds: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = rng.choice(seeds).unwrap().clone();
    for _ in 0..rng.usize(1..=8) {
        let at = rng.usize(..=bytes.len());
        let end = (at + rng.usize(..16)).min(bytes.len());
        match rng.u8(..7) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => bytes.insert(at, rng.u8(..)),
            3 if at < end => bytes[at] ^= 1 << rng.u8(..8),
            4 => {
                let word = rng.choice(WORDS).unwrap();
                bytes.splice(at..end, word.bytes());
            }
            5 => {
                let again = bytes[at..end].to_vec();
                bytes.splice(at..at, again);
            }
            _ => {
                let other = rng.choice(seeds).unwrap();
                let from = rng.usize(..=other.len());
                let to = (from + rng.usize(..64)).min(other.len());
                bytes.splice(at..end, other[from..to].iter().copied());
            }
        }
    }
    bytes
}

fn try_all(read: fn(&[u8]), seeds: &[Vec<u8>]) {
    assert!(!seeds.is_empty());
    seeds.iter().for_each(|seed| read(seed));
    let mut rng = Rng::with_seed(1);
    for _ in 0..RUNS {
        read(&damaged(&mut rng, seeds));
    }
}

#[test]
fn scenes_are_read_or_refused() {
    let seeds = [files("scenes", "scene"), files("scenes/invalid", "scene")];
    try_all(fuzz::scene, &seeds.concat());
}

#[test]
fn pictures_are_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut seeds = files("tests/golden", "png");
    let levels = (0..6).map(|i| [i, 10 * i, 40 * i]).collect();
    let small = Picture::from_levels(3, 2, levels).unwrap();
    for name in ["a.png", "a.ppm", "a.pfm", "a.ras", "a.int"] {
        let path = folder.path().join(name);
        let target = Target::new(path.clone()).unwrap();
        for depth in RasDepth::all() {
            target.write(&small, depth, &Default::default()).unwrap();
            seeds.push(fs::read(&path).unwrap());
        }
    }
    try_all(fuzz::picture, &seeds);
}

#[test]
fn plans_are_read_or_refused() {
    try_all(fuzz::plan, &files("fuzz/seeds/plan", "toml"));
}

#[test]
fn tables_of_figures_are_read_or_refused() {
    let mut seeds = files("lab/src/tables", "csv");
    let record = fs::read_to_string(root().join("lab/record/plan.csv")).unwrap();
    let lines: Vec<_> = record.lines().take(6).collect();
    seeds.push(lines.join("\n").into());
    try_all(fuzz::csv, &seeds);
}
