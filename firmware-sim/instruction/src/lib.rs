//! Classifies instructions by their disassembly.

/// A class of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Loads and stores of any registers.
    LoadStore,
    /// Jumps, calls and returns.
    Branch,
    /// Integer multiplication, with or without addition.
    Multiply,
    /// Integer division and remainder.
    Divide,
    /// Instructions of the floating-point unit, except its loads and stores.
    Float,
    /// The rest: moves, additions, shifts, comparisons.
    Other,
}

impl Class {
    /// Returns the class's name.
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
}

/// A kind of instructions, as fine as tables of cycles distinguish them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A load of one word.
    Load,
    /// A load of a byte or a half-word.
    LoadPart,
    /// A store of one word or of part of one.
    Store,
    /// A load or store of several registers.
    Multiple,
    /// A load of several registers that include the program counter: a return.
    MultipleReturn,
    /// A conditional branch.
    BranchIf,
    /// An unconditional branch to a fixed address.
    Branch,
    /// A call of a fixed address.
    Call,
    /// A branch or call to an address in a register or in memory.
    Indirect,
    /// A multiplication of 32 × 32 bits that keeps the lower 32.
    Multiply,
    /// The same with an addition or subtraction.
    MultiplyAdd,
    /// A multiplication of 32 × 32 bits that gives 64, or their upper half.
    MultiplyLong,
    /// The same with an addition.
    MultiplyLongAdd,
    /// Integer division and remainder.
    Divide,
    /// Additions, multiplications, comparisons, conversions and moves of the floating-point unit.
    Float,
    /// Its fused multiply-add.
    FloatMultiplyAdd,
    /// Its division.
    FloatDivide,
    /// Its square root.
    FloatRoot,
    /// The rest.
    Other,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 19] = [
        Self::Load,
        Self::LoadPart,
        Self::Store,
        Self::Multiple,
        Self::MultipleReturn,
        Self::BranchIf,
        Self::Branch,
        Self::Call,
        Self::Indirect,
        Self::Multiply,
        Self::MultiplyAdd,
        Self::MultiplyLong,
        Self::MultiplyLongAdd,
        Self::Divide,
        Self::Float,
        Self::FloatMultiplyAdd,
        Self::FloatDivide,
        Self::FloatRoot,
        Self::Other,
    ];

    /// Returns the kind of a [name](Self::name).
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Returns the kind's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::LoadPart => "load-part",
            Self::Store => "store",
            Self::Multiple => "multiple",
            Self::MultipleReturn => "multiple-return",
            Self::BranchIf => "branch-if",
            Self::Branch => "branch",
            Self::Call => "call",
            Self::Indirect => "indirect",
            Self::Multiply => "multiply",
            Self::MultiplyAdd => "multiply-add",
            Self::MultiplyLong => "multiply-long",
            Self::MultiplyLongAdd => "multiply-long-add",
            Self::Divide => "divide",
            Self::Float => "float",
            Self::FloatMultiplyAdd => "float-multiply-add",
            Self::FloatDivide => "float-divide",
            Self::FloatRoot => "float-root",
            Self::Other => "other",
        }
    }

    /// Returns the class of the kind.
    pub fn class(self) -> Class {
        match self {
            Self::Load | Self::LoadPart | Self::Store => Class::LoadStore,
            Self::Multiple | Self::MultipleReturn => Class::LoadStore,
            Self::BranchIf | Self::Branch | Self::Call | Self::Indirect => Class::Branch,
            Self::Multiply | Self::MultiplyAdd => Class::Multiply,
            Self::MultiplyLong | Self::MultiplyLongAdd => Class::Multiply,
            Self::Divide => Class::Divide,
            Self::Float | Self::FloatMultiplyAdd => Class::Float,
            Self::FloatDivide | Self::FloatRoot => Class::Float,
            Self::Other => Class::Other,
        }
    }

    /// Returns the kind of an instruction of Arm or RISC-V from its disassembly.
    pub fn of(disassembly: &str) -> Self {
        let (name, operands) = words(disassembly);
        let first = operands.split(',').next().unwrap_or_default().trim();
        let starts = |prefixes: &[&str]| prefixes.iter().any(|p| name.starts_with(p));
        let is = |names: &[&str]| names.contains(&name);
        if starts(&["ldrd", "strd", "ldm", "stm", "push", "pop"])
            || starts(&["vldm", "vstm", "vpush", "vpop"])
        {
            match registers(operands).contains(&"pc") {
                true => Self::MultipleReturn,
                false => Self::Multiple,
            }
        } else if starts(&["ldr"]) && first == "pc" {
            Self::Indirect
        } else if starts(&["ldrb", "ldrh", "ldrs"]) || is(&["lb", "lbu", "lh", "lhu"]) {
            Self::LoadPart
        } else if starts(&["ldr", "vldr", "lr"]) || is(&["lw", "flw", "lwsp", "flwsp"]) {
            Self::Load
        } else if starts(&["str", "vstr", "sc", "amo"])
            || is(&["sb", "sh", "sw", "fsw", "swsp", "fswsp"])
        {
            Self::Store
        } else if starts(&["umull", "smull", "mulh", "smmul"]) {
            Self::MultiplyLong
        } else if starts(&["umlal", "smlal", "umaal", "smmla"]) {
            Self::MultiplyLongAdd
        } else if starts(&["mla", "mls", "smla"]) {
            Self::MultiplyAdd
        } else if starts(&["mul", "smul"]) {
            Self::Multiply
        } else if starts(&["udiv", "sdiv", "div", "rem"]) {
            Self::Divide
        } else if starts(&["vdiv", "fdiv"]) {
            Self::FloatDivide
        } else if starts(&["vsqrt", "fsqrt"]) {
            Self::FloatRoot
        } else if starts(&["vmla", "vmls", "vnml", "vfma", "vfms", "vfnm"])
            || starts(&["fmadd", "fmsub", "fnmadd", "fnmsub"])
        {
            Self::FloatMultiplyAdd
        } else if starts(&["v", "f"]) && !starts(&["fence"]) {
            Self::Float
        } else if starts(&["bx", "blx", "jr", "jalr", "ret", "tb", "mret"])
            || (starts(&["mov", "add"]) && first == "pc")
        {
            Self::Indirect
        } else if is(&["bl", "jal", "call"]) {
            Self::Call
        } else if is(&["b", "j", "tail"]) {
            Self::Branch
        } else if starts(&["b", "cb"]) && !starts(&["bic", "bfi", "bfc", "bkpt"]) {
            Self::BranchIf
        } else {
            Self::Other
        }
    }
}

/// Returns how many registers a disassembled load or store of several registers moves.
pub fn moved(disassembly: &str) -> u64 {
    let (name, operands) = words(disassembly);
    match name {
        _ if name.starts_with("ldrd") || name.starts_with("strd") => 2,
        _ => registers(operands).len() as u64,
    }
}

/// Splits a disassembly into the mnemonic, without its suffix after a point, and the operands.
fn words(disassembly: &str) -> (&str, &str) {
    // RISC-V's disassembly begins with the encoding, in four or eight hexadecimal digits.
    let text = disassembly.trim();
    let text = match text.split_once(char::is_whitespace) {
        Some((word, rest))
            if matches!(word.len(), 4 | 8) && word.bytes().all(|b| b.is_ascii_hexdigit()) =>
        {
            rest.trim_start()
        }
        _ => text,
    };
    let (mnemonic, operands) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let name = mnemonic.strip_prefix("c.").unwrap_or(mnemonic);
    (name.split('.').next().unwrap_or_default(), operands.trim())
}

/// Returns the registers between braces.
fn registers(operands: &str) -> Vec<&str> {
    let inside = operands
        .split_once('{')
        .and_then(|(_, rest)| rest.split_once('}'));
    inside.map_or(Vec::new(), |(list, _)| {
        list.split(',').map(str::trim).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mnemonics_have_their_kind_and_class() {
        let cases = [
            ("ldr r0, [r1]", Kind::Load, Class::LoadStore),
            ("ldrb.w r0, [r1, #3]", Kind::LoadPart, Class::LoadStore),
            ("ldr pc, [r1]", Kind::Indirect, Class::Branch),
            ("strh r0, [r1]", Kind::Store, Class::LoadStore),
            ("push {r4, lr}", Kind::Multiple, Class::LoadStore),
            ("pop.w {r4, r8, pc}", Kind::MultipleReturn, Class::LoadStore),
            ("vldr s0, [r1]", Kind::Load, Class::LoadStore),
            ("vpush {d8, d9}", Kind::Multiple, Class::LoadStore),
            ("40b2      lw      ra,12(sp)", Kind::Load, Class::LoadStore),
            ("beq #0x12", Kind::BranchIf, Class::Branch),
            ("b.w #0x12", Kind::Branch, Class::Branch),
            ("bl #0x12", Kind::Call, Class::Branch),
            ("bx lr", Kind::Indirect, Class::Branch),
            ("bics r0, r1", Kind::Other, Class::Other),
            ("cbz r0, #4", Kind::BranchIf, Class::Branch),
            ("mov pc, r3", Kind::Indirect, Class::Branch),
            ("mov r3, r4", Kind::Other, Class::Other),
            ("jalr ra,ra,0", Kind::Indirect, Class::Branch),
            ("bltu a0,a1,8", Kind::BranchIf, Class::Branch),
            ("muls r0, r1, r0", Kind::Multiply, Class::Multiply),
            ("mls r0, r1, r2, r3", Kind::MultiplyAdd, Class::Multiply),
            (
                "smlal r0, r1, r2, r3",
                Kind::MultiplyLongAdd,
                Class::Multiply,
            ),
            ("mulhu a0,a1,a2", Kind::MultiplyLong, Class::Multiply),
            ("udiv r0, r1, r2", Kind::Divide, Class::Divide),
            ("vadd.f32 s0, s1, s2", Kind::Float, Class::Float),
            ("vsqrt.f32 s0, s0", Kind::FloatRoot, Class::Float),
            ("fmul.s fa0,fa1,fa2", Kind::Float, Class::Float),
            ("fdiv.s fa0,fa1,fa2", Kind::FloatDivide, Class::Float),
            ("adds r0, r1", Kind::Other, Class::Other),
            ("slli a0,a0,2", Kind::Other, Class::Other),
        ];
        for (text, kind, class) in cases {
            assert_eq!(Kind::of(text), kind, "{text}");
            assert_eq!(kind.class(), class, "{text}");
        }
    }

    #[test]
    fn moved_registers_are_counted() {
        assert_eq!(moved("push {r4, r5, lr}"), 3);
        assert_eq!(moved("ldm.w r0!, {r1}"), 1);
        assert_eq!(moved("ldrd r0, r1, [r2]"), 2);
        assert_eq!(moved("adds r0, r1"), 0);
    }
}
