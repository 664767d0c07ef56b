//! The numbers of the thesis's tables.

use serde::{Deserialize, Serialize};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// A table of the thesis.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    VariantArray,
    EnumMessage,
    EnumString,
    IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum TableNumber {
    /// Voxel and surface tests, plain octree against modified.
    #[strum(serialize = "I")]
    #[serde(rename = "I")]
    One,
    /// Rays and time of the figures.
    #[strum(serialize = "II")]
    #[serde(rename = "II")]
    Two,
    /// Time without and with a floating-point unit.
    #[strum(serialize = "III")]
    #[serde(rename = "III")]
    Three,
    /// Reflective surfaces against opaque ones.
    #[strum(serialize = "IV")]
    #[serde(rename = "IV")]
    Four,
    /// The number of surfaces.
    #[strum(serialize = "V")]
    #[serde(rename = "V")]
    Five,
    /// The resolution.
    #[strum(serialize = "VI")]
    #[serde(rename = "VI")]
    Six,
    /// Pixels that one ray colours.
    #[strum(serialize = "VII")]
    #[serde(rename = "VII")]
    Seven,
    /// Time against the rows of a tile, static and dynamic.
    #[strum(serialize = "VIII")]
    #[serde(rename = "VIII")]
    Eight,
    /// Speed-up against the number of processors, static and dynamic.
    #[strum(serialize = "IX")]
    #[serde(rename = "IX")]
    Nine,
}

impl TableNumber {
    /// Returns the Roman numeral.
    pub fn name(self) -> &'static str {
        match self {
            Self::One => "I",
            Self::Two => "II",
            Self::Three => "III",
            Self::Four => "IV",
            Self::Five => "V",
            Self::Six => "VI",
            Self::Seven => "VII",
            Self::Eight => "VIII",
            Self::Nine => "IX",
        }
    }

    /// Returns the title of the table.
    pub fn title(self) -> &'static str {
        match self {
            Self::One => "voxel and surface tests, plain octree against modified",
            Self::Two => "rays and time of the figures",
            Self::Three => "without and with a floating-point unit",
            Self::Four => "reflective surfaces against opaque ones",
            Self::Five => "the number of surfaces",
            Self::Six => "the resolution",
            Self::Seven => "pixels per ray",
            Self::Eight => "time against H, the rows of a tile",
            Self::Nine => "speed-up against processors",
        }
    }

    /// Returns the heading of its variants.
    pub fn variants(self) -> &'static str {
        match self {
            Self::One => "octree",
            Self::Two => "lights",
            Self::Three => "conditions, floating-point unit",
            Self::Four | Self::Five => "surfaces",
            Self::Six => "resolution",
            Self::Seven => "pixels per ray",
            Self::Eight => "H",
            Self::Nine => "processors",
        }
    }
}
