//! The splitting of a range of boxes by the surface area heuristic.

use super::bound::BoundScalar;
use super::boxes::{centroid, empty_box, side_lengths, union};
use crate::object::ObjectRef;
use crate::ray::Aabb;
use crate::vec3::Axis;

/// How many children a node has at most.
pub(super) const WIDTH: usize = 8;

/// A range of objects that one child will hold.
#[derive(Clone, Copy)]
pub(super) struct Group<B> {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) bounds: Aabb<B>,
}

impl<B: BoundScalar> Group<B> {
    pub(super) fn of(start: usize, end: usize, boxes: &[Aabb<B>]) -> Self {
        let bounds = (boxes.get(start..end).unwrap_or_default().iter())
            .fold(empty_box(), |a, b| union(a, *b));
        Self { start, end, bounds }
    }

    pub(super) fn len(&self) -> usize {
        self.end - self.start
    }
}

/// Divides a range of objects into up to eight groups: the group of the largest surface is split
/// again and again, until each fits a leaf or there are eight.
pub(super) fn split_into_groups<B: BoundScalar>(
    start: usize,
    end: usize,
    links: &mut [ObjectRef],
    boxes: &mut [Aabb<B>],
    leaf_size: usize,
) -> ([Group<B>; WIDTH], usize) {
    let mut groups = [Group::of(start, end, boxes); WIDTH];
    let mut count = 1;
    while count < WIDTH {
        let mut largest: Option<(B::Area, usize)> = None;
        for (i, group) in groups.iter().enumerate().take(count) {
            let area = B::half_area(side_lengths(&group.bounds));
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
    // A query for any hit tries the children in this order: the largest is the likeliest.
    groups
        .get_mut(..count)
        .unwrap_or_default()
        .sort_unstable_by(|a, b| {
            let area = |group: &Group<B>| B::half_area(side_lengths(&group.bounds));
            area(b)
                .partial_cmp(&area(a))
                .unwrap_or(core::cmp::Ordering::Equal)
        });
    (groups, count)
}

const BINS: usize = 16;

/// Splits a range of boxes in two by the surface area heuristic (Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007): the best of 15 planes on each axis between
/// centroids. Returns how many come first; the boxes and the elements that belong to them are
/// reordered. Boxes whose centroids coincide are split half and half.
pub(super) fn partition<B: BoundScalar, T: Copy>(boxes: &mut [Aabb<B>], things: &mut [T]) -> usize {
    let mut middles = empty_box();
    for bounds in boxes.iter() {
        let m = centroid(bounds);
        middles = union(middles, Aabb { low: m, high: m });
    }
    let mut best: Option<(B::Area, Axis, u32)> = None;
    for axis in Axis::ALL {
        let (low, high) = (middles.low[axis], middles.high[axis]);
        if low >= high {
            continue;
        }
        let mut counts = [0u32; BINS];
        let mut unions = [empty_box::<B>(); BINS];
        for bounds in boxes.iter() {
            let bin = centroid(bounds)[axis].bin_index(low, high, BINS as u32) as usize;
            counts[bin] += 1;
            unions[bin] = union(unions[bin], *bounds);
        }
        // Costs of all that lies above each plane, from the top down; then those below, upwards.
        let mut above = [B::NO_AREA; BINS];
        let (mut count, mut whole) = (0, empty_box());
        for bin in (1..BINS).rev() {
            count += counts[bin];
            whole = union(whole, unions[bin]);
            above[bin] = B::scale_area(B::half_area(side_lengths(&whole)), count);
        }
        let total = boxes.len() as u32;
        let (mut count, mut whole) = (0, empty_box());
        for bin in 1..BINS {
            count += counts[bin - 1];
            whole = union(whole, unions[bin - 1]);
            if count == 0 || count == total {
                continue;
            }
            let cost = B::add_areas(
                B::scale_area(B::half_area(side_lengths(&whole)), count),
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
        let below = |b: &Aabb<B>| centroid(b)[axis].bin_index(low, high, BINS as u32) < plane;
        if boxes.get(i).is_some_and(below) {
            swap(boxes, first, i);
            swap(things, first, i);
            first += 1;
        }
    }
    first
}

/// `slice::swap` without a panic: indices out of range do nothing.
fn swap<T: Copy>(things: &mut [T], a: usize, b: usize) {
    if let (Some(&x), Some(&y)) = (things.get(a), things.get(b)) {
        for (place, thing) in [(a, y), (b, x)] {
            if let Some(slot) = things.get_mut(place) {
                *slot = thing;
            }
        }
    }
}
