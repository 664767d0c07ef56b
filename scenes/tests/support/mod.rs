//! Scenes at random.

use octray_scenes::check;
use octray_scenes::model::{
    Camera, Checker, Light, Object, Point, Projection, Scene, Shape, Surface,
};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::Union;

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
        prop::option::of((positive(), colour(), colour())),
    )
        .prop_map(
            |(ambient, diffuse, specular, shine, reflect, refract, ior, checker)| Surface {
                ambient,
                diffuse,
                specular,
                shine,
                reflect,
                refract,
                ior: if refract > 0.0 { ior } else { 1.0 },
                checker: checker.map(|(size, ambient, diffuse)| Checker {
                    size,
                    ambient,
                    diffuse,
                }),
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
pub(crate) fn scene() -> impl Strategy<Value = Scene> {
    let light = (point(), prop::array::uniform3(coefficient()))
        .prop_map(|(position, colour)| Light { position, colour });
    let group = (surface(), vec(part(), 0..4));
    (
        camera(),
        (1u32..=65535, 1u32..=65535),
        prop::array::uniform3(coefficient()),
        prop::option::of(prop::array::uniform3(coefficient())),
        vec(light, 0..4),
        vec(group, 0..5),
    )
        .prop_map(
            |(camera, (width, height), background, zenith, lights, groups)| {
                let mut scene = Scene {
                    camera,
                    width,
                    height,
                    background,
                    zenith,
                    lights,
                    surfaces: vec![],
                    objects: vec![],
                    vertices: vec![],
                    normals: vec![],
                    room: None,
                };
                for (index, (surface, parts)) in groups.into_iter().enumerate() {
                    scene.surfaces.push(surface);
                    parts
                        .into_iter()
                        .for_each(|part| add(&mut scene, index as u32, part));
                }
                scene
            },
        )
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
