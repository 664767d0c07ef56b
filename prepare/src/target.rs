//! What a hit test costs on a target, by the name of its triple, as far as that decides which tree is best.

use crate::format::{Family, Format};

/// Whether 32-bit floats are emulated in integers, on an Arm or RISC-V core for microcontrollers.
pub fn emulates_floats(target: &str) -> bool {
    let extensions = target.strip_prefix("riscv32");
    let extensions = extensions.and_then(|rest| rest.split('-').next());
    match extensions {
        Some(letters) => !letters.contains(['f', 'g']),
        None => target.starts_with("thumb") && !target.ends_with("hf"),
    }
}

/// What it takes to test a ray against an object, compared with a box of the tree, which is tested in
/// short integers everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitTestCost {
    /// A few products.
    Low,
    /// Long products on a core that has none.
    High,
    /// Emulated floats.
    Highest,
}

impl HitTestCost {
    /// In a format on a target. Floating-point units have 32 bits.
    pub fn of(format: Format, target: &str) -> Self {
        let is_float = matches!(format.family(), Family::Float | Family::Approximate);
        let emulated = format == Format::F64 || emulates_floats(target);
        match is_float && emulated {
            true => Self::Highest,
            false if target.starts_with("thumbv6m") => Self::High,
            false => Self::Low,
        }
    }

    /// From how many objects walking a tree costs less than trying every one. Measured.
    pub fn least_objects(self) -> usize {
        match self {
            Self::Low => 8,
            Self::High => 5,
            Self::Highest => 3,
        }
    }

    /// Objects up to which a node of the tree is best not divided. Measured.
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
