//! The counters, and their report.

use octray_instruction::{Class, Kind};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::atomic::{AtomicU64, Ordering};

/// A counter that QEMU, or a callback, increments while the guest runs.
#[derive(Clone, Copy)]
pub(crate) struct Counter {
    now: &'static AtomicU64,
    /// Its value when counting was last resumed.
    start: u64,
    /// The sum over the periods in which counting was on.
    sum: u64,
}

impl Counter {
    fn new() -> Self {
        Self {
            now: Box::leak(Box::default()),
            start: 0,
            sum: 0,
        }
    }
}

/// What a counter counts.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum What {
    /// Instructions of a kind, in a function.
    Executed(String, Kind),
    /// Conditional branches that were taken.
    Taken,
    /// Registers moved by loads and stores of several registers.
    Moved,
}

/// Calls of one function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Calls {
    /// The number of calls.
    pub(crate) count: u64,
    /// Instructions from entry to return, including those of the functions it calls.
    pub(crate) instructions: u64,
}

/// All counters.
pub(crate) struct Counters {
    pub(crate) running: bool,
    by_kind: BTreeMap<What, Counter>,
    /// The instructions of the longest period in which counting was on.
    longest: u64,
    pub(crate) calls: BTreeMap<String, Calls>,
}

impl Counters {
    pub(crate) const fn new() -> Self {
        Self {
            running: false,
            by_kind: BTreeMap::new(),
            longest: 0,
            calls: BTreeMap::new(),
        }
    }

    /// Returns the counter of `what`.
    pub(crate) fn counter(&mut self, what: What) -> &'static AtomicU64 {
        self.by_kind.entry(what).or_insert_with(Counter::new).now
    }

    /// Resumes or pauses counting.
    pub(crate) fn run(&mut self, running: bool) {
        let mut period = 0;
        for (what, counter) in &mut self.by_kind {
            let now = counter.now.load(Ordering::Relaxed);
            if self.running {
                let counted = now - counter.start;
                counter.sum += counted;
                if matches!(what, What::Executed(..)) {
                    period += counted;
                }
            }
            counter.start = now;
        }
        self.longest = self.longest.max(period);
        self.running = running;
    }

    /// Returns all counts, one per line.
    pub(crate) fn report(&self) -> String {
        let mut classes: BTreeMap<Class, u64> = BTreeMap::new();
        let mut kinds: BTreeMap<Kind, u64> = BTreeMap::new();
        let mut functions: BTreeMap<&str, u64> = BTreeMap::new();
        let (mut taken, mut moved) = (0, 0);
        for (what, counter) in &self.by_kind {
            match what {
                What::Executed(function, kind) => {
                    *classes.entry(kind.class()).or_default() += counter.sum;
                    *kinds.entry(*kind).or_default() += counter.sum;
                    *functions.entry(function).or_default() += counter.sum;
                }
                What::Taken => taken = counter.sum,
                What::Moved => moved = counter.sum,
            }
        }
        let mut functions: Vec<_> = functions.into_iter().filter(|(_, n)| *n > 0).collect();
        functions.sort_by_key(|&(name, n)| (std::cmp::Reverse(n), name));
        let mut text = format!("instructions {}\n", classes.values().sum::<u64>());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "longest {}", self.longest);
        for (class, n) in classes {
            let _ = writeln!(text, "class {} {n}", class.name());
        }
        for (kind, n) in kinds {
            let _ = writeln!(text, "kind {} {n}", kind.name());
        }
        let _ = writeln!(text, "taken {taken}\nmoved {moved}");
        for (name, calls) in &self.calls {
            let Calls {
                count,
                instructions,
            } = calls;
            let _ = writeln!(text, "calls {count} {instructions} {name}");
        }
        for (name, n) in functions {
            let _ = writeln!(text, "function {n} {name}");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_instructions_between_resume_and_pause_count() {
        let mut counters = Counters::new();
        let add = counters.counter(What::Executed("f".into(), Kind::Load));
        add.fetch_add(5, Ordering::Relaxed);
        counters.run(true);
        add.fetch_add(7, Ordering::Relaxed);
        counters.run(false);
        add.fetch_add(11, Ordering::Relaxed);
        let report = counters.report();
        assert!(report.contains("instructions 7\nlongest 7\n"), "{report}");
        assert!(report.contains("class load-store 7\nkind load 7\n"));
        assert!(report.contains("function 7 f\n"));
    }

    #[test]
    fn the_longest_period_is_told() {
        let mut counters = Counters::new();
        let add = counters.counter(What::Executed("f".into(), Kind::Load));
        for n in [3, 0, 9, 4] {
            counters.run(true);
            add.fetch_add(n, Ordering::Relaxed);
            counters.run(false);
        }
        let report = counters.report();
        assert!(report.contains("instructions 16\nlongest 9\n"), "{report}");
    }
}
