//! Large functions that differ for every format, instantiated here once per format.
//!
//! A generic function is compiled again in every crate that uses it. These functions are not generic, so rendering,
//! baking and the laboratory share one copy per format.

use crate::limits::Overflow;
use crate::literal::Literal;
use crate::quantise::{self, Prepared, Quantised, TooFine};
use crate::saturation::PerThread;
use crate::settings::RenderSettings;
use crate::tree::{Growth, OwnedBvh8, OwnedCompactBvh8, OwnedOctree};
use octray_core::accel::{BuildError, BuildStats, LinkBy, OctreeVariant};
use octray_core::scalar::{Approx, Fixed, Fixed64};
use octray_scenes::model::Scene;

/// A format of [`crate::Format`], with the functions that prepare scenes in it.
pub trait Prepare: Literal {
    /// [`quantise::quantise`] in this format.
    ///
    /// # Errors
    /// Those of that function.
    fn quantised(scene: &Scene, settings: &RenderSettings) -> Result<Prepared<Self>, Overflow>;

    /// [`quantise::resolution`] in this format.
    ///
    /// # Errors
    /// Those of that function.
    fn resolution(scene: &Scene, settings: &RenderSettings) -> Result<(), TooFine>;

    /// [`OwnedBvh8::build`] in this format.
    fn bvh8(scene: &mut Quantised<Self>, growth: &Growth) -> (OwnedBvh8<Self::Bound>, BuildStats);

    /// [`OwnedCompactBvh8::build`] in this format.
    ///
    /// # Errors
    /// Those of that function.
    fn compact_bvh8(
        scene: &mut Quantised<Self>,
        growth: &Growth,
    ) -> Result<(OwnedCompactBvh8, BuildStats), BuildError>;

    /// [`OwnedOctree::build`] in this format.
    fn octree(
        scene: &mut Quantised<Self>,
        growth: &Growth,
        variant: OctreeVariant,
        link: LinkBy,
    ) -> (OwnedOctree<Self::Bound>, BuildStats);
}

macro_rules! prepare {
    ($($format:ty),*) => {
        $(impl Prepare for $format {
            fn quantised(
                scene: &Scene,
                settings: &RenderSettings,
            ) -> Result<Prepared<Self>, Overflow> {
                quantise::quantise(scene, settings)
            }

            fn resolution(scene: &Scene, settings: &RenderSettings) -> Result<(), TooFine> {
                quantise::resolution::<Self>(scene, settings)
            }

            fn bvh8(
                scene: &mut Quantised<Self>,
                growth: &Growth,
            ) -> (OwnedBvh8<Self::Bound>, BuildStats) {
                OwnedBvh8::build(scene, growth)
            }

            fn compact_bvh8(
                scene: &mut Quantised<Self>,
                growth: &Growth,
            ) -> Result<(OwnedCompactBvh8, BuildStats), BuildError> {
                OwnedCompactBvh8::build(scene, growth)
            }

            fn octree(
                scene: &mut Quantised<Self>,
                growth: &Growth,
                variant: OctreeVariant,
                link: LinkBy,
            ) -> (OwnedOctree<Self::Bound>, BuildStats) {
                OwnedOctree::build(scene, growth, variant, link)
            }
        })*
    };
}

prepare!(
    f64,
    f32,
    Approx<0>,
    Approx<1>,
    Approx<2>,
    Fixed<8, PerThread>,
    Fixed<10, PerThread>,
    Fixed<12, PerThread>,
    Fixed<14, PerThread>,
    Fixed<16, PerThread>,
    Fixed<18, PerThread>,
    Fixed<20, PerThread>,
    Fixed<22, PerThread>,
    Fixed<24, PerThread>,
    Fixed<26, PerThread>,
    Fixed<28, PerThread>,
    Fixed64<PerThread>
);
