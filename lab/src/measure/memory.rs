//! Reads the size of a program's memory from its file.

use object::elf::SHF_ALLOC;
use object::{Object, ObjectSection, SectionFlags};

/// Bytes of a program's memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Memory {
    /// Code, constants, and initial values of variables.
    pub flash: u64,
    /// Variables.
    pub ram: u64,
}

impl Memory {
    /// Returns the memory of an ELF file.
    ///
    /// # Errors
    /// If it is not one.
    pub fn of(file: &[u8]) -> Result<Self, object::Error> {
        let elf = object::File::parse(file)?;
        let mut memory = Self::default();
        for section in elf.sections() {
            let SectionFlags::Elf { sh_flags, .. } = section.flags() else {
                continue;
            };
            if (sh_flags & SHF_ALLOC).0 == 0 {
                continue;
            }
            let (name, size) = (section.name()?, section.size());
            let is = |starts: &[&str]| starts.iter().any(|start| name.starts_with(start));
            let loaded = !is(&[".bss", ".uninit", ".heap", ".stack"]);
            memory.flash += if loaded { size } else { 0 };
            memory.ram += if is(&[".data", ".bss", ".uninit"]) {
                size
            } else {
                0
            };
        }
        Ok(memory)
    }
}
