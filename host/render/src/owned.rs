//! Trees as the tracer sees them.

use octray_core::accel::{Accelerator, BoundScalar, BruteForce, Bvh8, CompactBvh8, Octree};
use octray_core::object::ObjectRef;
use octray_core::quantize::Quantize;
use octray_prepare::tree::{OwnedBvh8, OwnedCompactBvh8, OwnedOctree};

/// A tree in memory of its own.
pub(crate) trait OwnedAccelerator<S: Quantize>: Send + Sync {
    /// The tree as the tracer sees it.
    type View<'a>: Accelerator<S> + Send
    where
        Self: 'a;

    fn view(&self) -> Self::View<'_>;
}

impl<S: Quantize<Bound = P>, P: BoundScalar> OwnedAccelerator<S> for OwnedBvh8<P> {
    type View<'a> = Bvh8<'a, P>;

    fn view(&self) -> Bvh8<'_, P> {
        self.tree()
    }
}

impl<S: Quantize> OwnedAccelerator<S> for OwnedCompactBvh8 {
    type View<'a> = CompactBvh8<'a>;

    fn view(&self) -> CompactBvh8<'_> {
        self.tree()
    }
}

impl<S: Quantize<Bound = P>, P: BoundScalar> OwnedAccelerator<S> for OwnedOctree<P> {
    type View<'a> = Octree<'a, P>;

    fn view(&self) -> Octree<'_, P> {
        self.tree()
    }
}

/// No tree: every object.
impl<S: Quantize> OwnedAccelerator<S> for Vec<ObjectRef> {
    type View<'a> = BruteForce<'a>;

    fn view(&self) -> BruteForce<'_> {
        BruteForce(self)
    }
}
