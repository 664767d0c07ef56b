//! The builder of the octrees.

use super::node::{LEAF, OctreeNode};
use super::overlap::overlaps;
use super::{LinkBy, Octree, OctreeVariant};
use crate::accel::bound::BoundScalar;
use crate::accel::boxes::{centroid, empty_box, side_lengths, to_bounds, union};
use crate::accel::build::{BuildError, BuildOptions, BuildStats, MAX_DEPTH};
use crate::accel::scalar::AccelScalar;
use crate::object::ObjectRef;
use crate::shape::Shapes;
use crate::vec3::Axis;

impl<'a, B: BoundScalar> Octree<'a, B> {
    /// Builds the octree of all shapes in lent nodes and links. A leaf that should be split but
    /// for which there is no room stays as it is.
    ///
    /// # Errors
    /// If there is not one node, or not one link for each object.
    pub fn build<S: AccelScalar<Bound = B>>(
        shapes: &Shapes<'_, S>,
        nodes: &'a mut [OctreeNode<B>],
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
        let mut bounds = empty_box();
        let all = links.get_mut(..count).ok_or(too_small)?;
        for (link, object) in all.iter_mut().zip(shapes.refs()) {
            *link = object;
            bounds = union(bounds, to_bounds(shapes.bounds(object)));
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

struct Builder<'b, 's, S: AccelScalar> {
    shapes: &'b Shapes<'s, S>,
    nodes: &'b mut [OctreeNode<S::Bound>],
    links: &'b mut [ObjectRef],
    used_nodes: usize,
    used_links: usize,
    leaf_size: u32,
    variant: OctreeVariant,
    link: LinkBy,
}

impl<S: AccelScalar> Builder<'_, '_, S> {
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
                if cell.count() <= self.leaf_size || !self.can_be_separated(&cell) {
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

    /// Whether the objects of a cell are at more places than a leaf may have objects: if not, no
    /// split separates them. Of large leaves only so many places are looked at.
    fn can_be_separated(&self, cell: &OctreeNode<S::Bound>) -> bool {
        const PLACES: usize = 8;
        let most = self.leaf_size.min(PLACES as u32) as usize;
        let mut places = [ObjectRef::default(); PLACES];
        let mut used = 0;
        for &object in self.objects(cell) {
            let known = places.get(..used).unwrap_or_default();
            if known.iter().any(|&place| self.coincide(place, object)) {
                continue;
            }
            match places.get_mut(used) {
                Some(place) if used < most => *place = object,
                _ => return true,
            }
            used += 1;
        }
        false
    }

    /// Whether two objects are in the same cells, whatever the cells.
    fn coincide(&self, a: ObjectRef, b: ObjectRef) -> bool {
        match self.link {
            LinkBy::Shape => self.shapes.coincide(a, b),
            LinkBy::Box => self.shapes.bounds(a) == self.shapes.bounds(b),
        }
    }

    /// The cluster box: a cell whose objects' box, cut to the cell, fills less than half of it
    /// becomes that box.
    fn shrink(&self, mut cell: OctreeNode<S::Bound>) -> OctreeNode<S::Bound> {
        let mut cluster = empty_box();
        for &object in self.objects(&cell) {
            cluster = union(cluster, to_bounds(self.shapes.bounds(object)));
        }
        for axis in Axis::ALL {
            cluster.low[axis] = cluster.low[axis].max(cell.bounds.low[axis]);
            cluster.high[axis] = cluster.high[axis].min(cell.bounds.high[axis]);
        }
        type B<S> = <S as AccelScalar>::Bound;
        let volume = B::<S>::volume(side_lengths(&cluster));
        if B::<S>::add_areas(volume, volume) < B::<S>::volume(side_lengths(&cell.bounds)) {
            cell.bounds = cluster;
        }
        cell
    }

    /// Makes a leaf an inner node, if possible.
    fn split(&mut self, cell: OctreeNode<S::Bound>) -> (OctreeNode<S::Bound>, Split) {
        let centre = centroid(&cell.bounds);
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
fn merge<B: BoundScalar>(cells: &mut [OctreeNode<B>; 8]) -> usize {
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
                let all = half(side).fold(empty_box(), |a, (_, octant)| union(a, octant.bounds));
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
