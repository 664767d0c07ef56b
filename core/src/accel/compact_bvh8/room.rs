//! The stack of the compact tree's walk: how much room it takes.

use super::node::{CHILD, HEADER, LEAF};
use crate::accel::build::MAX_DEPTH;
use crate::object::ObjectRef;
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

/// A stack with too little room for a tree, or a tree that no builder has made: its walk might have no end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct StackTooSmall {
    /// The room that the tree's walk needs; [`usize::MAX`] if its words or links are corrupt.
    pub needed: usize,
}

impl Display for StackTooSmall {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.needed {
            usize::MAX => f.write_str("the tree's words are corrupt: its walk might have no end"),
            needed => write!(f, "the tree's walk needs a stack of {needed} entries"),
        }
    }
}

impl core::error::Error for StackTooSmall {}

/// The most nodes and leaves that can wait while a tree is walked; [`usize::MAX`] if it is corrupt.
pub(super) const fn required(words: &[u32], links: &[ObjectRef]) -> usize {
    if words.is_empty() {
        return 0;
    }
    // The last leaf ends with the list.
    if let [.., last] = links
        && !last.is_last()
    {
        return usize::MAX;
    }
    let mut nodes = words.len() / HEADER;
    below(words, links, 0, COMPACT_MAX_DEPTH, &mut nodes)
}

/// The same below a node: all its children, or all but one while that one is walked. There is no
/// bound for a node deeper than any that is built, or cut short, or whose children are elsewhere
/// than behind it and in the lists; nor if more than so many nodes are met, each by one way.
const fn below(
    words: &[u32],
    links: &[ObjectRef],
    at: usize,
    levels: u32,
    nodes: &mut usize,
) -> usize {
    if levels == 0 || *nodes == 0 || at + HEADER > words.len() {
        return usize::MAX;
    }
    *nodes -= 1;
    let count = (words[at + 1] >> 28) as usize;
    let end = at + HEADER + count * CHILD;
    if end > words.len() {
        return usize::MAX;
    }
    let mut most = 1;
    let mut child = at + HEADER;
    while child < end {
        let place = words[child] >> 24 | words[child + 1] >> 24 << 8;
        if place & LEAF != 0 {
            if (place & !LEAF) as usize >= links.len() {
                return usize::MAX;
            }
        } else {
            let next = place as usize * CHILD;
            if next <= at {
                return usize::MAX;
            }
            let inner = below(words, links, next, levels - 1, nodes);
            if inner == usize::MAX {
                return usize::MAX;
            }
            if inner > most {
                most = inner;
            }
        }
        child += CHILD;
    }
    count + most - 1
}
