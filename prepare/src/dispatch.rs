//! Converts the name of a format into its type.

use crate::format::{Arith, Format};
use crate::limits::limits;
use crate::prepare::Prepare;
use crate::saturation::PerThread;
use octray_core::scalar::{Approx, Fixed, Fixed64};
use octray_scenes::model::Scene;

/// A task that runs in a format chosen at run time.
pub trait InFormat {
    /// The result.
    type Output;

    /// Runs the task in format `S`.
    fn run<S: Prepare>(self) -> Self::Output;
}

impl Format {
    /// Runs a task in this format. This is the only place where names become types.
    pub fn dispatch<T: InFormat>(self, task: T) -> T::Output {
        match self {
            Self::F64 => task.run::<f64>(),
            Self::F32 => task.run::<f32>(),
            Self::Approx0 => task.run::<Approx<0>>(),
            Self::Approx1 => task.run::<Approx<1>>(),
            Self::Approx2 => task.run::<Approx<2>>(),
            Self::I24F8 => task.run::<Fixed<8, PerThread>>(),
            Self::I22F10 => task.run::<Fixed<10, PerThread>>(),
            Self::I20F12 => task.run::<Fixed<12, PerThread>>(),
            Self::I18F14 => task.run::<Fixed<14, PerThread>>(),
            Self::I16F16 => task.run::<Fixed<16, PerThread>>(),
            Self::I14F18 => task.run::<Fixed<18, PerThread>>(),
            Self::I12F20 => task.run::<Fixed<20, PerThread>>(),
            Self::I10F22 => task.run::<Fixed<22, PerThread>>(),
            Self::I8F24 => task.run::<Fixed<24, PerThread>>(),
            Self::I6F26 => task.run::<Fixed<26, PerThread>>(),
            Self::I4F28 => task.run::<Fixed<28, PerThread>>(),
            Self::I32F32 => task.run::<Fixed64<PerThread>>(),
        }
    }

    /// Returns the number of fraction bits of a fixed-point format.
    pub fn fraction_bits(self) -> Option<u32> {
        struct Bits;
        impl InFormat for Bits {
            type Output = Option<u32>;
            fn run<S: Prepare>(self) -> Option<u32> {
                S::FRACTION_BITS
            }
        }
        self.dispatch(Bits)
    }
}

impl Arith {
    /// Returns the format in which a scene is traced with at most `max_depth` bounces. For [`Arith::Auto`] it is the
    /// finest format of [`Format::AUTOMATIC`] that the scene cannot overflow, or the last one if every format could
    /// overflow.
    pub fn format(self, scene: &Scene, max_depth: u32) -> Format {
        struct Fits<'a>(&'a Scene, u32);
        impl InFormat for Fits<'_> {
            type Output = bool;
            fn run<S: Prepare>(self) -> bool {
                limits::<S>(self.0, self.1).is_ok()
            }
        }
        match self {
            Self::In(format) => format,
            Self::Auto => (Format::AUTOMATIC.into_iter())
                .find(|format| format.dispatch(Fits(scene, max_depth)))
                .unwrap_or(Format::I24F8),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Choice;
    use strum::VariantArray;

    #[test]
    fn a_format_has_the_name_of_its_type() {
        struct Name;
        impl InFormat for Name {
            type Output = &'static str;
            fn run<S: Prepare>(self) -> &'static str {
                S::NAME
            }
        }
        for format in Format::VARIANTS {
            assert_eq!(format.dispatch(Name), format.name());
            assert_eq!(Arith::named(format.name()), Some(Arith::In(*format)));
            assert!(!format.help().is_empty());
        }
    }

    #[test]
    fn auto_is_the_finest_format_that_a_scene_cannot_overflow() {
        for (light, finest) in [
            ("1", Format::I4F28),
            ("100", Format::I8F24),
            ("1e3", Format::I12F20),
            ("1e4", Format::I16F16),
            ("1e5", Format::I20F12),
            ("1e6", Format::I24F8),
            ("1e9", Format::I24F8),
        ] {
            let scene = octray_scenes::parse(&format!("v 0 0 9 l 0 0 9 {light}")).unwrap();
            assert_eq!(Arith::Auto.format(&scene, 8), finest, "{light}");
        }
    }
}
