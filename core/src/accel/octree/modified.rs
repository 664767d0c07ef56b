//! What figure 12 of the thesis adds to the plain octree: cluster boxes, the parting of two objects,
//! and merging.

use super::node::{CLUSTER, LEAF, OctreeNode};
use crate::accel::bound::BoundScalar;
use crate::accel::boxes::{intersection, side_lengths, union, widened};
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

/// Merges an octant of one object with the three empty ones of its half of the cell, or the four of an
/// empty half; an empty half is merged first, as no ray tests anything there. No cell that is split has
/// two halves of so few objects. Returns how many cells are left; they come first.
pub(super) fn merge<B: BoundScalar>(cells: &mut [OctreeNode<B>; 8]) -> usize {
    let is_in = |k: usize, (bit, side): (usize, usize)| k >> bit & 1 == side;
    let objects = |half| {
        let cells = cells.iter().enumerate();
        let of_half = cells.filter(move |(k, _)| is_in(*k, half));
        of_half.map(|(_, cell)| cell.count()).sum::<u32>()
    };
    let halves = || (0..3).flat_map(|bit| [(bit, 0), (bit, 1)]);
    let lone = |most| halves().find(|half| objects(*half) <= most);
    let Some(half) = lone(0).or_else(|| lone(1)) else {
        return 8;
    };
    let mut merged = OctreeNode::EMPTY;
    let mut left = [OctreeNode::EMPTY; 8];
    let mut places = left.iter_mut().skip(1);
    for (k, cell) in cells.iter().enumerate() {
        if is_in(k, half) {
            let bounds = union(merged.bounds, cell.bounds);
            if cell.count() > 0 {
                merged = *cell;
            }
            merged.bounds = bounds;
        } else if let Some(place) = places.next() {
            *place = *cell;
        }
    }
    left[0] = merged;
    *cells = left;
    5
}
