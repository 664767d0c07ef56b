//! What figure 12 of the thesis adds to the plain octree: cluster boxes, the parting of two objects,
//! and merging.

use super::node::{CLUSTER, LEAF, OctreeNode};
use crate::accel::bound::BoundScalar;
use crate::accel::boxes::{empty_box, intersection, side_lengths, union, widened};
use crate::ray::Aabb;
use crate::vec3::Axis;

/// The cluster box of a cell whose objects lie in a box: that box cut to the cell, if it fills less
/// than half of the cell. It is wider by the margin within which a ray is known on the grid.
pub(super) fn cluster_box<B: BoundScalar>(cell: &Aabb<B>, objects: &Aabb<B>) -> Option<Aabb<B>> {
    let cluster = intersection(cell, &widened(objects));
    let volume = B::volume(side_lengths(&cluster));
    let half_empty = B::add_areas(volume, volume) < B::volume(side_lengths(cell));
    half_empty.then_some(cluster)
}

/// A cell and the cell's cluster box, which takes over its objects and is the node at `place`.
pub(super) fn with_cluster<B: BoundScalar>(
    cell: OctreeNode<B>,
    cluster: Aabb<B>,
    place: usize,
) -> [OctreeNode<B>; 2] {
    let inside = OctreeNode {
        bounds: cluster,
        ..cell
    };
    let around = OctreeNode {
        first: place as u32,
        count: CLUSTER | 1,
        ..cell
    };
    [around, inside]
}

/// The two parts of a cell of two objects whose boxes are apart by more than the margin on some axis:
/// the cell is divided in the middle of the widest gap. Each part keeps its object's link.
pub(super) fn parted<B: BoundScalar>(
    cell: &OctreeNode<B>,
    boxes: &[Aabb<B>; 2],
) -> Option<[OctreeNode<B>; 2]> {
    let [first, second] = boxes;
    let mut best: Option<(B, Axis, B, bool)> = None;
    for axis in Axis::ALL {
        for (below, above, swapped) in [(first, second, false), (second, first, true)] {
            let (from, to) = (below.high[axis], above.low[axis]);
            if from.raised() < to.lowered() {
                let gap = to.difference(from);
                if best.is_none_or(|(widest, ..)| widest < gap) {
                    best = Some((gap, axis, from.midpoint(to), swapped));
                }
            }
        }
    }
    let (_, axis, plane, swapped) = best?;
    let part = |object: u32| OctreeNode {
        bounds: cell.bounds,
        first: cell.first + object,
        count: LEAF | 1,
    };
    let (mut below, mut above) = (part(u32::from(swapped)), part(u32::from(!swapped)));
    below.bounds.high[axis] = plane;
    above.bounds.low[axis] = plane;
    Some([below, above])
}

/// Merges an octant of one object, or an empty one, with three empty ones of the same half of the
/// cell, in both halves if possible, along the axis that merges most. Returns how many cells are
/// left; they come first.
pub(super) fn merge<B: BoundScalar>(cells: &mut [OctreeNode<B>; 8]) -> usize {
    let half = |bit: usize, side: usize| {
        let cells = cells.iter().enumerate();
        cells.filter(move |(k, _)| k >> bit & 1 == side)
    };
    let lone = |bit, side| half(bit, side).map(|(_, cell)| cell.count()).sum::<u32>() <= 1;
    let (mut best, mut most) = (0, 0);
    for bit in 0..3 {
        let merged = usize::from(lone(bit, 0)) + usize::from(lone(bit, 1));
        if merged > most {
            (best, most) = (bit, merged);
        }
    }
    if most == 0 {
        return 8;
    }
    let mut merged = [OctreeNode::EMPTY; 8];
    let mut places = merged.iter_mut();
    let mut parts = 0;
    for side in 0..2 {
        if lone(best, side) {
            let holder = half(best, side).find(|(_, cell)| cell.count() > 0);
            let all = half(best, side).fold(empty_box(), |a, (_, cell)| union(a, cell.bounds));
            if let Some(place) = places.next() {
                *place = holder.map_or(OctreeNode::EMPTY, |(_, cell)| *cell);
                place.bounds = all;
                parts += 1;
            }
        } else {
            for (cell, place) in half(best, side).zip(places.by_ref()) {
                *place = *cell.1;
                parts += 1;
            }
        }
    }
    *cells = merged;
    parts
}
