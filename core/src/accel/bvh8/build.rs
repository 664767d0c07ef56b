//! The builder of the 8-wide BVH.

use super::Bvh8;
use super::node::{Bvh8Node, ChildWord};
use crate::accel::bound::BoundScalar;
use crate::accel::boxes::to_bounds;
use crate::accel::build::{BuildError, BuildOptions, BuildStats, MAX_DEPTH};
use crate::accel::sah::split_into_groups;
use crate::accel::scalar::AccelScalar;
use crate::object::ObjectRef;
use crate::ray::Aabb;
use crate::shape::Shapes;

/// The memory that a tree is built in, all of it lent.
#[derive(Debug)]
pub struct Bvh8Memory<'a, B> {
    /// Room for inner nodes; at least one. What does not fit stays unsplit.
    pub nodes: &'a mut [Bvh8Node<B>],
    /// One for each object.
    pub links: &'a mut [ObjectRef],
    /// One for each object; free again when the tree is built.
    pub boxes: &'a mut [Aabb<B>],
}

impl<'a, B: BoundScalar> Bvh8<'a, B> {
    /// Builds the tree of all shapes.
    ///
    /// # Errors
    /// If there is not one node, or not a link and a box for each object.
    pub fn build<S: AccelScalar<Bound = B>>(
        shapes: &Shapes<'_, S>,
        memory: Bvh8Memory<'a, B>,
        options: BuildOptions,
    ) -> Result<(Self, BuildStats), BuildError> {
        let Bvh8Memory {
            nodes,
            links,
            boxes,
        } = memory;
        let count = shapes.len();
        let too_small = BuildError {
            nodes: 1,
            links: count,
        };
        let links = links.get_mut(..count).ok_or(too_small)?;
        let boxes = boxes.get_mut(..count).ok_or(too_small)?;
        *nodes.first_mut().ok_or(too_small)? = Bvh8Node::EMPTY;
        for ((link, bounds), object) in links.iter_mut().zip(&mut *boxes).zip(shapes.refs()) {
            *link = object;
            *bounds = to_bounds(shapes.bounds(object));
        }
        let mut stats = BuildStats {
            links: count as u32,
            ..BuildStats::default()
        };
        let used = if count == 0 {
            0
        } else {
            grow(nodes, links, boxes, options, &mut stats)
        };
        Ok((
            Self {
                nodes: nodes.get(..used).unwrap_or_default(),
                links,
            },
            stats,
        ))
    }
}

/// Splits breadth first. A node that is not built yet holds its range of objects and its depth in the words
/// of its children, so that no other memory is needed. Returns how many nodes there are.
fn grow<B: BoundScalar>(
    nodes: &mut [Bvh8Node<B>],
    links: &mut [ObjectRef],
    boxes: &mut [Aabb<B>],
    options: BuildOptions,
    stats: &mut BuildStats,
) -> usize {
    let leaf_size = options.leaf_size.max(1) as usize;
    let deepest = options.depth.clamp(1, MAX_DEPTH);
    if let Some(root) = nodes.first_mut() {
        *root = Bvh8Node::unbuilt(0, links.len(), 1);
    }
    let (mut done, mut used) = (0, 1);
    while done < used {
        let Some(&unbuilt) = nodes.get(done) else {
            break;
        };
        let [start, end, depth, ..] = unbuilt.children;
        stats.inner += 1;
        stats.depth = stats.depth.max(depth);
        let mut node = Bvh8Node::EMPTY;
        let (groups, count) =
            split_into_groups(start as usize, end as usize, links, boxes, leaf_size);
        for (child, group) in groups.iter().enumerate().take(count) {
            let fits = group.len() <= leaf_size;
            let room = nodes.get_mut(used).filter(|_| !fits && depth < deepest);
            let word = if let Some(room) = room {
                *room = Bvh8Node::unbuilt(group.start, group.end, depth + 1);
                used += 1;
                used as u32 - 1
            } else {
                stats.leaves += 1;
                stats.unsplit += u32::from(!fits && depth < deepest);
                if let Some(last) = links.get_mut(group.end.wrapping_sub(1)) {
                    *last = last.marked_last(true);
                }
                ChildWord::LEAF | group.start as u32
            };
            node.set(child, &group.bounds, word);
        }
        if let Some(place) = nodes.get_mut(done) {
            *place = node;
        }
        done += 1;
    }
    used
}
