//! Scenes made in code are what the parser makes of the same scene in a file, and refused where it refuses.

mod support;

use octray_scenes::builder::SceneBuilder;
use octray_scenes::diagnostic::{MOST, MOST_WARNINGS};
use octray_scenes::model::{Camera, Checker, Object, Point, Projection, Scene, Shape, Surface};
use octray_scenes::{check, parse, parse_with_warnings, write};
use proptest::collection::vec;
use proptest::prelude::*;
use std::fmt::Write;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn a_scene_made_in_code_is_the_same_when_written_and_parsed(scene in support::scene()) {
        let built = rebuilt(&scene, |object| object.surface as usize);
        prop_assert_eq!(check::scene(&built), Ok(()));
        prop_assert_eq!(resolved(&built), resolved(&scene));
        let again = parse(&text(&built)).unwrap();
        prop_assert_eq!(resolved(&again), resolved(&built));
        // A file's objects have the last surface before them.
        if built.objects.is_sorted_by_key(|object| object.surface) {
            prop_assert_eq!(again, built);
        }
    }

    #[test]
    fn objects_may_have_their_surfaces_in_any_order(scene in support::scene(), step in 1usize..5) {
        let surface = |object: &Object| (object.surface as usize * step + 1) % scene.surfaces.len();
        let built = rebuilt(&scene, surface);
        let wanted: Vec<_> = scene.objects.iter().map(|o| scene.surfaces[surface(o)]).collect();
        let found: Vec<_> = resolved(&built).1.into_iter().map(|(_, surface)| surface).collect();
        prop_assert_eq!(found, wanted);
        prop_assert!(built.surfaces.len() <= scene.surfaces.len());
        prop_assert_eq!(resolved(&parse(&text(&built)).unwrap()), resolved(&built));
    }

    /// Whatever the numbers, also NaN, the infinities and -0.
    #[test]
    fn code_and_file_are_refused_alike(kind in 0usize..11, numbers in vec(number(), 24), count in 0usize..5) {
        let (builder, source) = both(kind, &numbers, count);
        match (builder.build(), parse(&source)) {
            (Ok(built), Ok(parsed)) => prop_assert_eq!(built, parsed),
            (Err(_), Err(_)) => {}
            // The sign of a radius means nothing in a file.
            (Err(mistakes), Ok(_)) if matches!(kind, 0 | 1) => {
                prop_assert!(mistakes.to_string().contains("radius -"), "{}: {}", source, mistakes);
            }
            (built, parsed) => prop_assert!(false, "{}: {:?}, {:?}", source, built, parsed),
        }
    }
}

/// Numbers of which many are wrong somewhere.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => prop::sample::select(vec![0.0, 1.0, 2.0, 0.5]),
        4 => -2.0..2.0,
        1 => prop::sample::select(vec![-0.0, -1.0, 1e-9, 1e308, -1e308, 5e-324, 70_000.0]),
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
    ]
}

/// One call with these numbers, and a file with the same entity.
fn both(kind: usize, n: &[f64], count: usize) -> (SceneBuilder, String) {
    let point = |at: usize| -> Point { [n[at], n[at + 1], n[at + 2]] };
    let grey = Surface {
        diffuse: [1.0; 3],
        ..Surface::default()
    };
    let mut scene = SceneBuilder::with_camera(Camera::Thesis {
        viewpoint: [0.0, 0.0, 9.0],
        projection: Projection::Perspective,
    });
    let written = |numbers: &[f64]| -> String {
        let number = |text: &mut String, n| write!(text, " {n:e}").unwrap();
        let mut text = String::new();
        numbers.iter().for_each(|n| number(&mut text, n));
        text
    };
    let entity = match kind {
        0 => {
            scene.sphere(point(0), n[3], grey);
            format!("s{}", written(&n[..4]))
        }
        1 => {
            scene.cone(point(0), n[3], point(4), n[7], grey);
            format!("c{}", written(&n[..8]))
        }
        2 => {
            scene.cuboid(point(0), point(3), grey);
            format!("box{}", written(&n[..6]))
        }
        3 => {
            let vertices: Vec<_> = (0..count).map(|i| point(3 * i)).collect();
            scene.polygon(&vertices, grey);
            format!("p {count}{}", written(&n[..3 * count]))
        }
        4 => {
            let corners: Vec<_> = (0..count)
                .map(|i| (point(6 * i), point(6 * i + 3)))
                .collect();
            scene.patch(&corners, grey);
            format!("pp {count}{}", written(&n[..6 * count]))
        }
        5 => {
            scene.light(point(0), n[3]);
            format!("l{}", written(&n[..4]))
        }
        6 => {
            scene.coloured_light(point(0), point(3));
            format!("l{}", written(&n[..6]))
        }
        7 => {
            scene.background(point(0));
            format!("b{}", written(&n[..3]))
        }
        8 => {
            scene.sky(point(0), point(3));
            format!("b{}", written(&n[..6]))
        }
        9 => {
            let surface = Surface {
                ambient: point(0),
                diffuse: point(3),
                specular: point(6),
                shine: n[9],
                reflect: n[10],
                refract: n[11],
                ior: n[12],
                checker: Some(Checker {
                    size: n[13],
                    ambient: point(14),
                    diffuse: point(17),
                }),
            };
            scene.sphere([0.0; 3], 1.0, surface);
            let (surface, checker) = (written(&n[..13]), written(&n[13..20]));
            let source = format!("v 0 0 9 f{surface} checker{checker} s 0 0 0 1");
            return (scene, source);
        }
        _ => {
            let camera = Camera::Nff {
                from: point(0),
                at: point(3),
                up: point(6),
                angle: n[9],
                projection: Projection::Parallel,
            };
            let parts = [&n[..3], &n[3..6], &n[6..9], &n[9..10]].map(written);
            let [from, at, up, angle] = parts;
            let source = format!("v{from} at{at} up{up} angle{angle} view parallel");
            return (SceneBuilder::with_camera(camera), source);
        }
    };
    // A surface without objects is not in a scene made in code.
    let surface = if kind < 5 {
        "f 0 0 0 1 1 1 0 0 0 0 0 0"
    } else {
        ""
    };
    (scene, format!("v 0 0 9 {surface} {entity}"))
}

/// The same scene, made by calls.
fn rebuilt(scene: &Scene, surface: impl Fn(&Object) -> usize) -> Scene {
    let mut builder = SceneBuilder::with_camera(scene.camera);
    builder.size(scene.width, scene.height);
    match scene.zenith {
        Some(zenith) => builder.sky(scene.background, zenith),
        None => builder.background(scene.background),
    }
    for light in &scene.lights {
        builder.coloured_light(light.position, light.colour);
    }
    for object in &scene.objects {
        let surface = scene.surfaces[surface(object)];
        let range = |first: u32, count: u32| first as usize..(first + count) as usize;
        match object.shape {
            Shape::Sphere { centre, radius } => builder.sphere(centre, radius, surface),
            Shape::Cuboid { centre, size } => builder.cuboid(centre, size, surface),
            Shape::Cone {
                base,
                base_radius,
                top,
                top_radius,
            } if base_radius == top_radius => builder.cylinder(base, top, top_radius, surface),
            Shape::Cone {
                base,
                base_radius,
                top,
                top_radius,
            } => builder.cone(base, base_radius, top, top_radius, surface),
            Shape::Polygon { first, count } => {
                builder.polygon(&scene.vertices[range(first, count)], surface);
            }
            Shape::Patch {
                first,
                count,
                first_normal,
            } => {
                let vertices = scene.vertices[range(first, count)].iter().copied();
                let normals = scene.normals[range(first_normal, count)].iter().copied();
                builder.patch(&vertices.zip(normals).collect::<Vec<_>>(), surface);
            }
        }
    }
    builder.build().unwrap()
}

/// A scene without its surfaces, and its shapes with theirs.
fn resolved(scene: &Scene) -> (Scene, Vec<(Shape, Surface)>) {
    let object = |o: &Object| (o.shape, scene.surfaces[o.surface as usize]);
    let objects = scene.objects.iter().map(object).collect();
    let rest = Scene {
        surfaces: vec![],
        objects: vec![],
        ..scene.clone()
    };
    (rest, objects)
}

fn text(scene: &Scene) -> String {
    let mut text = Vec::new();
    write(scene, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

const GREY: Surface = Surface {
    ambient: [0.0; 3],
    diffuse: [0.5; 3],
    specular: [0.0; 3],
    shine: 0.0,
    reflect: 0.0,
    refract: 0.0,
    ior: 1.0,
    checker: None,
};

fn empty() -> SceneBuilder {
    SceneBuilder::look([0.0, 0.0, 5.0], [0.0; 3], 40.0)
}

/// What is said about a scene, without the places of the calls.
fn told(scene: SceneBuilder) -> String {
    let mistakes = scene.build().unwrap_err().to_string();
    let lines = mistakes
        .lines()
        .map(|line| match line.split_once(": error: ") {
            Some((_, told)) => told,
            None => line,
        });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_mistake_of_an_object_is_told_with_its_value_and_what_was_expected() {
    let square = |z: f64| {
        [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, z],
            [0.0, 1.0, 0.0],
        ]
    };
    let up = [0.0, 1.0, 0.0];
    let mut scene = empty();
    scene.sphere([0.0; 3], 1.0, GREY);
    scene.sphere([0.0; 3], -1.0, GREY);
    scene.sphere([-1.0; 3], 0.0, GREY);
    scene.sphere([0.0, f64::INFINITY, 1.5], 1.0, GREY);
    scene.cone([-1.0; 3], 1.0, [0.0; 3], -0.25, GREY);
    scene.cone([0.0; 3], 0.0, [1.0; 3], 0.0, GREY);
    scene.cylinder([1.0; 3], [1.0; 3], 1.0, GREY);
    scene.cuboid([0.0; 3], [1.0, 0.0, 1.0], GREY);
    scene.polygon(&square(0.0)[..2], GREY);
    scene.polygon(&square(0.25), GREY);
    scene.polygon(&square(f64::NAN), GREY);
    let corners = square(0.0).map(|vertex| (vertex, up));
    scene.patch(&corners[1..], GREY);
    scene.patch(&[corners[0], (corners[1].0, [0.0; 3]), corners[2]], GREY);
    // Also where nothing would be drawn.
    scene.patch(&[(up, up), (up, up), (up, [f64::NAN; 3])], GREY);
    snapbox::assert_data_eq!(
        told(scene),
        snapbox::str![[r#"
sphere 2: radius -1: expected a radius above 0
sphere 3: radius 0: expected a radius other than 0
sphere 4: centre [0, inf, 1.5]: expected finite numbers
cone 1: top radius -0.25: expected a radius above 0
cone 2: top radius 0: expected at least one radius other than 0
cylinder 1: top [1, 1, 1]: expected a top at another place than the base
box 1: size [1, 0, 1]: expected a length above 0 for every side
polygon 1: number of vertices 2: expected at least 3 vertices
polygon 2: vertex 4 [0, 1, 0]: 0.243 off the plane of the other vertices, expected no more than 0.00144: split it into triangles
polygon 3: vertex 3 [1, 1, NaN]: expected finite numbers
patch 2: normal 2 [0, 0, 0]: expected a normal of any other length
patch 3: normal 3 [NaN, NaN, NaN]: expected finite numbers
"#]]
    );
}

#[test]
fn every_mistake_of_a_surface_is_told_with_the_first_object_that_has_it() {
    let mut scene = empty();
    let black = Surface {
        diffuse: [0.5, -0.5, 0.5],
        ..GREY
    };
    scene.sphere([0.0; 3], 1.0, black);
    scene.cuboid([0.0; 3], [1.0; 3], black);
    scene.sphere(
        [0.0; 3],
        0.0,
        Surface {
            shine: -1.0,
            ..GREY
        },
    );
    scene.sphere(
        [0.0; 3],
        1.0,
        Surface {
            reflect: f64::NAN,
            ..GREY
        },
    );
    scene.sphere([0.0; 3], 1.0, Surface::glass(0.0));
    scene.sphere([0.0; 3], 1.0, GREY.checkered(0.0, GREY));
    scene.sphere([0.0; 3], 1.0, GREY.checkered(1.0, black));
    snapbox::assert_data_eq!(
        told(scene),
        snapbox::str![[r#"
sphere 1: diffuse [0.5, -0.5, 0.5]: expected at least 0
sphere 2: shine -1: expected at least 0
sphere 2: radius 0: expected a radius other than 0
sphere 3: reflect NaN: expected finite numbers
sphere 4: ior 0: expected above 0, as the surface lets light through
sphere 5: checker size 0: expected a size above 0
sphere 6: checker diffuse [0.5, -0.5, 0.5]: expected at least 0
"#]]
    );
}

#[test]
fn every_mistake_of_the_whole_is_told() {
    let camera = |from, at, up, angle| Camera::Nff {
        from,
        at,
        up,
        angle,
        projection: Projection::Perspective,
    };
    let (far, up) = ([0.0, 0.0, 9.0], [0.0, 1.0, 0.0]);
    let cameras = [
        camera(far, far, up, 40.0),
        camera(far, [0.0; 3], [0.0; 3], 40.0),
        camera(far, [0.0; 3], far, 40.0),
        camera(far, [0.0; 3], up, 180.0),
        camera([f64::NAN; 3], [0.0; 3], up, 40.0),
        camera(far, [0.0; 3], up, f64::NAN),
        Camera::Thesis {
            viewpoint: [1.0, 2.0, 0.0],
            projection: Projection::Parallel,
        },
    ];
    let mut all: Vec<_> = (cameras.into_iter())
        .map(|camera| told(SceneBuilder::with_camera(camera)))
        .collect();
    let mut scene = empty();
    scene.size(0, 65_536);
    scene.background([0.1, 0.2, -0.3]);
    scene.sky([1.0; 3], [1.0, f64::NAN, 1.0]);
    scene.light([-1.0; 3], -0.5);
    scene.coloured_light([0.0; 3], [1.0, -1.0, 1.0]);
    all.push(told(scene));
    snapbox::assert_data_eq!(
        all.join("\n"),
        snapbox::str![[r#"
camera: at [0, 0, 9]: same as the viewpoint; expected another place
camera: up [0, 0, 0]: expected a direction of any other length
camera: up [0, 0, 9]: expected a direction that differs from the view
camera: angle 180: expected above 0 and below 180
camera: from [NaN, NaN, NaN]: expected finite numbers
camera: angle NaN: expected above 0 and below 180
camera: viewpoint [1, 2, 0]: expected a z other than 0: the picture plane is z = 0
size: width 0: expected a whole number from 1 to 65535
size: height 65536: expected a whole number from 1 to 65535
background: colour [0.1, 0.2, -0.3]: expected at least 0
background: zenith [1, NaN, 1]: expected finite numbers
light 1: brightness -0.5: expected at least 0
light 2: colour [1, -1, 1]: expected at least 0
"#]]
    );
}

#[test]
fn a_mistake_knows_its_call_and_the_first_twenty_are_kept() {
    let mut scene = empty();
    let line = line!() + 1;
    scene.sphere([0.0; 3], -1.0, GREY);
    for _ in 1..=MOST {
        scene.cuboid([0.0; 3], [0.0; 3], GREY);
    }
    let mistakes = scene.build().unwrap_err();
    assert_eq!((mistakes.list.len(), mistakes.more), (MOST, true));
    let caller = mistakes.list[0].caller;
    assert_eq!((caller.file(), caller.line()), (file!(), line));
    let text = mistakes.to_string();
    assert!(
        text.starts_with(&format!("{caller}: error: sphere 1: ")),
        "{text}"
    );
    assert!(
        text.ends_with("\nand more: only the first 20 mistakes are shown"),
        "{text}"
    );
}

#[test]
fn what_is_odd_but_harmless_is_told_as_for_files() {
    let mut scene = empty();
    scene.polygon(&[[0.0; 3], [1.0; 3], [2.0; 3]], GREY);
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    scene.polygon(&[a, b, b, c], GREY);
    scene.patch(
        &[(a, c), (b, c), (c, c), ([0.0, 1.0, 1e-3], c), (a, c)],
        GREY,
    );
    for _ in 0..MOST_WARNINGS {
        scene.polygon(&[a, b, c, a], GREY);
    }
    let (scene, warnings) = scene.build_with_warnings().unwrap();
    assert_eq!(scene.objects.len(), 2 + MOST_WARNINGS);
    assert_eq!(scene.vertices.len(), 4 + 5 + 4 * MOST_WARNINGS);

    let source = "v 0 0 9 f 1 1 1 1 0 0 0 0  p 3 0 0 0 1 1 1 2 2 2  p 4 0 0 0 1 0 0 1 0 0 1 1 0
        pp 5 0 0 0 1 1 0  1 0 0 1 1 0  1 1 0 1 1 0  0 1 1e-3 1 1 0  0 0 0 1 1 0";
    let (_, of_file) = parse_with_warnings(source).unwrap();
    let kinds: Vec<_> = of_file.list.iter().map(|warning| warning.kind).collect();
    let found: Vec<_> = warnings.list.iter().map(|warning| warning.kind).collect();
    assert_eq!(found[..kinds.len()], kinds);

    let lines = warnings.to_string();
    let lines = lines
        .lines()
        .map(|line| line.split_once(": warning: ").map_or(line, |told| told.1));
    let lines = lines.collect::<Vec<_>>().join("\n");
    snapbox::assert_data_eq!(
        lines,
        snapbox::str![[r#"
polygon 1: left out: its vertices lie on one line
polygon 2: vertex 3: same as the vertex before it
patch 1: vertex 2: 0.001 off the plane of the other vertices; the polygon is drawn flat
polygon 3: vertex 1: same as the last vertex, which needs no repeating: the polygon closes itself
polygon 4: vertex 1: same as the last vertex, which needs no repeating: the polygon closes itself
3 more warnings
"#]]
    );
}

#[test]
fn equal_surfaces_are_one() {
    let mut scene = empty();
    let checkered = GREY.checkered(1.0, Surface::matt([1.0; 3]));
    for surface in [GREY, checkered, GREY, Surface::glass(1.5), checkered] {
        scene.sphere([0.0; 3], 1.0, surface);
    }
    let scene = scene.build().unwrap();
    assert_eq!(scene.surfaces, [GREY, checkered, Surface::glass(1.5)]);
    let of: Vec<_> = scene.objects.iter().map(|object| object.surface).collect();
    assert_eq!(of, [0, 1, 0, 2, 1]);
}
