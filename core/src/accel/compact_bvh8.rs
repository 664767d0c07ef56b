//! The tight tree in less than a quarter of the memory, walked in 16-bit integers whatever the arithmetic: for
//! targets with little memory, no floating-point unit, or no wide multiplication.
//!
//! Coordinates are on the *grid*: [`Scalar::to_grid`] maps a scene's numbers to integers whose
//! differences stay below 2³¹. Boxes and distances are in *ticks*, the power of two of grid units
//! of which the scene's diameter has 2¹³ to 2¹⁴: products of two such numbers fit 32 bits.
//!
//! A node is a run of words, bytes from the lowest:
//!
//! | words | what |
//! | --- | --- |
//! | 1 | its origin's x and y in ticks, 16 bits each: the least corner of all its children's boxes |
//! | 1 | its origin's z, 16 bits; how many bits its steps along x, y and z are shifted by, 4 each; how many children it has |
//! | 2 each | a child: three low planes in steps from the origin, and the low byte of its place; three high planes, and the high byte. The place is that of its first link, marked, or of its node in pairs of words |

use super::build::{self, BuildError, BuildOptions, BuildStats, MAX_DEPTH};
use super::query::Query;
use super::{Accelerator, Hit};
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::ray::{Aabb, Ray};
use crate::scalar::{Scalar, leading_zeros, reciprocal_q15};
use crate::scene::Scene;
use crate::shape::Shapes;
use crate::vec3::Axis;

const HEADER: usize = 2;
const CHILD: usize = 2;
/// Marks a child's place as that of a leaf.
const LEAF: u32 = 1 << 15;

/// The scene's diameter, and with it every difference of two coordinates, is below 2 to this, in ticks.
const REACH_BITS: u32 = 14;
/// How far rounding can bring a distance in ticks off; proved at [`Along`].
const MARGIN: i32 = 4;

/// A finished tree, walked with a stack of so much room.
#[derive(Clone, Copy, Debug)]
pub struct CompactBvh8<'a, const ROOM: usize = COMPACT_STACK_SIZE> {
    /// The nodes, the root first.
    pub words: &'a [u32],
    /// The objects, leaf by leaf, the last of each leaf marked.
    pub links: &'a [ObjectRef],
    /// A tick is 2 to this grid units; at least 1.
    pub tick: u32,
}

/// The nodes and leaves that wait while a packed tree is walked: the ticks at which each is
/// entered in the upper half, its place in the lower one, so that the nearer is the smaller.
/// Depth beyond [`COMPACT_MAX_DEPTH`] is cut off when the tree is built; [`CompactBvh8::waiting`] tells how much less
/// room does.
#[derive(Clone, Copy, Debug)]
pub struct CompactStack<const ROOM: usize = COMPACT_STACK_SIZE>([u32; ROOM]);

/// Room of a [`CompactStack`] that does for any tree.
pub const COMPACT_STACK_SIZE: usize = 64;
/// The deepest packed tree, whose walk fits it: every level leaves seven behind.
pub const COMPACT_MAX_DEPTH: u32 = (COMPACT_STACK_SIZE as u32 - 8) / 7;
const _: () = assert!(COMPACT_MAX_DEPTH <= MAX_DEPTH);

impl<const ROOM: usize> Default for CompactStack<ROOM> {
    fn default() -> Self {
        Self([0; ROOM])
    }
}

impl<'a> CompactBvh8<'a> {
    /// Builds the tree of all shapes of a scene of this diameter in lent words and links, with `boxes`
    /// as scratch memory, one for each object. What finds no room stays unsplit.
    ///
    /// # Errors
    /// If there is no room for one node, or for a link and a box for each object, or if there are
    /// 2¹⁵ objects or more: a child's word has no place for them.
    pub fn build<S: Scalar, const FEATURES: FeatureSet>(
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
            let shape = shapes.bounds(object);
            *bounds = Aabb {
                low: shape.low.map(|x| x.to_grid().saturating_sub(S::GRID_SLACK)),
                high: shape
                    .high
                    .map(|x| x.to_grid().saturating_add(S::GRID_SLACK)),
            };
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
                let group = build::Group::of(start, end, self.boxes);
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
        let (groups, count) =
            build::split_into_groups(start, end, self.links, self.boxes, self.leaf_size);
        let groups = groups.get(..count)?;
        let node = self.words.get_mut(at..at + HEADER + count * CHILD)?;
        let all = groups
            .iter()
            .fold(build::empty_box(), |a, g| build::union(a, g.bounds));
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

/// A box on the grid in ticks, rounded outward.
fn ticks_of(bounds: &Aabb<i32>, tick: u32) -> Aabb<i32> {
    let up = |x: i32| ((i64::from(x) + (1 << tick) - 1) >> tick) as i32;
    Aabb {
        low: bounds.low.map(|x| x >> tick),
        high: bounds.high.map(up),
    }
}

/// A node without its children, in ticks.
#[derive(Clone, Copy)]
struct Header {
    origin: [i32; 3],
    shift: [u32; 3],
    count: usize,
}

impl Header {
    /// The finest steps with which 255 of them span the box.
    fn around(bounds: &Aabb<i32>, count: usize) -> Self {
        Self {
            origin: Axis::ALL.map(|a| bounds.low[a]),
            shift: Axis::ALL.map(|a| {
                let extent = bounds.high[a].wrapping_sub(bounds.low[a]) as u32;
                (0..15)
                    .find(|s| extent.div_ceil(1 << s) <= 255)
                    .unwrap_or(15)
            }),
            count,
        }
    }

    fn words(&self) -> [u32; HEADER] {
        let [x, y, z] = self.origin.map(|c| c as u32 & 0xffff);
        let [sx, sy, sz] = self.shift;
        [
            x | y << 16,
            z | (sx | sy << 4 | sz << 8 | (self.count as u32) << 12) << 16,
        ]
    }

    #[inline(always)]
    fn read(words: &[u32], at: usize) -> Option<Self> {
        let &[first, second] = words.get(at..)?.first_chunk()?;
        Some(Self {
            origin: [
                i32::from(first as i16),
                first as i32 >> 16,
                i32::from(second as i16),
            ],
            shift: [second >> 16 & 15, second >> 20 & 15, second >> 24 & 15],
            count: (second >> 28) as usize,
        })
    }

    /// A child's two words; its box is rounded outward.
    fn child(&self, bounds: &Aabb<i32>, word: u32) -> [u32; CHILD] {
        let (mut low, mut high) = ([0u8; 4], [0u8; 4]);
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            let steps = |x: i32| x.wrapping_sub(self.origin[i]) as u32;
            low[i] = (steps(bounds.low[axis]) >> self.shift[i]).min(255) as u8;
            high[i] = steps(bounds.high[axis])
                .div_ceil(1 << self.shift[i])
                .min(255) as u8;
        }
        [low[3], high[3]] = (word as u16).to_le_bytes();
        [u32::from_le_bytes(low), u32::from_le_bytes(high)]
    }
}

/// A ray along one axis. The distance of a plane is (plane − origin) · slope / 2^shift, with 8
/// bits behind the point: the reciprocal 1/|d| ≤ 2⁷ has 16 bits, so that no product exceeds 2³⁰.
///
/// Distances that matter are below 2¹⁴ ticks. They are off, in ticks, by half a tick of the
/// origin times 1/|d|; by 2 for the reciprocal (relative 2⁻¹³, the same in both products); by 1 for the
/// step's product, 255 · 2⁻⁸; by 1 for the product of the node's origin, the direction's own
/// rounding (2⁻²⁹ over at least 2⁻⁷) and the limit's. `loose` is their sum.
///
/// A ray flatter than 2⁻⁷ drifts by less than diameter/2⁷ along the axis. It is taken for one of 2⁻⁷
/// that is loose by twice the diameter: where it can touch a box within its drift, (low − origin) 2⁷
/// ≤ diameter and (high − origin) 2⁷ ≥ −diameter, so the box is entered before 0 and left after diameter.
#[derive(Clone, Copy)]
struct Along {
    /// In ticks, to nearest.
    origin: i32,
    /// With the direction's sign.
    inv_direction: i32,
    shift: u32,
    loose_q8: i32,
}

/// The least inv_direction, with 30 bits behind the point, that is not flat.
const FLAT_Q30: u32 = 1 << 23;

impl Along {
    #[inline(always)]
    fn new<S: Scalar>(origin: S, direction: S, tick: u32) -> Self {
        let slope_q30 = direction.direction_q30();
        let size = slope_q30.unsigned_abs();
        let flat = size < FLAT_Q30;
        let size = if flat { FLAT_Q30 } else { size };
        // size · 2^zeros / 2³² is in [½, 1), its reciprocal y in (1, 2]; 1/|d| = y 2^(zeros − 2).
        let zeros = leading_zeros(size);
        let inverse = reciprocal_q15(size << zeros >> 16) as i32;
        let shift = 9u32.wrapping_sub(zeros) & 15;
        Self {
            origin: ((origin.to_grid() >> (tick.wrapping_sub(1) & 31)) + 1) >> 1,
            inv_direction: if slope_q30 < 0 { -inverse } else { inverse },
            shift,
            loose_q8: (MARGIN << 8)
                + if flat {
                    2 << (REACH_BITS + 8)
                } else {
                    inverse >> (shift + 1)
                },
        }
    }

    /// Against the planes of one node.
    #[inline(always)]
    fn at(&self, header: &Header, axis: usize) -> Slab {
        let apart = header.origin[axis].wrapping_sub(self.origin);
        let base = apart.wrapping_mul(self.inv_direction) >> self.shift;
        Slab {
            near_q8: base.wrapping_sub(self.loose_q8),
            far_q8: base.wrapping_add(self.loose_q8),
            step_q8: self.inv_direction << header.shift[axis] >> self.shift,
        }
    }
}

/// The planes of one node along one axis, as a ray comes to them: the ticks of the node's origin
/// and per step.
#[derive(Clone, Copy)]
struct Slab {
    near_q8: i32,
    far_q8: i32,
    step_q8: i32,
}

impl Slab {
    /// Narrows the ray to what lies between two planes of a child, the one it comes to first and
    /// the other. False if nothing is left.
    #[inline(always)]
    fn clip(&self, first: u32, second: u32, enter: &mut i32, exit: &mut i32) -> bool {
        let near = (first as i32)
            .wrapping_mul(self.step_q8)
            .wrapping_add(self.near_q8);
        let far = (second as i32)
            .wrapping_mul(self.step_q8)
            .wrapping_add(self.far_q8);
        *enter = near.max(*enter);
        *exit = far.min(*exit);
        *enter <= *exit
    }
}

impl<const ROOM: usize> CompactBvh8<'_, ROOM> {
    /// The most nodes and leaves that can ever wait, whatever the ray: the room that a stack needs.
    pub fn waiting(&self) -> usize {
        self.waiting_below(0, COMPACT_MAX_DEPTH)
    }

    /// The same below a node: all its children, or all but one while that one is walked.
    fn waiting_below(&self, at: usize, levels: u32) -> usize {
        let Some(header) = Header::read(self.words, at).filter(|_| levels > 0) else {
            return 0;
        };
        let first = at + HEADER;
        let children = self.words.get(first..first + header.count * CHILD);
        let place = |&[low, high]: &[u32; CHILD]| low >> 24 | high >> 24 << 8;
        let below = (children.unwrap_or_default().as_chunks::<CHILD>().0.iter())
            .map(place)
            .filter(|place| place & LEAF == 0)
            .map(|place| self.waiting_below(place as usize * CHILD, levels - 1))
            .max();
        header.count - 1 + below.unwrap_or(0).max(1)
    }

    /// How far objects are looked for, in ticks, rounded up.
    #[inline(always)]
    fn ticks(&self, limit: i32) -> i32 {
        (limit >> self.tick) + 1
    }

    #[inline(always)]
    fn walk<S: Scalar, O: Observer, const ANY: bool, const FEATURES: FeatureSet>(
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
        // The bytes of the planes that a ray going down an axis comes to in the other order.
        let swapped = (u32::from(along[0].inv_direction < 0) * 0xff)
            | (u32::from(along[1].inv_direction < 0) * 0xff00)
            | (u32::from(along[2].inv_direction < 0) * 0xff_0000);
        let mut limit = self.ticks(query.limit.to_grid());
        let mut at = 0;
        let mut waiting = 0usize;
        while let Some(header) = Header::read(self.words, at) {
            query.observer.step(header.count);
            let [x, y, z] = [0, 1, 2].map(|i| along[i].at(&header, i));
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
                if query.test_list(self.links.get(start..).unwrap_or_default()) {
                    return;
                }
                limit = self.ticks(query.limit.to_grid());
            };
        }
    }
}

impl<S: Scalar, const FEATURES: FeatureSet, const ROOM: usize> Accelerator<S, FEATURES>
    for CompactBvh8<'_, ROOM>
{
    type Stack = CompactStack<ROOM>;

    #[inline(never)]
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        stack: &mut CompactStack<ROOM>,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        let mut query = Query::<_, _, false, FEATURES>::new(scene, ray, scene.diameter, observer);
        self.walk(&mut query, stack);
        query.hit()
    }

    #[inline(never)]
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        limit: S,
        stack: &mut CompactStack<ROOM>,
        observer: &mut O,
    ) -> Option<ObjectRef> {
        let mut query = Query::<_, _, true, FEATURES>::new(scene, ray, limit, observer);
        self.walk(&mut query, stack);
        query.found
    }
}
