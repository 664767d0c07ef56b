//! What there is to choose when a scene is rendered, and the defaults.

use crate::choice::Choice;
use crate::format::{Arith, Format};
use crate::target::HitTestCost;
use octray_core::accel::COMPACT_MAX_DEPTH;
use serde::{Deserialize, Serialize};
use std::num::{NonZeroU32, NonZeroUsize};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// What is rendered and how: everything that the picture depends on beside the scene, and the tree, on which it
/// does not depend.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RenderSettings {
    /// The arithmetic.
    pub arith: Arith,
    /// The tree.
    pub tree: TreeSettings,
    /// Columns and rows, 1 to 65535 each; the scene's own if `None`. The framing stays.
    pub size: Option<(u32, u32)>,
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// K for the mean of K × K rays per pixel, 1 to 64; 1 with four pixels per ray.
    pub samples: u32,
    /// How often a ray may bounce, 0 to [`RenderSettings::DEEPEST`].
    pub max_depth: u32,
    /// The weight, 0 to 1, below which a ray is not traced.
    pub cut_off: f64,
}

impl RenderSettings {
    /// The largest limit of bounces that can be asked for.
    pub const DEEPEST: u32 = 64;

    /// f32, the default tree, the scene's own size, a ray per pixel, 8 bounces. Rays that weigh less than half a
    /// grey level, 1/512, are not traced.
    pub const DEFAULT: Self = Self {
        arith: Arith::F32,
        tree: TreeSettings::of(TreeKind::Bvh8),
        size: None,
        pixels_per_ray: PixelsPerRay::One,
        samples: 1,
        max_depth: 8,
        cut_off: 1.0 / 512.0,
    };
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The tree to build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TreeSettings {
    /// Its kind.
    pub kind: TreeKind,
    /// The deepest level of nodes, the root being level 0; [`TreeKind::default_depth`] if `None`.
    pub depth: Option<u32>,
    /// Objects up to which a node is not divided; [`leaf_size`] if `None`.
    pub leaf_size: Option<NonZeroU32>,
    /// Room for that many nodes; as many as it takes if `None`.
    pub arena: Option<NonZeroUsize>,
    /// How objects are linked into octants.
    pub link: Link,
}

impl TreeSettings {
    /// A tree of this kind, all else by default.
    pub const fn of(kind: TreeKind) -> Self {
        Self {
            kind,
            depth: None,
            leaf_size: None,
            arena: None,
            link: Link::Shape,
        }
    }

    /// How the tree of a scene in `format` is built: for a `target` (a triple such as `thumbv6m-none-eabi`), or for
    /// this machine if `None`.
    pub fn build_options(
        &self,
        format: Format,
        target: Option<&str>,
    ) -> octray_core::accel::BuildOptions {
        octray_core::accel::BuildOptions {
            depth: self.depth.unwrap_or(self.kind.default_depth()),
            leaf_size: self
                .leaf_size
                .map_or_else(|| leaf_size(format, target), NonZeroU32::get),
        }
    }
}

impl Default for TreeSettings {
    fn default() -> Self {
        Self::of(TreeKind::Bvh8)
    }
}

/// Objects up to which a node is not divided, where nothing else is asked for: for a target triple, or for this
/// machine if `None`. It depends on what a hit test costs there, and on nothing else.
pub fn leaf_size(format: Format, target: Option<&str>) -> u32 {
    hit_test_cost(format, target).leaf_size()
}

fn hit_test_cost(format: Format, target: Option<&str>) -> HitTestCost {
    target.map_or(HitTestCost::Low, |target| HitTestCost::of(format, target))
}

/// The kind of tree that finds what a ray meets. All give the same picture, to the bit.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    Hash,
    Serialize,
    Deserialize,
    VariantArray,
    EnumMessage,
    EnumString,
    IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum TreeKind {
    /// A bounding volume hierarchy: eight boxes per node, every object in one leaf.
    #[default]
    #[strum(to_string = "bvh8", serialize = "tight")]
    #[serde(alias = "tight")]
    Bvh8,
    /// The same with boxes in 8-bit integers, in a quarter of the memory: what small targets use.
    #[strum(to_string = "compact-bvh8", serialize = "packed")]
    #[serde(rename = "compact-bvh8", alias = "packed")]
    CompactBvh8,
    /// The thesis's octree: octants with cluster boxes, one merged with three empty ones where possible.
    Modified,
    /// Glassner's octree: octants split at the centre, objects linked into every leaf they touch.
    Plain,
    /// None: every ray tries every object.
    None,
}

impl TreeKind {
    /// Its name on the command line and in statistics.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The deepest level of nodes where nothing else is asked for.
    pub const fn default_depth(self) -> u32 {
        match self {
            Self::Bvh8 => 24,
            Self::CompactBvh8 => COMPACT_MAX_DEPTH,
            Self::Modified | Self::Plain | Self::None => 8,
        }
    }
}

/// The tree of a scene that is baked for a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FirmwareTree {
    /// [`TreeKind::CompactBvh8`] or [`TreeKind::None`]; whichever costs less if `None`.
    pub kind: Option<TreeKind>,
    /// Whether the device builds it in its own memory.
    pub on_device: bool,
}

impl FirmwareTree {
    /// The compact tree, baked.
    pub const COMPACT: Self = Self::of(Some(TreeKind::CompactBvh8), false);
    /// The compact tree, built by the device.
    pub const DEVICE: Self = Self::of(Some(TreeKind::CompactBvh8), true);
    /// The compact tree where it costs less than none, baked.
    pub const AUTO: Self = Self::of(None, false);
    /// None.
    pub const NONE: Self = Self::of(Some(TreeKind::None), false);

    const fn of(kind: Option<TreeKind>, on_device: bool) -> Self {
        Self { kind, on_device }
    }

    /// The kind that is taken for so many objects in a format on a target (a triple), or where hit tests cost little
    /// if `None`.
    pub fn kind_for(self, objects: usize, format: Format, target: Option<&str>) -> TreeKind {
        let least = hit_test_cost(format, target).least_objects();
        match self.kind {
            Some(kind) => kind,
            None if objects < least => TreeKind::None,
            None => TreeKind::CompactBvh8,
        }
    }
}

impl Default for FirmwareTree {
    fn default() -> Self {
        Self::COMPACT
    }
}

impl Choice for FirmwareTree {
    fn all() -> Vec<Self> {
        vec![Self::COMPACT, Self::DEVICE, Self::AUTO, Self::NONE]
    }

    fn name(self) -> &'static str {
        match (self.kind, self.on_device) {
            (None, _) => "auto",
            (Some(_), true) => "device",
            (Some(kind), false) => kind.name(),
        }
    }

    fn names(self) -> Vec<&'static str> {
        match (self.kind, self.on_device) {
            (Some(kind), false) => kind.names(),
            _ => vec![self.name()],
        }
    }

    fn help(self) -> &'static str {
        match (self.kind, self.on_device) {
            (None, _) => "The compact BVH where it costs less than none",
            (Some(_), true) => "The compact BVH, built by the device in its own memory",
            (Some(TreeKind::None), _) => "None: every ray tries every object",
            (Some(_), false) => {
                "A BVH of eight boxes per node in 8-bit integers, walked in integers"
            }
        }
    }
}

/// By name.
impl Serialize for FirmwareTree {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// How objects are linked into the octants of the plain and the modified octree.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    Serialize,
    Deserialize,
    VariantArray,
    EnumMessage,
    EnumString,
    IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Link {
    /// Wherever the object's surface passes.
    #[default]
    Shape,
    /// Wherever its bounding box reaches.
    Box,
}

/// Pixels that one ray colours.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    Serialize,
    Deserialize,
    VariantArray,
    EnumMessage,
    EnumString,
    IntoStaticStr,
)]
pub enum PixelsPerRay {
    /// A ray for each pixel.
    #[default]
    #[strum(serialize = "1")]
    One,
    /// A ray for each block of 2 × 2 pixels.
    #[strum(serialize = "4")]
    Four,
}

impl PixelsPerRay {
    /// How many.
    pub const fn number(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 4,
        }
    }

    /// The side of the square of pixels that one ray colours.
    pub const fn side(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_has_the_same_name_on_the_command_line_and_in_files() {
        for kind in TreeKind::VARIANTS {
            let json = serde_json::to_value(kind).unwrap();
            assert_eq!(json, kind.name());
        }
        let names: Vec<_> = TreeKind::VARIANTS.iter().map(|kind| kind.name()).collect();
        assert_eq!(names, ["bvh8", "compact-bvh8", "modified", "plain", "none"]);
    }

    #[test]
    fn old_names_of_trees_are_understood() {
        for (old, kind) in [("tight", TreeKind::Bvh8), ("packed", TreeKind::CompactBvh8)] {
            assert_eq!(TreeKind::named(old), Some(kind));
            assert_eq!(
                serde_json::from_value::<TreeKind>(old.into()).unwrap(),
                kind
            );
        }
    }

    #[test]
    fn a_tree_for_targets_is_known_by_its_name() {
        for tree in FirmwareTree::all() {
            assert_eq!(FirmwareTree::named(tree.name()), Some(tree));
        }
        assert_eq!(FirmwareTree::named("packed"), Some(FirmwareTree::COMPACT));
        assert_eq!(FirmwareTree::named("bvh8"), None);
        let kind =
            |objects| FirmwareTree::AUTO.kind_for(objects, Format::F32, Some("thumbv7m-none-eabi"));
        assert_eq!([kind(2), kind(3)], [TreeKind::None, TreeKind::CompactBvh8]);
    }

    #[test]
    fn leaves_hold_one_object_where_hit_tests_are_expensive() {
        assert_eq!(leaf_size(Format::F32, None), 2);
        assert_eq!(leaf_size(Format::I16F16, Some("thumbv6m-none-eabi")), 1);
        assert_eq!(leaf_size(Format::I16F16, Some("thumbv7m-none-eabi")), 2);
        assert_eq!(leaf_size(Format::F32, Some("thumbv7m-none-eabi")), 1);
    }
}
