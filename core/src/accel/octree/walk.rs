//! The walk of a ray through the octrees.

use super::node::OctreeNode;
use super::{Octree, Walk};
use crate::accel::bound::BoundScalar;
use crate::accel::inv_direction::InvDirection;
use crate::accel::query::{Query, accelerate};
use crate::accel::scalar::AccelScalar;
use crate::accel::stack::TraversalStack;
use crate::features::FeatureSet;
use crate::observe::Observer;
use crate::vec3::{Axis, Vec3};

impl<B: BoundScalar> Octree<'_, B> {
    /// Cells are visited in the order in which the ray enters them; of a cell with a cluster box, that box.
    #[inline(always)]
    fn walk<S: AccelScalar<Bound = B>, O: Observer, const ANY: bool, const FEATURES: FeatureSet>(
        &self,
        query: &mut Query<'_, S, O, ANY, FEATURES>,
        stack: &mut TraversalStack<B>,
    ) {
        if self.walk != Walk::Ordered {
            return self.walk_cells(query);
        }
        let origin = query.ray.origin.map(S::to_bound);
        let inv_direction = query.ray.direction.map(S::inv_direction);
        let Some(root) = self.nodes.first() else {
            return;
        };
        if entry_of(root, origin, inv_direction, query.limit.to_bound()).is_none() {
            return;
        }
        stack.0[0] = (0, B::ZERO);
        // At most seven parts of each level wait: a `u8` counts them, see `STACK_SIZE`.
        let mut waiting = 1u8;
        while waiting > 0 {
            waiting -= 1;
            let (place, entry) = stack.0[usize::from(waiting)];
            if entry > query.limit.to_bound() {
                continue;
            }
            let Some(node) = self.nodes.get(place as usize) else {
                continue;
            };
            query.observer.step(1);
            let start = node.first as usize;
            let end = start + node.count() as usize;
            if node.is_leaf() {
                if query.test_list::<false>(self.links.get(start..end).unwrap_or_default()) {
                    return;
                }
                continue;
            }
            let base = waiting;
            let parts = self.nodes.get(start..end).unwrap_or_default();
            for (part, place) in parts.iter().zip(node.first..) {
                let limit = query.limit.to_bound();
                let (part, place) = if part.is_cluster() {
                    let Some(cluster) = self.nodes.get(part.first as usize) else {
                        continue;
                    };
                    (cluster, part.first)
                } else {
                    (part, place)
                };
                let Some(entry) = entry_of(part, origin, inv_direction, limit) else {
                    continue;
                };
                let mut at = waiting;
                while at > base && stack.0[usize::from(at - 1)].1 < entry {
                    stack.0[usize::from(at)] = stack.0[usize::from(at - 1)];
                    at -= 1;
                }
                stack.0[usize::from(at)] = (place, entry);
                waiting = waiting.wrapping_add(1);
            }
        }
    }
}

/// The distance at which a ray enters a node's box, if it does so within `limit`.
#[inline(always)]
fn entry_of<B: BoundScalar>(
    node: &OctreeNode<B>,
    origin: Vec3<B>,
    inv_direction: Vec3<InvDirection<B>>,
    limit: B,
) -> Option<B> {
    let (mut entry, mut exit) = (B::ZERO, limit);
    for axis in Axis::ALL {
        let InvDirection {
            negative,
            near,
            far,
        } = inv_direction[axis];
        let (low, high) = (
            node.bounds.low[axis].round_down(),
            node.bounds.high[axis].round_up(),
        );
        let (first, last) = if negative { (high, low) } else { (low, high) };
        entry = entry.max(first.distance(origin[axis], near));
        exit = exit.min(last.distance(origin[axis], far));
    }
    (entry <= exit).then_some(entry)
}

accelerate!([] Octree<'_, S::Bound>, stack: TraversalStack<S::Bound>, scalar: AccelScalar);
