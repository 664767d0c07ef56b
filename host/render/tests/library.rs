//! What a program that uses the library alone gets: a scene made in code or read from a file, a picture, and errors.

use octray_render::{Arith, Error, RenderSettings, Scene, SceneBuilder, Surface, picture, render};
use octray_render::{scenes, scenes::model::Shape};
use std::path::Path;

const SMALL: RenderSettings = RenderSettings {
    arith: Arith::I16F16,
    size: Some((64, 48)),
    ..RenderSettings::DEFAULT
};

fn ball() -> SceneBuilder {
    let mut scene = SceneBuilder::look([0.0, 2.0, 6.0], [0.0, 0.7, 0.0], 40.0);
    scene.background([0.3, 0.5, 0.8]);
    scene.light([4.0, 6.0, 4.0], 1.0);
    let red = Surface::glossy([0.8, 0.2, 0.1], 30.0, 0.2);
    scene.sphere([0.0, 1.0, 0.0], 1.0, red);
    scene
}

#[test]
fn a_scene_made_in_code_gives_the_picture_of_its_file() {
    let scene = ball().build().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ball.scene");
    let mut text = Vec::new();
    scenes::write(&scene, &mut text).unwrap();
    std::fs::write(&file, text).unwrap();
    let [code, file] = [scene, scenes::read(&file).unwrap()].map(|s| render(&s, &SMALL).unwrap());
    assert_eq!(code.picture, file.picture);
    assert_eq!(code.counters, file.counters);
    assert!(code.counters.all_rays() > 500, "{:?}", code.counters);
}

#[test]
fn a_picture_is_saved_in_the_format_of_its_ending_or_not_at_all() {
    let rendering = render(&ball().build().unwrap(), &SMALL).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.png", "a.ppm", "a.pfm", "a.int", "a.RAS"] {
        let path = folder.path().join(name);
        rendering.save(&path).unwrap();
        let again = picture::read(&path).unwrap();
        assert_eq!(again.size(), (64, 48), "{name}");
        // A rasterfile has 256 colours.
        assert!(
            again.levels() == rendering.picture.levels() || name == "a.RAS",
            "{name}"
        );
    }
    let count = || std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(count(), 5);
    let unknown = rendering.save(folder.path().join("a.jpg")).unwrap_err();
    assert!(matches!(unknown, Error::Usage(_)), "{unknown}");
    let nowhere = rendering.save(folder.path().join("no/a.png")).unwrap_err();
    assert!(matches!(nowhere, Error::Write { .. }), "{nowhere}");
    assert_eq!(count(), 5);
}

#[test]
fn mistakes_reach_main_as_lines_with_their_calls() {
    let make = || -> Result<Scene, Error> {
        let mut scene = ball();
        scene.sphere([0.0; 3], -1.0, Surface::matt([1.0; 3]));
        scene.light([0.0; 3], f64::NAN);
        Ok(scene.build()?)
    };
    let line = line!() - 4;
    let error = make().unwrap_err();
    // `main` shows Debug.
    let text = format!("{error:?}");
    let (place, _) = text.split_once(": error: sphere 2: radius -1: ").unwrap();
    assert!(place.starts_with(&format!("{}:{line}:", file!())), "{text}");
    assert_eq!(text.lines().count(), 2, "{text}");
}

#[test]
fn a_scene_or_a_setting_that_breaks_a_rule_is_refused() {
    let mut scene = ball().build().unwrap();
    let settings = RenderSettings {
        size: Some((0, 48)),
        ..SMALL
    };
    let error = render(&scene, &settings).unwrap_err();
    assert!(matches!(error, Error::Usage(_)));
    assert_eq!(
        error.to_string(),
        "setting size (columns) 0: expected 1 to 65535"
    );

    scene.objects[0].shape = Shape::Sphere {
        centre: [0.0; 3],
        radius: f64::NAN,
    };
    let error = render(&scene, &SMALL).unwrap_err();
    assert!(matches!(error, Error::Scene(_)));
    assert_eq!(
        error.to_string(),
        "error: object 0: a number that is not finite"
    );
}

/// The example is built as its reader would, but with what is built already.
#[test]
fn the_example_for_hosts_builds_and_makes_its_picture() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let example = root.join("examples/hello-host");
    let packages = |folder: &Path| -> Vec<String> {
        let lock = std::fs::read_to_string(folder.join("Cargo.lock")).unwrap();
        let pair = |package: &str| package.lines().take(3).collect::<Vec<_>>().join(" ");
        lock.split("[[package]]").skip(1).map(pair).collect()
    };
    let known = packages(&root);
    for package in packages(&example) {
        let ours = package.contains("\"hello-host\"") || known.contains(&package);
        assert!(
            ours,
            "{package} is not in Cargo.lock: copy that to the example, then `cargo metadata`"
        );
    }

    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    let built = std::process::Command::new(env!("CARGO"))
        .args(["build", "--locked", "--offline"])
        .current_dir(&example)
        .env("CARGO_TARGET_DIR", target)
        .env_remove("CARGO_BUILD_TARGET")
        .output()
        .unwrap();
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );

    let folder = tempfile::tempdir().unwrap();
    let program = format!("debug/hello-host{}", std::env::consts::EXE_SUFFIX);
    let run = std::process::Command::new(target.join(program))
        .current_dir(&folder)
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    // Fixed point: the same on every machine.
    let hash = "4af436c2965fff68";
    assert_eq!(
        String::from_utf8_lossy(&run.stdout),
        format!("hello.png: hash {hash}\n")
    );
    let saved = picture::read(&folder.path().join("hello.png")).unwrap();
    assert_eq!(format!("{:016x}", saved.hash()), hash);
}
