//! Trees in heap memory, which grows until the tree fits.

use crate::quantise::Quantised;
use octray_core::accel::{
    BuildError, BuildOptions, BuildStats, Bvh8, Bvh8Memory, Bvh8Node, CompactBvh8, FaceLinks,
    LinkBy, Octree, OctreeNode, OctreeVariant, Walk,
};
use octray_core::object::ObjectRef;
use octray_core::quantize::Quantize;
use octray_core::ray::Aabb;

/// Octrees have no more nodes than this, or than this for each object, unless an arena is asked for: in one whose
/// objects splitting never separates, eight cells take the place of each.
const MOST_NODES: usize = 1 << 20;
const NODES_PER_OBJECT: usize = 256;

/// How a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Growth {
    /// Depth and leaf size.
    pub options: BuildOptions,
    /// The maximum number of nodes. If `None`, as many as needed, but octrees are bounded by the number of objects.
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
        let most = growth.arena.unwrap_or(usize::MAX).max(1);
        let mut room = (count / 2 + 16).min(most);
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
            if summary.unsplit > 0 && room < most {
                room = room.saturating_mul(2).min(most);
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
        let most = growth.arena.unwrap_or(usize::MAX);
        let mut words = vec![0; 18 * (count + 1).min(most)];
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
    neighbours: Vec<FaceLinks>,
    walk: Walk,
}

impl<P: octray_core::accel::BoundScalar> OwnedOctree<P> {
    /// Builds the tree, to be walked in order, and sorts the scene's objects in the order of its leaves.
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
        let default = MOST_NODES.max(NODES_PER_OBJECT.saturating_mul(count));
        let most = growth.arena.unwrap_or(default).max(1);
        let mut room = (8 * count + 64).min(most);
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
            if summary.unsplit > 0 && room < most {
                // With an arena as large as asked for, links are as many as for an arena that was so from the start.
                room = room.saturating_mul(2).min(most);
                link_room = match room == most {
                    true => room.saturating_mul(8).saturating_add(count),
                    false => 2 * link_room,
                };
                continue;
            }
            nodes.truncate(used);
            links.truncate(used_links);
            scene.reorder(&mut links);
            let tree = Self {
                nodes,
                links,
                neighbours: Vec::new(),
                walk: Walk::Ordered,
            };
            return (tree, summary);
        }
    }

    /// Returns the same tree to be walked another way.
    #[must_use]
    pub fn walked(mut self, walk: Walk) -> Self {
        let mut neighbours = Vec::new();
        if walk == Walk::Links {
            neighbours.resize(self.nodes.len(), FaceLinks::default());
            // There is room for the links of each node.
            let _ = self.tree().with_links(&mut neighbours);
        }
        (self.neighbours, self.walk) = (neighbours, walk);
        self
    }

    /// Returns the tree as the tracer uses it.
    pub fn tree(&self) -> Octree<'_, P> {
        Octree {
            nodes: &self.nodes,
            links: &self.links,
            neighbours: &self.neighbours,
            walk: self.walk,
        }
    }
}

/// Returns every object once, for [`octray_core::accel::BruteForce`].
pub fn every_object<S: Quantize>(scene: &Quantised<S>) -> Vec<ObjectRef> {
    scene.shapes().refs().collect()
}
