//! Which objects a ray has to be tested against: four trees in lent memory, and none.
//!
//! All give exactly what testing every object gives, in every arithmetic. The proof has three
//! parts.
//!
//! 1. A hit counts only if its computed point P = o ⊕ t ⊗ d lies in its object's box
//!    ([`crate::shape`]), so P lies in the box of every node above it, as boxes are unions.
//! 2. If P lies in a box, the walk enters that box, at a distance ≤ t ([`Slope`] says why).
//! 3. Nodes are left out only if they are entered beyond the best t so far; among equal t the
//!    object with the smallest identity counts, whatever the order of tests.

mod build;
mod list;
mod octants;
mod packed;
mod plane;
mod search;
mod tight;
mod touch;

pub use build::{BuildError, Options, Summary};
pub use list::List;
pub use octants::{Link, Octant, Octants, Variant};
pub use packed::{PACKED_DEPTH, PACKED_STACK, Packed, PackedStack};
pub use plane::{Faces, Plane, Slope};
pub use tight::{Node, Tight, TightMemory};

use crate::needs::{EVERYTHING, Needs};
use crate::observe::Observer;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::ObjectRef;

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<S> {
    /// At which distance.
    pub t: S,
    /// Which object.
    pub object: ObjectRef,
}

/// Room for the nodes that can wait while a tree is walked: every level leaves seven behind.
pub const STACK: usize = 256;
const _: () = assert!(7 * (build::MAX_DEPTH as usize + 1) < STACK);

/// The nodes that wait while a tree is walked, with the distance at which each is entered.
#[derive(Clone, Copy, Debug)]
pub struct Stack<P>([(u32, P); STACK]);

impl<P: Plane> Default for Stack<P> {
    fn default() -> Self {
        Self([(0, P::ZERO); STACK])
    }
}

/// Finds what rays meet.
pub trait Accelerator<S: Scalar, const NEEDS: Needs = EVERYTHING>: Sync {
    /// The nodes that wait while it is walked. Lent, since clearing it for each ray would cost
    /// more than the walk.
    type Stack: Default + Send;

    /// The first object that the ray meets at t > 0.
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, NEEDS>,
        ray: &Ray<S>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<Hit<S>>;

    /// Any object that the ray meets at 0 < t ≤ `limit`.
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, NEEDS>,
        ray: &Ray<S>,
        limit: S,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<ObjectRef>;
}
