//! Light, recursion and whole pictures.

use super::super::{Counts, Options, Picture, first_object, render, to_byte};

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
fn what_holds_a_light_does_not_block_it() {
    // The sphere is lit by its nearest point to the light.
    let scene = "l 3 0 5 1 f 0.1 0.1 0.1 0.5 0.5 0.5 0 0 0 1 0 0 s 0 0 0 1";
    let lit = pixel(scene);
    for holder in [
        "p 4 2 -9 5 9 -9 5 9 9 5 2 9 5",
        "box 3 0 6 2 2 2",
        "s 3 0 6 1",
        "c 3 0 6 1 9 0 6 1",
    ] {
        assert_eq!(pixel(&format!("{scene} {holder}")), lit, "{holder}");
    }
    // But its other side does.
    assert_eq!(pixel(&format!("{scene} box 2.5 0 4.5 1 1 1")), [26; 3]);
    assert_eq!(pixel(&format!("{scene} s 3 0 4 1")), [26; 3]);
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
    // A ray at 45° to polygons of ior 0.5 is totally reflected, for either winding: the background is mirrored.
    let wall = "f 0.4 0.4 0.4 0 0 0 0 0 0 1 0 0.75 0.5 p 4";
    for corners in [
        "-5 -5 -5 5 -5 5 5 5 5 -5 5 -5",
        "-5 5 -5 5 5 5 5 -5 5 -5 -5 -5",
    ] {
        let picture = pixel_with(&format!("{wall} {corners}"), &Options::default());
        assert_eq!(picture.rgb, [64, 102, 140]);
        assert_eq!(picture.counts.transmitted, 0);
        assert_eq!(picture.counts.reflected, 1);
    }
    // A single ray brings what is mirrored anyhow, too: 0.25 · 0.4 + (0.25 + 0.75) · background.
    let picture = pixel_with(
        &format!(
            "{} -5 -5 -5 5 -5 5 5 5 5 -5 5 -5",
            wall.replace("0 0.75 0.5 p", "0.25 0.75 0.5 p")
        ),
        &Options::default(),
    );
    assert_eq!(
        (picture.rgb, picture.counts.reflected),
        (vec![77, 128, 179], 1)
    );
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
