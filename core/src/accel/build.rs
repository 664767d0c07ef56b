//! What the builders of all trees share: their options, their limits, what they report, and the
//! splitting of a range of boxes by surface area.

use super::BoundScalar;
use crate::object::ObjectRef;
use crate::ray::Aabb;
use crate::scalar::Scalar;
use crate::vec3::{Axis, Vec3, vec3};

/// No tree is deeper than this, whatever the options say: the walk's stack is sized for it.
pub(super) const MAX_DEPTH: u32 = 24;

/// How far a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildOptions {
    /// Inner nodes above any leaf, at most; no more than 24 count.
    pub depth: u32,
    /// A node with no more objects than this is a leaf; at least 1.
    pub leaf_size: u32,
}

/// What was built.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BuildStats {
    /// Inner nodes.
    pub inner: u32,
    /// Leaves, empty ones included where the tree has such.
    pub leaves: u32,
    /// Links from leaves to objects.
    pub links: u32,
    /// The most inner nodes above a leaf.
    pub depth: u32,
    /// Leaves that hold more than the leaf size because the arena was full.
    pub unsplit: u32,
}

/// The lent memory is too small even for an unsplit tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildError {
    /// Nodes needed at least.
    pub nodes: usize,
    /// Links needed at least.
    pub links: usize,
}

/// The box of nothing: any union with it gives the other.
pub(super) fn empty_box<P: BoundScalar>() -> Aabb<P> {
    Aabb {
        low: vec3(P::MAX, P::MAX, P::MAX),
        high: vec3(P::MIN, P::MIN, P::MIN),
    }
}

/// The smallest box around two.
pub(super) fn union<P: BoundScalar>(a: Aabb<P>, b: Aabb<P>) -> Aabb<P> {
    let mut both = a;
    for axis in Axis::ALL {
        both.low[axis] = a.low[axis].min(b.low[axis]);
        both.high[axis] = a.high[axis].max(b.high[axis]);
    }
    both
}

/// A shape's box as planes, exactly.
pub(super) fn to_bounds<S: Scalar>(bounds: Aabb<S>) -> Aabb<S::Bound> {
    Aabb {
        low: bounds.low.map(S::to_bound),
        high: bounds.high.map(S::to_bound),
    }
}

/// The sides of a box, none of them negative.
pub(super) fn side_lengths<P: BoundScalar>(bounds: &Aabb<P>) -> [P; 3] {
    Axis::ALL.map(|a| {
        if bounds.low[a] < bounds.high[a] {
            bounds.high[a].difference(bounds.low[a])
        } else {
            P::ZERO
        }
    })
}

/// The middle of a box.
pub(super) fn centroid<P: BoundScalar>(bounds: &Aabb<P>) -> Vec3<P> {
    let [x, y, z] = Axis::ALL.map(|a| bounds.low[a].midpoint(bounds.high[a]));
    vec3(x, y, z)
}

/// How many children a node has at most.
pub(super) const WIDTH: usize = 8;

/// A range of objects that one child will hold.
#[derive(Clone, Copy)]
pub(super) struct Group<P> {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) bounds: Aabb<P>,
}

impl<P: BoundScalar> Group<P> {
    pub(super) fn of(start: usize, end: usize, boxes: &[Aabb<P>]) -> Self {
        let bounds = (boxes.get(start..end).unwrap_or_default().iter())
            .fold(empty_box(), |a, b| union(a, *b));
        Self { start, end, bounds }
    }

    pub(super) fn len(&self) -> usize {
        self.end - self.start
    }
}

/// Parts a range of objects into up to eight groups: the one of the largest surface is parted
/// again and again, until each fits a leaf or there are eight.
pub(super) fn split_into_groups<P: BoundScalar>(
    start: usize,
    end: usize,
    links: &mut [ObjectRef],
    boxes: &mut [Aabb<P>],
    leaf_size: usize,
) -> ([Group<P>; WIDTH], usize) {
    let mut groups = [Group::of(start, end, boxes); WIDTH];
    let mut count = 1;
    while count < WIDTH {
        let mut largest: Option<(P::Area, usize)> = None;
        for (i, group) in groups.iter().enumerate().take(count) {
            let area = P::half_area(side_lengths(&group.bounds));
            if group.len() > leaf_size && largest.is_none_or(|(a, _)| area > a) {
                largest = Some((area, i));
            }
        }
        let Some((_, i)) = largest else { break };
        let Some(group) = groups.get_mut(i) else {
            break;
        };
        let Group { start, end, .. } = *group;
        let (Some(some_boxes), Some(some_links)) =
            (boxes.get_mut(start..end), links.get_mut(start..end))
        else {
            break;
        };
        let middle = start + partition(some_boxes, some_links);
        *group = Group::of(start, middle, boxes);
        groups[count] = Group::of(middle, end, boxes);
        count += 1;
    }
    // A search for any hit tries the children in this order: the largest is the likeliest.
    groups
        .get_mut(..count)
        .unwrap_or_default()
        .sort_unstable_by(|a, b| {
            let area = |group: &Group<P>| P::half_area(side_lengths(&group.bounds));
            area(b)
                .partial_cmp(&area(a))
                .unwrap_or(core::cmp::Ordering::Equal)
        });
    (groups, count)
}

const BINS: usize = 16;

/// Parts a range of boxes in two by the surface area heuristic (Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007): the best of 15 planes on each axis between
/// middles. Returns how many come first; the boxes and what goes with them are reordered. Boxes
/// whose middles coincide are parted half and half.
pub(super) fn partition<P: BoundScalar, T: Copy>(boxes: &mut [Aabb<P>], things: &mut [T]) -> usize {
    let mut middles = empty_box();
    for bounds in boxes.iter() {
        let m = centroid(bounds);
        middles = union(middles, Aabb { low: m, high: m });
    }
    let mut best: Option<(P::Area, Axis, u32)> = None;
    for axis in Axis::ALL {
        let (low, high) = (middles.low[axis], middles.high[axis]);
        if low >= high {
            continue;
        }
        let mut counts = [0u32; BINS];
        let mut unions = [empty_box::<P>(); BINS];
        for bounds in boxes.iter() {
            let bin = centroid(bounds)[axis].bin_index(low, high, BINS as u32) as usize;
            counts[bin] += 1;
            unions[bin] = union(unions[bin], *bounds);
        }
        // Costs of all that lies above each plane, from the top down; then those below, upwards.
        let mut above = [P::NO_AREA; BINS];
        let (mut count, mut whole) = (0, empty_box());
        for bin in (1..BINS).rev() {
            count += counts[bin];
            whole = union(whole, unions[bin]);
            above[bin] = P::scale_area(P::half_area(side_lengths(&whole)), count);
        }
        let total = boxes.len() as u32;
        let (mut count, mut whole) = (0, empty_box());
        for bin in 1..BINS {
            count += counts[bin - 1];
            whole = union(whole, unions[bin - 1]);
            if count == 0 || count == total {
                continue;
            }
            let cost = P::add_areas(
                P::scale_area(P::half_area(side_lengths(&whole)), count),
                above[bin],
            );
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, bin as u32));
            }
        }
    }
    let Some((_, axis, plane)) = best else {
        return boxes.len() / 2;
    };
    let (low, high) = (middles.low[axis], middles.high[axis]);
    let mut first = 0;
    for i in 0..boxes.len() {
        let below = |b: &Aabb<P>| centroid(b)[axis].bin_index(low, high, BINS as u32) < plane;
        if boxes.get(i).is_some_and(below) {
            swap(boxes, first, i);
            swap(things, first, i);
            first += 1;
        }
    }
    first
}

/// `slice::swap` without a panic: nothing happens to places that are not there.
fn swap<T: Copy>(things: &mut [T], a: usize, b: usize) {
    if let (Some(&x), Some(&y)) = (things.get(a), things.get(b)) {
        for (place, thing) in [(a, y), (b, x)] {
            if let Some(slot) = things.get_mut(place) {
                *slot = thing;
            }
        }
    }
}
