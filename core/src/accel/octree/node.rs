//! The cells of the octrees.

use crate::accel::bound::BoundScalar;
use crate::ray::Aabb;
use crate::vec3::vec3;

/// A cell: a leaf with objects, an empty leaf, an inner node with up to eight parts, or one with a
/// cluster box inside, which is its only part.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct OctreeNode<B> {
    pub(super) bounds: Aabb<B>,
    /// The first part's place among the nodes, or the first object's among the links.
    pub(super) first: u32,
    /// How many parts, or objects if [`LEAF`] is set, and the flags.
    pub(super) count: u32,
}

/// The flag of a cell with objects or none, which has no parts.
pub(super) const LEAF: u32 = 1 << 31;
/// The flag of a cell with a cluster box.
pub(super) const CLUSTER: u32 = 1 << 30;

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

    /// Its box.
    pub const fn bounds(&self) -> &Aabb<B> {
        &self.bounds
    }

    /// The first part's place among the nodes, or the first object's among the links.
    pub const fn first(&self) -> usize {
        self.first as usize
    }

    /// Whether it has no parts.
    #[inline(always)]
    pub const fn is_leaf(&self) -> bool {
        self.count & LEAF != 0
    }

    /// Whether its only part is a cluster box inside of it.
    #[inline(always)]
    pub const fn is_cluster(&self) -> bool {
        self.count & CLUSTER != 0
    }

    /// How many parts or objects.
    #[inline(always)]
    pub const fn count(&self) -> u32 {
        self.count & !(LEAF | CLUSTER)
    }
}
