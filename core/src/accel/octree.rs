//! The thesis's two trees: the *plain* octree (Glassner 1984), whose cells are split at the centre
//! into eight octants, and the *modified* one (figure 12), which merges and shrinks cells.
//! Objects are linked into every leaf that they touch.

use super::build::{self, BuildError, BuildOptions, BuildStats, MAX_DEPTH};
use super::overlap::overlaps;
use super::query::Query;
use super::{Accelerator, BoundScalar, Hit, InvDirection, TraversalStack};
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::ray::{Aabb, Ray};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::Shapes;
use crate::vec3::Axis;

/// Which of the thesis's trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OctreeVariant {
    /// Every inner cell has its eight octants, empty ones included.
    Plain,
    /// An octant whose three neighbours in the same half of the cell are empty is merged with
    /// them; a cell whose objects' box fills less than half of it shrinks to that box (the
    /// cluster box); a cell in which splitting separates nothing stays a leaf.
    Modified,
}

/// When an object is linked into a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkBy {
    /// When its bounding box meets the cell.
    Box,
    /// When its surface does.
    Shape,
}

/// A cell: a leaf with objects, an empty leaf, or an inner node with up to eight parts.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct OctreeNode<P> {
    bounds: Aabb<P>,
    /// The first part's place among the nodes, or the first object's among the links.
    first: u32,
    /// How many parts or objects; `LEAF` tells which.
    count: u32,
}

const LEAF: u32 = 1 << 31;

impl<P: BoundScalar> OctreeNode<P> {
    /// An empty leaf without extent.
    pub const EMPTY: Self = Self {
        bounds: Aabb {
            low: crate::vec3::vec3(P::MAX, P::MAX, P::MAX),
            high: crate::vec3::vec3(P::MIN, P::MIN, P::MIN),
        },
        first: 0,
        count: LEAF,
    };

    #[inline(always)]
    const fn is_leaf(&self) -> bool {
        self.count & LEAF != 0
    }

    /// How many parts or objects.
    #[inline(always)]
    const fn count(&self) -> u32 {
        self.count & !LEAF
    }
}

/// A finished octree.
#[derive(Clone, Copy, Debug)]
pub struct Octree<'a, P> {
    /// The cells; the first is the root, parts of a cell are contiguous.
    pub nodes: &'a [OctreeNode<P>],
    /// The objects, leaf by leaf, the last of each leaf marked.
    pub links: &'a [ObjectRef],
}

impl<'a, P: BoundScalar> Octree<'a, P> {
    /// Builds the octree of all shapes in lent nodes and links. A leaf that should be split but
    /// for which there is no room stays as it is.
    ///
    /// # Errors
    /// If there is not one node, or not one link for each object.
    pub fn build<S: Scalar<Bound = P>>(
        shapes: &Shapes<'_, S>,
        nodes: &'a mut [OctreeNode<P>],
        links: &'a mut [ObjectRef],
        options: BuildOptions,
        variant: OctreeVariant,
        link: LinkBy,
    ) -> Result<(Self, BuildStats), BuildError> {
        let count = shapes.len();
        let too_small = BuildError {
            nodes: 1,
            links: count,
        };
        let mut bounds = build::empty_box();
        let all = links.get_mut(..count).ok_or(too_small)?;
        for (link, object) in all.iter_mut().zip(shapes.refs()) {
            *link = object;
            bounds = build::union(bounds, build::to_bounds(shapes.bounds(object)));
        }
        *nodes.first_mut().ok_or(too_small)? = OctreeNode {
            bounds,
            first: 0,
            count: LEAF | count as u32,
        };
        let mut builder = Builder {
            shapes,
            nodes,
            links,
            used_nodes: 1,
            used_links: count,
            leaf_size: options.leaf_size.max(1),
            variant,
            link,
        };
        let mut stats = builder.grow(options.depth.clamp(1, MAX_DEPTH));
        let (used_nodes, used_links) = (builder.used_nodes, builder.used_links);
        let nodes = nodes.get(..used_nodes).unwrap_or_default();
        let links = links.get_mut(..used_links).unwrap_or_default();
        for node in nodes.iter().filter(|node| node.is_leaf()) {
            stats.leaves += 1;
            stats.links += node.count();
            let last = (node.first + node.count()).wrapping_sub(1);
            if node.count() > 0
                && let Some(last) = links.get_mut(last as usize)
            {
                *last = last.marked_last(true);
            }
        }
        Ok((Self { nodes, links }, stats))
    }
}

struct Builder<'b, 's, S: Scalar> {
    shapes: &'b Shapes<'s, S>,
    nodes: &'b mut [OctreeNode<S::Bound>],
    links: &'b mut [ObjectRef],
    used_nodes: usize,
    used_links: usize,
    leaf_size: u32,
    variant: OctreeVariant,
    link: LinkBy,
}

impl<S: Scalar> Builder<'_, '_, S> {
    /// Splits breadth first, level by level.
    fn grow(&mut self, deepest: u32) -> BuildStats {
        let mut stats = BuildStats::default();
        let (mut done, mut depth) = (0, 1);
        while done < self.used_nodes && depth <= deepest {
            let level_end = self.used_nodes;
            for node in done..level_end {
                let Some(&cell) = self.nodes.get(node) else {
                    break;
                };
                if cell.count() <= self.leaf_size {
                    continue;
                }
                let cell = match self.variant {
                    OctreeVariant::Plain => cell,
                    OctreeVariant::Modified => self.shrink(cell),
                };
                let (cell, split) = self.split(cell);
                match split {
                    Split::Done => {
                        stats.inner += 1;
                        stats.depth = depth;
                    }
                    Split::Futile => {}
                    Split::Full => stats.unsplit += 1,
                }
                if let Some(place) = self.nodes.get_mut(node) {
                    *place = cell;
                }
            }
            done = level_end;
            depth += 1;
        }
        stats
    }

    /// The objects of a leaf.
    fn objects(&self, cell: &OctreeNode<S::Bound>) -> &[ObjectRef] {
        let start = cell.first as usize;
        let end = start + cell.count() as usize;
        self.links.get(start..end).unwrap_or_default()
    }

    /// The cluster box: a cell whose objects' box, cut to the cell, fills less than half of it
    /// becomes that box.
    fn shrink(&self, mut cell: OctreeNode<S::Bound>) -> OctreeNode<S::Bound> {
        let mut cluster = build::empty_box();
        for &object in self.objects(&cell) {
            cluster = build::union(cluster, build::to_bounds(self.shapes.bounds(object)));
        }
        for axis in Axis::ALL {
            cluster.low[axis] = cluster.low[axis].max(cell.bounds.low[axis]);
            cluster.high[axis] = cluster.high[axis].min(cell.bounds.high[axis]);
        }
        type P<S> = <S as Scalar>::Bound;
        let volume = P::<S>::volume(build::side_lengths(&cluster));
        if P::<S>::add_areas(volume, volume) < P::<S>::volume(build::side_lengths(&cell.bounds)) {
            cell.bounds = cluster;
        }
        cell
    }

    /// Makes a leaf an inner node, if possible.
    fn split(&mut self, cell: OctreeNode<S::Bound>) -> (OctreeNode<S::Bound>, Split) {
        let centre = build::centroid(&cell.bounds);
        let mut cells = [OctreeNode::EMPTY; 8];
        for (k, octant) in cells.iter_mut().enumerate() {
            octant.bounds = cell.bounds;
            for (i, axis) in Axis::ALL.into_iter().enumerate() {
                if k >> i & 1 == 0 {
                    octant.bounds.high[axis] = centre[axis];
                } else {
                    octant.bounds.low[axis] = centre[axis];
                }
            }
        }
        let before = self.used_links;
        for octant in &mut cells {
            if !self.distribute(&cell, octant) {
                self.used_links = before;
                return (cell, Split::Full);
            }
        }
        let mut parts = 8;
        if self.variant == OctreeVariant::Modified {
            let all = |octant: &&OctreeNode<S::Bound>| octant.count == cell.count;
            let some = cells.iter().filter(|octant| octant.count() > 0);
            if some.clone().all(|octant| all(&octant)) && some.count() > 1 {
                self.used_links = before;
                return (cell, Split::Futile);
            }
            parts = merge(&mut cells);
        }
        let end = self.used_nodes + parts;
        let Some(room) = self.nodes.get_mut(self.used_nodes..end) else {
            self.used_links = before;
            return (cell, Split::Full);
        };
        for (place, octant) in room.iter_mut().zip(cells) {
            *place = octant;
        }
        let inner = OctreeNode {
            first: self.used_nodes as u32,
            count: parts as u32,
            ..cell
        };
        self.used_nodes = end;
        (inner, Split::Done)
    }

    /// Links into an octant those of its cell's objects that touch it. False if there is no room.
    fn distribute(
        &mut self,
        cell: &OctreeNode<S::Bound>,
        octant: &mut OctreeNode<S::Bound>,
    ) -> bool {
        octant.first = self.used_links as u32;
        for i in 0..cell.count() {
            let Some(&object) = self.links.get((cell.first + i) as usize) else {
                break;
            };
            if overlaps(self.shapes, object, &octant.bounds, self.link) {
                let Some(place) = self.links.get_mut(self.used_links) else {
                    return false;
                };
                *place = object;
                self.used_links += 1;
                octant.count += 1;
            }
        }
        true
    }
}

enum Split {
    Done,
    /// Nothing is separated by it.
    Futile,
    /// There is no room.
    Full,
}

/// Merges, in each half of a cell in which one octant alone holds objects, that octant with the
/// three empty ones; the first axis along which a half qualifies is taken. Returns how many cells
/// are left; they come first.
fn merge<P: BoundScalar>(cells: &mut [OctreeNode<P>; 8]) -> usize {
    for bit in 0..3 {
        let half =
            |side: usize| (cells.iter().enumerate()).filter(move |(k, _)| k >> bit & 1 == side);
        let lone = |side| half(side).filter(|(_, octant)| octant.count() > 0).count() <= 1;
        if !lone(0) && !lone(1) {
            continue;
        }
        let mut merged = [OctreeNode::EMPTY; 8];
        let mut places = merged.iter_mut();
        let mut parts = 0;
        for side in 0..2 {
            if lone(side) {
                let holder = half(side).find(|(_, octant)| octant.count() > 0);
                let all = half(side).fold(build::empty_box(), |a, (_, octant)| {
                    build::union(a, octant.bounds)
                });
                if let Some(place) = places.next() {
                    *place = holder.map_or(OctreeNode::EMPTY, |(_, octant)| *octant);
                    place.bounds = all;
                    parts += 1;
                }
            } else {
                for (octant, place) in half(side).zip(places.by_ref()) {
                    *place = *octant.1;
                    parts += 1;
                }
            }
        }
        *cells = merged;
        return parts;
    }
    8
}

impl<P: BoundScalar> Octree<'_, P> {
    /// Cells are visited in the order in which the ray enters them.
    #[inline(always)]
    fn walk<S: Scalar<Bound = P>, O: Observer, const ANY: bool, const FEATURES: FeatureSet>(
        &self,
        query: &mut Query<'_, S, O, ANY, FEATURES>,
        stack: &mut TraversalStack<P>,
    ) {
        let origin = query.ray.origin.map(S::to_bound);
        let inv_direction = query.ray.direction.map(S::inv_direction);
        let enter = |node: &OctreeNode<P>, limit: P| {
            let (mut entry, mut exit) = (P::ZERO, limit);
            for axis in Axis::ALL {
                let InvDirection {
                    negative,
                    near,
                    far,
                } = inv_direction[axis];
                let (low, high) = (
                    node.bounds.low[axis].round_down(),
                    node.bounds.high[axis].round_up(),
                );
                let (first, last) = if negative { (high, low) } else { (low, high) };
                entry = entry.max(first.distance(origin[axis], near));
                exit = exit.min(last.distance(origin[axis], far));
            }
            (entry <= exit).then_some(entry)
        };
        let Some(root) = self.nodes.first() else {
            return;
        };
        if enter(root, query.limit.to_bound()).is_none() {
            return;
        }
        stack.0[0] = (0, P::ZERO);
        // At most seven parts of each level wait: a `u8` counts them, see `STACK_SIZE`.
        let mut waiting = 1u8;
        while waiting > 0 {
            waiting -= 1;
            let (place, entry) = stack.0[usize::from(waiting)];
            if entry > query.limit.to_bound() {
                continue;
            }
            let Some(node) = self.nodes.get(place as usize) else {
                continue;
            };
            query.observer.step(1);
            let start = node.first as usize;
            let end = start + node.count() as usize;
            if node.is_leaf() {
                if query.test_list(self.links.get(start..end).unwrap_or_default()) {
                    return;
                }
                continue;
            }
            let base = waiting;
            let parts = self.nodes.get(start..end).unwrap_or_default();
            for (part, place) in parts.iter().zip(node.first..) {
                let Some(entry) = enter(part, query.limit.to_bound()) else {
                    continue;
                };
                let mut at = waiting;
                while at > base && stack.0[usize::from(at - 1)].1 < entry {
                    stack.0[usize::from(at)] = stack.0[usize::from(at - 1)];
                    at -= 1;
                }
                stack.0[usize::from(at)] = (place, entry);
                waiting = waiting.wrapping_add(1);
            }
        }
    }
}

impl<S: Scalar, const FEATURES: FeatureSet> Accelerator<S, FEATURES> for Octree<'_, S::Bound> {
    type Stack = TraversalStack<S::Bound>;

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
