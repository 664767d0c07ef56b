//! The stack of the compact tree's walk: how much room it takes.

use super::node::{CHILD, HEADER, LEAF};
use crate::accel::build::MAX_DEPTH;
use core::fmt::{self, Display, Formatter};

/// Room of a [`CompactStack`] that does for any tree.
pub const COMPACT_STACK_SIZE: usize = 64;
/// The deepest compact tree, whose walk fits it: every level leaves seven behind. Depth beyond it is
/// cut off when the tree is built.
pub const COMPACT_MAX_DEPTH: u32 = (COMPACT_STACK_SIZE as u32 - 8) / 7;
const _: () = assert!(COMPACT_MAX_DEPTH <= MAX_DEPTH);

/// The nodes and leaves that wait while a compact tree is walked: the ticks at which each is
/// entered in the upper half, its place in the lower one, so that the nearer is the smaller.
#[derive(Clone, Copy, Debug)]
pub struct CompactStack<const ROOM: usize = COMPACT_STACK_SIZE>(pub(super) [u32; ROOM]);

impl<const ROOM: usize> Default for CompactStack<ROOM> {
    fn default() -> Self {
        Self([0; ROOM])
    }
}

/// A stack with too little room for a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct StackTooSmall {
    /// The room that the tree's walk needs.
    pub needed: usize,
}

impl Display for StackTooSmall {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the tree's walk needs a stack of {} entries",
            self.needed
        )
    }
}

impl core::error::Error for StackTooSmall {}

/// The most nodes and leaves that can wait while a tree is walked.
pub(super) const fn required(words: &[u32]) -> usize {
    below(words, 0, COMPACT_MAX_DEPTH)
}

/// The same below a node: all its children, or all but one while that one is walked. A node deeper
/// than any that is built has no bound.
const fn below(words: &[u32], at: usize, levels: u32) -> usize {
    if at + HEADER > words.len() {
        return 0;
    }
    if levels == 0 {
        return usize::MAX;
    }
    let count = (words[at + 1] >> 28) as usize;
    let mut most = 1;
    let mut child = at + HEADER;
    while child < at + HEADER + count * CHILD && child + CHILD <= words.len() {
        let place = words[child] >> 24 | words[child + 1] >> 24 << 8;
        if place & LEAF == 0 {
            let inner = below(words, place as usize * CHILD, levels - 1);
            if inner > most {
                most = inner;
            }
        }
        child += CHILD;
    }
    count.saturating_add(most) - 1
}
