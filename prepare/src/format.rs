//! The list of number formats. [`crate::dispatch`] converts a name into a type.

use crate::choice::Choice;
use serde::{Deserialize, Serialize, de};
use std::fmt;
use strum::{EnumMessage, IntoStaticStr, VariantArray};

/// A number format in which pictures are traced.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    Hash,
    Serialize,
    Deserialize,
    VariantArray,
    EnumMessage,
    IntoStaticStr,
)]
#[strum(serialize_all = "lowercase")]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// 64-bit floats, the reference.
    F64,
    /// 32-bit floats.
    F32,
    /// 32-bit floats with approximate roots and reciprocals.
    Approx0,
    /// The same, improved by one Newton step.
    Approx1,
    /// The same, improved by two Newton steps.
    Approx2,
    /// 32-bit fixed point with 8 fraction bits.
    I24F8,
    /// 32-bit fixed point with 10 fraction bits.
    I22F10,
    /// 32-bit fixed point with 12 fraction bits.
    I20F12,
    /// 32-bit fixed point with 14 fraction bits.
    I18F14,
    /// 32-bit fixed point with 16 fraction bits.
    I16F16,
    /// 32-bit fixed point with 18 fraction bits.
    I14F18,
    /// 32-bit fixed point with 20 fraction bits.
    I12F20,
    /// 32-bit fixed point with 22 fraction bits.
    I10F22,
    /// 32-bit fixed point with 24 fraction bits.
    I8F24,
    /// 32-bit fixed point with 26 fraction bits.
    I6F26,
    /// 32-bit fixed point with 28 fraction bits.
    I4F28,
    /// 64-bit fixed point with 32 fraction bits.
    I32F32,
}

/// The kind of numbers of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Floats.
    Float,
    /// Floats with approximate roots and reciprocals.
    Approximate,
    /// Fixed point in 32 bits.
    Fixed,
    /// Fixed point in 64 bits.
    Fixed64,
}

impl Format {
    /// The 32-bit fixed-point formats of [`Arith::STANDARD`], the finest first: `auto` chooses one of them.
    pub const AUTOMATIC: [Self; 6] = [
        Self::I4F28,
        Self::I8F24,
        Self::I12F20,
        Self::I16F16,
        Self::I20F12,
        Self::I24F8,
    ];

    /// Returns its name on the command line, in files and in statistics.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Returns the kind of its numbers.
    pub const fn family(self) -> Family {
        match self {
            Self::F64 | Self::F32 => Family::Float,
            Self::Approx0 | Self::Approx1 | Self::Approx2 => Family::Approximate,
            Self::I32F32 => Family::Fixed64,
            _ => Family::Fixed,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The requested arithmetic: a format, or the one that suits the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arith {
    /// The finest format of [`Format::AUTOMATIC`] that the scene cannot overflow.
    Auto,
    /// This one.
    In(Format),
}

impl Arith {
    /// [`Format::F64`].
    pub const F64: Self = Self::In(Format::F64);
    /// [`Format::F32`].
    pub const F32: Self = Self::In(Format::F32);
    /// [`Format::Approx0`].
    pub const APPROX0: Self = Self::In(Format::Approx0);
    /// [`Format::Approx1`].
    pub const APPROX1: Self = Self::In(Format::Approx1);
    /// [`Format::Approx2`].
    pub const APPROX2: Self = Self::In(Format::Approx2);
    /// [`Format::I24F8`].
    pub const I24F8: Self = Self::In(Format::I24F8);
    /// [`Format::I20F12`].
    pub const I20F12: Self = Self::In(Format::I20F12);
    /// [`Format::I16F16`].
    pub const I16F16: Self = Self::In(Format::I16F16);
    /// [`Format::I12F20`].
    pub const I12F20: Self = Self::In(Format::I12F20);
    /// [`Format::I8F24`].
    pub const I8F24: Self = Self::In(Format::I8F24);
    /// [`Format::I4F28`].
    pub const I4F28: Self = Self::In(Format::I4F28);
    /// [`Format::I32F32`].
    pub const I32F32: Self = Self::In(Format::I32F32);

    /// The formats that charts and reports compare; of 32-bit fixed point, one in four fraction bits.
    pub const STANDARD: [Self; 12] = [
        Self::F64,
        Self::F32,
        Self::APPROX0,
        Self::APPROX1,
        Self::APPROX2,
        Self::I24F8,
        Self::I20F12,
        Self::I16F16,
        Self::I12F20,
        Self::I8F24,
        Self::I4F28,
        Self::I32F32,
    ];

    /// Returns its name on the command line, in files and in statistics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::In(format) => format.name(),
        }
    }

    /// Returns its name, with the format that was used if it differs: `auto: i8f24`.
    pub fn with_format(self, used: Option<Format>) -> String {
        match used {
            Some(format) if Self::In(format) != self => format!("{}: {format}", self.name()),
            _ => self.name().into(),
        }
    }
}

impl Default for Arith {
    fn default() -> Self {
        Self::F32
    }
}

impl From<Format> for Arith {
    fn from(format: Format) -> Self {
        Self::In(format)
    }
}

impl Choice for Arith {
    fn all() -> Vec<Self> {
        let formats = Format::VARIANTS.iter().copied().map(Self::In);
        formats.chain([Self::Auto]).collect()
    }

    fn name(self) -> &'static str {
        self.name()
    }

    fn names(self) -> Vec<&'static str> {
        vec![self.name()]
    }

    fn help(self) -> &'static str {
        match self {
            Self::Auto => "The finest 32-bit fixed point that the scene cannot overflow",
            Self::In(format) => format.help(),
        }
    }
}

/// Serialises by name.
impl Serialize for Arith {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// Deserialises by name.
impl<'de> Deserialize<'de> for Arith {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Self::named(&name)
            .ok_or_else(|| de::Error::custom(format_args!("no arithmetic is called {name}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arithmetic_is_written_by_name_and_read_back() {
        for arith in Arith::all() {
            let json = serde_json::to_string(&arith).unwrap();
            assert_eq!(json, format!("\"{}\"", arith.name()));
            assert_eq!(serde_json::from_str::<Arith>(&json).unwrap(), arith);
        }
        let wrong = serde_json::from_str::<Arith>("\"f16\"").unwrap_err();
        assert!(wrong.to_string().starts_with("no arithmetic is called f16"));
    }
}
