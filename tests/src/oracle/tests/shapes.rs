//! Files, cameras, shapes and refraction.

use super::super::camera::Camera;
use super::super::cone::Cone;
use super::super::polygon::Polygon;
use super::super::read::{self, View};
use super::super::shape::Shape;
use super::super::trace::refract;
use super::super::vector::{Ray, V3};
use super::{close, down, near, v};

const ROOT_HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

#[test]
fn both_forms_of_each_entity_are_distinguished_by_their_numbers() {
    let scene = read::scene(
        "v 1 2 3 # thesis\r\nresolution 20 40\tb .1 2e-1 0.3 l 0 0 1 0.5 l 0 0 2 l 0 0 3 1 0.5 0.25 l 0 0 4 # last
        f 1 2 3 4 5 6 7 8 9 10 11 12 s 0 0 0 -2 f 1 2 3 4 5 6 7 8 9 10 11 12 13 s 0 0 0 1
        f 1 0.5 0.25 0.5 0.2 3.0827 0.3 0 s 0 0 0 1",
    );
    assert_eq!((scene.view.width, scene.view.height), (40, 20));
    assert!(scene.view.aim.is_none());
    assert_eq!(scene.sky, [v(0.1, 0.2, 0.3); 2]);
    let colours: Vec<V3> = scene.lights.iter().map(|light| light.colour).collect();
    assert_eq!(
        colours,
        [
            v(0.5, 0.5, 0.5),
            v(0.5, 0.5, 0.5),
            v(1.0, 0.5, 0.25),
            v(0.5, 0.5, 0.5)
        ]
    );
    let [short, long, nff] = [0, 1, 2].map(|index: usize| scene.objects[index].surface);
    assert_eq!(
        (short.ambient, short.diffuse, short.specular),
        (v(1.0, 2.0, 3.0), v(4.0, 5.0, 6.0), v(7.0, 8.0, 9.0))
    );
    assert_eq!(
        (short.shine, short.reflect, short.refract, short.ior),
        (10.0, 11.0, 12.0, 1.0)
    );
    assert_eq!(long.ior, 13.0);
    assert_eq!(
        (nff.ambient, nff.diffuse, nff.specular),
        (V3::ZERO, v(0.5, 0.25, 0.125), v(0.2, 0.2, 0.2))
    );
    assert_eq!(
        (nff.shine, nff.reflect, nff.refract, nff.ior),
        (3.0827, 0.2, 0.3, 0.0)
    );
    assert_eq!(
        scene.objects[0]
            .shape
            .hit(&down(1.9, 0.0))
            .map(|t| t < 10.0),
        Some(true),
        "radius −2 is 2"
    );
}

#[test]
fn the_resolution_is_width_first_in_nff_and_512_square_if_absent() {
    let nff = read::scene("v from 0 0 5 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 40 20");
    assert_eq!((nff.view.width, nff.view.height), (40, 20));
    let thesis = read::scene("v 0 0 5 at 0 0 0 up 0 1 0 angle 45 view parallel");
    assert_eq!((thesis.view.width, thesis.view.height), (512, 512));
    assert!(thesis.view.parallel && thesis.view.aim.is_some());
}

#[test]
#[should_panic(expected = "`s` with 3 numbers")]
fn a_bad_file_panics() {
    read::scene("v 0 0 1 f 0 0 0 0 0 0 0 0 0 0 0 0 s 1 2 3");
}

// Cameras

fn view(text: &str) -> View {
    read::scene(text).view
}

#[test]
fn thesis_camera_looks_through_the_plane_z_0() {
    let camera = Camera::new(&view("v 1 2 10 resolution 4 6"), None);
    let ray = camera.ray(0.5, 0.5);
    near(ray.origin, v(1.0, 2.0, 10.0));
    near(ray.direction, v(-2.5 - 1.0, 1.5 - 2.0, -10.0).unit());
    let twice = Camera::new(&view("v 1 2 10 resolution 4 6"), Some((12, 8)));
    near(
        twice.ray(0.5, 0.5).direction,
        v(-2.75 - 1.0, 1.75 - 2.0, -10.0).unit(),
    );
}

#[test]
fn thesis_parallel_rays_start_beside_the_viewpoint() {
    let front = Camera::new(&view("v 1 2 10 resolution 4 6 view parallel"), None).ray(5.5, 3.5);
    near(front.origin, v(2.5, -1.5, 10.0));
    near(front.direction, v(0.0, 0.0, -1.0));
    let behind = Camera::new(&view("v 1 2 -3 resolution 4 6 view parallel"), None).ray(5.5, 3.5);
    near(behind.origin, v(2.5, -1.5, -3.0));
    near(behind.direction, v(0.0, 0.0, 1.0));
}

#[test]
fn nff_angle_lies_between_the_centres_of_the_outer_rows() {
    let text = "v from 0 0 5 at 0 0 3 up 0 2 1 angle 90 resolution 3 3";
    let camera = Camera::new(&view(text), None);
    near(camera.ray(1.5, 1.5).direction, v(0.0, 0.0, -1.0));
    near(
        camera.ray(1.5, 0.5).direction,
        v(0.0, ROOT_HALF, -ROOT_HALF),
    );
    near(
        camera.ray(2.5, 1.5).direction,
        v(ROOT_HALF, 0.0, -ROOT_HALF),
    );
    let wide = Camera::new(&view(text), Some((9, 5)));
    near(wide.ray(4.5, 0.5).direction, v(0.0, ROOT_HALF, -ROOT_HALF));
    let one_row = Camera::new(&view(text), Some((3, 1)));
    near(one_row.ray(2.5, 0.5).direction, v(2.0, 0.0, -1.0).unit());
}

#[test]
fn nff_parallel_rays_pass_the_plane_through_at_like_the_perspective_rays() {
    let text = "v 0 0 5 at 0 0 3 up 0 2 1 angle 90 resolution 3 3";
    let ray = Camera::new(&view(&format!("{text} view parallel")), None).ray(2.5, 0.5);
    near(ray.direction, v(0.0, 0.0, -1.0));
    near(ray.at(2.0), v(2.0, 2.0, 3.0));
    let perspective = Camera::new(&view(text), None).ray(2.5, 0.5);
    near(perspective.at(2.0 * 3f64.sqrt()), v(2.0, 2.0, 3.0));
}

// Shapes

#[test]
fn sphere_is_hit_from_outside_and_from_inside() {
    let sphere = Shape::Sphere {
        centre: v(0.0, 0.0, 1.0),
        radius: 5.0,
    };
    close(sphere.hit(&down(3.0, 0.0)).unwrap(), 5.0);
    close(
        sphere
            .hit(&Ray::new(v(3.0, 0.0, 1.0), v(0.0, 0.0, -1.0)))
            .unwrap(),
        4.0,
    );
    assert_eq!(sphere.hit(&down(5.1, 0.0)), None);
    assert_eq!(
        sphere.hit(&Ray::new(v(0.0, 0.0, 10.0), v(0.0, 0.0, 1.0))),
        None
    );
    near(sphere.facing(v(3.0, 0.0, 5.0)).geometric, v(0.6, 0.0, 0.8));
}

#[test]
fn box_is_hit_from_outside_and_from_inside() {
    let cuboid = Shape::Cuboid {
        centre: v(1.0, 0.0, 0.0),
        half: v(1.0, 2.0, 3.0),
    };
    close(cuboid.hit(&down(0.5, 1.0)).unwrap(), 7.0);
    close(
        cuboid
            .hit(&Ray::new(v(1.0, 0.0, 0.0), v(3.0, 4.0, 0.0)))
            .unwrap(),
        5.0 / 3.0,
    );
    close(
        cuboid
            .hit(&Ray::new(v(-2.0, -2.0, 0.0), v(1.0, 1.0, 0.0)))
            .unwrap(),
        8f64.sqrt(),
    );
    assert_eq!(cuboid.hit(&down(2.5, 0.0)), None);
    near(cuboid.facing(v(0.0, 1.0, 1.0)).geometric, v(-1.0, 0.0, 0.0));
    near(cuboid.facing(v(0.5, 1.0, 3.0)).geometric, v(0.0, 0.0, 1.0));
}

#[test]
fn cone_has_a_side_and_no_caps() {
    // Radius 2 at y = 0 down to 0 at y = 2.
    let cone = Cone::new(V3::ZERO, 2.0, v(0.0, 2.0, 0.0), 0.0);
    close(cone.hit(&down(0.0, 1.0)).unwrap(), 9.0);
    close(
        cone.hit(&Ray::new(v(0.0, 1.0, 0.0), v(0.0, 0.0, -1.0)))
            .unwrap(),
        1.0,
    );
    assert_eq!(cone.hit(&down(0.0, 2.5)), None);
    near(cone.normal(v(0.0, 1.0, 1.0)), v(0.0, ROOT_HALF, ROOT_HALF));
    // Through the open base, onto the inside: x = 1 meets the radius at y = 1.
    close(
        cone.hit(&Ray::new(v(1.0, -5.0, 0.0), v(0.0, 1.0, 0.0)))
            .unwrap(),
        6.0,
    );
    // Parallel to the side: one root only.
    let along_side = |x| cone.hit(&Ray::new(v(x, 3.0, 0.0), v(1.0, -1.0, 0.0)));
    close(along_side(-3.0).unwrap(), 8f64.sqrt());
    assert_eq!(along_side(0.0), None, "it would be above the apex");
    // Along the axis of a cylinder there is nothing.
    let cylinder = Cone::new(V3::ZERO, 1.0, v(0.0, 0.0, 4.0), 1.0);
    assert_eq!(cylinder.hit(&down(0.0, 0.0)), None);
    near(cylinder.normal(v(1.0, 0.0, 2.0)), v(1.0, 0.0, 0.0));
}

#[test]
fn the_bounding_sphere_hides_no_hit() {
    let objects = read::scene(
        "v 0 0 1 f 0 0 0 0 0 0 0 0 0 0 0 0 s 1 2 3 2 c -3 0 0 1 0 4 1 2 box 0 -3 1 1 2 3
        p 4 0 0 4 3 0 5 3 3 6 0 3 5 pp 3 -4 0 0 0 0 1 -1 1 0 0 0 1 -3 4 1 0 0 1 c 4 4 4 0 4 4 -4 2",
    )
    .objects;
    let mut state = 1u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 30) - 1.0
    };
    let mut point = |size: f64| v(random() * size, random() * size, random() * size);
    let mut hits = 0;
    for _ in 0..20_000 {
        let from = point(10.0);
        let ray = Ray::new(from, point(5.0) - from);
        for object in &objects {
            let hit = object.shape.hit(&ray);
            assert_eq!(object.hit(&ray, f64::INFINITY), hit);
            assert_eq!(object.hit(&ray, 4.0), hit.filter(|&t| t < 4.0));
            hits += u32::from(hit.is_some());
        }
    }
    assert!(hits > 5_000, "only {hits} hits");
}

#[test]
fn polygon_follows_the_even_odd_rule() {
    // A square with a notch from the right, and a pentagram.
    let notched = Polygon::new(
        vec![
            v(0., 0., 1.),
            v(4., 0., 1.),
            v(4., 1., 1.),
            v(1., 2., 1.),
            v(4., 3., 1.),
            v(4., 4., 1.),
            v(0., 4., 1.),
        ],
        None,
    );
    close(notched.hit(&down(0.5, 2.0)).unwrap(), 9.0);
    assert!(notched.hit(&down(3.0, 0.5)).is_some() && notched.hit(&down(3.0, 3.5)).is_some());
    assert_eq!(notched.hit(&down(3.0, 2.0)), None);
    let corner = |k: f64| {
        let angle = (90.0 + 144.0 * k).to_radians();
        v(angle.cos(), angle.sin(), 0.0)
    };
    let star = Polygon::new([0.0, 1.0, 2.0, 3.0, 4.0].map(corner).to_vec(), None);
    assert!(star.hit(&down(0.0, 0.8)).is_some());
    assert_eq!(star.hit(&down(0.0, 0.0)), None);
}

#[test]
fn a_shared_edge_or_vertex_belongs_to_every_polygon() {
    let triangle = |a, b| Polygon::new(vec![V3::ZERO, a, b], None);
    let (n, e, s, w) = (v(0., 1., 0.), v(1., 0., 0.), v(0., -1., 0.), v(-1., 0., 0.));
    let fan = [
        triangle(e, n),
        triangle(n, w),
        triangle(w, s),
        triangle(s, e),
    ];
    for (x, y, owners) in [
        (0.0, 0.0, 4),
        (0.5, 0.0, 2),
        (-0.5, 0.0, 2),
        (0.0, 0.5, 2),
        (0.0, -0.5, 2),
        (0.25, 0.25, 1),
        (0.5, 0.5, 1),
        (0.75, 0.5, 0),
    ] {
        let hits = fan
            .iter()
            .filter(|polygon| polygon.hit(&down(x, y)).is_some())
            .count();
        assert_eq!(hits, owners, "at {x} {y}");
    }
    let low_left = Polygon::new(vec![V3::ZERO, e, v(1., 1., 0.), n], None);
    assert!(low_left.hit(&down(0.0, 0.0)).is_some());
    assert!(low_left.hit(&down(0.5, 1.0)).is_some() && low_left.hit(&down(1.0, 0.5)).is_some());
    assert!(low_left.hit(&down(0.5, 1.001)).is_none());
}

#[test]
fn patch_normal_is_interpolated_over_the_fan() {
    let vertices = vec![V3::ZERO, v(1., 0., 0.), v(1., 1., 0.), v(0., 1., 0.)];
    let normals = vec![v(0., 0., 1.), v(1., 0., 1.), v(0., 1., 1.), v(0., 0., -1.)];
    let patch = Polygon::new(vertices, Some(normals));
    near(
        patch.shading_normal(v(1., 0., 0.)),
        v(ROOT_HALF, 0., ROOT_HALF),
    );
    near(
        patch.shading_normal(v(0.75, 0.25, 0.)),
        v(0.5, 0.25, 1.0).unit(),
    );
    // In the second triangle the second vertex has no weight: 0.25 of the first, 0.5 of the third, 0.25 of the fourth.
    near(
        patch.shading_normal(v(0.5, 0.75, 0.)),
        v(0.0, 0.5, 0.5).unit(),
    );
}

// Light

#[test]
fn refraction_obeys_snell() {
    let incoming = v(0.6, 0.0, -0.8);
    let n = v(0.0, 0.0, 1.0);
    near(refract(incoming, n, 1.0).unwrap(), incoming);
    near(
        refract(incoming, n, 1.5).unwrap(),
        v(0.4, 0.0, -(0.84f64.sqrt())),
    );
    near(refract(incoming, n, 0.75).unwrap(), v(0.8, 0.0, -0.6));
    assert_eq!(refract(incoming, n, 0.5), None);
}
