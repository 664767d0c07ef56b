//! A small picture of every scene, as it was when somebody last looked at it.
//!
//! `OCTRAY_UPDATE_GOLDEN=1` renders the pictures in `golden/` anew; look at them before committing.

use octray_prepare::Arith;
use octray_render::interrupt::Interrupt;
use octray_render::metric::Difference;
use octray_render::picture::{self, RasDepth, Target};
use octray_scenes::generate::{SceneKind, Spec, generate};
use octray_tests::shot::{self, Shot};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Rows of the pictures; their proportions are the scenes' own.
const HEIGHT: u32 = 90;

/// Where the benchmark of speed has the hashes of its pictures.
const BENCHMARK: &str = "../host/render/benches/pictures.csv";

/// The most objects of a scene of the benchmark that is traced here, too.
const MOST_OBJECTS: usize = 1000;

/// Arithmetic is the same on every machine. But where a formula is changed for the better, pixels
/// at edges may change sides: one in 500 may differ by more than a level.
const SHARE: f64 = 0.002;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden")
}

#[test]
fn every_scene_looks_as_it_did() {
    let update = std::env::var_os("OCTRAY_UPDATE_GOLDEN").is_some();
    let mut failures = Vec::new();
    for path in shot::scene_files() {
        let name = format!("{}.png", shot::stem(&path));
        let golden = folder().join(&name);
        let scene = shot::read(&path);
        let shot = Shot::new(Arith::F32).size(HEIGHT * scene.width / scene.height, HEIGHT);
        let taken = shot.take(&scene).picture;
        if update {
            fs::create_dir_all(folder()).unwrap();
            let target = Target::new(golden).unwrap();
            target
                .write(&taken, RasDepth::Eight, &Interrupt::new())
                .unwrap();
            continue;
        }
        match picture::read(&golden) {
            Err(error) => failures.push(error.to_string()),
            Ok(golden) => match Difference::between(&golden, &taken) {
                Err(error) => failures.push(format!("{name}: {error}")),
                Ok(difference) => {
                    let share = difference.beyond_1 as f64 / difference.pixels as f64;
                    if share > SHARE {
                        failures.push(format!(
                            "{name}: {} pixels beyond one level, {:.1} dB",
                            difference.beyond_1,
                            difference.psnr()
                        ));
                    }
                }
            },
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_picture_has_its_scene() {
    let scenes: BTreeSet<String> = shot::scene_files()
        .iter()
        .map(|path| shot::stem(path))
        .collect();
    for entry in fs::read_dir(folder()).expect("there are golden pictures") {
        let name = shot::stem(&entry.unwrap().path());
        assert!(scenes.contains(&name), "{name}.png has no scene any more");
    }
}

#[test]
fn the_benchmark_knows_its_pictures() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let known = fs::read_to_string(root.join(BENCHMARK)).unwrap();
    let mut wrong = Vec::new();
    let mut compared = 0;
    for line in known.lines().skip(1) {
        let (name, expected) = line.split_once(',').unwrap();
        let scene = match name.split_once(' ') {
            None => shot::read(&root.join("../scenes").join(name).with_extension("scene")),
            Some((kind, objects)) => {
                let kind = SceneKind::ALL
                    .into_iter()
                    .find(|known| known.name() == kind);
                let (kind, objects) = (kind.unwrap(), objects.parse().unwrap());
                if objects > MOST_OBJECTS {
                    continue;
                }
                generate(Spec { kind, objects }, 1)
            }
        };
        let mut shot = Shot::new(Arith::F32).size(512, 512);
        (shot.settings.max_depth, shot.settings.cut_off) = (4, 0.0);
        let hash = format!("{:016x}", shot.take(&scene).picture.hash());
        if hash != expected {
            wrong.push(format!("{name},{hash}"));
        }
        compared += 1;
    }
    assert!(compared > 10);
    assert!(wrong.is_empty(), "in {BENCHMARK}:\n{}", wrong.join("\n"));
}
