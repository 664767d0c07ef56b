//! Writes numbers of every format as Rust source.

use octray_core::quantize::Quantize;
use octray_core::scalar::SaturationCounter;
use octray_core::scalar::{Approx, Fixed, Fixed64, Reciprocal};

/// A format whose numbers can be written as source.
pub trait Literal: Quantize {
    /// The format's type, within `use octray_core::scalar`.
    fn type_name() -> String;
    /// The type of a bit pattern.
    const RAW: &'static str;
    /// The function that makes a number from the bit pattern `raw` in a constant.
    const FROM_RAW: &'static str;
    /// The source of the number nearest to the `f64` `x`, in a constant.
    const NEAREST: &'static str;
    /// Returns the bit pattern.
    fn raw(self) -> String;
    /// Returns the source of a reciprocal in a constant.
    fn reciprocal_source(reciprocal: Self::Reciprocal) -> String;
}

impl<const F: u32, C: SaturationCounter> Literal for Fixed<F, C> {
    // Preparation proves that nothing saturates, so the target checks nothing.
    fn type_name() -> String {
        format!("scalar::Fixed<{F}>")
    }
    const RAW: &'static str = "i32";
    const FROM_RAW: &'static str = "S::from_bits(raw)";
    const NEAREST: &'static str = "S::nearest(x)";
    fn raw(self) -> String {
        self.to_bits().to_string()
    }
    fn reciprocal_source(reciprocal: Reciprocal) -> String {
        let (mantissa, shift) = reciprocal.parts();
        format!("scalar::Reciprocal::from_parts({mantissa}, {shift})")
    }
}

impl<C: SaturationCounter> Literal for Fixed64<C> {
    fn type_name() -> String {
        "scalar::Fixed64".into()
    }
    const RAW: &'static str = "i64";
    const FROM_RAW: &'static str = "S::from_bits(raw)";
    const NEAREST: &'static str = "S::nearest(x)";
    fn raw(self) -> String {
        self.to_bits().to_string()
    }
    fn reciprocal_source(reciprocal: Self) -> String {
        format!("n({})", reciprocal.raw())
    }
}

impl Literal for f32 {
    fn type_name() -> String {
        "f32".into()
    }
    const RAW: &'static str = "u32";
    const FROM_RAW: &'static str = "f32::from_bits(raw)";
    const NEAREST: &'static str = "x as f32";
    fn raw(self) -> String {
        format!("{:#010x}", self.to_bits())
    }
    fn reciprocal_source(reciprocal: Self) -> String {
        format!("n({})", reciprocal.raw())
    }
}

impl Literal for f64 {
    fn type_name() -> String {
        "f64".into()
    }
    const RAW: &'static str = "u64";
    const FROM_RAW: &'static str = "f64::from_bits(raw)";
    const NEAREST: &'static str = "x";
    fn raw(self) -> String {
        format!("{:#018x}", self.to_bits())
    }
    fn reciprocal_source(reciprocal: Self) -> String {
        format!("n({})", reciprocal.raw())
    }
}

impl<const N: u32> Literal for Approx<N> {
    fn type_name() -> String {
        format!("scalar::Approx<{N}>")
    }
    const RAW: &'static str = "u32";
    const FROM_RAW: &'static str = "scalar::Approx(f32::from_bits(raw))";
    const NEAREST: &'static str = "scalar::Approx(x as f32)";
    fn raw(self) -> String {
        Literal::raw(self.0)
    }
    fn reciprocal_source(reciprocal: f32) -> String {
        format!("f32::from_bits({})", Literal::raw(reciprocal))
    }
}
