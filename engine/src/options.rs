//! What there is to choose when a scene is made ready: arithmetic, octree, and what to trace.

use clap::ValueEnum;
use octray_scenes::model::Scene;
use octray_prepare::quantise;
use serde::{Deserialize, Serialize};
use std::num::{NonZeroU32, NonZeroUsize};

/// The octree to build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TreeOptions {
    /// Its kind.
    pub kind: Tree,
    /// The deepest level of nodes, the root being level 0; the kind's own default if `None`.
    pub depth: Option<u32>,
    /// Objects up to which a node is not divided; the kind's own default if `None`.
    pub leaf_size: Option<NonZeroU32>,
    /// Room for that many nodes; as many as it takes if `None`.
    pub arena: Option<NonZeroUsize>,
    /// How objects are linked into octants.
    pub link: Link,
}

/// What to trace.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewOptions {
    /// Columns and rows, 1 to 65535 each; the scene's own if `None`.
    pub size: Option<(u32, u32)>,
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// Rays per pixel in each direction, 1 to 64.
    pub samples: u32,
    /// How often a ray may bounce, 0 to [`DEEPEST`].
    pub max_depth: u32,
    /// The weight below which a ray is not traced, 0 to 1.
    pub cut_off: f64,
}

/// The largest limit of bounces that can be asked for.
pub const DEEPEST: u32 = 64;

/// The arithmetic a picture is traced in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[value(rename_all = "lower")]
#[serde(rename_all = "lowercase")]
pub enum Arith {
    /// 64-bit floats, the reference.
    F64,
    /// 32-bit floats.
    #[default]
    F32,
    /// 32-bit floats with approximate roots and reciprocals.
    Approx0,
    /// The same, made better by one Newton step.
    Approx1,
    /// The same, made better by two Newton steps.
    Approx2,
    /// 32-bit fixed point with 8 fraction bits.
    I24F8,
    /// 32-bit fixed point with 12 fraction bits.
    I20F12,
    /// 32-bit fixed point with 16 fraction bits.
    I16F16,
    /// 32-bit fixed point with 20 fraction bits.
    I12F20,
    /// 32-bit fixed point with 24 fraction bits.
    I8F24,
    /// 32-bit fixed point with 28 fraction bits.
    I4F28,
    /// 64-bit fixed point with 32 fraction bits.
    I32F32,
    /// The finest 32-bit fixed point of those above that the scene cannot overflow.
    Auto,
}

/// The kind of octree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tree {
    /// Up to eight tight boxes per node, every object in one leaf.
    #[default]
    Tight,
    /// The tight tree in few bytes, walked in integers: what small targets use.
    Packed,
    /// Octants with cluster boxes, one merged with three empty ones where possible.
    Modified,
    /// Octants split at the centre, objects linked into every leaf they touch.
    Plain,
    /// None: every ray tries every object.
    None,
}

/// How objects are linked into the octants of the plain and the modified tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
pub enum Link {
    /// Wherever the object's surface passes.
    #[default]
    Shape,
    /// Wherever its bounding box reaches.
    Box,
}

/// Pixels that one ray colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
pub enum PixelsPerRay {
    /// A ray for each pixel.
    #[default]
    #[value(name = "1")]
    One,
    /// A ray for each block of 2 × 2 pixels.
    #[value(name = "4")]
    Four,
}

impl Arith {
    /// What `auto` stands for; see [`quantise::finest`].
    pub fn finest(scene: &Scene, max_depth: u32) -> Self {
        let name = quantise::finest(scene, max_depth);
        let mut all = Self::value_variants().iter().copied();
        all.find(|arith| arith.name() == name)
            .unwrap_or(Self::I24F8)
    }

    /// Its name on the command line and in statistics.
    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
            Self::Approx0 => "approx0",
            Self::Approx1 => "approx1",
            Self::Approx2 => "approx2",
            Self::I24F8 => "i24f8",
            Self::I20F12 => "i20f12",
            Self::I16F16 => "i16f16",
            Self::I12F20 => "i12f20",
            Self::I8F24 => "i8f24",
            Self::I4F28 => "i4f28",
            Self::I32F32 => "i32f32",
            Self::Auto => "auto",
        }
    }
}

impl Arith {
    /// Its name, and the number format that was used where that is another: `auto: i8f24`.
    pub fn with_format(self, format: &str) -> String {
        match self.name() {
            name if name == format || format.is_empty() => name.into(),
            name => format!("{name}: {format}"),
        }
    }
}

impl TreeOptions {
    /// A tree of this kind, all else as suits it.
    pub fn of(kind: Tree) -> Self {
        Self {
            kind,
            depth: None,
            leaf_size: None,
            arena: None,
            link: Link::Shape,
        }
    }
}

impl PixelsPerRay {
    /// How many.
    pub fn number(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 4,
        }
    }
}

impl Tree {
    /// Its name on the command line and in statistics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tight => "tight",
            Self::Packed => "packed",
            Self::Modified => "modified",
            Self::Plain => "plain",
            Self::None => "none",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The name in messages, on the command line and in JSON are one and the same.
    fn agree<T: ValueEnum + Serialize + Copy>(name: impl Fn(T) -> &'static str) {
        for value in T::value_variants() {
            let on_command_line = value.to_possible_value().unwrap();
            assert_eq!(on_command_line.get_name(), name(*value));
            let in_json = serde_json::to_value(value).unwrap();
            assert_eq!(in_json, name(*value));
        }
    }

    #[test]
    fn what_is_finest_is_an_arithmetic() {
        for (light, finest) in [
            ("1", Arith::I4F28),
            ("100", Arith::I8F24),
            ("1e3", Arith::I12F20),
            ("1e4", Arith::I16F16),
            ("1e5", Arith::I20F12),
            ("1e6", Arith::I24F8),
        ] {
            let scene = octray_scenes::parse(&format!("v 0 0 9 l 0 0 9 {light}")).unwrap();
            assert_eq!(Arith::finest(&scene, 8), finest, "{light}");
        }
    }

    #[test]
    fn a_name_is_the_same_everywhere() {
        agree(Arith::name);
        agree(Tree::name);
    }
}
