//! The guest's way from block to block: which conditional branches were taken, and what calls of
//! watched functions cost, the functions that they call included.

use crate::tally::{Calls, Tally};
use std::sync::atomic::{AtomicU64, Ordering};

/// A translated block of instructions.
pub(crate) struct Block {
    /// Its address.
    pub(crate) start: u64,
    /// The address behind its last instruction.
    pub(crate) next: u64,
    /// Its instructions.
    pub(crate) length: u64,
    /// Where to add if the conditional branch at its end is taken.
    pub(crate) taken: Option<&'static AtomicU64>,
    /// The watched function it belongs to.
    pub(crate) watched: Option<String>,
}

/// A call that has not returned yet.
struct Call {
    function: String,
    /// The address at which its caller goes on.
    back: u64,
    /// Instructions executed before it.
    before: u64,
}

/// Where the guest is.
pub(crate) struct Path {
    previous: Option<&'static Block>,
    call: Option<Call>,
    executed: u64,
}

impl Path {
    pub(crate) const fn new() -> Self {
        Self {
            previous: None,
            call: None,
            executed: 0,
        }
    }

    /// The guest comes to a block. A watched function has been called where one of its blocks is
    /// reached from elsewhere, and returns behind the block from which it was reached; a watched
    /// function called within is part of the first one's cost.
    pub(crate) fn come(&mut self, block: &'static Block, tally: &mut Tally) {
        let previous = self.previous.replace(block);
        if let Some(Block {
            next,
            taken: Some(taken),
            ..
        }) = previous
            && *next != block.start
        {
            taken.fetch_add(1, Ordering::Relaxed);
        }
        if let Some(call) = self.call.take_if(|call| call.back == block.start) {
            let calls: &mut Calls = tally.calls.entry(call.function).or_default();
            calls.count += 1;
            calls.instructions += self.executed - call.before;
        }
        if self.call.is_none()
            && tally.running
            && let (Some(function), Some(previous)) = (&block.watched, previous)
            && previous.watched.as_ref() != Some(function)
        {
            self.call = Some(Call {
                function: function.clone(),
                back: previous.next,
                before: self.executed,
            });
        }
        self.executed += block.length;
    }
}

/// Whether a demangled name is one of the patterns': the last part of the path, or with an
/// asterisk the beginning of it.
pub(crate) fn watched(name: &str, patterns: &[String]) -> bool {
    let last = name.rsplit("::").next().unwrap_or_default();
    patterns
        .iter()
        .any(|pattern| match pattern.strip_suffix('*') {
            Some(start) => last.starts_with(start),
            None => last == pattern,
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(start: u64, length: u64, watched: Option<&str>) -> &'static Block {
        Box::leak(Box::new(Block {
            start,
            next: start + 4 * length,
            length,
            taken: None,
            watched: watched.map(Into::into),
        }))
    }

    #[test]
    fn a_call_costs_what_happens_until_its_return() {
        let (mut path, mut tally) = (Path::new(), Tally::new());
        let caller = block(0, 2, None);
        let (callee, inner) = (block(100, 5, Some("f")), block(200, 7, Some("g")));
        let callee_goes_on = block(120, 3, Some("f"));
        let caller_goes_on = block(8, 1, None);
        tally.running = true;
        for _ in 0..2 {
            for block in [caller, callee, inner, callee_goes_on, caller_goes_on] {
                path.come(block, &mut tally);
            }
        }
        let calls = Calls {
            count: 2,
            instructions: 2 * (5 + 7 + 3),
        };
        assert_eq!(
            tally.calls.into_iter().collect::<Vec<_>>(),
            [("f".to_owned(), calls)]
        );
    }

    #[test]
    fn a_branch_is_taken_if_the_next_block_is_not_behind_it() {
        let (mut path, mut tally) = (Path::new(), Tally::new());
        let taken: &'static AtomicU64 = Box::leak(Box::default());
        let fork = Box::leak(Box::new(Block {
            taken: Some(taken),
            ..Block {
                start: 0,
                next: 8,
                length: 2,
                taken: None,
                watched: None,
            }
        }));
        for next in [8, 40, 8, 40, 40] {
            path.come(fork, &mut tally);
            path.come(block(next, 1, None), &mut tally);
        }
        assert_eq!(taken.load(Ordering::Relaxed), 3);
    }

    #[test]
    fn names_are_watched_by_their_last_part() {
        let patterns = ["nearest".to_owned(), "kernel_*".to_owned()];
        for (name, expected) in [
            ("<octray_core::accel::CompactBvh8 as A<S>>::nearest", true),
            ("kernel_add", true),
            ("octray_core::nearest_of", false),
            ("octray_core::nearest::f", false),
        ] {
            assert_eq!(watched(name, &patterns), expected, "{name}");
        }
    }
}
