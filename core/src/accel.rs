//! Which objects a ray has to be tested against: three trees in lent memory, and none.
//!
//! | accelerator | what it is | for |
//! | --- | --- | --- |
//! | [`Bvh8`] | a bounding volume hierarchy (BVH) of eight children per node | hosts; the fastest |
//! | [`CompactBvh8`] | the same in less than a quarter of the memory, walked in integers | small targets |
//! | [`Octree`] | the thesis's octrees, plain and modified, and its walk | comparison |
//! | [`BruteForce`] | no tree: every object is tested | a handful of objects; the oracle |
//!
//! All give exactly what testing every object gives, in every arithmetic. The proof has three
//! parts.
//!
//! 1. A hit counts only if its computed point P = o ⊕ t ⊗ d lies in its object's box
//!    ([`crate::shape`]), so P lies in the box of every node above it, as boxes are unions.
//! 2. If P lies in a box, the walk enters that box, at a distance ≤ t ([`InvDirection`] says why).
//! 3. Nodes are left out only if they are entered beyond the best t so far; among equal t the
//!    object with the smallest identity counts, whatever the order of tests.
//!
//! An octree can be walked from cell to cell as well; `octree/cells.rs` says why that finds the same.
//!
//! The object that a ray leaves is not tested like others, and where the ray comes to its light a hit may not count
//! ([`Shapes::blocks`](crate::shape::Shapes::blocks)). Object, ray and t decide that, not the order of tests; and where
//! the ray meets again what it leaves is a hit in the sense of part 1.
//!
//! The modules: [`Accelerator`] is the interface; `query` holds what every walk does with the objects it comes
//! to; `bound`, `inv_direction` and `clip` are the arithmetic of boxes, `boxes` and `sah` that of building.

mod accelerator;
mod bound;
mod boxes;
mod brute_force;
mod build;
mod bvh8;
mod clip;
mod compact_bvh8;
mod inv_direction;
mod octree;
mod query;
mod sah;
mod scalar;
mod stack;

pub use accelerator::{Accelerator, Hit};
pub use bound::{BoundScalar, Shifted};
pub use brute_force::BruteForce;
pub use build::{BuildError, BuildOptions, BuildStats};
pub use bvh8::{Bvh8, Bvh8Memory, Bvh8Node};
pub use clip::{ClipBoxes, SlabPlanes};
pub use compact_bvh8::{
    COMPACT_MAX_DEPTH, COMPACT_STACK_SIZE, CompactBvh8, CompactStack, StackTooSmall, compact_words,
};
pub use inv_direction::InvDirection;
pub use octree::{FaceLinks, LinkBy, Octree, OctreeNode, OctreeVariant, Walk};
pub use scalar::AccelScalar;
pub use stack::{STACK_SIZE, TraversalStack};
