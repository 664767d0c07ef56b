//! Trees in heap memory, which grows until the tree fits.

use crate::quantise::Quantised;
use octray_core::octree::{
    BuildError, Link, Node, Octant, Octants, Options, Packed, Summary, Tight, TightMemory, Variant,
};
use octray_core::ray::Bounds;
use octray_core::scalar::Quantize;
use octray_core::shape::ObjectRef;

/// How a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Growth {
    /// Depth and leaf size.
    pub options: Options,
    /// The maximum number of nodes; as many as needed if `None`.
    pub arena: Option<usize>,
}

/// An 8-wide BVH.
#[derive(Clone, Debug)]
pub struct OwnedBvh8<P> {
    nodes: Vec<Node<P>>,
    links: Vec<ObjectRef>,
}

impl<P: octray_core::octree::Plane> OwnedBvh8<P> {
    /// Builds the tree, and sorts the scene's objects in the order of its leaves.
    pub fn build<S: Quantize<Plane = P>>(
        scene: &mut Quantised<S>,
        growth: &Growth,
    ) -> (Self, Summary) {
        let count = scene.shapes().len();
        let mut links = vec![ObjectRef::default(); count];
        let mut boxes = vec![Bounds::default(); count];
        let mut room = growth.arena.unwrap_or(count / 2 + 16).max(1);
        loop {
            let mut nodes = vec![Node::EMPTY; room];
            let memory = TightMemory {
                nodes: &mut nodes,
                links: &mut links,
                boxes: &mut boxes,
            };
            // There is at least one node, and a link and a box per object: building cannot fail.
            let (used, summary) = Tight::build(&scene.shapes(), memory, growth.options)
                .map_or((0, Summary::default()), |(tree, summary)| {
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
    pub fn tree(&self) -> Tight<'_, P> {
        Tight {
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
    ) -> Result<(Self, Summary), BuildError> {
        let count = scene.shapes().len();
        let mut links = vec![ObjectRef::default(); count];
        let mut boxes = vec![Bounds::default(); count];
        let mut words = vec![0; 18 * growth.arena.unwrap_or(count + 1)];
        let (tree, summary) = Packed::build(
            &scene.shapes(),
            scene.reach,
            &mut words,
            &mut links,
            &mut boxes,
            growth.options,
        )?;
        let (used, tick) = (tree.words.len(), tree.tick);
        words.truncate(used);
        scene.reorder(&mut links);
        Ok((Self { words, links, tick }, summary))
    }

    /// Returns the tree as the tracer uses it.
    pub fn tree(&self) -> Packed<'_> {
        Packed {
            words: &self.words,
            links: &self.links,
            tick: self.tick,
        }
    }
}

/// One of the thesis's octrees.
#[derive(Clone, Debug)]
pub struct OwnedOctree<P> {
    nodes: Vec<Octant<P>>,
    links: Vec<ObjectRef>,
}

impl<P: octray_core::octree::Plane> OwnedOctree<P> {
    /// Builds the tree, and sorts the scene's objects in the order of its leaves.
    pub fn build<S: Quantize<Plane = P>>(
        scene: &mut Quantised<S>,
        growth: &Growth,
        variant: Variant,
        link: Link,
    ) -> (Self, Summary) {
        // If hits of a format can be off their surfaces, an object belongs to every cell that its box overlaps.
        let link = if S::SOUND { link } else { Link::Box };
        let count = scene.shapes().len();
        let mut room = growth.arena.unwrap_or(8 * count + 64).max(1);
        let mut link_room = 8 * room + count;
        loop {
            let mut nodes = vec![Octant::EMPTY; room];
            let mut links = vec![ObjectRef::default(); link_room];
            let (used, used_links, summary) = Octants::build(
                &scene.shapes(),
                &mut nodes,
                &mut links,
                growth.options,
                variant,
                link,
            )
            .map_or((0, 0, Summary::default()), |(tree, summary)| {
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
    pub fn tree(&self) -> Octants<'_, P> {
        Octants {
            nodes: &self.nodes,
            links: &self.links,
        }
    }
}

/// Returns every object once, for [`octray_core::octree::List`].
pub fn every_object<S: Quantize>(scene: &Quantised<S>) -> Vec<ObjectRef> {
    scene.shapes().refs().collect()
}
