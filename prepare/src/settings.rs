//! The settings of a rendering, and their defaults.

use crate::choice::Choice;
use crate::format::{Arith, Format};
use crate::samples::{Adaptive, Samples};
use crate::target::HitTestCost;
use octray_core::accel::COMPACT_MAX_DEPTH;
use serde::{Deserialize, Serialize, Serializer};
use std::num::{NonZeroU32, NonZeroUsize};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// What to render and how: everything beside the scene that the picture depends on, and the tree, on which it does not
/// depend.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RenderSettings {
    /// The arithmetic.
    pub arith: Arith,
    /// The tree.
    pub tree: TreeSettings,
    /// Columns and rows, 1 to 65535 each; the scene's own if `None`. The framing stays the same.
    pub size: Option<(u32, u32)>,
    /// Degrees by which the camera is turned, to its right, about what it looks at: the point that an NFF camera looks at,
    /// or the median of the objects' middles for the thesis's. 0 is as in the file.
    pub orbit: f64,
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// K for the mean of K × K rays per pixel, 1 to 64; 1 with several pixels per ray.
    pub samples: u32,
    /// More rays only where neighbouring ones differ; `samples` and `pixels_per_ray` are 1 then.
    pub adaptive: Option<Adaptive>,
    /// Maximum number of bounces of a ray, 0 to [`RenderSettings::DEEPEST`].
    pub max_depth: u32,
    /// Rays of a smaller weight than this, 0 to 1, are not traced.
    pub cut_off: f64,
}

impl RenderSettings {
    /// The largest allowed number of bounces.
    pub const DEEPEST: u32 = 64;

    /// f32, the default tree, the scene's own size, one ray per pixel, 8 bounces, a cut-off of 1/512: rays that
    /// contribute less than half a grey level are not traced.
    pub const DEFAULT: Self = Self {
        arith: Arith::F32,
        tree: TreeSettings::of(TreeKind::Bvh8),
        size: None,
        orbit: 0.0,
        pixels_per_ray: PixelsPerRay::One,
        samples: 1,
        adaptive: None,
        max_depth: 8,
        cut_off: 1.0 / 512.0,
    };

    /// The same with other rays per pixel.
    #[must_use]
    pub const fn with_samples(self, samples: Samples) -> Self {
        let (samples, adaptive) = match samples {
            Samples::Uniform(samples) => (samples, None),
            Samples::Adaptive(how) => (1, Some(how)),
        };
        Self {
            samples,
            adaptive,
            ..self
        }
    }

    /// Returns the rays per pixel.
    pub const fn rays_per_pixel(&self) -> Samples {
        match self.adaptive {
            Some(how) => Samples::Adaptive(how),
            None => Samples::Uniform(self.samples),
        }
    }
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
    /// The deepest level of nodes; the root is level 0. [`TreeKind::default_depth`] if `None`.
    pub depth: Option<u32>,
    /// Nodes of up to this many objects are not divided; [`leaf_size`] if `None`.
    pub leaf_size: Option<NonZeroU32>,
    /// Memory for that many nodes; as many as needed if `None`.
    pub arena: Option<NonZeroUsize>,
    /// How objects are assigned to the cells of an octree.
    pub link: Link,
    /// How rays find their way through an octree; other trees have only one.
    #[serde(default)]
    pub walk: Walk,
}

impl TreeSettings {
    /// Returns a tree of this kind with defaults otherwise.
    pub const fn of(kind: TreeKind) -> Self {
        Self {
            kind,
            depth: None,
            leaf_size: None,
            arena: None,
            link: Link::Shape,
            walk: Walk::Ordered,
        }
    }

    /// Returns how to build the tree of a scene in `format` for a `target` (a triple such as `thumbv6m-none-eabi`), or
    /// for this machine if `None`.
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

/// Returns the default leaf size: nodes of up to this many objects are not divided. It is for a target triple, or for
/// this machine if `None`, and depends only on the cost of a hit test there.
pub fn leaf_size(format: Format, target: Option<&str>) -> u32 {
    hit_test_cost(format, target).leaf_size()
}

fn hit_test_cost(format: Format, target: Option<&str>) -> HitTestCost {
    target.map_or(HitTestCost::Low, |target| HitTestCost::of(format, target))
}

/// The kind of accelerator. All give the same picture, bit for bit.
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
    /// An 8-wide BVH: eight boxes per node, every object in one leaf.
    #[default]
    #[strum(to_string = "bvh8", serialize = "tight")]
    #[serde(alias = "tight")]
    Bvh8,
    /// The same with boxes of 8-bit integers, in a quarter of the memory, for microcontrollers.
    #[strum(to_string = "compact-bvh8", serialize = "packed")]
    #[serde(rename = "compact-bvh8", alias = "packed")]
    CompactBvh8,
    /// The thesis's octree (its figure 12): cells with cluster boxes, two objects parted at once, empty cells merged.
    Modified,
    /// Glassner's octree: cells split at the centre, objects linked into every leaf they touch.
    Plain,
    /// None: every ray is tested against every object.
    None,
}

impl TreeKind {
    /// Returns its name on the command line and in statistics.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Returns whether it is one of the octrees.
    pub const fn is_octree(self) -> bool {
        matches!(self, Self::Modified | Self::Plain)
    }

    /// Returns the default of the deepest level of nodes.
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
    /// [`TreeKind::CompactBvh8`] or [`TreeKind::None`]; the cheaper one if `None`.
    pub kind: Option<TreeKind>,
    /// Whether the device builds the tree in its own memory.
    pub on_device: bool,
}

impl FirmwareTree {
    /// The compact tree, baked.
    pub const COMPACT: Self = Self::of(Some(TreeKind::CompactBvh8), false);
    /// The compact tree, built by the device.
    pub const DEVICE: Self = Self::of(Some(TreeKind::CompactBvh8), true);
    /// The compact tree if it is cheaper than none, baked.
    pub const AUTO: Self = Self::of(None, false);
    /// None.
    pub const NONE: Self = Self::of(Some(TreeKind::None), false);

    const fn of(kind: Option<TreeKind>, on_device: bool) -> Self {
        Self { kind, on_device }
    }

    /// Returns the kind of tree for this many objects in a format on a target (a triple), or on a target where hit
    /// tests are cheap if `None`.
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
            (None, _) => "The compact BVH if it is cheaper than none",
            (Some(_), true) => "The compact BVH, built by the device in its own memory",
            (Some(TreeKind::None), _) => "None: every ray is tested against every object",
            (Some(_), false) => "An 8-wide BVH with boxes of 8-bit integers, traversed in integers",
        }
    }
}

/// Serialises by name.
impl Serialize for FirmwareTree {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// How objects are assigned to the cells of the plain and the modified octree.
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
    /// To every cell that the object's surface passes through.
    #[default]
    Shape,
    /// To every cell that its bounding box overlaps.
    Box,
}

/// How rays find their way through the plain and the modified octree. All ways give the same picture, bit for bit.
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
pub enum Walk {
    /// Downward from the root: the parts of a cell that the ray meets, in order.
    #[default]
    Ordered,
    /// The thesis's: from cell to cell, each looked for from the root at the ray's exit from the last.
    Neighbour,
    /// From cell to cell along links between their faces.
    Links,
}

impl Walk {
    /// Returns it as the core has it.
    pub const fn of_core(self) -> octray_core::accel::Walk {
        match self {
            Self::Ordered => octray_core::accel::Walk::Ordered,
            Self::Neighbour => octray_core::accel::Walk::Neighbour,
            Self::Links => octray_core::accel::Walk::Links,
        }
    }
}

/// Pixels that one ray colours: a square of up to 8 × 8.
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
    /// One ray per pixel.
    #[default]
    #[strum(serialize = "1")]
    One,
    /// One ray per block of 2 × 2 pixels.
    #[strum(serialize = "4")]
    Four,
    /// One ray per block of 3 × 3 pixels.
    #[strum(serialize = "9")]
    Nine,
    /// One ray per block of 4 × 4 pixels.
    #[strum(serialize = "16")]
    Sixteen,
    /// One ray per block of 5 × 5 pixels.
    #[strum(serialize = "25")]
    TwentyFive,
    /// One ray per block of 6 × 6 pixels.
    #[strum(serialize = "36")]
    ThirtySix,
    /// One ray per block of 7 × 7 pixels.
    #[strum(serialize = "49")]
    FortyNine,
    /// One ray per block of 8 × 8 pixels.
    #[strum(serialize = "64")]
    SixtyFour,
}

impl PixelsPerRay {
    /// Returns the number of pixels.
    pub const fn number(self) -> u32 {
        self.side() * self.side()
    }

    /// Returns the side of the square of pixels that one ray colours.
    pub const fn side(self) -> u32 {
        self as u32 + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_core::frame::Frame;

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
    fn old_names_of_trees_are_accepted() {
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
    fn pixels_per_ray_are_the_squares_that_their_names_say() {
        for (side, pixels) in (1..).zip(PixelsPerRay::VARIANTS) {
            assert_eq!((pixels.side(), pixels.number()), (side, side * side));
            assert_eq!(pixels.name(), (side * side).to_string());
        }
        assert_eq!(PixelsPerRay::VARIANTS.len() as u32, Frame::<f32>::MAX_BLOCK);
    }

    #[test]
    fn leaves_hold_one_object_where_hit_tests_are_expensive() {
        assert_eq!(leaf_size(Format::F32, None), 2);
        assert_eq!(leaf_size(Format::I16F16, Some("thumbv6m-none-eabi")), 1);
        assert_eq!(leaf_size(Format::I16F16, Some("thumbv7m-none-eabi")), 2);
        assert_eq!(leaf_size(Format::F32, Some("thumbv7m-none-eabi")), 1);
    }
}
