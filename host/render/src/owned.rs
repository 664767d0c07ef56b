//! Trees as the tracer sees them.

use octray_core::octree::{Accelerator, List, Octants, Packed, Plane, Tight};
use octray_core::scalar::Quantize;
use octray_core::shape::ObjectRef;
use octray_prepare::tree::{OwnedBvh8, OwnedCompactBvh8, OwnedOctree};

/// A tree in memory of its own.
pub(crate) trait OwnedAccelerator<S: Quantize>: Send + Sync {
    /// The tree as the tracer sees it.
    type View<'a>: Accelerator<S> + Send
    where
        Self: 'a;

    fn view(&self) -> Self::View<'_>;
}

impl<S: Quantize<Plane = P>, P: Plane> OwnedAccelerator<S> for OwnedBvh8<P> {
    type View<'a> = Tight<'a, P>;

    fn view(&self) -> Tight<'_, P> {
        self.tree()
    }
}

impl<S: Quantize> OwnedAccelerator<S> for OwnedCompactBvh8 {
    type View<'a> = Packed<'a>;

    fn view(&self) -> Packed<'_> {
        self.tree()
    }
}

impl<S: Quantize<Plane = P>, P: Plane> OwnedAccelerator<S> for OwnedOctree<P> {
    type View<'a> = Octants<'a, P>;

    fn view(&self) -> Octants<'_, P> {
        self.tree()
    }
}

/// No tree: every object.
impl<S: Quantize> OwnedAccelerator<S> for Vec<ObjectRef> {
    type View<'a> = List<'a>;

    fn view(&self) -> List<'_> {
        List(self)
    }
}
