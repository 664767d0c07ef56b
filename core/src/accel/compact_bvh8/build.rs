//! The builder of the compact tree.

use super::node::{CHILD, HEADER, Header, LEAF};
use super::ray::REACH_BITS;
use super::{COMPACT_MAX_DEPTH, CompactBvh8};
use crate::accel::bound::BoundScalar;
use crate::accel::boxes::{empty_box, union};
use crate::accel::build::{BuildError, BuildOptions, BuildStats};
use crate::accel::sah::{Group, split_into_groups};
use crate::accel::scalar::AccelScalar;
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::ray::Aabb;
use crate::shape::Shapes;

impl<'a> CompactBvh8<'a> {
    /// Builds the tree of all shapes of a scene of this diameter in lent words and links, with `boxes`
    /// as scratch memory, one for each object. What finds no room stays unsplit.
    ///
    /// # Errors
    /// If there is no room for one node, or for a link and a box for each object, or if there are
    /// 2¹⁵ objects or more: a child's word has no place for them.
    pub fn build<S: AccelScalar, const FEATURES: FeatureSet>(
        shapes: &Shapes<'_, S, FEATURES>,
        diameter: S,
        words: &'a mut [u32],
        links: &'a mut [ObjectRef],
        boxes: &mut [Aabb<i32>],
        options: BuildOptions,
    ) -> Result<(Self, BuildStats), BuildError> {
        let count = shapes.len();
        let too_small = BuildError {
            nodes: 1,
            links: count,
        };
        if count >= LEAF as usize {
            return Err(too_small);
        }
        let links = links.get_mut(..count).ok_or(too_small)?;
        let boxes = boxes.get_mut(..count).ok_or(too_small)?;
        for ((link, bounds), object) in links.iter_mut().zip(&mut *boxes).zip(shapes.refs()) {
            *link = object;
            *bounds = grid_box(shapes, object);
        }
        let mut stats = BuildStats {
            links: count as u32,
            ..BuildStats::default()
        };
        let mut builder = Builder {
            words,
            links,
            boxes,
            used: 0,
            tick: tick_of(diameter.to_grid()),
            leaf_size: options.leaf_size.max(1) as usize,
        };
        if count > 0 {
            builder.node(0, count).ok_or(too_small)?;
            builder.grow(options.depth.clamp(1, COMPACT_MAX_DEPTH), &mut stats);
        }
        let (used, tick) = (builder.used, builder.tick);
        Ok((
            Self {
                words: words.get(..used).unwrap_or_default(),
                links,
                tick,
            },
            stats,
        ))
    }
}

/// The least shift, but for 0, that brings a diameter, and what rounding adds to it, below
/// 2^`REACH_BITS`.
fn tick_of(diameter: i32) -> u32 {
    let bits = i32::BITS - diameter.saturating_add(diameter >> 8).leading_zeros();
    bits.saturating_sub(REACH_BITS).max(1)
}

struct Builder<'b> {
    words: &'b mut [u32],
    links: &'b mut [ObjectRef],
    boxes: &'b mut [Aabb<i32>],
    used: usize,
    tick: u32,
    leaf_size: usize,
}

impl Builder<'_> {
    /// Splits what is below the root breadth first. Until it is its turn, a child's two words hold
    /// its range of objects, so that no other memory is needed.
    fn grow(&mut self, deepest: u32, stats: &mut BuildStats) {
        let (mut at, mut depth, mut level_end) = (0, 1, self.used);
        while let Some(header) = Header::read(self.words, at) {
            if at >= level_end {
                depth += 1;
                level_end = self.used;
            }
            stats.inner += 1;
            stats.depth = stats.depth.max(depth);
            for k in 0..header.count {
                let slot = at + HEADER + k * CHILD;
                let Some(&[start, end]) = self.words.get(slot..).and_then(|w| w.first_chunk())
                else {
                    break;
                };
                let (start, end) = (start as usize, end as usize);
                let fits = end - start <= self.leaf_size;
                let inner = if fits || depth >= deepest {
                    None
                } else {
                    self.node(start, end)
                };
                let word = inner.unwrap_or_else(|| {
                    stats.leaves += 1;
                    stats.unsplit += u32::from(!fits && depth < deepest);
                    if let Some(last) = self.links.get_mut(end.wrapping_sub(1)) {
                        *last = last.marked_last(true);
                    }
                    LEAF | start as u32
                });
                let group = Group::of(start, end, self.boxes);
                let child = header.child(&ticks_of(&group.bounds, self.tick), word);
                if let Some(place) = self.words.get_mut(slot..).and_then(|w| w.first_chunk_mut()) {
                    *place = child;
                }
            }
            at += HEADER + header.count * CHILD;
            if at >= self.used {
                break;
            }
        }
    }

    /// Writes a node over a range of objects, its children waiting. Returns its word.
    fn node(&mut self, start: usize, end: usize) -> Option<u32> {
        let at = self.used;
        if at / CHILD >= LEAF as usize {
            return None;
        }
        let (groups, count) = split_into_groups(start, end, self.links, self.boxes, self.leaf_size);
        let groups = groups.get(..count)?;
        let node = self.words.get_mut(at..at + HEADER + count * CHILD)?;
        let all = groups.iter().fold(empty_box(), |a, g| union(a, g.bounds));
        let header = Header::around(&ticks_of(&all, self.tick), count);
        let ranges = groups.iter().flat_map(|g| [g.start as u32, g.end as u32]);
        for (place, word) in node
            .iter_mut()
            .zip(header.words().into_iter().chain(ranges))
        {
            *place = word;
        }
        self.used += HEADER + count * CHILD;
        Some((at / CHILD) as u32)
    }
}

/// The box of an object on the grid.
pub(super) fn grid_box<S: AccelScalar, const FEATURES: FeatureSet>(
    shapes: &Shapes<'_, S, FEATURES>,
    object: ObjectRef,
) -> Aabb<i32> {
    let shape = shapes.bounds(object);
    let slack = S::Bound::GRID_SLACK;
    Aabb {
        low: shape.low.map(|x| x.to_grid().saturating_sub(slack)),
        high: shape.high.map(|x| x.to_grid().saturating_add(slack)),
    }
}

/// A box on the grid in ticks, rounded outward.
pub(super) fn ticks_of(bounds: &Aabb<i32>, tick: u32) -> Aabb<i32> {
    let up = |x: i32| ((i64::from(x) + (1 << tick) - 1) >> tick) as i32;
    Aabb {
        low: bounds.low.map(|x| x >> tick),
        high: bounds.high.map(up),
    }
}
