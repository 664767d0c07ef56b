//! Trees in heap memory, which grows until the tree fits.

use crate::quantise::Quantised;
use octray_core::accel::{
    BuildError, BuildOptions, BuildStats, Bvh8, Bvh8Memory, Bvh8Node, CompactBvh8, LinkBy, Octree,
    OctreeNode, OctreeVariant,
};
use octray_core::object::ObjectRef;
use octray_core::quantize::Quantize;
use octray_core::ray::Aabb;

/// How a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Growth {
    /// Depth and leaf size.
    pub options: BuildOptions,
    /// The maximum number of nodes; as many as needed if `None`.
    pub arena: Option<usize>,
}

/// An 8-wide BVH.
#[derive(Clone, Debug)]
pub struct OwnedBvh8<P> {
    nodes: Vec<Bvh8Node<P>>,
    links: Vec<ObjectRef>,
}

impl<P: octray_core::accel::BoundScalar> OwnedBvh8<P> {
    /// Builds the tree, and sorts the scene's objects in the order of its leaves.
    pub fn build<S: Quantize<Bound = P>>(
        scene: &mut Quantised<S>,
        growth: &Growth,
    ) -> (Self, BuildStats) {
        let count = scene.shapes().len();
        let mut links = vec![ObjectRef::default(); count];
        let mut boxes = vec![Aabb::default(); count];
        let mut room = growth.arena.unwrap_or(count / 2 + 16).max(1);
        loop {
            let mut nodes = vec![Bvh8Node::EMPTY; room];
            let memory = Bvh8Memory {
                nodes: &mut nodes,
                links: &mut links,
                boxes: &mut boxes,
            };
            // There is at least one node, and a link and a box per object: building cannot fail.
            let (used, summary) = Bvh8::build(&scene.shapes(), memory, growth.options)
                .map_or((0, BuildStats::default()), |(tree, summary)| {
                    (tree.nodes.len(), summary)
                });
            if summary.unsplit > 0 && growth.arena.is_none() {
                room *= 2;
                continue;
            }
            nodes.truncate(used);
            scene.reorder(&mut links);
            return (Self { nodes, links }, summary);
        }
    }

    /// Returns the tree as the tracer uses it.
    pub fn tree(&self) -> Bvh8<'_, P> {
        Bvh8 {
            nodes: &self.nodes,
            links: &self.links,
        }
    }
}

/// A compact 8-wide BVH.
#[derive(Clone, Debug)]
pub struct OwnedCompactBvh8 {
    /// The nodes.
    pub words: Vec<u32>,
    /// The objects, leaf by leaf.
    pub links: Vec<ObjectRef>,
    /// A tick is 2 to this power, in grid units.
    pub tick: u32,
}

impl OwnedCompactBvh8 {
    /// Builds the tree, and sorts the scene's objects in the order of its leaves. The arena is counted in nodes of
    /// eight children, 18 words each.
    ///
    /// # Errors
    /// If there are more objects than a compact BVH can hold.
    pub fn build<S: Quantize>(
        scene: &mut Quantised<S>,
        growth: &Growth,
    ) -> Result<(Self, BuildStats), BuildError> {
        let count = scene.shapes().len();
        let mut links = vec![ObjectRef::default(); count];
        let mut boxes = vec![Aabb::default(); count];
        let mut words = vec![0; 18 * growth.arena.unwrap_or(count + 1)];
        let (tree, summary) = CompactBvh8::build(
            &scene.shapes(),
            scene.diameter,
            &mut words,
            &mut links,
            &mut boxes,
            growth.options,
        )?;
        let (used, tick) = (tree.words().len(), tree.tick());
        words.truncate(used);
        scene.reorder(&mut links);
        Ok((Self { words, links, tick }, summary))
    }

    /// Returns the tree as the tracer uses it.
    pub fn tree(&self) -> CompactBvh8<'_> {
        CompactBvh8::new(&self.words, &self.links, self.tick).expect("a tree as it was built")
    }
}

/// One of the thesis's octrees.
#[derive(Clone, Debug)]
pub struct OwnedOctree<P> {
    nodes: Vec<OctreeNode<P>>,
    links: Vec<ObjectRef>,
}

impl<P: octray_core::accel::BoundScalar> OwnedOctree<P> {
    /// Builds the tree, and sorts the scene's objects in the order of its leaves.
    pub fn build<S: Quantize<Bound = P>>(
        scene: &mut Quantised<S>,
        growth: &Growth,
        variant: OctreeVariant,
        link: LinkBy,
    ) -> (Self, BuildStats) {
        // If hits of a format can be off their surfaces, an object belongs to every cell that its box overlaps.
        let link = if S::HITS_WITHIN_SLACK {
            link
        } else {
            LinkBy::Box
        };
        let count = scene.shapes().len();
        let mut room = growth.arena.unwrap_or(8 * count + 64).max(1);
        let mut link_room = 8 * room + count;
        loop {
            let mut nodes = vec![OctreeNode::EMPTY; room];
            let mut links = vec![ObjectRef::default(); link_room];
            let (used, used_links, summary) = Octree::build(
                &scene.shapes(),
                &mut nodes,
                &mut links,
                growth.options,
                variant,
                link,
            )
            .map_or((0, 0, BuildStats::default()), |(tree, summary)| {
                (tree.nodes.len(), tree.links.len(), summary)
            });
            // Memory is bounded even if splitting never separates the objects.
            if summary.unsplit > 0 && growth.arena.is_none() && room < 1 << 24 {
                room *= 2;
                link_room *= 2;
                continue;
            }
            nodes.truncate(used);
            links.truncate(used_links);
            scene.reorder(&mut links);
            return (Self { nodes, links }, summary);
        }
    }

    /// Returns the tree as the tracer uses it.
    pub fn tree(&self) -> Octree<'_, P> {
        Octree {
            nodes: &self.nodes,
            links: &self.links,
        }
    }
}

/// Returns every object once, for [`octray_core::accel::BruteForce`].
pub fn every_object<S: Quantize>(scene: &Quantised<S>) -> Vec<ObjectRef> {
    scene.shapes().refs().collect()
}
