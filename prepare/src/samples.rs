//! How many rays a pixel gets.

use serde::{Deserialize, Serialize, Serializer};
use std::fmt;

/// Whitted's adaptive antialiasing (thesis, chapter IV): a ray through every corner of a pixel, and where the four of a
/// pixel differ, rays through the corners of its quarters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Adaptive {
    /// How often a pixel is quartered at most, 1 to [`Adaptive::MOST_LEVELS`].
    pub levels: u32,
    /// Corners differ if any channel differs by more than this many of 255 levels.
    pub threshold: u8,
}

impl Adaptive {
    /// The largest allowed number of levels: quarters of 1/64 of a pixel's side.
    pub const MOST_LEVELS: u32 = 6;

    /// Two levels, as fine as four by four rays.
    pub const DEFAULT: Self = Self {
        levels: 2,
        threshold: 8,
    };

    /// Returns the side of a pixel in sides of the smallest quarters.
    pub const fn side(self) -> u32 {
        1 << self.levels
    }
}

/// How many rays a pixel gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    /// K × K of them.
    Uniform(u32),
    /// More where neighbouring ones differ.
    Adaptive(Adaptive),
}

/// Displays it as `--samples` takes it.
impl fmt::Display for Samples {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uniform(samples) => write!(f, "{samples}"),
            Self::Adaptive(Adaptive { levels, threshold }) => {
                write!(f, "adaptive:{levels}:{threshold}")
            }
        }
    }
}

/// A number, or its text.
impl Serialize for Samples {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Uniform(samples) => serializer.serialize_u32(*samples),
            Self::Adaptive(_) => serializer.collect_str(self),
        }
    }
}
