//! The thesis's two trees: the *plain* octree (Glassner 1984), whose cells are split at the centre
//! into eight octants, and the *modified* one (figure 12), which merges and shrinks cells.
//! Objects are linked into every leaf that they touch.

use super::build::{self, BuildError, MAX_DEPTH, Options, Summary};
use super::search::Search;
use super::touch::touches;
use super::{Accelerator, Hit, Plane, STACK, Slope, Stack};
use crate::observe::Observer;
use crate::ray::{Bounds, Ray};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::{ObjectRef, Shapes};
use crate::vec3::Axis;

/// Which of the thesis's trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Every inner cell has its eight octants, empty ones included.
    Plain,
    /// An octant whose three neighbours in the same half of the cell are empty is merged with
    /// them; a cell whose objects' box fills less than half of it shrinks to that box (the
    /// cluster box); a cell in which splitting separates nothing stays a leaf.
    Modified,
}

/// When an object is linked into a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// When its bounding box meets the cell.
    Box,
    /// When its surface does.
    Shape,
}

/// A cell: a leaf with objects, an empty leaf, or an inner node with up to eight parts.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Octant<P> {
    bounds: Bounds<P>,
    /// The first part's place among the nodes, or the first object's among the links.
    first: u32,
    /// How many parts or objects; `LEAF` tells which.
    count: u32,
}

const LEAF: u32 = 1 << 31;

impl<P: Plane> Octant<P> {
    /// An empty leaf without extent.
    pub const EMPTY: Self = Self {
        bounds: Bounds {
            low: crate::vec3::vec3(P::MAX, P::MAX, P::MAX),
            high: crate::vec3::vec3(P::MIN, P::MIN, P::MIN),
        },
        first: 0,
        count: LEAF,
    };
}

/// A finished octree.
#[derive(Clone, Copy, Debug)]
pub struct Octants<'a, P> {
    /// The cells; the first is the root, parts of a cell are contiguous.
    pub nodes: &'a [Octant<P>],
    /// The objects, leaf by leaf, the last of each leaf marked.
    pub links: &'a [ObjectRef],
}

impl<'a, P: Plane> Octants<'a, P> {
    /// Builds the octree of all shapes in lent nodes and links. A leaf that should be split but
    /// for which there is no room stays as it is.
    ///
    /// # Errors
    /// If there is not one node, or not one link for each object.
    pub fn build<S: Scalar<Plane = P>>(
        shapes: &Shapes<'_, S>,
        nodes: &'a mut [Octant<P>],
        links: &'a mut [ObjectRef],
        options: Options,
        variant: Variant,
        link: Link,
    ) -> Result<(Self, Summary), BuildError> {
        let count = shapes.len();
        if nodes.is_empty() || links.len() < count {
            return Err(BuildError {
                nodes: 1,
                links: count,
            });
        }
        let mut bounds = build::nothing();
        for (i, object) in shapes.refs().enumerate() {
            links[i] = object;
            bounds = build::union(bounds, build::planes(shapes.bounds(object)));
        }
        nodes[0] = Octant {
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
        let mut summary = builder.grow(options.depth.clamp(1, MAX_DEPTH));
        let (used_nodes, used_links) = (builder.used_nodes, builder.used_links);
        let (nodes, links) = (&mut nodes[..used_nodes], &mut links[..used_links]);
        for node in nodes.iter().filter(|node| node.count & LEAF != 0) {
            let count = node.count & !LEAF;
            summary.leaves += 1;
            summary.links += count;
            if count > 0 {
                let last = (node.first + count) as usize - 1;
                links[last] = links[last].marked_last(true);
            }
        }
        Ok((Self { nodes, links }, summary))
    }
}

struct Builder<'b, 's, S: Scalar> {
    shapes: &'b Shapes<'s, S>,
    nodes: &'b mut [Octant<S::Plane>],
    links: &'b mut [ObjectRef],
    used_nodes: usize,
    used_links: usize,
    leaf_size: u32,
    variant: Variant,
    link: Link,
}

impl<S: Scalar> Builder<'_, '_, S> {
    /// Splits breadth first, level by level.
    fn grow(&mut self, deepest: u32) -> Summary {
        let mut summary = Summary::default();
        let (mut done, mut depth) = (0, 1);
        while done < self.used_nodes && depth <= deepest {
            let level_end = self.used_nodes;
            for node in done..level_end {
                if self.nodes[node].count & !LEAF <= self.leaf_size {
                    continue;
                }
                if self.variant == Variant::Modified {
                    self.shrink(node);
                }
                match self.split(node) {
                    Split::Done => {
                        summary.inner += 1;
                        summary.depth = depth;
                    }
                    Split::Futile => {}
                    Split::Full => summary.unsplit += 1,
                }
            }
            done = level_end;
            depth += 1;
        }
        summary
    }

    /// The cluster box: a cell whose objects' box, cut to the cell, fills less than half of it
    /// becomes that box.
    fn shrink(&mut self, node: usize) {
        let cell = self.nodes[node];
        let start = cell.first as usize;
        let mut cluster = build::nothing();
        for &object in &self.links[start..start + (cell.count & !LEAF) as usize] {
            cluster = build::union(cluster, build::planes(self.shapes.bounds(object)));
        }
        for axis in Axis::ALL {
            cluster.low[axis] = cluster.low[axis].upper(cell.bounds.low[axis]);
            cluster.high[axis] = cluster.high[axis].lower(cell.bounds.high[axis]);
        }
        type P<S> = <S as Scalar>::Plane;
        let volume = P::<S>::volume(build::sides(&cluster));
        if P::<S>::sum(volume, volume) < P::<S>::volume(build::sides(&cell.bounds)) {
            self.nodes[node].bounds = cluster;
        }
    }

    /// Makes a leaf an inner node.
    fn split(&mut self, node: usize) -> Split {
        let cell = self.nodes[node];
        let count = (cell.count & !LEAF) as usize;
        let centre = build::middle(&cell.bounds);
        let mut cells = [Octant::EMPTY; 8];
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
            if !self.distribute(&cell, count, octant) {
                self.used_links = before;
                return Split::Full;
            }
        }
        let mut parts = 8;
        if self.variant == Variant::Modified {
            let all = |octant: &Octant<S::Plane>| (octant.count & !LEAF) as usize == count;
            let none = |octant: &Octant<S::Plane>| octant.count == LEAF;
            if cells.iter().all(|octant| all(octant) || none(octant))
                && cells.iter().filter(|c| all(c)).count() > 1
            {
                self.used_links = before;
                return Split::Futile;
            }
            parts = merge(&mut cells);
        }
        let Some(room) = self.nodes.get_mut(self.used_nodes..self.used_nodes + parts) else {
            self.used_links = before;
            return Split::Full;
        };
        room.copy_from_slice(&cells[..parts]);
        self.nodes[node].first = self.used_nodes as u32;
        self.nodes[node].count = parts as u32;
        self.used_nodes += parts;
        Split::Done
    }

    /// Links into an octant those of its cell's objects that touch it. False if there is no room.
    fn distribute(
        &mut self,
        cell: &Octant<S::Plane>,
        count: usize,
        octant: &mut Octant<S::Plane>,
    ) -> bool {
        octant.first = self.used_links as u32;
        for i in 0..count {
            let object = self.links[cell.first as usize + i];
            if touches(self.shapes, object, &octant.bounds, self.link) {
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
fn merge<P: Plane>(cells: &mut [Octant<P>; 8]) -> usize {
    let empty = |octant: &Octant<P>| octant.count == LEAF;
    for bit in 0..3 {
        let mut merged = [Octant::EMPTY; 8];
        let mut parts = 0;
        for side in 0..2 {
            let half = || (0..8usize).filter(move |k| k >> bit & 1 == side);
            let full = half().filter(|&k| !empty(&cells[k])).count();
            if full <= 1 {
                let holder = half().find(|&k| !empty(&cells[k])).unwrap_or(side << bit);
                merged[parts] = Octant {
                    bounds: half().fold(build::nothing(), |a, k| build::union(a, cells[k].bounds)),
                    ..cells[holder]
                };
                parts += 1;
            } else {
                for k in half() {
                    merged[parts] = cells[k];
                    parts += 1;
                }
            }
        }
        if parts < 8 {
            *cells = merged;
            return parts;
        }
    }
    8
}

impl<P: Plane> Octants<'_, P> {
    /// Cells are visited in the order in which the ray enters them.
    #[inline(always)]
    fn walk<S: Scalar<Plane = P>, O: Observer, const ANY: bool>(
        &self,
        search: &mut Search<'_, S, O, ANY>,
        stack: &mut Stack<P>,
    ) {
        let origin = search.ray.origin.map(S::plane);
        let slope = search.ray.direction.map(S::slope);
        let enter = |node: &Octant<P>, limit: P| {
            let (mut entry, mut exit) = (P::ZERO, limit);
            for axis in Axis::ALL {
                let Slope {
                    negative,
                    near,
                    far,
                } = slope[axis];
                let (low, high) = (
                    node.bounds.low[axis].below(),
                    node.bounds.high[axis].above(),
                );
                let (first, last) = if negative { (high, low) } else { (low, high) };
                entry = entry.upper(first.distance(origin[axis], near));
                exit = exit.lower(last.distance(origin[axis], far));
            }
            (entry <= exit).then_some(entry)
        };
        let Some(root) = self.nodes.first() else {
            return;
        };
        if enter(root, search.limit.plane()).is_none() {
            return;
        }
        stack.0[0] = (0, P::ZERO);
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let (place, entry) = stack.0[waiting];
            if entry > search.limit.plane() {
                continue;
            }
            let Some(node) = self.nodes.get(place as usize) else {
                continue;
            };
            search.observer.step();
            if node.count & LEAF != 0 {
                let start = node.first as usize;
                let end = start + (node.count & !LEAF) as usize;
                if search.list(self.links.get(start..end).unwrap_or(&[])) {
                    return;
                }
                continue;
            }
            let base = waiting;
            for place in node.first..node.first + node.count {
                let Some(part) = self.nodes.get(place as usize) else {
                    continue;
                };
                if let Some(entry) = enter(part, search.limit.plane())
                    && waiting < STACK
                {
                    let mut at = waiting;
                    while at > base && stack.0[at - 1].1 < entry {
                        stack.0[at] = stack.0[at - 1];
                        at -= 1;
                    }
                    stack.0[at] = (place, entry);
                    waiting += 1;
                }
            }
        }
    }

    /// The box around everything; inverted if there is nothing.
    pub fn bounds(&self) -> Bounds<P> {
        self.nodes
            .first()
            .map_or_else(build::nothing, |root| root.bounds)
    }
}

impl<S: Scalar> Accelerator<S> for Octants<'_, S::Plane> {
    #[inline(never)]
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S>,
        ray: &Ray<S>,
        stack: &mut Stack<S::Plane>,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        let mut search = Search::<_, _, false>::new(scene, ray, scene.reach, observer);
        self.walk(&mut search, stack);
        search.hit()
    }

    #[inline(never)]
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S>,
        ray: &Ray<S>,
        limit: S,
        stack: &mut Stack<S::Plane>,
        observer: &mut O,
    ) -> Option<ObjectRef> {
        let mut search = Search::<_, _, true>::new(scene, ray, limit, observer);
        self.walk(&mut search, stack);
        search.found
    }
}
