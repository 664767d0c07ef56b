//! What a program that uses the library alone gets: a scene made in code or read from a file, a picture, and errors.

use octray_render::{Arith, Error, RenderSettings, Scene, SceneBuilder, Surface, picture, render};
use octray_render::{scenes, scenes::model::Shape};

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
