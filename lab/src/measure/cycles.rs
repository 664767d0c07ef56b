//! Estimates cycles: instructions by kind, times the cycles of each kind at zero wait states according to the core's
//! manual. If the manual states a range, or the cycles depend on neighbouring instructions, the estimate is a range.

use super::count::Count;
use octray_instruction::Kind;
use serde::Serialize;

/// The least and the largest number of cycles.
type Range = (u64, u64);

/// The cycles of instructions on a core.
#[derive(Debug)]
pub struct CycleTable {
    /// The publication of the numbers.
    pub source: &'static str,
    /// The core whose cycles are used for kinds that `costs` lacks.
    like: Option<&'static CycleTable>,
    /// Cycles of each kind of instructions; of [`Kind::BranchIf`] if it is not taken.
    costs: &'static [(Kind, Range)],
    /// Additional cycles of [`Kind::BranchIf`] if it is taken.
    taken: Range,
    /// Additional cycles per register that [`Kind::Multiple`] or [`Kind::MultipleReturn`] moves.
    moved: Range,
}

/// With a single-cycle multiplier, as in most parts.
pub const CORTEX_M0: CycleTable = CycleTable {
    source: "Arm Cortex-M0 Technical Reference Manual (DDI 0432), table 3-1",
    like: None,
    costs: &[
        (Kind::Load, (2, 2)),
        (Kind::LoadPart, (2, 2)),
        (Kind::Store, (2, 2)),
        (Kind::Multiple, (1, 1)),
        (Kind::MultipleReturn, (4, 4)),
        (Kind::BranchIf, (1, 1)),
        (Kind::Branch, (3, 3)),
        (Kind::Call, (4, 4)),
        (Kind::Indirect, (3, 3)),
        (Kind::Multiply, (1, 1)),
        (Kind::Other, (1, 1)),
    ],
    taken: (2, 2),
    moved: (1, 1),
};

/// A pipeline refill takes 1 to 3 cycles; neighbouring loads and stores of a word overlap.
pub const CORTEX_M3: CycleTable = CycleTable {
    source: "Arm Cortex-M3 Technical Reference Manual (100165), table 3-1",
    like: None,
    costs: &[
        (Kind::Load, (1, 2)),
        (Kind::LoadPart, (1, 2)),
        (Kind::Store, (1, 2)),
        (Kind::Multiple, (1, 1)),
        (Kind::MultipleReturn, (2, 4)),
        (Kind::BranchIf, (1, 1)),
        (Kind::Branch, (2, 4)),
        (Kind::Call, (2, 4)),
        (Kind::Indirect, (2, 4)),
        (Kind::Multiply, (1, 1)),
        (Kind::MultiplyAdd, (2, 2)),
        (Kind::MultiplyLong, (3, 5)),
        (Kind::MultiplyLongAdd, (4, 7)),
        (Kind::Divide, (2, 12)),
        (Kind::Other, (1, 1)),
    ],
    taken: (1, 3),
    moved: (1, 1),
};

/// Like the Cortex-M3, with a faster multiplier and a floating-point unit.
pub const CORTEX_M4: CycleTable = CycleTable {
    source: "Arm Cortex-M4 Technical Reference Manual (100166), tables 3-1 and 7-1",
    like: Some(&CORTEX_M3),
    costs: &[
        (Kind::MultiplyAdd, (1, 1)),
        (Kind::MultiplyLong, (1, 1)),
        (Kind::MultiplyLongAdd, (1, 1)),
        (Kind::Float, (1, 1)),
        (Kind::FloatMultiplyAdd, (3, 3)),
        (Kind::FloatDivide, (14, 14)),
        (Kind::FloatRoot, (14, 14)),
    ],
    taken: (1, 3),
    moved: (1, 1),
};

/// At best one instruction per cycle; at worst every instruction waits for the previous result and every branch is
/// mispredicted.
pub const SIFIVE_E31: CycleTable = CycleTable {
    source: "SiFive FE310-G000 Manual, chapter 3: E31 core",
    like: None,
    costs: &[
        (Kind::Load, (1, 2)),
        (Kind::LoadPart, (1, 3)),
        (Kind::Store, (1, 1)),
        (Kind::BranchIf, (1, 4)),
        (Kind::Branch, (1, 4)),
        (Kind::Call, (1, 4)),
        (Kind::Indirect, (1, 4)),
        (Kind::Multiply, (1, 5)),
        (Kind::MultiplyLong, (1, 5)),
        (Kind::Divide, (1, 33)),
        (Kind::Other, (1, 1)),
    ],
    taken: (0, 0),
    moved: (0, 0),
};

/// An estimate, not a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Estimate {
    /// The lower bound.
    pub least: u64,
    /// The upper bound.
    pub most: u64,
}

impl CycleTable {
    /// Estimates the cycles of a count; `None` if the table lacks one of its kinds.
    pub fn estimate(&self, count: &Count) -> Option<Estimate> {
        let mut sum = Estimate { least: 0, most: 0 };
        let mut add = |(least, most): Range, n: u64| {
            sum.least += least * n;
            sum.most += most * n;
        };
        for (&kind, &n) in count.kinds.iter().filter(|(_, n)| **n > 0) {
            add(self.cost(kind)?, n);
        }
        add(self.taken, count.taken);
        add(self.moved, count.moved);
        Some(sum)
    }

    fn cost(&self, kind: Kind) -> Option<Range> {
        let own = self.costs.iter().find(|(known, _)| *known == kind);
        own.map(|(_, cost)| *cost).or_else(|| self.like?.cost(kind))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(kinds: &[(Kind, u64)], taken: u64, moved: u64) -> Count {
        Count {
            kinds: kinds.iter().copied().collect(),
            taken,
            moved,
            ..Count::default()
        }
    }

    #[test]
    fn the_tables_match_the_manuals() {
        // Three loads, a return that pops r4 and pc, ten branches of which four are taken.
        let kinds = [
            (Kind::Load, 3),
            (Kind::MultipleReturn, 1),
            (Kind::BranchIf, 10),
        ];
        let count = counted(&kinds, 4, 2);
        let cases = [
            (&CORTEX_M0, (3 * 2 + 4 + 2 + 10 + 4 * 2, 30)),
            (&CORTEX_M3, (3 + 2 + 2 + 10 + 4, 3 * 2 + 4 + 2 + 10 + 4 * 3)),
            (&CORTEX_M4, (3 + 2 + 2 + 10 + 4, 3 * 2 + 4 + 2 + 10 + 4 * 3)),
        ];
        for (table, (least, most)) in cases {
            let expected = Some(Estimate { least, most });
            assert_eq!(table.estimate(&count), expected, "{}", table.source);
        }
        let count = counted(&[(Kind::LoadPart, 1), (Kind::Divide, 2)], 0, 0);
        let expected = Some(Estimate { least: 3, most: 69 });
        assert_eq!(SIFIVE_E31.estimate(&count), expected);
    }

    #[test]
    fn m3_and_m4_differ_in_long_products() {
        let count = counted(
            &[(Kind::MultiplyLong, 10), (Kind::MultiplyLongAdd, 10)],
            0,
            0,
        );
        let cycles = |table: &CycleTable| table.estimate(&count).map(|e| (e.least, e.most));
        assert_eq!(cycles(&CORTEX_M3), Some((70, 120)));
        assert_eq!(cycles(&CORTEX_M4), Some((20, 20)));
    }

    #[test]
    fn instructions_that_a_core_lacks_are_not_estimated() {
        let count = counted(&[(Kind::Float, 1)], 0, 0);
        assert_eq!(SIFIVE_E31.estimate(&count), None);
        let count = counted(&[(Kind::Float, 0), (Kind::Other, 1)], 0, 0);
        assert!(SIFIVE_E31.estimate(&count).is_some());
    }

    #[test]
    fn no_range_is_inverted() {
        for table in [&CORTEX_M0, &CORTEX_M3, &CORTEX_M4, &SIFIVE_E31] {
            for (kind, (least, most)) in table.costs {
                assert!(least <= most && *least > 0, "{}: {kind:?}", table.source);
            }
        }
    }
}
