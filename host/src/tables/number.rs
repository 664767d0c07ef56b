//! The thesis's tables by number.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A table of the thesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum, Serialize, Deserialize)]
pub enum Number {
    /// Voxel and surface tests, plain octree against modified.
    #[value(name = "I")]
    #[serde(rename = "I")]
    One,
    /// Rays and time of the figures.
    #[value(name = "II")]
    #[serde(rename = "II")]
    Two,
    /// Time without and with a floating-point unit.
    #[value(name = "III")]
    #[serde(rename = "III")]
    Three,
    /// Reflective surfaces against opaque ones.
    #[value(name = "IV")]
    #[serde(rename = "IV")]
    Four,
    /// The number of surfaces.
    #[value(name = "V")]
    #[serde(rename = "V")]
    Five,
    /// The resolution.
    #[value(name = "VI")]
    #[serde(rename = "VI")]
    Six,
    /// Pixels that one ray colours.
    #[value(name = "VII")]
    #[serde(rename = "VII")]
    Seven,
    /// Time against the rows of a packet, static and dynamic.
    #[value(name = "VIII")]
    #[serde(rename = "VIII")]
    Eight,
    /// Speed-up against the number of processors, static and dynamic.
    #[value(name = "IX")]
    #[serde(rename = "IX")]
    Nine,
}

impl Number {
    /// The Roman numeral.
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

    /// What the table shows.
    pub fn title(self) -> &'static str {
        match self {
            Self::One => "voxel and surface tests, plain octree against modified",
            Self::Two => "rays and time of the figures",
            Self::Three => "without and with a floating-point unit",
            Self::Four => "reflective surfaces against opaque ones",
            Self::Five => "the number of surfaces",
            Self::Six => "the resolution",
            Self::Seven => "pixels per ray",
            Self::Eight => "time against H, the rows of a packet",
            Self::Nine => "speed-up against processors",
        }
    }

    /// What its variants are.
    pub fn variants(self) -> &'static str {
        match self {
            Self::One => "octree",
            Self::Two => "lights",
            Self::Three => "unit",
            Self::Four | Self::Five => "surfaces",
            Self::Six => "resolution",
            Self::Seven => "pixels per ray",
            Self::Eight => "H",
            Self::Nine => "processors",
        }
    }
}
