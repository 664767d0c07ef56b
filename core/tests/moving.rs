//! Things that move: the picture of a tree that is fitted to them anew is that of every other tree, the words suffice
//! wherever they are, and a scene that fits its room overflows nothing.

#[allow(dead_code, unreachable_pub, reason = "other tests share it")]
#[path = "support/strew.rs"]
mod strew;

use fastrand::Rng;
use octray_core::accel::{Accelerator, BruteForce, BuildOptions, CompactBvh8, compact_words};
use octray_core::camera::{Projection, View};
use octray_core::frame::Frame;
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::quantize::Quantize;
use octray_core::scalar::{Approx, Fixed, Scalar};
use octray_core::scene::{OutOfRoom, Surface};
use octray_core::shape::{Cone, Polygon, Triangle};
use octray_core::trace::{QueuedRay, Tracer};
use octray_core::vec3::{Vec3, vec3};
use octray_core::world::World;
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Prepared, quantise};
use octray_prepare::saturation::{PerThread, counted};
use octray_prepare::tree::every_object;

const VIEW: RenderSettings = RenderSettings {
    size: Some((24, 18)),
    max_depth: 3,
    ..RenderSettings::DEFAULT
};
const OPTIONS: BuildOptions = BuildOptions {
    depth: 8,
    leaf_size: 1,
};

/// A scene of many shapes, with room to move all around it.
fn strewn<S: Quantize>(seed: u64) -> Prepared<S> {
    let mut scene = octray_scenes::parse(&strew::picture(seed)).unwrap();
    let still = quantise::<f64>(&scene, &VIEW).unwrap().world;
    let half = still.diagonal * 0.6;
    scene.room = Some([
        still.centre.map(|c| c - half),
        still.centre.map(|c| c + half),
    ]);
    quantise::<S>(&scene, &VIEW).unwrap()
}

/// Moves every sphere, box and near light somewhere within the room.
fn moved<S: Quantize>(prepared: &mut Prepared<S>, rng: &mut Rng) {
    let reach = prepared.world.diagonal * 0.2;
    let mut by = || {
        let far = [(); 3].map(|()| (rng.f64() - 0.5) * reach);
        Vec3::from(far.map(|x| S::from_f64(prepared.world.length(x))))
    };
    for sphere in &mut prepared.scene.spheres {
        sphere.centre = sphere.centre + by();
    }
    for cuboid in &mut prepared.scene.cuboids {
        let by = by();
        (cuboid.low, cuboid.high) = (cuboid.low + by, cuboid.high + by);
    }
    for light in &mut prepared.scene.lights {
        if light.parallax.is_none() {
            light.position = light.position + by();
        }
    }
}

fn picture<S: Quantize, A: Accelerator<S>>(prepared: &Prepared<S>, tree: &A) -> Vec<Vec3<S>> {
    let scene = prepared.scene.scene();
    let tracer = Tracer {
        scene: &scene,
        accelerator: tree,
        max_depth: VIEW.max_depth,
        cut_off: S::from_f64(1.0 / 512.0),
    };
    let (mut rays, mut stack) = ([QueuedRay::EMPTY; 8], A::Stack::default());
    let mut shadow_cache = vec![None; scene.lights.len()];
    let mut workspace = tracer
        .workspace(&mut rays, &mut stack, &mut shadow_cache)
        .unwrap();
    let mut colours = Vec::new();
    let put = |_, _, colour| colours.push(colour);
    (prepared.frame).render(0..18, &tracer, &mut workspace, &mut (), put);
    colours
}

/// The words and links of the tree of a scene.
fn built<S: Quantize>(prepared: &Prepared<S>) -> (Vec<u32>, Vec<ObjectRef>, u32) {
    let scene = prepared.scene.scene();
    let count = scene.shapes.len();
    let mut words = vec![0; compact_words(count)];
    let mut links = vec![ObjectRef::default(); count];
    let mut boxes = vec![Default::default(); count];
    let (shapes, diameter) = (&scene.shapes, scene.diameter);
    let (tree, stats) = CompactBvh8::build(
        shapes, diameter, &mut words, &mut links, &mut boxes, OPTIONS,
    )
    .unwrap();
    assert_eq!(
        stats.unsplit,
        0,
        "{count} objects in {} words",
        compact_words(count)
    );
    let (used, tick) = (tree.words().len(), tree.tick());
    words.truncate(used);
    (words, links, tick)
}

fn moving_scenes<S: Quantize>() {
    let mut fitting = 0;
    for seed in 0..24 {
        let mut rng = Rng::with_seed(seed);
        let mut prepared = strewn::<S>(seed);
        let camera = *prepared.frame.camera();
        assert_eq!(prepared.scene.scene().fits(&camera), Ok(()), "{seed}");
        let (mut words, links, tick) = built(&prepared);
        for step in 0..4 {
            moved(&mut prepared, &mut rng);
            if prepared.scene.scene().fits(&camera).is_err() {
                continue;
            }
            fitting += 1;
            let all = every_object(&prepared.scene);
            let (expected, saturated) = counted(|| picture(&prepared, &BruteForce(&all)));
            assert_eq!(saturated, 0, "{seed}, {step}: fits, but overflows");
            let shapes = prepared.scene.shapes();
            let tree = CompactBvh8::<64>::refit(&shapes, &mut words, &links, tick).unwrap();
            assert!(
                picture(&prepared, &tree) == expected,
                "{seed}, {step}: fitted"
            );
            let (words, links, tick) = built(&prepared);
            let tree = CompactBvh8::<64>::new(&words, &links, tick).unwrap();
            assert!(
                picture(&prepared, &tree) == expected,
                "{seed}, {step}: built"
            );
        }
    }
    assert!(fitting > 50, "{fitting}");
}

#[test]
fn what_moves_looks_the_same_through_every_tree_in_f32() {
    moving_scenes::<f32>();
}

#[test]
fn what_moves_looks_the_same_through_every_tree_in_fixed_point() {
    moving_scenes::<Fixed<16, PerThread>>();
    moving_scenes::<Fixed<12, PerThread>>();
    moving_scenes::<Fixed<24, PerThread>>();
}

#[test]
fn what_moves_looks_the_same_through_every_tree_in_approximate_floats() {
    moving_scenes::<Approx<2>>();
}

#[test]
fn a_tree_that_nothing_has_moved_in_stays_as_it_is() {
    for seed in 0..24 {
        let prepared = strewn::<Fixed<16, PerThread>>(seed);
        let (words, links, tick) = built(&prepared);
        let mut again = words.clone();
        let shapes = prepared.scene.shapes();
        CompactBvh8::<64>::refit(&shapes, &mut again, &links, tick).unwrap();
        assert_eq!(again, words, "{seed}");
    }
}

#[test]
fn corrupt_words_are_refused() {
    let prepared = strewn::<Fixed<16, PerThread>>(3);
    let (words, links, tick) = built(&prepared);
    let shapes = prepared.scene.shapes();
    for i in 0..words.len() {
        // A child that is its own ancestor, or elsewhere.
        let mut words = words.clone();
        words[i] ^= 0xff00_0000;
        let _ = CompactBvh8::<64>::refit(&shapes, &mut words, &links, tick);
    }
    let mut none: [u32; 1] = [0];
    assert!(CompactBvh8::<64>::refit(&shapes, &mut none, &links, tick).is_err());
}

#[test]
fn what_leaves_the_room_is_named() {
    let text = "v 0 0 9 at 0 0 0 up 0 1 0 angle 35 l 4 5 6 1 f 0 0 0 1 1 1 0 0 0 0 0 0
        s 0 0 0 1 s 2 0 0 1";
    let scene = octray_scenes::parse(text).unwrap();
    let mut prepared = quantise::<Fixed<16, PerThread>>(&scene, &VIEW).unwrap();
    let camera = *prepared.frame.camera();
    let far = prepared.scene.diameter;
    let place = vec3(far, Scalar::ZERO, Scalar::ZERO);
    let before = prepared.scene.spheres[1].centre;
    prepared.scene.spheres[1].centre = place;
    let ball = ObjectRef::new(ObjectKind::Sphere, 1);
    let out = prepared.scene.scene().fits(&camera);
    assert_eq!(out, Err(OutOfRoom::Object(ball)));
    assert_eq!(
        out.unwrap_err().to_string(),
        "Sphere 1 is outside of the scene's room"
    );
    prepared.scene.spheres[1].centre = before;

    let mut away = camera;
    away.origin = place;
    let out = prepared.scene.scene().fits(&away);
    assert_eq!(out, Err(OutOfRoom::Viewpoint));
    prepared.scene.lights[0].position = place;
    let out = prepared.scene.scene().fits(&camera);
    assert_eq!(out, Err(OutOfRoom::Light(0)));
}

/// The scene of shapes that a device makes is the scene that the host makes, to the bit.
#[test]
fn shapes_made_in_code_are_those_of_a_file() {
    fn compare<S: Quantize>() {
        let text = "v 1 2 9 at 0 0 0 up 0.1 1 0 angle 35 l 4 5 6 1 f 0 0 0 1 1 1 0 0 0 0 0 0
            s 0.3 -0.2 0.1 0.7 box 1 1 1 0.5 0.6 0.7 c -1 -1 0 0.8 -1 1 0.3 0.4
            f 0.25 0.25 0.25 0.5 0.5 0.5 0.75 0.75 0.75 20 0.25 0.5 1.25
            p 3 0 0 0 1 0.1 0 0 1.2 0.3 p 4 -1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1";
        let prepared = quantise::<S>(&octray_scenes::parse(text).unwrap(), &VIEW).unwrap();
        let (scene, world) = (&prepared.scene, &prepared.world);
        let cone = Cone::new(world, [-1.0, -1.0, 0.0], 0.8, [-1.0, 1.0, 0.3], 0.4);
        assert_eq!(cone, scene.cones[0]);
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.0, 1.2, 0.3]];
        assert_eq!(Triangle::new(world, &corners), scene.triangles[0]);
        let square =
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [x, y, -1.0]);
        let mut projected = [[S::ZERO; 2]; 4];
        let polygon = Polygon::new(world, &square, 0, &mut projected);
        assert_eq!(&projected[..], &scene.corners[..]);
        assert_eq!(
            (polygon.plane, polygon.bounds),
            (scene.polygons[0].plane, scene.polygons[0].bounds)
        );
        let (eye, up) = ([1.0, 2.0, 9.0], [0.1, 1.0, 0.0]);
        let view = View::look(eye, [0.0; 3], up, 35.0, (24, 18), Projection::Perspective);
        assert_eq!(view.camera::<S>(world), *prepared.frame.camera());
        let ball = &scene.spheres[0];
        assert_eq!(
            (ball.centre, ball.radius),
            (world.place([0.3, -0.2, 0.1]), world.radius(0.7))
        );
        let seen = scene.scene();
        for (id, kind) in [
            (0, ObjectKind::Sphere),
            (1, ObjectKind::Cuboid),
            (2, ObjectKind::Cone),
        ] {
            assert_eq!(seen.object(id), Some(ObjectRef::new(kind, 0)));
        }
        assert_eq!(seen.object(5), None);
        let every = prepared.frame.from_camera(*prepared.frame.camera());
        assert_eq!(
            (every.active().columns.clone(), every.active().rows.clone()),
            (0..24, 0..18)
        );
        let first = |frame: &Frame<S>| frame.ray_at(1, 1).direction;
        assert_eq!(first(&every), first(&prepared.frame));
        let grey = |x: f64| vec3(S::from_f64(x), S::from_f64(x), S::from_f64(x));
        let [half, quarter] = [0.5, 0.25].map(S::from_f64);
        let surface = (Surface::matt(grey(0.5)).with_ambient(grey(0.25)))
            .with_highlights(grey(0.75), 20)
            .with_mirror(quarter)
            .with_glass(half, S::from_f64(1.25), S::from_f64(0.8));
        assert_eq!(surface, scene.surfaces[1]);
        assert_eq!(
            (scene.slack, scene.diameter),
            (world.slack(), world.diameter())
        );
    }
    compare::<f64>();
    compare::<f32>();
    compare::<Fixed<16, PerThread>>();
    compare::<Fixed<8, PerThread>>();
}

/// Vertices in one line, or all in one point, as a device may make them: no ray meets what they make, and nothing
/// panics.
#[test]
fn shapes_without_area_are_never_met() {
    fn try_it<S: Quantize>() {
        let world = World::around::<S>([-2.0; 3], [2.0; 3]);
        for vertices in [[[0.5; 3]; 3], [[0.0; 3], [0.5; 3], [1.0; 3]]] {
            let triangles = [Triangle::<S>::new(&world, &vertices)];
            let shapes = octray_core::shape::Shapes {
                triangles: &triangles,
                ..octray_core::shape::Shapes::<S>::empty(world.slack())
            };
            let object = ObjectRef::new(ObjectKind::Triangle, 0);
            let origin = world.place([2.0, 0.5, 0.5]);
            let ray = octray_core::ray::Ray::new(origin, vec3(-S::ONE, S::ZERO, S::ZERO));
            assert_eq!(shapes.hit(object, &ray, world.diameter(), &mut ()), None);
        }
    }
    try_it::<f64>();
    try_it::<f32>();
    try_it::<Fixed<16, PerThread>>();
    try_it::<Fixed<28, PerThread>>();
}

#[test]
fn numbers_in_constants_are_those_of_from_f64() {
    const THIRD: Fixed<16> = Fixed::nearest(1.0 / 3.0);
    assert_eq!(THIRD.to_bits(), 21845);
    let mut rng = Rng::with_seed(7);
    for _ in 0..100_000 {
        let x = f64::from_bits(rng.u64(..));
        let fine = (libm::floor(x * 65536.0 + 0.5) as i32).max(-i32::MAX);
        assert_eq!(Fixed::<16>::nearest(x).to_bits(), fine, "{x}");
        let ordinary = (rng.f64() - 0.5) * 70_000.0;
        let near = (libm::floor(ordinary * 65536.0 + 0.5) as i32).max(-i32::MAX);
        assert_eq!(Fixed::<16>::nearest(ordinary).to_bits(), near, "{ordinary}");
    }
    for x in [
        f64::NAN,
        f64::INFINITY,
        -f64::INFINITY,
        -0.5 / 65536.0,
        0.5 / 65536.0,
        -1.5 / 65536.0,
    ] {
        let expected = (libm::floor(x * 65536.0 + 0.5) as i32).max(-i32::MAX);
        assert_eq!(Fixed::<16>::nearest(x).to_bits(), expected, "{x}");
    }
}
