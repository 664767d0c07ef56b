//! The nodes of the 8-wide BVH.

use crate::accel::bound::BoundScalar;
use crate::accel::sah::WIDTH;
use crate::ray::Aabb;
use crate::vec3::Axis;

/// An inner node: the boxes of its children, plane by plane, and what lies in them.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Bvh8Node<B> {
    /// Low x, y, z, then high x, y, z of all eight. An empty place has an inverted box.
    pub(super) planes: [[B; WIDTH]; 6],
    /// The children's words: see `ChildWord`.
    pub(super) children: [u32; WIDTH],
}

/// A child: `LEAF` and the place of its first object in the list of links, or the place of a node.
pub(super) struct ChildWord;

impl ChildWord {
    pub(super) const LEAF: u32 = 1 << 31;
    /// A leaf without links, for places without a child.
    pub(super) const NONE: u32 = u32::MAX;
}

impl<B: BoundScalar> Bvh8Node<B> {
    /// A node without children.
    pub const EMPTY: Self = Self {
        planes: [
            [B::MAX; WIDTH],
            [B::MAX; WIDTH],
            [B::MAX; WIDTH],
            [B::MIN; WIDTH],
            [B::MIN; WIDTH],
            [B::MIN; WIDTH],
        ],
        children: [ChildWord::NONE; WIDTH],
    };

    /// A node that is still to be split.
    pub(super) fn unbuilt(start: usize, end: usize, depth: u32) -> Self {
        let mut node = Self::EMPTY;
        node.children[..3].copy_from_slice(&[start as u32, end as u32, depth]);
        node
    }

    pub(super) fn set(&mut self, child: usize, bounds: &Aabb<B>, word: u32) {
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            self.planes[i][child] = bounds.low[axis].round_down();
            self.planes[i + 3][child] = bounds.high[axis].round_up();
        }
        self.children[child] = word;
    }
}
