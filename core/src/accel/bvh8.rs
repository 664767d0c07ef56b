//! The tight tree: up to eight tight boxes per node, every object in exactly one leaf.
//!
//! It takes the thesis's cluster box to its end: a node's children are not the octants of a cell
//! but the groups into which surface area says its objects fall.

use super::build::{self, BuildError, BuildOptions, BuildStats, MAX_DEPTH, WIDTH};
use super::query::Query;
use super::{Accelerator, BoundScalar, Hit, InvDirection, SlabPlanes, TraversalStack};
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::ray::{Aabb, Ray};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::Shapes;
use crate::vec3::Axis;

/// An inner node: the boxes of its children, plane by plane, and what lies in them.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Bvh8Node<P> {
    /// Low x, y, z, then high x, y, z of all eight. An empty place has an inverted box.
    planes: [[P; WIDTH]; 6],
    /// The children's words: see [`Word`].
    children: [u32; WIDTH],
}

/// A child: `LEAF` and the place of its first object in the list of links, or the place of a node.
struct Word;

impl Word {
    const LEAF: u32 = 1 << 31;
    /// A leaf without links: even a ray whose numbers have gone astray ends there.
    const NONE: u32 = u32::MAX;
}

impl<P: BoundScalar> Bvh8Node<P> {
    /// A node without children.
    pub const EMPTY: Self = Self {
        planes: [
            [P::MAX; WIDTH],
            [P::MAX; WIDTH],
            [P::MAX; WIDTH],
            [P::MIN; WIDTH],
            [P::MIN; WIDTH],
            [P::MIN; WIDTH],
        ],
        children: [Word::NONE; WIDTH],
    };

    /// A node that is still to be split.
    fn waiting(start: usize, end: usize, depth: u32) -> Self {
        let mut node = Self::EMPTY;
        node.children[..3].copy_from_slice(&[start as u32, end as u32, depth]);
        node
    }

    fn set(&mut self, child: usize, bounds: &Aabb<P>, word: u32) {
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            self.planes[i][child] = bounds.low[axis].round_down();
            self.planes[i + 3][child] = bounds.high[axis].round_up();
        }
        self.children[child] = word;
    }
}

/// The memory a tree is built in, all of it lent.
#[derive(Debug)]
pub struct Bvh8Memory<'a, P> {
    /// Room for inner nodes; at least one. What does not fit stays unsplit.
    pub nodes: &'a mut [Bvh8Node<P>],
    /// One for each object.
    pub links: &'a mut [ObjectRef],
    /// One for each object; free again when the tree is built.
    pub boxes: &'a mut [Aabb<P>],
}

/// A finished tree.
#[derive(Clone, Copy, Debug)]
pub struct Bvh8<'a, P> {
    /// The nodes; the first is the root.
    pub nodes: &'a [Bvh8Node<P>],
    /// The objects, leaf by leaf, the last of each leaf marked.
    pub links: &'a [ObjectRef],
}

impl<'a, P: BoundScalar> Bvh8<'a, P> {
    /// Builds the tree of all shapes.
    ///
    /// # Errors
    /// If there is not one node, or not a link and a box for each object.
    pub fn build<S: Scalar<Bound = P>>(
        shapes: &Shapes<'_, S>,
        memory: Bvh8Memory<'a, P>,
        options: BuildOptions,
    ) -> Result<(Self, BuildStats), BuildError> {
        let Bvh8Memory {
            nodes,
            links,
            boxes,
        } = memory;
        let count = shapes.len();
        let too_small = BuildError {
            nodes: 1,
            links: count,
        };
        let links = links.get_mut(..count).ok_or(too_small)?;
        let boxes = boxes.get_mut(..count).ok_or(too_small)?;
        *nodes.first_mut().ok_or(too_small)? = Bvh8Node::EMPTY;
        for ((link, bounds), object) in links.iter_mut().zip(&mut *boxes).zip(shapes.refs()) {
            *link = object;
            *bounds = build::to_bounds(shapes.bounds(object));
        }
        let mut stats = BuildStats {
            links: count as u32,
            ..BuildStats::default()
        };
        let used = if count == 0 {
            0
        } else {
            grow(nodes, links, boxes, options, &mut stats)
        };
        Ok((
            Self {
                nodes: nodes.get(..used).unwrap_or_default(),
                links,
            },
            stats,
        ))
    }
}

/// Splits breadth first. A node that waits holds its range of objects and its depth in the words
/// of its children, so that no other memory is needed. Returns how many nodes there are.
fn grow<P: BoundScalar>(
    nodes: &mut [Bvh8Node<P>],
    links: &mut [ObjectRef],
    boxes: &mut [Aabb<P>],
    options: BuildOptions,
    stats: &mut BuildStats,
) -> usize {
    let leaf_size = options.leaf_size.max(1) as usize;
    let deepest = options.depth.clamp(1, MAX_DEPTH);
    if let Some(root) = nodes.first_mut() {
        *root = Bvh8Node::waiting(0, links.len(), 1);
    }
    let (mut done, mut used) = (0, 1);
    while done < used {
        let Some(&waiting) = nodes.get(done) else {
            break;
        };
        let [start, end, depth, ..] = waiting.children;
        stats.inner += 1;
        stats.depth = stats.depth.max(depth);
        let mut node = Bvh8Node::EMPTY;
        let (groups, count) =
            build::split_into_groups(start as usize, end as usize, links, boxes, leaf_size);
        for (child, group) in groups.iter().enumerate().take(count) {
            let fits = group.len() <= leaf_size;
            let room = nodes.get_mut(used).filter(|_| !fits && depth < deepest);
            let word = if let Some(room) = room {
                *room = Bvh8Node::waiting(group.start, group.end, depth + 1);
                used += 1;
                used as u32 - 1
            } else {
                stats.leaves += 1;
                stats.unsplit += u32::from(!fits && depth < deepest);
                if let Some(last) = links.get_mut(group.end.wrapping_sub(1)) {
                    *last = last.marked_last(true);
                }
                Word::LEAF | group.start as u32
            };
            node.set(child, &group.bounds, word);
        }
        if let Some(place) = nodes.get_mut(done) {
            *place = node;
        }
        done += 1;
    }
    used
}

/// The ray as the walk wants it.
struct Walk<P: BoundScalar> {
    origin: [P; 3],
    inv_direction: [InvDirection<P>; 3],
    /// Which planes of a node are met first and last on each axis.
    near: [usize; 3],
    far: [usize; 3],
}

impl<P: BoundScalar> Walk<P> {
    #[inline(always)]
    fn new<S: Scalar<Bound = P>>(ray: &Ray<S>) -> Self {
        let origin = ray.origin.to_array().map(S::to_bound);
        let inv_direction = ray.direction.to_array().map(S::inv_direction);
        let pick = |flip: bool| {
            [0, 1, 2].map(|i: usize| {
                if inv_direction[i].negative == flip {
                    i
                } else {
                    i + 3
                }
            })
        };
        Self {
            origin,
            near: pick(false),
            far: pick(true),
            inv_direction,
        }
    }

    #[inline(always)]
    fn slab_planes<'n>(&self, node: &'n Bvh8Node<P>) -> SlabPlanes<'n, P> {
        SlabPlanes {
            near: self.near.map(|i| &node.planes[i]),
            far: self.far.map(|i| &node.planes[i]),
        }
    }
}

impl<P: BoundScalar> Bvh8<'_, P> {
    /// Children are visited in the order in which the ray enters them; a search for any hit takes
    /// them as they come.
    ///
    /// The child entered first is gone on with directly, only the others go through the stack; its
    /// places are counted in a `u8`, which cannot leave its 256, so that no access is checked.
    #[inline(always)]
    fn walk<S: Scalar<Bound = P>, O: Observer, const ANY: bool, const FEATURES: FeatureSet>(
        &self,
        query: &mut Query<'_, S, O, ANY, FEATURES>,
        stack: &mut TraversalStack<P>,
    ) {
        let Some(mut node) = self.nodes.first() else {
            return;
        };
        let walk = Walk::new(query.ray);
        let mut waiting = 0u8;
        loop {
            query.observer.step(WIDTH);
            let limit = query.limit.to_bound();
            let (entry, mut met) = P::clip_boxes(
                walk.slab_planes(node),
                walk.origin,
                &walk.inv_direction,
                limit,
            );
            let mut next = None;
            if met != 0 {
                let mut child = || {
                    let k = met.trailing_zeros() as usize % WIDTH;
                    met &= met - 1;
                    (met == 0, (node.children[k], entry[k]))
                };
                let (mut last, mut first) = child();
                let base = waiting;
                while !last {
                    let mut item;
                    (last, item) = child();
                    if !ANY && item.1 < first.1 {
                        (item, first) = (first, item);
                    }
                    let mut place = waiting;
                    while !ANY && place > base && stack.0[usize::from(place - 1)].1 < item.1 {
                        stack.0[usize::from(place)] = stack.0[usize::from(place - 1)];
                        place -= 1;
                    }
                    stack.0[usize::from(place)] = item;
                    waiting = waiting.wrapping_add(1);
                }
                next = Some(first.0);
            }
            // Leaves are emptied on the spot; the next inner node within the limit goes on.
            node = loop {
                let word = match next.take() {
                    Some(word) => word,
                    None if waiting == 0 => return,
                    None => {
                        waiting -= 1;
                        let (word, entry) = stack.0[usize::from(waiting)];
                        if !ANY && entry > query.limit.to_bound() {
                            continue;
                        }
                        word
                    }
                };
                if word & Word::LEAF == 0 {
                    match self.nodes.get(word as usize) {
                        Some(node) => break node,
                        None => continue,
                    }
                }
                let start = (word & !Word::LEAF) as usize;
                if query.test_list(self.links.get(start..).unwrap_or(&[])) {
                    return;
                }
            };
        }
    }
}

impl<S: Scalar, const FEATURES: FeatureSet> Accelerator<S, FEATURES> for Bvh8<'_, S::Bound> {
    type Stack = TraversalStack<S::Bound>;

    // One copy of the walk per use: inlined into the tracer it would not fit the code cache.
    #[inline(never)]
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        stack: &mut TraversalStack<S::Bound>,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        let mut query = Query::<_, _, false, FEATURES>::new(scene, ray, scene.diameter, observer);
        self.walk(&mut query, stack);
        query.hit()
    }

    #[inline(never)]
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        limit: S,
        stack: &mut TraversalStack<S::Bound>,
        observer: &mut O,
    ) -> Option<ObjectRef> {
        let mut query = Query::<_, _, true, FEATURES>::new(scene, ray, limit, observer);
        self.walk(&mut query, stack);
        query.found
    }
}
