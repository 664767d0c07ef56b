//! The guest's path from block to block: finds taken conditional branches, and the cost of calls of watched functions,
//! including the functions that they call.

use crate::counters::{Calls, Counters};
use std::sync::atomic::{AtomicU64, Ordering};

/// A translated block of instructions.
pub(crate) struct Block {
    /// Its address.
    pub(crate) start: u64,
    /// The address after its last instruction.
    pub(crate) next: u64,
    /// The number of its instructions.
    pub(crate) length: u64,
    /// The counter to increment if the conditional branch at its end is taken.
    pub(crate) taken: Option<&'static AtomicU64>,
    /// The watched function it belongs to.
    pub(crate) watched: Option<String>,
}

/// A call that has not returned.
struct Call {
    function: String,
    /// The address at which its caller continues.
    back: u64,
    /// The number of instructions executed before it.
    before: u64,
}

/// The position of the guest.
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

    /// Records that the guest enters a block. A watched function is called when one of its blocks is reached from
    /// another function, and returns to the address after the block that called it. Calls of watched functions during
    /// such a call are part of its cost.
    pub(crate) fn enter(&mut self, block: &'static Block, counters: &mut Counters) {
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
            let calls: &mut Calls = counters.calls.entry(call.function).or_default();
            calls.count += 1;
            calls.instructions += self.executed - call.before;
        }
        if self.call.is_none()
            && counters.running
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

/// Returns whether a demangled name matches one of the patterns: the last part of the path, or with an asterisk its
/// beginning.
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
    fn a_call_costs_all_instructions_until_its_return() {
        let (mut path, mut counters) = (Path::new(), Counters::new());
        let caller = block(0, 2, None);
        let (callee, inner) = (block(100, 5, Some("f")), block(200, 7, Some("g")));
        let callee_goes_on = block(120, 3, Some("f"));
        let caller_goes_on = block(8, 1, None);
        counters.running = true;
        for _ in 0..2 {
            for block in [caller, callee, inner, callee_goes_on, caller_goes_on] {
                path.enter(block, &mut counters);
            }
        }
        let calls = Calls {
            count: 2,
            instructions: 2 * (5 + 7 + 3),
        };
        assert_eq!(
            counters.calls.into_iter().collect::<Vec<_>>(),
            [("f".to_owned(), calls)]
        );
    }

    #[test]
    fn a_branch_is_taken_if_another_block_than_the_following_one_is_next() {
        let (mut path, mut counters) = (Path::new(), Counters::new());
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
            path.enter(fork, &mut counters);
            path.enter(block(next, 1, None), &mut counters);
        }
        assert_eq!(taken.load(Ordering::Relaxed), 3);
    }

    #[test]
    fn names_are_matched_by_their_last_part() {
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
