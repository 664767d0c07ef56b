//! Tests of the oracle's parts against numbers computed by hand.

use super::camera::Camera;
use super::cone::Cone;
use super::polygon::Polygon;
use super::read::{self, View};
use super::shape::Shape;
use super::trace::refract;
use super::vector::{Ray, V3};
use super::{Counts, Options, Picture, first_object, render, to_byte};

const ROOT_HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

fn v(x: f64, y: f64, z: f64) -> V3 {
    V3::new(x, y, z)
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-12, "{a} is not {b}");
}

fn near(a: V3, b: V3) {
    assert!((a - b).length() < 1e-12, "{a:?} is not {b:?}");
}

/// A ray along −z from (x, y, 10).
fn down(x: f64, y: f64) -> Ray {
    Ray::new(v(x, y, 10.0), v(0.0, 0.0, -1.0))
}

// Reading

#[test]
fn both_forms_of_each_entity_are_distinguished_by_their_numbers() {
    let scene = read::scene(
        "v 1 2 3 # thesis\r\nresolution 20 40\tb .1 2e-1 0.3 l 0 0 1 0.5 l 0 0 2 l 0 0 3 1 0.5 0.25 l 0 0 4 # last
        f 1 2 3 4 5 6 7 8 9 10 11 12 s 0 0 0 -2 f 1 2 3 4 5 6 7 8 9 10 11 12 13 s 0 0 0 1
        f 1 0.5 0.25 0.5 0.2 3.0827 0.3 0 s 0 0 0 1",
    );
    assert_eq!((scene.view.width, scene.view.height), (40, 20));
    assert!(scene.view.aim.is_none());
    assert_eq!(scene.background, v(0.1, 0.2, 0.3));
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
fn a_shared_edge_or_vertex_belongs_to_one_polygon() {
    let triangle = |a, b| Polygon::new(vec![V3::ZERO, a, b], None);
    let (n, e, s, w) = (v(0., 1., 0.), v(1., 0., 0.), v(0., -1., 0.), v(-1., 0., 0.));
    let fan = [
        triangle(e, n),
        triangle(n, w),
        triangle(w, s),
        triangle(s, e),
    ];
    for (x, y) in [
        (0.0, 0.0),
        (0.5, 0.0),
        (-0.5, 0.0),
        (0.0, 0.5),
        (0.0, -0.5),
        (0.25, 0.25),
    ] {
        let hits = fan
            .iter()
            .filter(|polygon| polygon.hit(&down(x, y)).is_some())
            .count();
        assert_eq!(hits, 1, "at {x} {y}");
    }
    let low_left = Polygon::new(vec![V3::ZERO, e, v(1., 1., 0.), n], None);
    assert!(low_left.hit(&down(0.0, 0.0)).is_some());
    assert!(low_left.hit(&down(0.5, 1.0)).is_none() && low_left.hit(&down(1.0, 0.5)).is_none());
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

#[test]
fn intensities_round_to_the_nearest_byte() {
    assert_eq!(
        [0.0, 1.0, 0.5, 0.499 / 255.0, 0.501 / 255.0].map(to_byte),
        [0, 255, 128, 0, 1]
    );
}

/// One pixel, seen along −z from (0, 0, 10).
fn pixel_with(objects: &str, options: &Options) -> Picture {
    render(
        &format!("v 0 0 10 view parallel resolution 1 1 b 0.2 0.4 0.6\n{objects}"),
        options,
    )
}

fn pixel(objects: &str) -> [u8; 3] {
    pixel_with(objects, &Options::default())
        .rgb
        .try_into()
        .unwrap()
}

#[test]
fn light_and_gloss_add_up() {
    // N = (0, 0, 1), L = (0.6, 0, 0.8), R = N: 0.1 + 0.5 · (0.5 · 0.8 + 0.25 · 0.8²) = 0.38.
    let lit = "l 3 0 5 0.5 f 0.1 0.1 0.1 0.5 0.5 0.5 0.25 0.25 0.25 2 0 0 s 0 0 0 1";
    assert_eq!(pixel(lit), [97; 3]);
    let coloured = "l 3 0 5 0.5 0 1 f 0.1 0.1 0.1 0.5 0.5 0.5 0.25 0.25 0.25 2 0 0 s 0 0 0 1";
    assert_eq!(pixel(coloured), [97, 26, 168]);
    // Behind the surface a light adds nothing, and no shadow ray is traced.
    let behind = pixel_with(
        "l 0 0 -5 1 f 0.1 0.1 0.1 1 1 1 1 1 1 0 0 0 p 3 -9 -9 0 9 -9 0 0 9 0",
        &Options::default(),
    );
    assert_eq!((behind.rgb, behind.counts.shadow), (vec![26; 3], 0));
}

#[test]
fn zero_to_the_zero_is_one() {
    // A wall at 45° mirrors the ray along −z to −x, perpendicular to the light in +z.
    let wall = "l 0 0 9 1 f 0 0 0 0 0 0 0.5 0.5 0.5 0 0 0 p 4 -5 -5 -5 5 -5 5 5 5 5 -5 5 -5";
    assert_eq!(pixel(wall), [128; 3]);
    assert_eq!(pixel(&wall.replace("0.5 0 0 0", "0.5 1 0 0")), [0; 3]);
}

#[test]
fn anything_between_a_point_and_a_light_blocks_it() {
    let scene = "l 3 0 5 1 f 0.1 0.1 0.1 0.5 0.5 0.5 0 0 0 1 0 0 s 0 0 0 1";
    assert_eq!(pixel(scene), [128; 3]);
    let clear_glass = "f 0 0 0 0 0 0 0 0 0 1 0 1 s 1.5 0 3 0.2";
    let shaded = pixel_with(&format!("{scene} {clear_glass}"), &Options::default());
    assert_eq!(shaded.rgb, [26; 3]);
    assert_eq!((shaded.counts.shadow, shaded.counts.blocked), (1, 1));
    // Behind the light, or behind the point, nothing blocks.
    assert_eq!(pixel(&format!("{scene} s 6 0 9 1 s -3 0 -3 0.5")), [128; 3]);
}

#[test]
fn mirror_and_glass_contribute_their_shares() {
    // A mirror of 0.5 under the background.
    assert_eq!(
        pixel("f 0.1 0.1 0.1 0 0 0 0 0 0 1 0.5 0 p 3 -9 -9 0 9 -9 0 0 9 0"),
        [51, 77, 102]
    );
    // 0.25 of the surface's own and 0.75 of the background behind it.
    assert_eq!(
        pixel("f 0.4 0.4 0.4 0 0 0 0 0 0 1 0 0.75 p 3 -9 -9 0 9 -9 0 0 9 0"),
        [64, 102, 140]
    );
    // A sphere has two such surfaces: 0.1 + 0.75 · (0.1 + 0.75 · background).
    assert_eq!(
        pixel("f 0.4 0.4 0.4 0 0 0 0 0 0 1 0 0.75 1.5 s 0 0 0 1"),
        [73, 102, 131]
    );
}

#[test]
fn polygons_are_entered_at_each_hit_and_spheres_are_left() {
    // A ray at 45° to polygons of ior 0.5 is totally reflected, for either winding; its transmitted term is 0.
    let wall = "f 0.4 0.4 0.4 0 0 0 0 0 0 1 0 0.75 0.5 p 4";
    for corners in [
        "-5 -5 -5 5 -5 5 5 5 5 -5 5 -5",
        "-5 5 -5 5 5 5 5 -5 5 -5 -5 -5",
    ] {
        let picture = pixel_with(&format!("{wall} {corners}"), &Options::default());
        assert_eq!((picture.rgb, picture.counts.transmitted), (vec![26; 3], 0));
    }
    // With ior 2 they transmit it.
    let picture = pixel_with(
        &format!(
            "{} -5 -5 -5 5 -5 5 5 5 5 -5 5 -5",
            wall.replace("0.5 p", "2 p")
        ),
        &Options::default(),
    );
    assert_eq!(
        (picture.rgb, picture.counts.transmitted),
        (vec![64, 102, 140], 1)
    );
    // Into a box of ior 2 perpendicularly, and out of it again.
    let picture = pixel_with(
        "f 0.4 0.4 0.4 0 0 0 0 0 0 1 0 0.75 2 box 0 0 0 2 2 2",
        &Options::default(),
    );
    assert_eq!(
        (picture.rgb, picture.counts.transmitted),
        (vec![73, 102, 131], 2)
    );
}

#[test]
fn depth_and_weight_end_the_recursion() {
    // Two facing mirrors of 0.5, with the eye between them.
    let hall =
        "f 0.2 0.2 0.2 0 0 0 0 0 0 1 0.5 0 p 3 -9 -9 0 9 -9 0 0 9 0 p 3 -9 -9 20 9 -9 20 0 9 20";
    let with = |max_depth, cut_off| {
        pixel_with(
            hall,
            &Options {
                max_depth,
                cut_off,
                ..Options::default()
            },
        )
    };
    // 0.2 · (1 + 1/2 + 1/4 + …), with one term per ray.
    assert_eq!(with(0, 0.0).rgb, [51; 3]);
    assert_eq!(with(2, 0.0).rgb, [89; 3]);
    assert_eq!(with(2, 0.0).counts.reflected, 2);
    assert_eq!(
        with(100, 0.25).counts.reflected,
        2,
        "a weight of just the cut-off is traced"
    );
    assert_eq!(with(100, 0.26).counts.reflected, 1);
    assert_eq!(Options::default().max_depth, 8);
    assert_eq!(with(100, Options::default().cut_off).counts.reflected, 9);
}

#[test]
fn a_pixel_is_the_mean_of_its_clamped_samples() {
    // A polygon brighter than 1 covers the left half of the pixel; the rest is black.
    let half = "b 0 0 0 f 2 2 2 0 0 0 0 0 0 1 0 0 p 4 -9 -9 0 0 -9 0 0 9 0 -9 9 0";
    let picture = pixel_with(
        half,
        &Options {
            samples: 2,
            ..Options::default()
        },
    );
    assert_eq!((picture.rgb, picture.counts.primary), (vec![128; 3], 4));
}

#[test]
fn four_pixels_per_ray_share_the_colour_of_their_middle() {
    let text = "v 0 0 10 view parallel resolution 3 5 b 0 0 0 f 1 1 1 0 0 0 0 0 0 1 0 0 box -1 0.7 0 2.5 1 1";
    let four = Options {
        pixels_per_ray: 4,
        ..Options::default()
    };
    let picture = render(text, &four);
    assert_eq!(
        (picture.width, picture.height, picture.counts.primary),
        (5, 3, 6)
    );
    // The middles of the blocks lie at x = −1.5, 0.5, 2.5 and y = 0.5, −1.5; the box covers
    // −2.25…0.25 and 0.2…1.2.
    let lit: Vec<u8> = picture.rgb.chunks(3).map(|pixel| pixel[0] / 255).collect();
    assert_eq!(lit, [1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0]);
}

#[test]
fn first_object_names_the_nearest_in_file_order() {
    let text = "v 0 0 10 view parallel resolution 1 3 f 1 1 1 0 0 0 0 0 0 1 0 0
        p 3 -9 -9 0 9 -9 0 0 9 0  s 0 0 1 0.4  s 1 0 -1 0.4  s 0 0 1 0.4";
    assert_eq!(
        first_object(text, &Options::default()),
        [Some(0), Some(1), Some(0)]
    );
    assert_eq!(
        first_object("v 0 0 1 resolution 1 1", &Options::default()),
        [None]
    );
}

#[test]
fn threads_do_not_change_the_counts() {
    let text =
        "v 0 0 50 resolution 30 40 l 0 20 20 f 0 0 0 1 1 1 0 0 0 1 0.5 0 s 0 0 0 5 s 9 0 0 4";
    let (a, b) = (
        render(text, &Options::default()),
        render(text, &Options::default()),
    );
    assert_eq!((a.rgb, a.counts), (b.rgb, b.counts));
    assert_eq!(a.counts.primary, 1200);
    assert_ne!(a.counts, Counts::default());
}
