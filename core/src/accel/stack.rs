//! The stack of nodes that wait while a tree of boxes is walked.

use super::bound::BoundScalar;
use super::build::MAX_DEPTH;

/// Room for the nodes that can wait while a [`Bvh8`](super::Bvh8) or an [`Octree`](super::Octree)
/// is walked: every level leaves seven behind, and no tree is deeper than 24 levels.
pub const STACK_SIZE: usize = 256;
const _: () = assert!(7 * (MAX_DEPTH as usize + 1) < STACK_SIZE);

/// The nodes that wait while a tree is walked, with the distance at which each is entered.
///
/// It cannot be too small: its size covers the deepest tree that can be built ([`STACK_SIZE`]).
#[derive(Clone, Copy, Debug)]
pub struct TraversalStack<B>(pub(super) [(u32, B); STACK_SIZE]);

impl<B: BoundScalar> Default for TraversalStack<B> {
    fn default() -> Self {
        Self([(0, B::ZERO); STACK_SIZE])
    }
}
