//! What a target's core is good at, as far as it decides which tree is best; told by the target's name.

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
pub enum Test {
    /// A few products.
    Cheap,
    /// Long products on a core that has none.
    Dear,
    /// Emulated floats.
    Dearest,
}

impl Test {
    /// In an arithmetic (see [`FORMATS`](crate::bake::FORMATS)) on a target. Units for floats have 32 bits.
    pub fn of(arith: &str, target: &str) -> Self {
        let is_float = arith.starts_with('f') || arith.starts_with("approx");
        let emulated = arith == "f64" || emulates_floats(target);
        match is_float && emulated {
            true => Self::Dearest,
            false if target.starts_with("thumbv6m") => Self::Dear,
            false => Self::Cheap,
        }
    }

    /// From how many objects walking a tree costs less than trying every one. Measured.
    pub fn least_objects(self) -> usize {
        match self {
            Self::Cheap => 8,
            Self::Dear => 5,
            Self::Dearest => 3,
        }
    }

    /// Objects up to which a node of the tree is best not divided. Measured.
    pub fn leaf_size(self) -> u32 {
        match self {
            Self::Cheap => 2,
            Self::Dear | Self::Dearest => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_are_dear_where_the_core_has_no_instructions_for_them() {
        for (target, fixed, f32, f64) in [
            (
                "thumbv6m-none-eabi",
                Test::Dear,
                Test::Dearest,
                Test::Dearest,
            ),
            (
                "thumbv7m-none-eabi",
                Test::Cheap,
                Test::Dearest,
                Test::Dearest,
            ),
            (
                "thumbv7em-none-eabihf",
                Test::Cheap,
                Test::Cheap,
                Test::Dearest,
            ),
            (
                "riscv32imac-unknown-none-elf",
                Test::Cheap,
                Test::Dearest,
                Test::Dearest,
            ),
            (
                "riscv32imafc-unknown-none-elf",
                Test::Cheap,
                Test::Cheap,
                Test::Dearest,
            ),
        ] {
            let of = |arith| Test::of(arith, target);
            assert_eq!([of("auto"), of("i16f16")], [fixed; 2], "{target}");
            assert_eq!([of("f32"), of("approx2")], [f32; 2], "{target}");
            assert_eq!(of("f64"), f64, "{target}");
        }
    }
}
