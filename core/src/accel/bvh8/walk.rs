//! The walk of a ray through the 8-wide BVH.

use super::Bvh8;
use super::node::{Bvh8Node, ChildWord};
use crate::accel::clip::{ClipBoxes, SlabPlanes};
use crate::accel::inv_direction::InvDirection;
use crate::accel::query::{Query, accelerate};
use crate::accel::sah::WIDTH;
use crate::accel::scalar::AccelScalar;
use crate::accel::stack::TraversalStack;
use crate::array::map3;
use crate::features::FeatureSet;
use crate::observe::Observer;
use crate::ray::Ray;

/// The ray in the numbers of the boxes, prepared once for all nodes.
struct WalkRay<B: ClipBoxes> {
    origin: [B; 3],
    inv_direction: [InvDirection<B>; 3],
    /// Which planes of a node are met first and last on each axis.
    near: [usize; 3],
    far: [usize; 3],
}

impl<B: ClipBoxes> WalkRay<B> {
    #[inline(always)]
    fn new<S: AccelScalar<Bound = B>>(ray: &Ray<S>) -> Self {
        let origin = map3(ray.origin.to_array(), S::to_bound);
        let inv_direction = map3(ray.direction.to_array(), S::inv_direction);
        let pick = |flip: bool| {
            map3([0, 1, 2], |i: usize| {
                if inv_direction[i].negative == flip {
                    i
                } else {
                    i + 3
                }
            })
        };
        Self {
            origin,
            near: pick(false),
            far: pick(true),
            inv_direction,
        }
    }

    #[inline(always)]
    fn slab_planes<'n>(&self, node: &'n Bvh8Node<B>) -> SlabPlanes<'n, B> {
        SlabPlanes {
            near: map3(self.near, |i| &node.planes[i]),
            far: map3(self.far, |i| &node.planes[i]),
        }
    }
}

impl<B: ClipBoxes> Bvh8<'_, B> {
    /// Children are visited in the order in which the ray enters them; a query for any hit takes
    /// them in the order of the node.
    ///
    /// The nearest child is visited next without a push. The stack pointer is a `u8` and the stack
    /// has 256 slots, so indexing needs no bounds check.
    #[inline(always)]
    fn walk<S: AccelScalar<Bound = B>, O: Observer, const ANY: bool, const FEATURES: FeatureSet>(
        &self,
        query: &mut Query<'_, S, O, ANY, FEATURES>,
        stack: &mut TraversalStack<B>,
    ) {
        let Some(mut node) = self.nodes.first() else {
            return;
        };
        let walk = WalkRay::new(query.ray);
        let mut waiting = 0u8;
        loop {
            query.observer.step(WIDTH);
            let limit = query.limit.to_bound();
            let (entry, mut met) = B::clip_boxes(
                walk.slab_planes(node),
                walk.origin,
                &walk.inv_direction,
                limit,
            );
            let mut next = None;
            if met != 0 {
                let mut child = || {
                    let k = met.trailing_zeros() as usize % WIDTH;
                    met &= met - 1;
                    (met == 0, (node.children[k], entry[k]))
                };
                let (mut last, mut first) = child();
                let base = waiting;
                while !last {
                    let mut item;
                    (last, item) = child();
                    if !ANY && item.1 < first.1 {
                        (item, first) = (first, item);
                    }
                    let mut place = waiting;
                    while !ANY && place > base && stack.0[usize::from(place - 1)].1 < item.1 {
                        stack.0[usize::from(place)] = stack.0[usize::from(place - 1)];
                        place -= 1;
                    }
                    stack.0[usize::from(place)] = item;
                    waiting = waiting.wrapping_add(1);
                }
                next = Some(first.0);
            }
            // Test the objects of leaves at once, until there is an inner node to visit.
            node = loop {
                let word = match next.take() {
                    Some(word) => word,
                    None if waiting == 0 => return,
                    None => {
                        waiting -= 1;
                        let (word, entry) = stack.0[usize::from(waiting)];
                        if !ANY && entry > query.limit.to_bound() {
                            continue;
                        }
                        word
                    }
                };
                if word & ChildWord::LEAF == 0 {
                    match self.nodes.get(word as usize) {
                        Some(node) => break node,
                        None => continue,
                    }
                }
                let start = (word & !ChildWord::LEAF) as usize;
                if query.test_list::<true>(self.links.get(start..).unwrap_or(&[])) {
                    return;
                }
            };
        }
    }
}

accelerate!([] Bvh8<'_, S::Bound>, stack: TraversalStack<S::Bound>, scalar: AccelScalar);
