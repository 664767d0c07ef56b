//! Trees and tables take no more memory than their scenes justify, whatever the objects and the options.

use octray_core::accel::{BuildOptions, BuildStats, LinkBy, OctreeVariant};
use octray_core::quantize::Quantize;
use octray_core::scalar::Approx;
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Quantised, quantise};
use octray_prepare::tree::{Growth, OwnedBvh8, OwnedCompactBvh8, OwnedOctree};
use octray_scenes::parse;

const HEAD: &str = "v 0 0 9 resolution 8 8 l 5 5 9 1 f 0 0 0 1 1 1 0 0 0 0 0 0";

const OPTIONS: BuildOptions = BuildOptions {
    depth: 24,
    leaf_size: 2,
};

fn quantised<S: Quantize>(objects: &str) -> Quantised<S> {
    let scene = parse(&format!("{HEAD} {objects}")).unwrap();
    quantise::<S>(&scene, &RenderSettings::DEFAULT)
        .unwrap()
        .scene
}

fn octree<S: Quantize>(
    objects: &str,
    variant: OctreeVariant,
    link: LinkBy,
    arena: Option<usize>,
) -> BuildStats {
    let options = OPTIONS;
    let growth = Growth { options, arena };
    OwnedOctree::build(&mut quantised::<S>(objects), &growth, variant, link).1
}

#[test]
fn objects_at_one_place_are_not_split() {
    let shapes = [
        "s 0 0 -5 2 ",
        "p 3 -1 -1 -3 1 -1 -3 0 1 -2 ",
        "p 4 -1 -1 -3 1 -1 -3 1 1 -3 -1 1 -3 ",
        "c 0 -1 -4 1 0 1 -4 0.5 ",
        "box 0 0 -4 1 2 3 ",
    ];
    for shape in shapes {
        for link in [LinkBy::Shape, LinkBy::Box] {
            for variant in [OctreeVariant::Plain, OctreeVariant::Modified] {
                let summary = octree::<f32>(&shape.repeat(50), variant, link, None);
                assert_eq!((summary.inner, summary.leaves), (0, 1), "{shape}");
            }
        }
    }
    // Beside another object they are one more place.
    let beside = format!("{} s 3 0 -5 1", shapes[0].repeat(3));
    let summary = octree::<f32>(&beside, OctreeVariant::Plain, LinkBy::Shape, None);
    assert_eq!(summary.inner, 0);
}

#[test]
fn objects_that_nearly_coincide_have_a_bounded_tree() {
    let near = "s 0 0 -5 2 s 0 0 -5 2.0000001 s 0 0.0000001 -5 2 s 0.0000001 0 -5 2";
    let summary = octree::<f64>(near, OctreeVariant::Plain, LinkBy::Shape, None);
    assert!(summary.inner + summary.leaves <= 1 << 20);
    assert!(summary.unsplit > 0);
    // In a coarse format they are at one place.
    let summary = octree::<Approx<0>>(near, OctreeVariant::Plain, LinkBy::Shape, None);
    assert_eq!(summary.inner, 0);
}

#[test]
fn an_arena_of_any_size_takes_no_more_than_the_tree() {
    let balls: String = (0..40).map(|i| format!("s {i} 0 -5 0.7 ")).collect();
    let bvh8 = |arena| {
        let options = OPTIONS;
        OwnedBvh8::build(&mut quantised::<f32>(&balls), &Growth { options, arena }).1
    };
    let compact = |arena| {
        let options = OPTIONS;
        let mut scene = quantised::<f32>(&balls);
        let built = OwnedCompactBvh8::build(&mut scene, &Growth { options, arena });
        built.unwrap().1
    };
    let plain = |arena| octree::<f32>(&balls, OctreeVariant::Plain, LinkBy::Shape, arena);
    for arena in [1_000_000_000, usize::MAX / 16, usize::MAX] {
        assert_eq!(bvh8(Some(arena)), bvh8(None));
        assert_eq!(compact(Some(arena)), compact(None));
        assert_eq!(plain(Some(arena)), plain(None));
    }
    for arena in [1, 3, 17] {
        assert!(plain(Some(arena)).unsplit > 0 && bvh8(Some(1)).unsplit > 0);
    }
}

/// With time quadratic in the vertices, this would take minutes.
#[test]
fn a_polygon_of_very_many_vertices_is_cut_into_bands() {
    let vertices = 200_000;
    let mut text = format!("p {vertices}");
    for i in 0..vertices {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(vertices);
        let radius = 3.0 + f64::from(i % 7) / 10.0;
        text += &format!(" {} {} -5", radius * angle.cos(), radius * angle.sin());
    }
    let scene = quantised::<f32>(&text);
    let bands = scene.polygons[0].bands;
    assert!(bands.count > 100);
    assert!(scene.edges.len() <= 8 * vertices as usize);
}

#[test]
fn a_band_holds_the_edges_that_pass_through_it_in_their_order() {
    let vertices = 60;
    let mut text = format!("p {vertices}");
    for i in 0..vertices {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(vertices);
        let radius = 3.0 + f64::from(i % 7) / 2.0;
        text += &format!(" {} {} -5", radius * angle.cos(), radius * angle.sin());
    }
    // The second polygon's bands follow the first one's.
    let scene = quantised::<f64>(&format!("{text} {text}"));
    for polygon in &scene.polygons {
        let bands = polygon.bands;
        assert!(bands.count >= 4);
        let corners = &scene.corners[polygon.first as usize..][..vertices as usize];
        let upwards = (corners.iter().zip(corners.iter().cycle().skip(1)))
            .filter(|(a, b)| a[1] != b[1])
            .map(|(a, b)| if a[1] < b[1] { [*a, *b] } else { [*b, *a] });
        let upwards: Vec<_> = upwards.collect();
        for band in 0..bands.count {
            let place = (bands.first + band) as usize;
            let found = &scene.edges[scene.bands[place] as usize..scene.bands[place + 1] as usize];
            let passes = |edge: &&[[f64; 2]; 2]| {
                (bands.of(edge[0][1])..=bands.of(edge[1][1])).contains(&band)
            };
            let expected: Vec<_> = upwards.iter().filter(passes).copied().collect();
            assert_eq!(found, expected, "band {band}");
        }
    }
}
