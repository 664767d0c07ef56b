//! The border between `f64` and a format. Only code that prepares a scene or looks at a result uses
//! it; nothing in the tracer does.

use crate::scalar::{Approx, Fixed, Fixed64, SaturationCounter};
use crate::trace::TraceScalar;

/// A format that numbers can be converted to and from.
pub trait Quantize: TraceScalar {
    /// The name that the command line uses, e.g. `i16f16`.
    const NAME: &'static str;
    /// Bits behind the point, for fixed-point formats.
    const FRACTION_BITS: Option<u32>;
    /// How far a computed hit point, not refined, can lie from its shape, as a share of the
    /// largest distance in the scene. Bounding boxes are this much larger than their shapes.
    const SLACK: f64;
    /// The nearest value; saturates, NaN gives 0.
    fn from_f64(x: f64) -> Self;
    /// The exact value (the 64-bit fixed format: rounded to nearest).
    fn to_f64(self) -> f64;
}

impl Quantize for f32 {
    const NAME: &'static str = "f32";
    const FRACTION_BITS: Option<u32> = None;
    const SLACK: f64 = 1.0 / (1u64 << 20) as f64;

    fn from_f64(x: f64) -> Self {
        x as f32
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Quantize for f64 {
    const NAME: &'static str = "f64";
    const FRACTION_BITS: Option<u32> = None;
    const SLACK: f64 = 1.0 / (1u64 << 48) as f64;

    fn from_f64(x: f64) -> Self {
        x
    }

    fn to_f64(self) -> f64 {
        self
    }
}

impl<const N: u32> Quantize for Approx<N> {
    const NAME: &'static str = ["approx0", "approx1", "approx2"][N as usize];
    const FRACTION_BITS: Option<u32> = None;
    const SLACK: f64 = [1.0 / 8.0, 1.0 / 128.0, 1.0 / 16_384.0][N as usize];

    fn from_f64(x: f64) -> Self {
        Self(x as f32)
    }

    fn to_f64(self) -> f64 {
        f64::from(self.0)
    }
}

impl<const F: u32, C: SaturationCounter> Quantize for Fixed<F, C> {
    const NAME: &'static str = match F {
        8 => "i24f8",
        10 => "i22f10",
        12 => "i20f12",
        14 => "i18f14",
        16 => "i16f16",
        18 => "i14f18",
        20 => "i12f20",
        22 => "i10f22",
        24 => "i8f24",
        26 => "i6f26",
        28 => "i4f28",
        _ => "fixed",
    };
    const FRACTION_BITS: Option<u32> = Some(F);
    // A direction is rounded to F bits: over the scene's diagonal that is this share of it.
    const SLACK: f64 = 4.0 / (1u64 << F) as f64;

    fn from_f64(x: f64) -> Self {
        Self::nearest(x)
    }

    fn to_f64(self) -> f64 {
        f64::from(self.to_bits()) / (1u64 << F) as f64
    }
}

impl<C: SaturationCounter> Quantize for Fixed64<C> {
    const NAME: &'static str = "i32f32";
    const FRACTION_BITS: Option<u32> = Some(32);
    const SLACK: f64 = 1.0 / (1u64 << 28) as f64;

    fn from_f64(x: f64) -> Self {
        Self::nearest(x)
    }

    fn to_f64(self) -> f64 {
        self.to_bits() as f64 / (1u64 << 32) as f64
    }
}
