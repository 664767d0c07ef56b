//! The meaning of entities: MODEL's table of both dialects, with its defaults.

use octray_scenes::model::{Camera, Projection, Scene, Shape};
use octray_scenes::parse;

fn scene(source: &str) -> Scene {
    parse(source).unwrap_or_else(|mistakes| panic!("{}", mistakes.draw("scene", source)))
}

#[test]
fn the_smallest_scene_has_the_defaults() {
    let scene = scene("v 10 -20 500");
    let viewpoint = [10.0, -20.0, 500.0];
    assert_eq!(
        scene.camera,
        Camera::Thesis {
            viewpoint,
            projection: Projection::Perspective
        }
    );
    assert_eq!((scene.width, scene.height), (512, 512));
    assert_eq!(scene.background, [0.0; 3]);
    assert!(scene.lights.is_empty() && scene.surfaces.is_empty() && scene.objects.is_empty());
}

#[test]
fn a_resolution_is_height_first_but_inside_the_nff_viewpoint() {
    let size = |source: &str| {
        let scene = scene(source);
        (scene.width, scene.height)
    };
    assert_eq!(size("v 0 0 1 resolution 100 200"), (200, 100));
    assert_eq!(size("resolution 100 200 v 0 0 1"), (200, 100));
    let nff = "v from 0 0 1 at 0 0 0 up 0 1 0 angle 9 hither 1";
    assert_eq!(size(&format!("{nff} resolution 100 200")), (100, 200));
    assert_eq!(
        size("v 0 0 1 at 0 0 0 up 0 1 0 angle 9 resolution 100 200"),
        (200, 100)
    );
}

#[test]
fn at_up_and_angle_make_the_nff_camera_in_any_order() {
    let expected = |projection| Camera::Nff {
        from: [1.0, 2.0, 0.0],
        at: [3.0, 4.0, 5.0],
        up: [0.0, 1.0, 0.0],
        angle: 60.0,
        projection,
    };
    let rest = "at 3 4 5 up 0 1 0 angle 60";
    for source in [
        format!("v from 1 2 0 {rest}"),
        format!("v\n{rest}\nfrom 1 2 0"),
        format!("v 1 2 0 {rest}"),
        format!("{rest} v 1 2 0"),
        format!("v 1 2 0 b 0 0 0 {rest} view perspective"),
    ] {
        assert_eq!(
            scene(&source).camera,
            expected(Projection::Perspective),
            "{source}"
        );
        let parallel = format!("view parallel {}", source.replace("view perspective", ""));
        assert_eq!(
            scene(&parallel).camera,
            expected(Projection::Parallel),
            "{parallel}"
        );
    }
}

#[test]
fn lights_have_three_forms_and_those_without_a_colour_share_one_unit() {
    let scene = scene("v 0 0 1 l 1 2 3 l 4 5 6 0.25 l 7 8 9 1 2 3 l 0 0 0");
    let colours: Vec<_> = scene.lights.iter().map(|light| light.colour).collect();
    assert_eq!(colours, [[0.5; 3], [0.25; 3], [1.0, 2.0, 3.0], [0.5; 3]]);
    assert_eq!(scene.lights[2].position, [7.0, 8.0, 9.0]);
}

#[test]
fn surfaces_of_both_dialects() {
    let scene = scene(
        "v 0 0 1
         f 1 0.5 0.25  0.8 0.3 12.5 0.1 1.25
         f 1 1 1  1 0 100000 0 0
         f 1 2 3 4 5 6 7 8 9 10 0.5 0
         f 1 2 3 4 5 6 7 8 9 10 0.5 0.25
         f 1 2 3 4 5 6 7 8 9 10 0.5 0.25 1.5
         f 1 2 3 4 5 6 7 8 9 10 0.5 0 -7",
    );
    let [nff, matt, opaque, hollow, glass, odd] = scene.surfaces[..] else {
        panic!()
    };
    assert_eq!(nff.ambient, [0.0; 3]);
    assert_eq!(nff.diffuse, [0.8, 0.4, 0.2]);
    assert_eq!(nff.specular, [0.3; 3]);
    assert_eq!(
        (nff.shine, nff.reflect, nff.refract, nff.ior),
        (12.5, 0.3, 0.1, 1.25)
    );
    assert_eq!((matt.shine, matt.refract, matt.ior), (100_000.0, 0.0, 1.0));
    assert_eq!(opaque.ambient, [1.0, 2.0, 3.0]);
    assert_eq!(opaque.diffuse, [4.0, 5.0, 6.0]);
    assert_eq!(opaque.specular, [7.0, 8.0, 9.0]);
    assert_eq!(
        (opaque.shine, opaque.reflect, opaque.refract),
        (10.0, 0.5, 0.0)
    );
    assert_eq!((hollow.refract, hollow.ior), (0.25, 1.0));
    assert_eq!((glass.refract, glass.ior), (0.25, 1.5));
    assert_eq!((odd.refract, odd.ior), (0.0, 1.0));
}

#[test]
fn objects_take_the_surface_before_them_and_drop_the_sign_of_radii() {
    let scene = scene(
        "v 0 0 1 f 0 0 0 0 0 0 0 0 s 1 2 3 -4 f 1 1 1 1 0 0 0 0 f 0 0 0 0 0 0 0 0
         c 0 0 0 -1
           0 0 5 2  box 1 2 3 4 5 6",
    );
    let surfaces: Vec<_> = scene.objects.iter().map(|object| object.surface).collect();
    assert_eq!(surfaces, [0, 2, 2]);
    let [sphere, cone, cuboid] = [0, 1, 2].map(|index: usize| scene.objects[index].shape);
    assert_eq!(
        sphere,
        Shape::Sphere {
            centre: [1.0, 2.0, 3.0],
            radius: 4.0
        }
    );
    assert_eq!(
        cone,
        Shape::Cone {
            base: [0.0; 3],
            base_radius: 1.0,
            top: [0.0, 0.0, 5.0],
            top_radius: 2.0
        }
    );
    assert_eq!(
        cuboid,
        Shape::Cuboid {
            centre: [1.0, 2.0, 3.0],
            size: [4.0, 5.0, 6.0]
        }
    );
}

#[test]
fn polygons_and_patches_share_the_vertices() {
    let scene = scene(
        "v 0 0 1 f 0 0 0 0 0 0 0 0
         p 3 0 0 0 1 0 0 0 1 0
         pp 3 0 0 1 0 0 2  1 0 1 0 1 2  0 1 1 1 0 2
         p 4 0 0 2 1 0 2 1 1 2 0 1 2",
    );
    let shapes: Vec<_> = scene.objects.iter().map(|object| object.shape).collect();
    assert_eq!(
        shapes,
        [
            Shape::Polygon { first: 0, count: 3 },
            Shape::Patch {
                first: 3,
                count: 3,
                first_normal: 0
            },
            Shape::Polygon { first: 6, count: 4 },
        ]
    );
    assert_eq!(scene.vertices[4], [1.0, 0.0, 1.0]);
    assert_eq!(scene.vertices[9], [0.0, 1.0, 2.0]);
    assert_eq!(
        scene.normals,
        [[0.0, 0.0, 2.0], [0.0, 1.0, 2.0], [1.0, 0.0, 2.0]]
    );
}

/// The parser reads the layout of figure 9, an NFF file and one long line alike.
#[test]
fn line_breaks_have_no_meaning() {
    let source = "v 0 0 500\nresolution 10 20\nf 1 0 0\n0 1 0\n0 0 1\n5 0.5 0\np 4\n0 0 0\n1 0 0\n\
                  1 1 0\n0 1 0\nl 1 2 3 4";
    let one_line = source.replace('\n', " ");
    let one_each = source.replace([' ', '\n'], "\r\n");
    assert_eq!(parse(source), parse(&one_line));
    assert_eq!(parse(source), parse(&one_each));
    assert_eq!(scene(source).objects.len(), 1);
}
