//! Reads the report of the emulator's plugin.

use octray_instruction::Kind;
use std::collections::BTreeMap;

/// Calls of a watched function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Calls {
    /// The function's path.
    pub function: String,
    /// The number of calls.
    pub count: u64,
    /// Instructions from entry to return, of all calls.
    pub instructions: u64,
}

/// Instructions of a frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// All instructions.
    pub instructions: u64,
    /// Those of the longest period between the marks: the dearest strip of a frame.
    pub longest: u64,
    /// By class.
    pub classes: BTreeMap<String, u64>,
    /// By kind.
    pub kinds: BTreeMap<Kind, u64>,
    /// Taken conditional branches.
    pub taken: u64,
    /// Registers moved by loads and stores of several registers.
    pub moved: u64,
    /// Calls of watched functions.
    pub calls: Vec<Calls>,
    /// Each function's own instructions, the most expensive first.
    pub functions: Vec<(String, u64)>,
}

impl Count {
    /// Parses the plugin's report; `None` if it is not one.
    pub fn parse(report: &str) -> Option<Self> {
        let mut count = Self::default();
        for line in report.lines() {
            let (what, rest) = line.split_once(' ')?;
            match what {
                "instructions" => count.instructions = rest.parse().ok()?,
                "longest" => count.longest = rest.parse().ok()?,
                "taken" => count.taken = rest.parse().ok()?,
                "moved" => count.moved = rest.parse().ok()?,
                "class" => {
                    let (name, n) = rest.split_once(' ')?;
                    count.classes.insert(name.into(), n.parse().ok()?);
                }
                "kind" => {
                    let (name, n) = rest.split_once(' ')?;
                    count.kinds.insert(Kind::named(name)?, n.parse().ok()?);
                }
                "calls" => {
                    let (calls, rest) = rest.split_once(' ')?;
                    let (instructions, function) = rest.split_once(' ')?;
                    count.calls.push(Calls {
                        function: function.into(),
                        count: calls.parse().ok()?,
                        instructions: instructions.parse().ok()?,
                    });
                }
                "function" => {
                    let (n, name) = rest.split_once(' ')?;
                    count.functions.push((name.into(), n.parse().ok()?));
                }
                _ => return None,
            }
        }
        (count.instructions > 0 || count.calls.iter().any(|c| c.count > 0)).then_some(count)
    }

    /// Returns the instructions of a class, by its name.
    pub fn class(&self, name: &str) -> u64 {
        self.classes.get(name).copied().unwrap_or(0)
    }

    /// Returns the instructions of functions for whose name `name` is true.
    pub fn in_functions(&self, name: impl Fn(&str) -> bool) -> u64 {
        (self.functions.iter())
            .filter(|(function, _)| name(function))
            .map(|(_, n)| n)
            .sum()
    }

    /// Returns the calls and instructions of all watched functions of one name.
    pub fn calls_of(&self, name: &str) -> (u64, u64) {
        let of_name = |calls: &&Calls| calls.function.rsplit("::").next() == Some(name);
        (self.calls.iter().filter(of_name))
            .fold((0, 0), |(n, m), c| (n + c.count, m + c.instructions))
    }
}

/// Returns whether a function belongs to the library that emulates floating point.
pub fn is_float_library(function: &str) -> bool {
    const PATHS: [&str; 3] = ["compiler_builtins::float::", "libm::", "soft_float::"];
    // Arm's run-time ABI: f is float, c compares; i, u and l are integers.
    const ARM: [&str; 7] = ["f", "cf", "d", "i2", "ui2", "l2", "ul2"];
    if PATHS.iter().any(|path| function.contains(path)) {
        return true;
    }
    if ["fminf", "fmaxf", "sqrtf"].contains(&function) {
        return true;
    }
    match function.strip_prefix("__aeabi_") {
        Some(rest) => ARM.iter().any(|start| rest.starts_with(start)),
        // GCC's names: sf is single, df double precision.
        None => function.starts_with("__") && (function.contains("sf") || function.contains("df")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REPORT: &str = "instructions 10\nclass branch 3\nclass other 7\nkind branch-if 3\n\
        kind other 7\ntaken 2\nmoved 0\ncalls 2 8 <A as B<C>>::nearest\n\
        function 6 <A as B<C>>::nearest\nfunction 4 __addsf3\n";

    #[test]
    fn a_report_is_read_back() {
        let count = Count::parse(REPORT).unwrap();
        assert_eq!(count.instructions, 10);
        assert_eq!((count.class("branch"), count.class("float")), (3, 0));
        assert_eq!(count.kinds[&Kind::BranchIf], 3);
        assert_eq!((count.taken, count.moved), (2, 0));
        assert_eq!(count.calls_of("nearest"), (2, 8));
        assert_eq!(count.calls_of("any_hit"), (0, 0));
        assert_eq!(count.in_functions(is_float_library), 4);
    }

    #[test]
    fn incomplete_reports_and_unknown_kinds_are_refused() {
        let wrong = [
            "",
            "instructions",
            "instructions x",
            "kind blob 3",
            "blob 3",
            "instructions 0",
        ];
        for text in wrong {
            assert_eq!(Count::parse(text), None, "{text}");
        }
    }

    #[test]
    fn the_float_library_is_recognised_by_name() {
        let cases = [
            ("compiler_builtins::float::mul::__mulsf3", true),
            ("__aeabi_fadd", true),
            ("__aeabi_i2f", true),
            ("__fixsfsi", true),
            ("libm::math::sqrt::sqrtf", true),
            ("__aeabi_lmul", false),
            ("__aeabi_uidiv", false),
            ("__aeabi_memcpy4", false),
            ("__clzsi2", false),
            ("__udivsi3", false),
            ("octray_core::scalar::float::unit", false),
        ];
        for (name, expected) in cases {
            assert_eq!(is_float_library(name), expected, "{name}");
        }
    }
}
