//! A tree of any kind, so that all else is compiled once for each format and not for each tree.

use octray_core::accel::{
    Accelerator, BoundScalar, BruteForce, Bvh8, CompactBvh8, CompactStack, Hit, Octree,
    TraversalStack,
};
use octray_core::features::ALL_FEATURES;
use octray_core::object::ObjectRef;
use octray_core::observe::Observer;
use octray_core::quantize::Quantize;
use octray_core::ray::Ray;
use octray_core::scene::{Light, Scene};
use octray_prepare::tree::{OwnedBvh8, OwnedCompactBvh8, OwnedOctree};

/// A tree in memory of its own.
pub(crate) enum OwnedAccelerator<B> {
    Bvh8(OwnedBvh8<B>),
    CompactBvh8(OwnedCompactBvh8),
    Octree(OwnedOctree<B>),
    /// No tree: every object.
    BruteForce(Vec<ObjectRef>),
}

impl<B: BoundScalar> OwnedAccelerator<B> {
    /// The tree as the tracer sees it.
    pub(crate) fn view(&self) -> AnyAccelerator<'_, B> {
        match self {
            Self::Bvh8(tree) => AnyAccelerator::Bvh8(tree.tree()),
            Self::CompactBvh8(tree) => AnyAccelerator::CompactBvh8(tree.tree()),
            Self::Octree(tree) => AnyAccelerator::Octree(tree.tree()),
            Self::BruteForce(objects) => AnyAccelerator::BruteForce(BruteForce(objects)),
        }
    }
}

/// A tree as the tracer sees it. Its kind is looked at once for each search, which does not show in the time of a
/// picture.
#[derive(Clone, Copy, Debug)]
pub(crate) enum AnyAccelerator<'a, B> {
    Bvh8(Bvh8<'a, B>),
    CompactBvh8(CompactBvh8<'a>),
    Octree(Octree<'a, B>),
    BruteForce(BruteForce<'a>),
}

/// The nodes that wait while a tree of any kind is walked.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub(crate) struct AnyStack<B: BoundScalar> {
    bounds: TraversalStack<B>,
    compact: CompactStack,
}

impl<S: Quantize> Accelerator<S> for AnyAccelerator<'_, S::Bound> {
    type Stack = AnyStack<S::Bound>;

    // The arguments are handed on as they came, so the search is jumped to.
    #[inline(never)]
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, ALL_FEATURES>,
        ray: &Ray<S>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        match self {
            Self::Bvh8(tree) => tree.nearest(scene, ray, &mut stack.bounds, observer),
            Self::CompactBvh8(tree) => tree.nearest(scene, ray, &mut stack.compact, observer),
            Self::Octree(tree) => tree.nearest(scene, ray, &mut stack.bounds, observer),
            Self::BruteForce(all) => all.nearest(scene, ray, &mut (), observer),
        }
    }

    #[inline(never)]
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, ALL_FEATURES>,
        ray: &Ray<S>,
        limit: S,
        light: Option<&Light<S>>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<ObjectRef> {
        match self {
            Self::Bvh8(tree) => tree.any_hit(scene, ray, limit, light, &mut stack.bounds, observer),
            Self::CompactBvh8(tree) => {
                tree.any_hit(scene, ray, limit, light, &mut stack.compact, observer)
            }
            Self::Octree(tree) => {
                tree.any_hit(scene, ray, limit, light, &mut stack.bounds, observer)
            }
            Self::BruteForce(all) => all.any_hit(scene, ray, limit, light, &mut (), observer),
        }
    }
}
