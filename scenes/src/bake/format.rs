//! The arithmetics by name.

use super::{BakeError, Baked, Options, bake_as};
use crate::model::Scene;
use crate::quantise::finest;
use crate::saturation::PerThread;
use octray_core::scalar::{Approx, Fixed, Fixed64};

/// The names that [`bake`] knows, besides `auto`.
pub const FORMATS: [&str; 17] = [
    "f64", "f32", "approx0", "approx1", "approx2", "i24f8", "i22f10", "i20f12", "i18f14", "i16f16",
    "i14f18", "i12f20", "i10f22", "i8f24", "i6f26", "i4f28", "i32f32",
];

/// Bakes a scene in the arithmetic of that name; `auto` is the [`finest`] that the scene cannot overflow.
///
/// # Errors
/// If the scene does not fit the format or the tree, or there is no such arithmetic.
pub fn bake(scene: &Scene, arith: &str, options: &Options<'_>) -> Result<Baked, BakeError> {
    let by = match arith {
        "auto" => return bake(scene, finest(scene, options.view.max_depth), options),
        "f64" => bake_as::<f64>,
        "f32" => bake_as::<f32>,
        "approx0" => bake_as::<Approx<0>>,
        "approx1" => bake_as::<Approx<1>>,
        "approx2" => bake_as::<Approx<2>>,
        "i24f8" => bake_as::<Fixed<8, PerThread>>,
        "i22f10" => bake_as::<Fixed<10, PerThread>>,
        "i20f12" => bake_as::<Fixed<12, PerThread>>,
        "i18f14" => bake_as::<Fixed<14, PerThread>>,
        "i16f16" => bake_as::<Fixed<16, PerThread>>,
        "i14f18" => bake_as::<Fixed<18, PerThread>>,
        "i12f20" => bake_as::<Fixed<20, PerThread>>,
        "i10f22" => bake_as::<Fixed<22, PerThread>>,
        "i8f24" => bake_as::<Fixed<24, PerThread>>,
        "i6f26" => bake_as::<Fixed<26, PerThread>>,
        "i4f28" => bake_as::<Fixed<28, PerThread>>,
        "i32f32" => bake_as::<Fixed64<PerThread>>,
        unknown => return Err(BakeError::Unknown(unknown.into())),
    };
    by(scene, options)
}
