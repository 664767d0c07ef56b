//! Generated scenes have the documented size, satisfy the model's invariants and survive a file.

use octray_scenes::generate::{SceneKind, Spec};
use octray_scenes::model::{Scene, Shape};
use octray_scenes::{check, generate, parse, write};

const SIZES: [usize; 10] = [0, 1, 2, 3, 10, 11, 92, 100, 1000, 20_000];

fn scenes() -> impl Iterator<Item = (SceneKind, usize, Scene)> {
    SceneKind::ALL
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
    for (kind, requested, scene) in scenes() {
        let size = scene.objects.len();
        let expected = match kind {
            SceneKind::Flake | SceneKind::Lattice | SceneKind::Soup => requested.max(1),
            SceneKind::Tree => 1 + 2 * (requested.saturating_sub(1) / 2),
            SceneKind::Terrain => {
                let half = (requested.saturating_sub(1) / 2).max(1);
                1 + 2 * half.isqrt() * (half / half.isqrt())
            }
        };
        assert_eq!(size, expected, "{} of {requested}", kind.name());
        if requested >= 3 {
            assert!(
                size <= requested
                    && (requested - size) as f64 <= 2.0 + 2.0 * (requested as f64).sqrt()
            );
        }
    }
}

#[test]
fn all_invariants_hold_and_every_scene_survives_a_file() {
    for (kind, requested, scene) in scenes() {
        let name = format!("{} of {requested}", kind.name());
        assert_eq!(check::scene(&scene), Ok(()), "{name}");
        let again = parse(&text(&scene)).unwrap_or_else(|mistakes| {
            panic!("{name}: {}", mistakes.draw(&name, &text(&scene)));
        });
        assert!(again == scene, "{name} changes in a file");
    }
}

#[test]
fn seeds_matter_and_nothing_else_does() {
    for kind in SceneKind::ALL {
        let spec = Spec { kind, objects: 100 };
        assert_eq!(generate(spec, 1), generate(spec, 1));
        assert_ne!(generate(spec, 1), generate(spec, 2), "{}", kind.name());
    }
}

/// These scenes have the same digits on every machine. If they change, so do pictures that users made with the same
/// seed. FNV-1a, 64 bits, over the file.
#[test]
fn the_files_are_the_same_everywhere() {
    let hashes = SceneKind::ALL.map(|kind| {
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
fn a_soup_contains_all_shapes_and_concave_polygons() {
    let scene = generate(
        Spec {
            kind: SceneKind::Soup,
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
