//! The builder of the octrees.

use super::modified::{cluster_box, merge, parted, with_cluster};
use super::node::{LEAF, OctreeNode};
use super::overlap::overlaps;
use super::{LinkBy, Octree, OctreeVariant, Walk};
use crate::accel::bound::BoundScalar;
use crate::accel::boxes::{centroid, empty_box, to_bounds, union, widened};
use crate::accel::build::{BuildError, BuildOptions, BuildStats, MAX_DEPTH};
use crate::accel::scalar::AccelScalar;
use crate::object::ObjectRef;
use crate::ray::Aabb;
use crate::shape::Shapes;
use crate::vec3::Axis;
use core::ops::Range;

impl<'a, B: BoundScalar> Octree<'a, B> {
    /// Builds the octree of all shapes in lent nodes and links, to be walked in order. A leaf that
    /// should be split but for which there is no room stays as it is.
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
            bounds: widened(&bounds),
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
        // Up to the maximum of objects, three and more are sorted into the root's octants once.
        let sorted = variant == OctreeVariant::Modified && count <= options.leaf_size as usize;
        let deepest = if sorted {
            1
        } else {
            options.depth.clamp(1, MAX_DEPTH)
        };
        let mut stats = builder.grow(deepest);
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
        let tree = Self {
            nodes,
            links,
            neighbours: &[],
            walk: Walk::Ordered,
        };
        Ok((tree, stats))
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
            if self.variant == OctreeVariant::Modified {
                stats.inner += self.cluster(done..self.used_nodes);
            }
            let level_end = self.used_nodes;
            for node in done..level_end {
                let Some(&cell) = self.nodes.get(node) else {
                    break;
                };
                let parts = match self.plan(&cell) {
                    Plan::Leaf => continue,
                    Plan::Part(parts) => self.append(&parts),
                    Plan::Octants => self.split(&cell),
                };
                let Some(inner) = parts else {
                    stats.unsplit += 1;
                    continue;
                };
                stats.inner += 1;
                stats.depth = depth;
                if let Some(place) = self.nodes.get_mut(node) {
                    (place.first, place.count) = inner;
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

    /// What becomes of a leaf.
    fn plan(&self, cell: &OctreeNode<S::Bound>) -> Plan<S::Bound> {
        if !cell.is_leaf() {
            return Plan::Leaf;
        }
        let most = match self.variant {
            OctreeVariant::Plain => self.leaf_size,
            OctreeVariant::Modified => {
                if let &[a, b] = self.objects(cell) {
                    let boxes = [a, b].map(|object| to_bounds(self.shapes.bounds(object)));
                    return parted(cell, &boxes).map_or(Plan::Leaf, Plan::Part);
                }
                // Three objects and more are split for as far as the depth allows, unless they coincide.
                1
            }
        };
        if cell.count() <= most || !self.can_be_separated(cell, most) {
            return Plan::Leaf;
        }
        Plan::Octants
    }

    /// Whether the objects of a cell are at more than `most` places: if not, no split separates them. Of
    /// large leaves only so many places are looked at.
    fn can_be_separated(&self, cell: &OctreeNode<S::Bound>, most: u32) -> bool {
        const PLACES: usize = 8;
        let most = most.min(PLACES as u32) as usize;
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

    /// Gives cells of two objects and more a cluster box where it fills less than half of them. Returns how many.
    fn cluster(&mut self, level: Range<usize>) -> u32 {
        let mut clusters = 0;
        for node in level {
            let Some(&cell) = self.nodes.get(node) else {
                break;
            };
            let objects = self.objects(&cell);
            if !cell.is_leaf() || objects.len() < 2 {
                continue;
            }
            let bounds = objects.iter().fold(empty_box(), |all, object| {
                union(all, to_bounds(self.shapes.bounds(*object)))
            });
            let Some(cluster) = cluster_box(&cell.bounds, &bounds) else {
                continue;
            };
            let [around, inside] = with_cluster(cell, cluster, self.used_nodes);
            if self.append(&[inside]).is_some()
                && let Some(place) = self.nodes.get_mut(node)
            {
                *place = around;
                clusters += 1;
            }
        }
        clusters
    }

    /// The octants of a leaf, if there is room: the first and the count of its parts.
    fn split(&mut self, cell: &OctreeNode<S::Bound>) -> Option<(u32, u32)> {
        let mut cells = octants(&cell.bounds);
        let before = self.used_links;
        let mut room = cells.iter_mut().all(|octant| self.distribute(cell, octant));
        let mut inner = None;
        if room {
            let parts = match self.variant {
                OctreeVariant::Plain => 8,
                OctreeVariant::Modified => merge(&mut cells),
            };
            inner = self.append(cells.get(..parts).unwrap_or_default());
            room = inner.is_some();
        }
        if !room {
            self.used_links = before;
        }
        inner
    }

    /// Appends the parts of a cell, if there is room: their first and their count.
    fn append(&mut self, parts: &[OctreeNode<S::Bound>]) -> Option<(u32, u32)> {
        let (start, end) = (self.used_nodes, self.used_nodes + parts.len());
        let room = self.nodes.get_mut(start..end)?;
        for (place, part) in room.iter_mut().zip(parts) {
            *place = *part;
        }
        self.used_nodes = end;
        Some((start as u32, parts.len() as u32))
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

/// What becomes of a leaf.
enum Plan<B> {
    /// It stays one.
    Leaf,
    /// It is divided between its two objects.
    Part([OctreeNode<B>; 2]),
    /// It is split into octants.
    Octants,
}

/// The octants of a cell, empty.
fn octants<B: BoundScalar>(cell: &Aabb<B>) -> [OctreeNode<B>; 8] {
    let centre = centroid(cell);
    let mut cells = [OctreeNode::EMPTY; 8];
    for (k, octant) in cells.iter_mut().enumerate() {
        octant.bounds = *cell;
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            if k >> i & 1 == 0 {
                octant.bounds.high[axis] = centre[axis];
            } else {
                octant.bounds.low[axis] = centre[axis];
            }
        }
    }
    cells
}
