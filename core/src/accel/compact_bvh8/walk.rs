//! The walk of a ray through the compact tree.

use super::node::{CHILD, HEADER, Header, LEAF};
use super::ray::Along;
use super::{CompactBvh8, CompactStack};
use crate::accel::query::{Query, accelerate};
use crate::accel::scalar::AccelScalar;
use crate::array::map3;
use crate::features::FeatureSet;
use crate::observe::Observer;

impl<const ROOM: usize> CompactBvh8<'_, ROOM> {
    /// How far objects are looked for, in ticks, rounded up.
    #[inline(always)]
    fn ticks(&self, limit: i32) -> i32 {
        (limit >> self.tick) + 1
    }

    #[inline(always)]
    fn walk<S: AccelScalar, O: Observer, const ANY: bool, const FEATURES: FeatureSet>(
        &self,
        query: &mut Query<'_, S, O, ANY, FEATURES>,
        stack: &mut CompactStack<ROOM>,
    ) {
        let (o, d) = (query.ray.origin, query.ray.direction);
        let along = [
            Along::new(o.x, d.x, self.tick),
            Along::new(o.y, d.y, self.tick),
            Along::new(o.z, d.z, self.tick),
        ];
        // The bytes of the planes that a ray going down an axis meets in the other order.
        let swapped = (u32::from(along[0].inv_direction < 0) * 0xff)
            | (u32::from(along[1].inv_direction < 0) * 0xff00)
            | (u32::from(along[2].inv_direction < 0) * 0xff_0000);
        let mut limit = self.ticks(query.limit.to_grid());
        let mut at = 0;
        let mut waiting = 0usize;
        while let Some(header) = Header::read(self.words, at) {
            query.observer.step(header.count);
            let [x, y, z] = map3([0, 1, 2], |i: usize| along[i].at(&header, i));
            let base = waiting;
            let first = at + HEADER;
            let children = self.words.get(first..first + header.count * CHILD);
            for &[low, high] in children.unwrap_or_default().as_chunks::<CHILD>().0 {
                let (mut enter, mut exit) = (0, limit << 8);
                let swap = (low ^ high) & swapped;
                let (near, far) = (low ^ swap, high ^ swap);
                let met = x.clip(near & 255, far & 255, &mut enter, &mut exit)
                    && y.clip(near >> 8 & 255, far >> 8 & 255, &mut enter, &mut exit)
                    && z.clip(near >> 16 & 255, far >> 16 & 255, &mut enter, &mut exit);
                if !met || waiting >= ROOM {
                    // Never for want of room: a tree that needs more is refused when it is made.
                    if met {
                        query.observer.dropped_child();
                    }
                    continue;
                }
                let place = low >> 24 | high >> 24 << 8;
                let key = (enter as u32) >> 8 << 16 | place;
                let mut slot = waiting;
                while !ANY && slot > base && stack.0[slot - 1] < key {
                    stack.0[slot] = stack.0[slot - 1];
                    slot -= 1;
                }
                stack.0[slot] = key;
                waiting += 1;
            }
            at = loop {
                if waiting == 0 {
                    return;
                }
                waiting -= 1;
                let Some(&key) = stack.0.get(waiting) else {
                    return;
                };
                if !ANY && (key >> 16) as i32 > limit {
                    continue;
                }
                let place = key & 0xffff;
                if place & LEAF == 0 {
                    break place as usize * CHILD;
                }
                let start = (place & !LEAF) as usize;
                if query.test_list::<false>(self.links.get(start..).unwrap_or_default()) {
                    return;
                }
                limit = self.ticks(query.limit.to_grid());
            };
        }
    }
}

accelerate!([, const ROOM: usize] CompactBvh8<'_, ROOM>, stack: CompactStack<ROOM>, scalar: AccelScalar);
