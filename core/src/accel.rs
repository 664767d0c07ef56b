//! Which objects a ray has to be tested against: four trees in lent memory, and none.
//!
//! All give exactly what testing every object gives, in every arithmetic. The proof has three
//! parts.
//!
//! 1. A hit counts only if its computed point P = o ⊕ t ⊗ d lies in its object's box
//!    ([`crate::shape`]), so P lies in the box of every node above it, as boxes are unions.
//! 2. If P lies in a box, the walk enters that box, at a distance ≤ t ([`InvDirection`] says why).
//! 3. Nodes are left out only if they are entered beyond the best t so far; among equal t the
//!    object with the smallest identity counts, whatever the order of tests.

mod bound;
mod brute_force;
mod build;
mod bvh8;
mod compact_bvh8;
mod octree;
mod overlap;
mod query;

pub use bound::{BoundScalar, InvDirection, SlabPlanes};
pub use brute_force::BruteForce;
pub use build::{BuildError, BuildOptions, BuildStats};
pub use bvh8::{Bvh8, Bvh8Memory, Bvh8Node};
pub use compact_bvh8::{COMPACT_MAX_DEPTH, COMPACT_STACK_SIZE, CompactBvh8, CompactStack};
pub use octree::{LinkBy, Octree, OctreeNode, OctreeVariant};

use crate::features::{ALL_FEATURES, FeatureSet};
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::Scene;

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<S> {
    /// At which distance.
    pub t: S,
    /// Which object.
    pub object: ObjectRef,
}

/// Room for the nodes that can wait while a tree is walked: every level leaves seven behind.
pub const STACK_SIZE: usize = 256;
const _: () = assert!(7 * (build::MAX_DEPTH as usize + 1) < STACK_SIZE);

/// The nodes that wait while a tree is walked, with the distance at which each is entered.
#[derive(Clone, Copy, Debug)]
pub struct TraversalStack<P>([(u32, P); STACK_SIZE]);

impl<P: BoundScalar> Default for TraversalStack<P> {
    fn default() -> Self {
        Self([(0, P::ZERO); STACK_SIZE])
    }
}

/// Finds what rays meet.
pub trait Accelerator<S: Scalar, const FEATURES: FeatureSet = ALL_FEATURES>: Sync {
    /// The nodes that wait while it is walked. Lent, since clearing it for each ray would cost
    /// more than the walk.
    type Stack: Default + Send;

    /// The first object that the ray meets at t > 0.
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<Hit<S>>;

    /// Any object that the ray meets at 0 < t ≤ `limit`.
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        limit: S,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<ObjectRef>;
}
