//! Properties of every source and every scene.

use octray_scenes::diagnostic::{MOST, MistakeKind};
use octray_scenes::model::{Camera, Light, Object, Point, Projection, Scene, Shape, Surface};
use octray_scenes::{check, parse, write};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::Union;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn any_scene_survives_a_file(scene in scene()) {
        prop_assert_eq!(check::scene(&scene), Ok(()));
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        match parse(&text) {
            Ok(again) => prop_assert_eq!(again, scene),
            Err(mistakes) => prop_assert!(false, "{}", mistakes.draw("scene", &text)),
        }
    }

    #[test]
    fn any_bytes_give_a_scene_or_mistakes_that_can_be_drawn(
        bytes in vec(any::<u8>(), 0..200)
    ) {
        judge(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn any_text_gives_a_scene_or_mistakes_that_can_be_drawn(text in any::<String>()) {
        judge(&text)?;
    }

    /// Near misses: tokens of the language in any order.
    #[test]
    fn any_tokens_give_a_scene_or_mistakes_that_can_be_drawn(tokens in vec(token(), 0..60)) {
        judge(&tokens.concat())?;
    }

    /// A valid scene with a part cut out.
    #[test]
    fn a_scene_with_a_gap_gives_a_scene_or_mistakes_that_can_be_drawn(
        scene in scene(), from in any::<prop::sample::Index>(), length in 0usize..30
    ) {
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let from = from.index(text.len());
        text.drain(from..(from + length).min(text.len()));
        judge(std::str::from_utf8(&text).unwrap())?;
    }

    #[test]
    fn white_space_and_comments_have_no_meaning(scene in scene(), space in vec(space(), 16)) {
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let mut spaces = space.iter().cycle();
        let text: String = std::str::from_utf8(&text)
            .unwrap()
            .split_whitespace()
            .flat_map(|token| [token, spaces.next().unwrap()])
            .collect();
        prop_assert_eq!(parse(&text), Ok(scene));
    }
}

/// Checks that an accepted scene satisfies the invariants, and that mistakes are few, in order, and within the source.
fn judge(source: &str) -> Result<(), TestCaseError> {
    match parse(source) {
        Ok(scene) => prop_assert_eq!(check::scene(&scene), Ok(())),
        Err(mistakes) => {
            prop_assert!((1..=MOST).contains(&mistakes.list.len()));
            prop_assert!(mistakes.list.is_sorted_by_key(|mistake| mistake.span.start));
            for mistake in &mistakes.list {
                let span = mistake.span;
                prop_assert!(source.get(span.start..span.end).is_some(), "{:?}", mistake);
                if let MistakeKind::Duplicate { first, .. } = mistake.kind {
                    prop_assert!(first.end <= span.start);
                }
            }
            let drawn = mistakes.draw("scene", source);
            prop_assert!(
                !drawn.contains(|c: char| c.is_control() && c != '\n'),
                "{:?}",
                drawn
            );
        }
    }
    Ok(())
}

fn token() -> impl Strategy<Value = String> {
    let words = "v from at up angle hither resolution view parallel perspective b l f s c box p pp";
    let numbers = "0 1 -1 0.5 2 3 3 4 12 1e-320 1e308 -1e308 1e999 nan 65536 4294967295 x 1.2.3";
    let any_of = |words: &'static str| prop::sample::select(words.split(' ').collect::<Vec<_>>());
    let token = prop_oneof![2 => any_of(words), 7 => any_of(numbers)];
    (token, space()).prop_map(|(token, space)| format!("{token}{space}"))
}

fn space() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        " ",
        "  ",
        "\t",
        "\n",
        "\r\n",
        "\r",
        "\u{c}",
        "\t#v 1 2 3\n",
        " # s 0 \u{e9}\r\n",
    ])
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -10.0..10.0,
        (-1000..1000).prop_map(f64::from),
        any::<f32>().prop_map(f64::from)
    ]
    .prop_filter("finite", |number: &f64| number.is_finite())
}

fn positive() -> impl Strategy<Value = f64> {
    prop_oneof![1e-9..1e9, Just(1.0), Just(f64::MIN_POSITIVE)]
}

fn coefficient() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), 0.0..1.0, 0.0..1e6]
}

fn point() -> impl Strategy<Value = Point> {
    prop::array::uniform3(number())
}

fn camera() -> impl Strategy<Value = Camera> {
    let projection = || prop::sample::select(vec![Projection::Perspective, Projection::Parallel]);
    let thesis = (point(), projection()).prop_map(|(viewpoint, projection)| Camera::Thesis {
        viewpoint,
        projection,
    });
    let nff = (point(), point(), point(), 0.001..179.999, projection()).prop_map(
        |(from, at, up, angle, projection)| Camera::Nff {
            from,
            at,
            up,
            angle,
            projection,
        },
    );
    prop_oneof![thesis, nff]
}

fn surface() -> impl Strategy<Value = Surface> {
    let colour = || prop::array::uniform3(coefficient());
    let ray = || coefficient();
    (
        colour(),
        colour(),
        colour(),
        coefficient(),
        ray(),
        ray(),
        positive(),
    )
        .prop_map(
            |(ambient, diffuse, specular, shine, reflect, refract, ior)| Surface {
                ambient,
                diffuse,
                specular,
                shine,
                reflect,
                refract,
                ior: if refract > 0.0 { ior } else { 1.0 },
            },
        )
}

/// A shape, its vertices and its normals; ranges begin at 0.
type Part = (Shape, Vec<Point>, Vec<Point>);

fn part() -> impl Strategy<Value = Part> {
    let solid = |shape| (shape, vec![], vec![]);
    let sphere = (point(), positive())
        .prop_map(move |(centre, radius)| solid(Shape::Sphere { centre, radius }));
    let cone = (point(), coefficient(), point(), positive()).prop_map(
        move |(base, base_radius, top, top_radius)| {
            solid(Shape::Cone {
                base,
                base_radius,
                top,
                top_radius,
            })
        },
    );
    let cuboid = (point(), prop::array::uniform3(positive()))
        .prop_map(move |(centre, size)| solid(Shape::Cuboid { centre, size }));
    let polygon = vertices().prop_map(|vertices| {
        (
            Shape::Polygon {
                first: 0,
                count: vertices.len() as u32,
            },
            vertices,
            vec![],
        )
    });
    let patch = (vertices(), vec(point(), 8)).prop_map(|(vertices, mut normals)| {
        normals.truncate(vertices.len());
        let count = vertices.len() as u32;
        (
            Shape::Patch {
                first: 0,
                count,
                first_normal: 0,
            },
            vertices,
            normals,
        )
    });
    Union::new([
        sphere.boxed(),
        cone.boxed(),
        cuboid.boxed(),
        polygon.boxed(),
        patch.boxed(),
    ])
}

/// Vertices in a plane; edges may cross.
fn vertices() -> impl Strategy<Value = Vec<Point>> {
    let place = (-100i32..100, -100i32..100);
    let frame = prop::array::uniform3(prop::array::uniform3(-20i32..20));
    (frame, vec(place, 3..=8)).prop_map(|([origin, u, v], places)| {
        let vertex = |(x, y): (i32, i32)| {
            [0, 1, 2].map(|axis| f64::from(origin[axis] + x * u[axis] + y * v[axis]) / 8.0)
        };
        places.into_iter().map(vertex).collect()
    })
}

/// A scene as the parser might return it.
fn scene() -> impl Strategy<Value = Scene> {
    let light = (point(), prop::array::uniform3(coefficient()))
        .prop_map(|(position, colour)| Light { position, colour });
    let group = (surface(), vec(part(), 0..4));
    (
        camera(),
        (1u32..=65535, 1u32..=65535),
        prop::array::uniform3(coefficient()),
        vec(light, 0..4),
        vec(group, 0..5),
    )
        .prop_map(|(camera, (width, height), background, lights, groups)| {
            let mut scene = Scene {
                camera,
                width,
                height,
                background,
                lights,
                surfaces: vec![],
                objects: vec![],
                vertices: vec![],
                normals: vec![],
            };
            for (index, (surface, parts)) in groups.into_iter().enumerate() {
                scene.surfaces.push(surface);
                parts
                    .into_iter()
                    .for_each(|part| add(&mut scene, index as u32, part));
            }
            scene
        })
        .prop_filter("a camera that can see", |scene| check::scene(scene).is_ok())
}

/// Adds `part` unless it is degenerate.
fn add(scene: &mut Scene, surface: u32, (mut shape, vertices, normals): Part) {
    let (first_vertex, first_of_normals) = (scene.vertices.len(), scene.normals.len());
    match &mut shape {
        Shape::Polygon { first, .. } => *first = first_vertex as u32,
        Shape::Patch {
            first,
            first_normal,
            ..
        } => {
            *first = first_vertex as u32;
            *first_normal = first_of_normals as u32;
        }
        _ => {}
    }
    scene.vertices.extend(vertices);
    scene.normals.extend(normals);
    scene.objects.push(Object { shape, surface });
    let camera = Camera::Thesis {
        viewpoint: [0.0, 0.0, 1.0],
        projection: Projection::Parallel,
    };
    let whole = Scene {
        camera,
        ..scene.clone()
    };
    if check::scene(&whole).is_err() {
        scene.objects.pop();
        scene.vertices.truncate(first_vertex);
        scene.normals.truncate(first_of_normals);
    }
}
