//! A plan as it stands in its file.

use super::{Plan, PlanError};
use crate::choice::Choice;
use crate::format::{Arith, Format};
use crate::settings::{PixelsPerRay, RenderSettings};
use octray_core::accel;
use serde::de::{Deserialize, Deserializer, Error as _};
use std::str::FromStr;
use strum::VariantArray;

impl FromStr for Plan {
    type Err = PlanError;

    fn from_str(text: &str) -> Result<Self, PlanError> {
        let PlanFile {
            scene,
            arith,
            size,
            pixels_per_ray,
            max_depth,
            cut_off,
            tree,
            tree_depth,
            leaf_size,
            rays,
        } = toml::from_str(text).map_err(|error| match is_old(text) {
            true => PlanError::Old,
            false => error.into(),
        })?;
        let wrong = |why| Err(toml::de::Error::custom(why).into());
        let tree_options = match (tree, tree_depth, leaf_size) {
            (FileTree::None, None, None) => None,
            (FileTree::None, ..) => {
                return wrong("`tree-depth` and `leaf-size` are of no use without a tree");
            }
            (_, Some(depth), Some(leaf_size)) => Some(accel::BuildOptions { depth, leaf_size }),
            _ => return wrong("a tree needs `tree-depth` and `leaf-size`"),
        };
        Ok(Self {
            scene,
            format: arith,
            size,
            pixels_per_ray,
            max_depth,
            cut_off,
            tree: tree_options,
            on_device: tree == FileTree::Device,
            rays,
        })
    }
}

/// Whether the file begins as plans did before they were TOML.
fn is_old(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim_start);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'));
    let mut words = first.unwrap_or_default().split_whitespace();
    words.next().is_some_and(|name| KEYS.contains(&name)) && words.next() != Some("=")
}

const KEYS: [&str; 10] = [
    "scene",
    "arith",
    "size",
    "pixels-per-ray",
    "max-depth",
    "cut-off",
    "tree",
    "tree-depth",
    "leaf-size",
    "rays",
];

/// A plan as it stands in its file.
#[derive(serde::Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
struct PlanFile {
    #[serde(deserialize_with = "scene")]
    scene: u64,
    #[serde(deserialize_with = "arith")]
    arith: Format,
    #[serde(deserialize_with = "size")]
    size: (u32, u32),
    #[serde(deserialize_with = "pixels_per_ray")]
    pixels_per_ray: PixelsPerRay,
    #[serde(deserialize_with = "max_depth")]
    max_depth: u32,
    #[serde(deserialize_with = "cut_off")]
    cut_off: f64,
    #[serde(deserialize_with = "tree")]
    tree: FileTree,
    #[serde(default, deserialize_with = "whole")]
    tree_depth: Option<u32>,
    #[serde(default, deserialize_with = "whole")]
    leaf_size: Option<u32>,
    #[serde(deserialize_with = "rays")]
    rays: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum FileTree {
    None,
    Compact,
    Device,
}

/// Reads a value, or says what was expected.
fn read<'de, D: Deserializer<'de>, T: Deserialize<'de>, U>(
    deserializer: D,
    expected: &str,
    read: impl Fn(T) -> Option<U>,
) -> Result<U, D::Error> {
    let value = T::deserialize(deserializer).ok().and_then(read);
    value.ok_or_else(|| D::Error::custom(format!("expected {expected}")))
}

fn scene<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
    read(
        deserializer,
        "16 hexadecimal digits in quotes",
        |text: String| {
            let digits = text.len() == 16 && text.bytes().all(|digit| digit.is_ascii_hexdigit());
            u64::from_str_radix(&text, 16).ok().filter(|_| digits)
        },
    )
}

fn arith<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Format, D::Error> {
    let names: Vec<_> = Format::VARIANTS
        .iter()
        .map(|format| format.name())
        .collect();
    let expected = format!("one of {}, in quotes", names.join(", "));
    read(deserializer, &expected, |name: String| {
        match Arith::named(&name) {
            Some(Arith::In(format)) => Some(format),
            _ => None,
        }
    })
}

fn size<'de, D: Deserializer<'de>>(deserializer: D) -> Result<(u32, u32), D::Error> {
    let expected = "columns x rows, each from 1 to 65535, such as \"160x120\"";
    read(deserializer, expected, |text: String| {
        let side = |text: &str| text.parse::<u16>().ok().filter(|side| *side > 0);
        let (width, height) = text.split_once('x')?;
        Some((side(width)?.into(), side(height)?.into()))
    })
}

fn pixels_per_ray<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PixelsPerRay, D::Error> {
    read(deserializer, "the square of 1 to 8", |n: u32| {
        PixelsPerRay::named(&n.to_string())
    })
}

fn max_depth<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    read(deserializer, "0 to 64", |n| {
        Some(n).filter(|n| *n <= RenderSettings::DEEPEST)
    })
}

fn cut_off<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    read(deserializer, "a number from 0 to 1", |x| {
        Some(x).filter(|x| (0.0..=1.0).contains(x))
    })
}

fn tree<'de, D: Deserializer<'de>>(deserializer: D) -> Result<FileTree, D::Error> {
    let expected = "\"compact-bvh8\", \"device\" or \"none\"";
    read(deserializer, expected, |kind: String| match &*kind {
        "none" => Some(FileTree::None),
        "compact-bvh8" | "packed" => Some(FileTree::Compact),
        "device" => Some(FileTree::Device),
        _ => None,
    })
}

fn whole<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    read(deserializer, "a whole number", |n| Some(Some(n)))
}

fn rays<'de, D: Deserializer<'de>>(deserializer: D) -> Result<usize, D::Error> {
    read(deserializer, "0 to 65", |n| Some(n).filter(|n| *n <= 65))
}

#[cfg(test)]
mod tests {
    use super::super::tests::example;
    use super::*;
    use snapbox::{IntoData, assert_data_eq, str};

    /// What is reported of the example with a part of it changed.
    fn check(part: &str, other: &str, expected: impl IntoData) {
        let text = example().to_string();
        assert_eq!(text.matches(part).count(), 1, "{part}");
        let error = text.replace(part, other).parse::<Plan>().unwrap_err();
        assert_data_eq!(error.to_string(), expected);
    }

    #[test]
    fn wrong_text_is_reported_with_its_place() {
        check(
            "rays = 2\n",
            "",
            str![[r#"
plan: TOML parse error at line 1, column 1
  |
1 | scene = "0000000000000012"
  | ^
missing field `rays`
"#]],
        );
        check(
            "rays = 2",
            "rays = 2\nrays = 2",
            str![[r#"
plan: TOML parse error at line 11, column 1
   |
11 | rays = 2
   | ^^^^
duplicate key
"#]],
        );
        check(
            "rays = 2",
            "moons = 3\nrays = 2",
            str![[r#"
plan: TOML parse error at line 10, column 1
   |
10 | moons = 3
   | ^^^^^
unknown field `moons`, expected one of `scene`, `arith`, `size`, `pixels-per-ray`, `max-depth`, `cut-off`, `tree`, `tree-depth`, `leaf-size`, `rays`
"#]],
        );
        check(
            "rays = 2",
            "rays",
            str![[r#"
plan: TOML parse error at line 10, column 5
   |
10 | rays
   |     ^
key with no value, expected `=`
"#]],
        );
        check(
            "rays = 2",
            "rays = 66",
            str![[r#"
plan: TOML parse error at line 10, column 8
   |
10 | rays = 66
   |        ^^
expected 0 to 65
"#]],
        );
        check(
            "\"compact-bvh8\"",
            "\"oak\"",
            str![[r#"
plan: TOML parse error at line 7, column 8
  |
7 | tree = "oak"
  |        ^^^^^
expected "compact-bvh8", "device" or "none"
"#]],
        );
        check(
            "i18f14",
            "i18f13",
            str![[r#"
plan: TOML parse error at line 2, column 9
  |
2 | arith = "i18f13"
  |         ^^^^^^^^
expected one of f64, f32, approx0, approx1, approx2, i24f8, i22f10, i20f12, i18f14, i16f16, i14f18, i12f20, i10f22, i8f24, i6f26, i4f28, i32f32, in quotes
"#]],
        );
        check(
            "max-depth = 5",
            "max-depth = 65",
            str![[r#"
plan: TOML parse error at line 5, column 13
  |
5 | max-depth = 65
  |             ^^
expected 0 to 64
"#]],
        );
        check(
            "max-depth = 5",
            "max-depth = \"5\"",
            str![[r#"
plan: TOML parse error at line 5, column 13
  |
5 | max-depth = "5"
  |             ^^^
expected 0 to 64
"#]],
        );
        check(
            "0000000000000012",
            "12",
            str![[r#"
plan: TOML parse error at line 1, column 9
  |
1 | scene = "12"
  |         ^^^^
expected 16 hexadecimal digits in quotes
"#]],
        );
        check(
            "-ray = 4",
            "-ray = 2",
            str![[r#"
plan: TOML parse error at line 4, column 18
  |
4 | pixels-per-ray = 2
  |                  ^
expected the square of 1 to 8
"#]],
        );
        check(
            "160x120",
            "0x3",
            str![[r#"
plan: TOML parse error at line 3, column 8
  |
3 | size = "0x3"
  |        ^^^^^
expected columns x rows, each from 1 to 65535, such as "160x120"
"#]],
        );
        check(
            "cut-off = 0.001953125",
            "cut-off = nan",
            str![[r#"
plan: TOML parse error at line 6, column 11
  |
6 | cut-off = nan
  |           ^^^
expected a number from 0 to 1
"#]],
        );
        check(
            "leaf-size = 2",
            "leaf-size = -2",
            str![[r#"
plan: TOML parse error at line 9, column 13
  |
9 | leaf-size = -2
  |             ^^
expected a whole number
"#]],
        );
        check(
            "leaf-size = 2\n",
            "",
            str![[r#"
plan: a tree needs `tree-depth` and `leaf-size`
"#]],
        );
        check(
            "\"compact-bvh8\"",
            "\"none\"",
            str![[r#"
plan: `tree-depth` and `leaf-size` are of no use without a tree
"#]],
        );
    }

    #[test]
    fn plans_of_before_they_were_toml_are_refused_as_such() {
        let old = "# octray plan figure-22 --target m3\nscene 0123456789abcdef\narith i18f14\nsize 64x48\n";
        assert_eq!(old.parse::<Plan>(), Err(PlanError::Old));
        assert_eq!("max-depth 3".parse::<Plan>(), Err(PlanError::Old));
        for other in ["", "v 0 0 500", "scene = 3", "scene ="] {
            assert!(
                matches!(other.parse::<Plan>(), Err(PlanError::Text(_))),
                "{other}"
            );
        }
    }
}
