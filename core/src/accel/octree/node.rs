//! The cells of the octrees.

use crate::accel::bound::BoundScalar;
use crate::ray::Aabb;
use crate::vec3::vec3;

/// A cell: a leaf with objects, an empty leaf, or an inner node with up to eight parts.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct OctreeNode<B> {
    pub(super) bounds: Aabb<B>,
    /// The first part's place among the nodes, or the first object's among the links.
    pub(super) first: u32,
    /// How many parts, or objects if [`LEAF`] is set.
    pub(super) count: u32,
}

pub(super) const LEAF: u32 = 1 << 31;

impl<B: BoundScalar> OctreeNode<B> {
    /// An empty leaf without extent.
    pub const EMPTY: Self = Self {
        bounds: Aabb {
            low: vec3(B::MAX, B::MAX, B::MAX),
            high: vec3(B::MIN, B::MIN, B::MIN),
        },
        first: 0,
        count: LEAF,
    };

    #[inline(always)]
    pub(super) const fn is_leaf(&self) -> bool {
        self.count & LEAF != 0
    }

    /// How many parts or objects.
    #[inline(always)]
    pub(super) const fn count(&self) -> u32 {
        self.count & !LEAF
    }
}
