//! The cost of a hit test on a target, derived from its triple, because it decides which tree is best.

use crate::format::{Family, Format};

/// Returns whether the target is an Arm or RISC-V microcontroller core that emulates 32-bit floats in integers.
pub fn emulates_floats(target: &str) -> bool {
    let extensions = target.strip_prefix("riscv32");
    let extensions = extensions.and_then(|rest| rest.split('-').next());
    match extensions {
        Some(letters) => !letters.contains(['f', 'g']),
        None => target.starts_with("thumb") && !target.ends_with("hf"),
    }
}

/// The cost of testing a ray against an object, relative to a box of the tree, whose test uses short integers on every
/// target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitTestCost {
    /// A few multiplications.
    Low,
    /// Long multiplications on a core without an instruction for them.
    High,
    /// Emulated floats.
    Highest,
}

impl HitTestCost {
    /// Returns the cost in a format on a target. Floating-point units are assumed to have 32 bits.
    pub fn of(format: Format, target: &str) -> Self {
        let is_float = matches!(format.family(), Family::Float | Family::Approximate);
        let emulated = format == Format::F64 || emulates_floats(target);
        match is_float && emulated {
            true => Self::Highest,
            false if target.starts_with("thumbv6m") => Self::High,
            false => Self::Low,
        }
    }

    /// Returns the number of objects from which a tree is cheaper than testing every object. Measured.
    pub fn least_objects(self) -> usize {
        match self {
            Self::Low => 8,
            Self::High => 5,
            Self::Highest => 3,
        }
    }

    /// Returns the best leaf size: nodes of up to this many objects are not divided. Measured.
    pub fn leaf_size(self) -> u32 {
        match self {
            Self::Low => 2,
            Self::High | Self::Highest => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hit_tests_are_expensive_where_the_core_has_no_instructions_for_them() {
        for (target, fixed, f32, f64) in [
            (
                "thumbv6m-none-eabi",
                HitTestCost::High,
                HitTestCost::Highest,
                HitTestCost::Highest,
            ),
            (
                "thumbv7m-none-eabi",
                HitTestCost::Low,
                HitTestCost::Highest,
                HitTestCost::Highest,
            ),
            (
                "thumbv7em-none-eabihf",
                HitTestCost::Low,
                HitTestCost::Low,
                HitTestCost::Highest,
            ),
            (
                "riscv32imac-unknown-none-elf",
                HitTestCost::Low,
                HitTestCost::Highest,
                HitTestCost::Highest,
            ),
            (
                "riscv32imafc-unknown-none-elf",
                HitTestCost::Low,
                HitTestCost::Low,
                HitTestCost::Highest,
            ),
        ] {
            let of = |format| HitTestCost::of(format, target);
            assert_eq!(
                [of(Format::I18F14), of(Format::I32F32)],
                [fixed; 2],
                "{target}"
            );
            assert_eq!([of(Format::F32), of(Format::Approx2)], [f32; 2], "{target}");
            assert_eq!(of(Format::F64), f64, "{target}");
        }
    }
}
