//! Trees as the tracer sees them.

use octray_core::octree::{Accelerator, List, Octants, Packed, Plane, Tight};
use octray_core::scalar::Quantize;
use octray_core::shape::ObjectRef;
use octray_prepare::tree::{OctantTree, PackedTree, TightTree};

/// A tree in memory of its own.
pub(crate) trait Grown<S: Quantize>: Send + Sync {
    /// The tree as the tracer sees it.
    type View<'a>: Accelerator<S> + Send
    where
        Self: 'a;

    fn view(&self) -> Self::View<'_>;
}

impl<S: Quantize<Plane = P>, P: Plane> Grown<S> for TightTree<P> {
    type View<'a> = Tight<'a, P>;

    fn view(&self) -> Tight<'_, P> {
        self.tree()
    }
}

impl<S: Quantize> Grown<S> for PackedTree {
    type View<'a> = Packed<'a>;

    fn view(&self) -> Packed<'_> {
        self.tree()
    }
}

impl<S: Quantize<Plane = P>, P: Plane> Grown<S> for OctantTree<P> {
    type View<'a> = Octants<'a, P>;

    fn view(&self) -> Octants<'_, P> {
        self.tree()
    }
}

/// No tree: every object.
impl<S: Quantize> Grown<S> for Vec<ObjectRef> {
    type View<'a> = List<'a>;

    fn view(&self) -> List<'_> {
        List(self)
    }
}
