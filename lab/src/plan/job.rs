//! The job of `octray plan`: a checked command line.

use crate::measure::board::Board;
use serde::Serialize;
use std::path::PathBuf;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Everything that `octray plan` was asked to do.
#[derive(Clone, Debug)]
pub struct PlanJob {
    /// The scene file.
    pub scene: PathBuf,
    /// The target board.
    pub board: &'static Board,
    /// The limits to respect.
    pub limits: PlanLimits,
    /// The arithmetics to consider.
    pub numbers: Numbers,
    /// Columns and rows; the scene's own if `None`.
    pub size: Option<(u32, u32)>,
    /// Whether to build the firmware and measure it.
    pub measure: bool,
    /// Whether to print JSON.
    pub json: bool,
    /// Where to write the plan for `octray bake --plan`.
    pub emit: Option<PathBuf>,
}

/// The limits of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlanLimits {
    /// Bytes of flash.
    pub flash: u64,
    /// Bytes of RAM, including the stack.
    pub ram: u64,
    /// The least distance from the picture in 64-bit floats (PSNR), in dB.
    pub min_psnr: f64,
}

/// The arithmetics to consider.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Numbers {
    /// Either, whichever needs fewer instructions.
    #[default]
    Any,
    /// 32-bit fixed point.
    Fixed,
    /// 32-bit floats.
    F32,
}

/// Returns the bytes of flash and RAM in the firmware's memory layout of a board.
pub fn memory(board: &Board) -> (u64, u64) {
    let flash = match board.machine {
        "virt" => 1 << 20,
        "sifive_e" => 4 << 20,
        _ => 256 << 10,
    };
    (flash, 16 << 10)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::board::BOARDS;
    use crate::measure::source_tree::SourceTree;
    use std::fs;

    #[test]
    fn boards_have_the_memory_of_the_firmwares_layout() {
        let root = SourceTree::root().unwrap();
        for board in &BOARDS {
            let layout = match board.is_arm() {
                true => "cortex-m",
                false => board.machine,
            };
            let path = root
                .join("firmware-sim/link")
                .join(layout)
                .with_extension("x");
            let text = fs::read_to_string(path).unwrap();
            let length = |name: &str| -> u64 {
                let line = text
                    .lines()
                    .find(|line| line.trim().starts_with(name))
                    .unwrap();
                let (_, size) = line.split_once("LENGTH = ").unwrap();
                let (number, unit) = size.split_at(size.len() - 1);
                number.parse::<u64>().unwrap() << if unit == "M" { 20 } else { 10 }
            };
            assert_eq!(memory(board), (length("FLASH"), length("RAM")), "{board}");
        }
    }
}
