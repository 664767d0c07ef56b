//! Instructions by what they do, told by the mnemonic.

/// A class of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Between memory and any register.
    LoadStore,
    /// Jumps, calls and returns.
    Branch,
    /// Integer multiplication, with or without addition.
    Multiply,
    /// Integer division and remainder.
    Divide,
    /// Floating-point unit, but for its loads and stores.
    Float,
    /// The rest: moves, sums, shifts, comparisons.
    Other,
}

impl Class {
    /// The class's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::LoadStore => "load-store",
            Self::Branch => "branch",
            Self::Multiply => "multiply",
            Self::Divide => "divide",
            Self::Float => "float",
            Self::Other => "other",
        }
    }

    /// Of an instruction of Arm or RISC-V, disassembled.
    pub fn of(disassembly: &str) -> Self {
        // RISC-V's begins with the encoding, in four or eight hexadecimal digits.
        let encoding = |word: &&str| {
            matches!(word.len(), 4 | 8) && word.bytes().all(|b| b.is_ascii_hexdigit())
        };
        let mut words = disassembly.split_whitespace();
        let mnemonic = words.find(|word| !encoding(word)).unwrap_or_default();
        let name = mnemonic.strip_prefix("c.").unwrap_or(mnemonic);
        let name = name.split('.').next().unwrap_or_default();
        let starts = |prefixes: &[&str]| prefixes.iter().any(|p| name.starts_with(p));
        let is = |names: &[&str]| names.contains(&name);
        if starts(&[
            "ldr", "str", "ldm", "stm", "ldrd", "push", "pop", "vldr", "vstr", "vldm",
        ]) || starts(&["vstm", "vpush", "vpop", "lr", "sc", "amo"])
            || is(&[
                "lb", "lbu", "lh", "lhu", "lw", "sb", "sh", "sw", "flw", "fsw", "lwsp", "swsp",
                "flwsp", "fswsp",
            ])
        {
            Self::LoadStore
        } else if starts(&[
            "mul", "mla", "mls", "smul", "umul", "smla", "umla", "smmul", "smmla",
        ]) || starts(&["umaal", "smull"])
        {
            Self::Multiply
        } else if starts(&["udiv", "sdiv", "div", "rem"]) {
            Self::Divide
        } else if starts(&["v", "f"]) && !starts(&["fence"]) {
            Self::Float
        } else if starts(&["b", "cb", "j", "tb", "ret", "call", "tail", "mret"])
            && !starts(&["bic", "bfi", "bfc", "bkpt"])
        {
            Self::Branch
        } else {
            Self::Other
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Class;

    #[test]
    fn mnemonics_have_their_class() {
        let cases = [
            ("ldr r0, [r1]", Class::LoadStore),
            ("push {r4, lr}", Class::LoadStore),
            ("vldr s0, [r1]", Class::LoadStore),
            (
                "40b2              lw              ra,12(sp)",
                Class::LoadStore,
            ),
            ("beq #0x12", Class::Branch),
            ("bics r0, r1", Class::Other),
            ("cbz r0, #4", Class::Branch),
            ("jalr ra,ra,0", Class::Branch),
            ("smlal r0, r1, r2, r3", Class::Multiply),
            ("mulhu a0,a1,a2", Class::Multiply),
            ("udiv r0, r1, r2", Class::Divide),
            ("vadd.f32 s0, s1, s2", Class::Float),
            ("fmul.s fa0,fa1,fa2", Class::Float),
            ("adds r0, r1", Class::Other),
            ("slli a0,a0,2", Class::Other),
        ];
        for (text, class) in cases {
            assert_eq!(Class::of(text), class, "{text}");
        }
    }
}
