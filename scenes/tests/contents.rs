//! Every scene of this folder parses without a mistake, and the thesis's five have the contents that its tables state.

use octray_scenes::model::{Camera, Scene, Shape};
use octray_scenes::read;
use std::path::{Path, PathBuf};

/// Counts of a scene's contents.
#[derive(Debug, PartialEq)]
struct Contents {
    spheres: usize,
    boxes: usize,
    polygons: usize,
    lights: usize,
}

/// The thesis's figures: number and contents. Lights are the most that a table states: figures 19 and 21 have 2 and 3 in
/// their captions and in table V, 10 in tables III and IX.
const FIGURES: [(u32, Contents); 5] = [
    (19, contents(62, 0, 1, 10)),
    (20, contents(0, 15, 1, 10)),
    (21, contents(0, 5, 1, 10)),
    (22, contents(8, 0, 2, 6)),
    (23, contents(48, 0, 1, 6)),
];

const fn contents(spheres: usize, boxes: usize, polygons: usize, lights: usize) -> Contents {
    Contents {
        spheres,
        boxes,
        polygons,
        lights,
    }
}

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn scene(path: &Path) -> Scene {
    read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn every_scene_parses_and_is_not_empty() {
    let paths: Vec<PathBuf> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|name| name == "scene"))
        .collect();
    assert!(paths.len() >= FIGURES.len(), "only {}", paths.len());
    for path in paths {
        let scene = scene(&path);
        assert!(!scene.objects.is_empty(), "{}: no object", path.display());
        assert!(!scene.lights.is_empty(), "{}: no light", path.display());
    }
}

#[test]
fn the_figures_have_the_contents_that_the_thesis_states() {
    for (figure, expected) in FIGURES {
        let scene = scene(&folder().join(format!("figure-{figure}.scene")));
        let count = |kind: fn(&Shape) -> bool| {
            let shapes = scene.objects.iter().map(|object| object.shape);
            shapes.filter(kind).count()
        };
        let found = Contents {
            spheres: count(|shape| matches!(shape, Shape::Sphere { .. })),
            boxes: count(|shape| matches!(shape, Shape::Cuboid { .. })),
            polygons: count(|shape| matches!(shape, Shape::Polygon { .. })),
            lights: scene.lights.len(),
        };
        assert_eq!(found, expected, "figure {figure}");
        let all = found.spheres + found.boxes + found.polygons;
        assert_eq!(scene.objects.len(), all, "figure {figure}: other objects");
    }
}

#[test]
fn the_figures_have_the_camera_of_the_thesis() {
    for (figure, _) in FIGURES {
        let scene = scene(&folder().join(format!("figure-{figure}.scene")));
        assert_eq!((scene.width, scene.height), (512, 512), "figure {figure}");
        let thesis = matches!(scene.camera, Camera::Thesis { .. });
        assert!(thesis, "figure {figure}: {:?}", scene.camera);
    }
}
