//! The boards on which firmware is measured, and checks that they can be emulated on this machine.

use super::cycles::{self, CycleTable};
use octray_render::error::Error;
use serde::{Serialize, Serializer};
use std::fmt;
use std::path::Path;
use std::process::{Command, Stdio};

/// A board that QEMU emulates.
#[derive(Debug)]
pub struct Board {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its target triple in Rust.
    pub target: &'static str,
    /// Its name in QEMU.
    pub machine: &'static str,
    /// Its core.
    pub core: &'static str,
    /// Whether its programs use a floating-point unit.
    pub fpu: bool,
    /// The core's table of cycles, if one was published.
    pub cycles: Option<&'static CycleTable>,
}

/// All boards.
pub const BOARDS: [Board; 8] = [
    Board {
        name: "m0",
        target: "thumbv6m-none-eabi",
        machine: "microbit",
        core: "Cortex-M0",
        fpu: false,
        cycles: Some(&cycles::CORTEX_M0),
    },
    Board {
        name: "m3",
        target: "thumbv7m-none-eabi",
        machine: "lm3s6965evb",
        core: "Cortex-M3",
        fpu: false,
        cycles: Some(&cycles::CORTEX_M3),
    },
    Board {
        name: "m4",
        target: "thumbv7em-none-eabi",
        machine: "mps2-an386",
        core: "Cortex-M4",
        fpu: false,
        cycles: Some(&cycles::CORTEX_M4),
    },
    Board {
        name: "m4f",
        target: "thumbv7em-none-eabihf",
        machine: "mps2-an386",
        core: "Cortex-M4",
        fpu: true,
        cycles: Some(&cycles::CORTEX_M4),
    },
    Board {
        name: "m7f",
        target: "thumbv7em-none-eabihf",
        machine: "mps2-an500",
        core: "Cortex-M7",
        fpu: true,
        cycles: None,
    },
    Board {
        name: "rv32imac",
        target: "riscv32imac-unknown-none-elf",
        machine: "virt",
        core: "RV32IMAC",
        fpu: false,
        cycles: Some(&cycles::SIFIVE_E31),
    },
    Board {
        name: "sifive-e",
        target: "riscv32imac-unknown-none-elf",
        machine: "sifive_e",
        core: "SiFive E31",
        fpu: false,
        cycles: Some(&cycles::SIFIVE_E31),
    },
    Board {
        name: "rv32imafc",
        target: "riscv32imafc-unknown-none-elf",
        machine: "virt",
        core: "RV32IMAFC",
        fpu: true,
        cycles: None,
    },
];

/// Serialises its name.
impl Serialize for Board {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

impl Board {
    /// Returns whether it has an Arm core; otherwise it has a RISC-V core.
    pub fn is_arm(&self) -> bool {
        self.target.starts_with("thumb")
    }

    /// Returns the name of the emulator.
    pub fn emulator(&self) -> &'static str {
        match self.is_arm() {
            true => "qemu-system-arm",
            false => "qemu-system-riscv32",
        }
    }

    fn package(&self) -> &'static str {
        match self.is_arm() {
            true => "qemu-system-arm",
            false => "qemu-system-misc",
        }
    }

    /// Returns instructions to install what building for it and emulating it needs, if it is missing on this machine.
    fn missing(&self, sources: &Path) -> Vec<String> {
        let mut missing = Vec::new();
        if !runs(self.emulator()) {
            let (emulator, package) = (self.emulator(), self.package());
            missing.push(format!(
                "{emulator} is missing: apt-get install {package}, or see https://www.qemu.org/download"
            ));
        }
        let library = Command::new("rustc")
            .current_dir(sources)
            .args(["--print", "target-libdir", "--target", self.target])
            .output();
        match library {
            Err(_) => missing.push("rustc is missing: install Rust from https://rustup.rs".into()),
            Ok(output) if Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir() => {}
            Ok(_) => {
                let target = self.target;
                missing.push(format!(
                    "target {target} is missing: rustup target add {target}"
                ));
            }
        }
        missing
    }
}

impl fmt::Display for Board {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.name, self.machine)
    }
}

fn runs(program: &str) -> bool {
    (Command::new(program).arg("--version"))
        .stdin(Stdio::null())
        .output()
        .is_ok_and(|output| output.status.success())
}

/// Returns the boards that a word on the command line names: one board by its name, or all boards of a target by its
/// triple.
///
/// # Errors
/// If there is none; the message lists the names.
pub fn named(name: &str) -> Result<Vec<&'static Board>, String> {
    let found: Vec<_> = (BOARDS.iter())
        .filter(|board| board.name == name || board.target == name)
        .collect();
    if found.is_empty() {
        let names: Vec<_> = BOARDS.iter().map(|board| board.name).collect();
        return Err(format!(
            "expected one of {}, or a target such as {}",
            names.join(", "),
            BOARDS[0].target
        ));
    }
    Ok(found)
}

/// Checks that programs can be built for all boards, and that all can be emulated.
///
/// # Errors
/// [`Error::Failed`] with everything that is missing, and how to install it.
pub fn require(boards: &[&Board], sources: &Path) -> Result<(), Error> {
    let mut missing: Vec<String> = Vec::new();
    for line in boards.iter().flat_map(|board| board.missing(sources)) {
        if !missing.contains(&line) {
            missing.push(line);
        }
    }
    match &*missing {
        [] => Ok(()),
        lines => Err(Error::Failed(lines.join("\n       "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boards_are_named_by_name_and_by_target() {
        let names = |name| -> Vec<_> { named(name).unwrap().iter().map(|b| b.name).collect() };
        assert_eq!(names("m0"), ["m0"]);
        assert_eq!(names("thumbv7em-none-eabihf"), ["m4f", "m7f"]);
        let text = named("m1").unwrap_err();
        assert!(text.contains("m0, m3, m4, m4f, m7f"), "{text}");
    }

    #[test]
    fn floats_are_emulated_where_there_is_no_unit() {
        for board in &BOARDS {
            let emulated = octray_prepare::target::emulates_floats(board.target);
            assert_eq!(board.fpu, !emulated, "{board}");
        }
    }

    #[test]
    fn no_name_names_two_boards() {
        for (i, board) in BOARDS.iter().enumerate() {
            let others = &BOARDS[i + 1..];
            assert!(others.iter().all(|other| other.name != board.name));
        }
    }
}
