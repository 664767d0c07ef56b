//! Generated scenes have the size they promise, keep the model's promises and survive a file.

use octray_scenes::generate::{Kind, Spec};
use octray_scenes::model::{Scene, Shape};
use octray_scenes::{check, generate, parse, write};

const SIZES: [usize; 10] = [0, 1, 2, 3, 10, 11, 92, 100, 1000, 20_000];

fn scenes() -> impl Iterator<Item = (Kind, usize, Scene)> {
    Kind::ALL
        .into_iter()
        .flat_map(|kind| SIZES.map(|objects| (kind, objects, generate(Spec { kind, objects }, 7))))
}

fn text(scene: &Scene) -> String {
    let mut text = Vec::new();
    write(scene, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn sizes_are_as_documented() {
    for (kind, wished, scene) in scenes() {
        let size = scene.objects.len();
        let expected = match kind {
            Kind::Flake | Kind::Lattice | Kind::Soup => wished.max(1),
            Kind::Tree => 1 + 2 * (wished.saturating_sub(1) / 2),
            Kind::Terrain => {
                let half = (wished.saturating_sub(1) / 2).max(1);
                1 + 2 * half.isqrt() * (half / half.isqrt())
            }
        };
        assert_eq!(size, expected, "{} of {wished}", kind.name());
        if wished >= 3 {
            assert!(size <= wished && (wished - size) as f64 <= 2.0 + 2.0 * (wished as f64).sqrt());
        }
    }
}

#[test]
fn all_promises_are_kept_and_every_scene_comes_back_from_a_file() {
    for (kind, wished, scene) in scenes() {
        let name = format!("{} of {wished}", kind.name());
        assert_eq!(check::scene(&scene), Ok(()), "{name}");
        let again = parse(&text(&scene)).unwrap_or_else(|mistakes| {
            panic!("{name}: {}", mistakes.draw(&name, &text(&scene)));
        });
        assert!(again == scene, "{name} changes in a file");
    }
}

#[test]
fn seeds_matter_and_nothing_else_does() {
    for kind in Kind::ALL {
        let spec = Spec { kind, objects: 100 };
        assert_eq!(generate(spec, 1), generate(spec, 1));
        assert_ne!(generate(spec, 1), generate(spec, 2), "{}", kind.name());
    }
}

/// The digits of these scenes are the same on every machine; if they change, so does the picture
/// that somebody made with the same seed. FNV-1a, 64 bits, over the file.
#[test]
fn the_files_are_the_same_everywhere() {
    let hashes = Kind::ALL.map(|kind| {
        let scene = generate(
            Spec {
                kind,
                objects: 5000,
            },
            1989,
        );
        let hash = text(&scene)
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
            });
        format!("{} {hash:016x}", kind.name())
    });
    snapbox::assert_data_eq!(
        hashes.join("\n"),
        snapbox::str![[r#"
flake 9fa394ae90fcc749
lattice 410a767b8253b362
terrain 27efad7e7de2e9a4
tree 8dc171ab22c5bb63
soup fd7fa2c976ecf786
"#]]
    );
}

#[test]
fn a_soup_has_all_shapes_and_concave_polygons() {
    let scene = generate(
        Spec {
            kind: Kind::Soup,
            objects: 71,
        },
        3,
    );
    let mut count = [0; 5];
    for object in &scene.objects {
        count[match object.shape {
            Shape::Sphere { .. } => 0,
            Shape::Cone { .. } => 1,
            Shape::Cuboid { .. } => 2,
            Shape::Polygon { .. } => 3,
            Shape::Patch { .. } => 4,
        }] += 1;
    }
    assert_eq!(count, [10, 20, 10, 21, 10]);
}
