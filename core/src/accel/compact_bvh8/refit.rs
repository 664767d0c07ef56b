//! Fits the boxes of a compact tree to objects that have moved.

use super::CompactBvh8;
use super::build::{grid_box, ticks_of};
use super::node::{CHILD, HEADER, Header, LEAF};
use super::room::{COMPACT_MAX_DEPTH, StackTooSmall, required};
use crate::accel::boxes::{empty_box, union};
use crate::accel::sah::WIDTH;
use crate::accel::scalar::AccelScalar;
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::ray::Aabb;
use crate::shape::Shapes;

impl<'a, const ROOM: usize> CompactBvh8<'a, ROOM> {
    /// Fits the boxes of a tree, in place, to shapes of the same scene that have moved: which objects share a node stays,
    /// so that rays meet more of them the farther objects have moved from their neighbours, and a tree that is built anew
    /// is then faster to walk. Pictures are the same.
    ///
    /// The words are those of [`CompactBvh8::words`], copied to memory that can be written; `links` and `tick` belong to
    /// the same tree.
    ///
    /// # Errors
    /// As [`CompactBvh8::new`].
    pub fn refit<S: AccelScalar, const FEATURES: FeatureSet>(
        shapes: &Shapes<'_, S, FEATURES>,
        words: &'a mut [u32],
        links: &'a [ObjectRef],
        tick: u32,
    ) -> Result<Self, StackTooSmall> {
        // Which also says that there is an end to going down.
        let needed = required(words, links);
        if needed > ROOM {
            return Err(StackTooSmall { needed });
        }
        if !words.is_empty() {
            refit_node(shapes, words, links, tick, 0, COMPACT_MAX_DEPTH);
        }
        Ok(Self { words, links, tick })
    }
}

/// Fits the boxes below a node, and returns the box of all that is below, on the grid.
fn refit_node<S: AccelScalar, const FEATURES: FeatureSet>(
    shapes: &Shapes<'_, S, FEATURES>,
    words: &mut [u32],
    links: &[ObjectRef],
    tick: u32,
    at: usize,
    levels: u32,
) -> Aabb<i32> {
    // A node has no more children; in words that no builder has made, the others keep their boxes.
    let mut boxes = [empty_box::<i32>(); WIDTH];
    let mut all = empty_box();
    let count = Header::read(words, at).map_or(0, |header| header.count);
    for (k, bounds) in boxes.iter_mut().enumerate().take(count) {
        let place = place_of(words, at + HEADER + k * CHILD);
        *bounds = if place & LEAF != 0 {
            leaf_box(shapes, links, (place & !LEAF) as usize)
        } else if levels > 1 {
            refit_node(
                shapes,
                words,
                links,
                tick,
                place as usize * CHILD,
                levels - 1,
            )
        } else {
            empty_box()
        };
        all = union(all, *bounds);
    }
    let header = Header::around(&ticks_of(&all, tick), count);
    write(words, at, header.words());
    for (k, bounds) in boxes.iter().enumerate().take(count) {
        let slot = at + HEADER + k * CHILD;
        let child = header.child(&ticks_of(bounds, tick), place_of(words, slot));
        write(words, slot, child);
    }
    all
}

fn write(words: &mut [u32], at: usize, new: [u32; 2]) {
    if let Some(old) = words
        .get_mut(at..)
        .and_then(|words| words.first_chunk_mut())
    {
        *old = new;
    }
}

/// A child's place: the high bytes of its two words.
fn place_of(words: &[u32], slot: usize) -> u32 {
    let [low, high] = [slot, slot + 1].map(|i| words.get(i).map_or(0, |word| word >> 24));
    low | high << 8
}

/// The box of the objects of a leaf, on the grid.
fn leaf_box<S: AccelScalar, const FEATURES: FeatureSet>(
    shapes: &Shapes<'_, S, FEATURES>,
    links: &[ObjectRef],
    first: usize,
) -> Aabb<i32> {
    let mut all = empty_box();
    for link in links.get(first..).unwrap_or_default() {
        all = union(all, grid_box(shapes, *link));
        if link.is_last() {
            break;
        }
    }
    all
}
