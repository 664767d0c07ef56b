//! What to plan: a command line that has been checked.

use crate::measure::board::Board;
use serde::Serialize;
use std::path::PathBuf;
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Everything `octray plan` was asked for.
#[derive(Clone, Debug)]
pub struct PlanJob {
    /// The scene file.
    pub scene: PathBuf,
    /// The board that is to render it.
    pub board: &'static Board,
    /// What it has to keep to.
    pub bounds: Bounds,
    /// The arithmetics that come into question.
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

/// What a plan has to keep to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounds {
    /// Bytes of flash.
    pub flash: u64,
    /// Bytes of RAM, the stack included.
    pub ram: u64,
    /// The least distance from the picture in 64-bit floats, in dB.
    pub min_psnr: f64,
}

/// The arithmetics that come into question.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Numbers {
    /// Whichever takes fewer instructions.
    #[default]
    Any,
    /// 32-bit fixed point.
    Fixed,
    /// 32-bit floats.
    F32,
}

/// Bytes of flash and RAM that the firmware's memory layout has for a board.
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
    use crate::measure::workspace::Workspace;
    use std::fs;

    #[test]
    fn boards_have_the_memory_that_firmware_is_linked_for() {
        let root = Workspace::root().unwrap();
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
