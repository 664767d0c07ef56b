//! The reader of scene files in both dialects; valid files only.

use super::cone::Cone;
use super::polygon::Polygon;
use super::shape::{Object, Shape};
use super::vector::V3;

/// A whole scene file.
#[derive(Debug)]
pub(super) struct Scene {
    pub(super) view: View,
    pub(super) background: V3,
    pub(super) lights: Vec<Light>,
    /// In file order.
    pub(super) objects: Vec<Object>,
}

/// The camera's position and direction.
#[derive(Debug)]
pub(super) struct View {
    pub(super) from: V3,
    /// The NFF camera's target; the camera is the thesis's if `None`.
    pub(super) aim: Option<Aim>,
    pub(super) parallel: bool,
    pub(super) width: u32,
    pub(super) height: u32,
}

/// The part of the NFF camera beside the viewpoint; the angle is in degrees.
#[derive(Debug)]
pub(super) struct Aim {
    pub(super) at: V3,
    pub(super) up: V3,
    pub(super) angle: f64,
}

/// A point light.
#[derive(Debug)]
pub(super) struct Light {
    pub(super) position: V3,
    /// Brightness per channel.
    pub(super) colour: V3,
}

/// The optical properties of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    pub(super) ambient: V3,
    pub(super) diffuse: V3,
    pub(super) specular: V3,
    pub(super) shine: f64,
    pub(super) reflect: f64,
    pub(super) refract: f64,
    pub(super) ior: f64,
}

/// Reads a valid scene file; panics on others.
pub(super) fn scene(source: &str) -> Scene {
    let words: Vec<&str> = source.lines().flat_map(uncommented).collect();

    let mut nff = false;
    let mut from = None;
    let mut at = None;
    let mut up = None;
    let mut angle = None;
    let mut parallel = false;
    let mut resolution = [512, 512];
    let mut background = V3::ZERO;
    let mut lights = Vec::new();
    let mut surface = None;
    let mut objects = Vec::new();

    let mut rest = &words[..];
    while let Some((&keyword, tail)) = rest.split_first() {
        let count = tail
            .iter()
            .take_while(|word| number(word).is_some())
            .count();
        let n: Vec<f64> = tail[..count]
            .iter()
            .filter_map(|word| number(word))
            .collect();
        rest = &tail[count..];
        let mut add = |shape| {
            let surface = surface.unwrap_or_else(|| panic!("`{keyword}` before the first `f`"));
            objects.push(Object::new(shape, surface));
        };
        match (keyword, count) {
            ("v", 0) => nff = true,
            ("v", 3) | ("from", 3) => from = Some(V3::from_slice(&n)),
            ("at", 3) => at = Some(V3::from_slice(&n)),
            ("up", 3) => up = Some(V3::from_slice(&n)),
            ("angle", 1) => angle = Some(n[0]),
            ("hither", 1) => {}
            ("resolution", 2) => resolution = [whole(n[0]), whole(n[1])],
            ("view", 0) => {
                let (&kind, tail) = rest.split_first().expect("`view` needs a word");
                rest = tail;
                parallel = match kind {
                    "parallel" => true,
                    "perspective" => false,
                    _ => panic!("`view {kind}`"),
                };
            }
            ("b", 3) => background = V3::from_slice(&n),
            ("l", 3) => lights.push((V3::from_slice(&n), None)),
            ("l", 4) => lights.push((V3::from_slice(&n), Some(V3::new(n[3], n[3], n[3])))),
            ("l", 6) => lights.push((V3::from_slice(&n), Some(V3::from_slice(&n[3..])))),
            ("f", 8) => surface = Some(nff_surface(&n)),
            ("f", 12 | 13) => surface = Some(thesis_surface(&n)),
            ("s", 4) => add(Shape::Sphere {
                centre: V3::from_slice(&n),
                radius: n[3].abs(),
            }),
            ("c", 8) => {
                let (base, top) = (V3::from_slice(&n), V3::from_slice(&n[4..]));
                add(Shape::Cone(Cone::new(base, n[3].abs(), top, n[7].abs())));
            }
            ("box", 6) => {
                let half = V3::from_slice(&n[3..]).map(|side| side.abs() / 2.0);
                add(Shape::Cuboid {
                    centre: V3::from_slice(&n),
                    half,
                });
            }
            ("p", 1..) if count as f64 == 1.0 + 3.0 * n[0] => {
                add(Shape::Polygon(Polygon::new(
                    n[1..].chunks(3).map(V3::from_slice).collect(),
                    None,
                )));
            }
            ("pp", 1..) if count as f64 == 1.0 + 6.0 * n[0] => {
                let vertices = n[1..].chunks(6).map(V3::from_slice).collect();
                let normals = n[1..]
                    .chunks(6)
                    .map(|six| V3::from_slice(&six[3..]))
                    .collect();
                add(Shape::Polygon(Polygon::new(vertices, Some(normals))));
            }
            _ => panic!("`{keyword}` with {count} numbers"),
        }
    }

    let [first, second] = resolution;
    let (width, height) = if nff {
        (first, second)
    } else {
        (second, first)
    };
    let aim = match (at, up, angle) {
        (Some(at), Some(up), Some(angle)) => Some(Aim { at, up, angle }),
        (None, None, None) if !nff => None,
        _ => panic!("`at`, `up` and `angle` belong together"),
    };
    let even_share = 1.0 / (lights.len() as f64).sqrt();
    let light = |(position, colour): (V3, Option<V3>)| Light {
        position,
        colour: colour.unwrap_or(V3::new(even_share, even_share, even_share)),
    };
    Scene {
        view: View {
            from: from.expect("no viewpoint"),
            aim,
            parallel,
            width,
            height,
        },
        background,
        lights: lights.into_iter().map(light).collect(),
        objects,
    }
}

/// Reads `f r g b Kd Ks Shine T ior`.
fn nff_surface(n: &[f64]) -> Surface {
    Surface {
        ambient: V3::ZERO,
        diffuse: V3::from_slice(n) * n[3],
        specular: V3::new(n[4], n[4], n[4]),
        shine: n[5],
        reflect: n[4],
        refract: n[6],
        ior: n[7],
    }
}

/// Reads `f ar ag ab dr dg db sr sg sb shine reflect refract [ior]`.
fn thesis_surface(n: &[f64]) -> Surface {
    Surface {
        ambient: V3::from_slice(n),
        diffuse: V3::from_slice(&n[3..]),
        specular: V3::from_slice(&n[6..]),
        shine: n[9],
        reflect: n[10],
        refract: n[11],
        ior: n.get(12).copied().unwrap_or(1.0),
    }
}

/// The words of a line before its comment. A `#` within a number begins none.
fn uncommented(line: &str) -> Vec<&str> {
    let mut words = Vec::new();
    for word in line.split_whitespace() {
        match word.find('#') {
            Some(hash) if !starts_as_number(word) => {
                words.extend((hash > 0).then_some(&word[..hash]));
                break;
            }
            _ => words.push(word),
        }
    }
    words
}

fn starts_as_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
}

/// Parses a word as a number; names such as `inf` are words.
fn number(word: &str) -> Option<f64> {
    if starts_as_number(word) {
        word.parse().ok().filter(|n: &f64| n.is_finite())
    } else {
        None
    }
}

/// Converts a number of pixels.
fn whole(n: f64) -> u32 {
    assert!(
        n >= 1.0 && n <= f64::from(u32::MAX) && n.fract() == 0.0,
        "{n} is not a number of pixels"
    );
    n as u32
}
