//! The tight tree in a quarter of the memory, walked in 32-bit integers whatever the arithmetic:
//! for targets with little memory, no floating-point unit, or no wide multiplication.
//!
//! Coordinates are on the *grid*: [`Scalar::grid`] maps a scene's numbers to integers whose
//! differences stay below 2³¹. Distances along a ray are in *ticks* of 2⁸ grid units.
//!
//! A node is a run of words:
//!
//! | words | what |
//! | --- | --- |
//! | 3 | its origin, the least corner of all its children's boxes, on the grid |
//! | 1 | how many bits its steps along x, y and z are shifted by, and how many children it has |
//! | 2 each | a child: six planes in steps from the origin (x, y, z low, then high), and a 16-bit word: the place of its first link, marked, or of its node in pairs of words |

use super::build::{self, BuildError, MAX_DEPTH, Options, Summary, WIDTH};
use super::search::Search;
use super::{Accelerator, Hit};
use crate::needs::Needs;
use crate::observe::Observer;
use crate::ray::{Bounds, Ray};
use crate::scalar::{Scalar, multiply};
use crate::scene::Scene;
use crate::shape::{ObjectRef, Shapes};
use crate::vec3::Axis;

const HEADER: usize = 4;
const CHILD: usize = 2;
/// Marks a child's word as that of a leaf.
const LEAF: u32 = 1 << 15;

/// Grid units in a tick.
const TICK_BITS: u32 = 8;
/// How far rounding can bring a distance in ticks off; proved at [`Along`].
const MARGIN: i32 = 4;

/// A finished tree.
#[derive(Clone, Copy, Debug)]
pub struct Packed<'a> {
    /// The nodes, the root first.
    pub words: &'a [u32],
    /// The objects, leaf by leaf, the last of each leaf marked.
    pub links: &'a [ObjectRef],
}

/// The nodes that wait while a packed tree is walked: child words, and the ticks at which they are
/// entered. Depth beyond its room is cut off when the tree is built.
#[derive(Clone, Copy, Debug)]
pub struct PackedStack([(u16, i32); PACKED_STACK]);

/// Room of a [`PackedStack`].
pub const PACKED_STACK: usize = 64;
/// The deepest tree whose walk fits it: every level leaves seven behind.
const DEEPEST: u32 = (PACKED_STACK as u32 - 8) / 7;

impl Default for PackedStack {
    fn default() -> Self {
        Self([(0, 0); PACKED_STACK])
    }
}

impl<'a> Packed<'a> {
    /// Builds the tree of all shapes in lent words and links, with `boxes` as scratch memory, one
    /// for each object. What finds no room stays unsplit.
    ///
    /// # Errors
    /// If there is no room for one node of eight children, or for a link and a box for each
    /// object, or if there are 2¹⁵ objects or more: a child's word has no place for them.
    pub fn build<S: Scalar, const NEEDS: Needs>(
        shapes: &Shapes<'_, S, NEEDS>,
        words: &'a mut [u32],
        links: &'a mut [ObjectRef],
        boxes: &mut [Bounds<i32>],
        options: Options,
    ) -> Result<(Self, Summary), BuildError> {
        let count = shapes.len();
        let too_small = BuildError {
            nodes: 1,
            links: count,
        };
        if words.len() < HEADER + WIDTH * CHILD || count >= LEAF as usize {
            return Err(too_small);
        }
        let links = links.get_mut(..count).ok_or(too_small)?;
        let boxes = boxes.get_mut(..count).ok_or(too_small)?;
        for ((link, bounds), object) in links.iter_mut().zip(&mut *boxes).zip(shapes.refs()) {
            *link = object;
            let shape = shapes.bounds(object);
            *bounds = Bounds {
                low: shape.low.map(|x| x.grid().saturating_sub(S::GRID_SLACK)),
                high: shape.high.map(|x| x.grid().saturating_add(S::GRID_SLACK)),
            };
        }
        let mut summary = Summary {
            links: count as u32,
            ..Summary::default()
        };
        let mut builder = Builder {
            words,
            links,
            boxes,
            used: 0,
            leaf_size: options.leaf_size.max(1) as usize,
        };
        if count > 0 {
            builder.grow(options.depth.clamp(1, DEEPEST.min(MAX_DEPTH)), &mut summary);
        }
        let used = builder.used;
        Ok((
            Self {
                words: words.get(..used).unwrap_or_default(),
                links,
            },
            summary,
        ))
    }
}

struct Builder<'b> {
    words: &'b mut [u32],
    links: &'b mut [ObjectRef],
    boxes: &'b mut [Bounds<i32>],
    used: usize,
    leaf_size: usize,
}

impl Builder<'_> {
    /// Splits breadth first. Until it is its turn, a child's two words hold its range of objects,
    /// so that no other memory is needed.
    fn grow(&mut self, deepest: u32, summary: &mut Summary) {
        self.node(0, self.links.len());
        let (mut at, mut depth, mut level_end) = (0, 1, self.used);
        while let Some(header) = Header::read(self.words, at) {
            if at >= level_end {
                depth += 1;
                level_end = self.used;
            }
            summary.inner += 1;
            summary.depth = summary.depth.max(depth);
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
                    summary.leaves += 1;
                    summary.unsplit += u32::from(!fits && depth < deepest);
                    if let Some(last) = self.links.get_mut(end.wrapping_sub(1)) {
                        *last = last.marked_last(true);
                    }
                    LEAF | start as u32
                });
                let group = build::Group::of(start, end, self.boxes);
                let child = header.child(&group.bounds, word);
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
        let room = self.words.len().checked_sub(at)?;
        if room < HEADER + WIDTH * CHILD || at / CHILD >= LEAF as usize {
            return None;
        }
        let (groups, count) = build::split(start, end, self.links, self.boxes, self.leaf_size);
        let groups = groups.get(..count)?;
        let all = groups
            .iter()
            .fold(build::nothing(), |a, g| build::union(a, g.bounds));
        let header = Header::around(&all, count);
        let ranges = groups.iter().flat_map(|g| [g.start as u32, g.end as u32]);
        for (place, word) in
            (self.words.get_mut(at..)?.iter_mut()).zip(header.words().into_iter().chain(ranges))
        {
            *place = word;
        }
        self.used += HEADER + count * CHILD;
        Some((at / CHILD) as u32)
    }
}

/// A node without its children.
#[derive(Clone, Copy)]
struct Header {
    origin: [i32; 3],
    shift: [u32; 3],
    count: usize,
}

impl Header {
    /// The finest steps with which 255 of them span the box.
    fn around(bounds: &Bounds<i32>, count: usize) -> Self {
        Self {
            origin: Axis::ALL.map(|a| bounds.low[a]),
            shift: Axis::ALL.map(|a| {
                let extent = bounds.high[a].wrapping_sub(bounds.low[a]) as u32;
                (0..24)
                    .find(|s| extent.div_ceil(1 << s) <= 255)
                    .unwrap_or(24)
            }),
            count,
        }
    }

    fn words(&self) -> [u32; HEADER] {
        let [x, y, z] = self.origin;
        let [sx, sy, sz] = self.shift;
        [
            x as u32,
            y as u32,
            z as u32,
            sx | sy << 8 | sz << 16 | (self.count as u32) << 24,
        ]
    }

    #[inline(always)]
    fn read(words: &[u32], at: usize) -> Option<Self> {
        let &[x, y, z, rest] = words.get(at..)?.first_chunk()?;
        Some(Self {
            origin: [x as i32, y as i32, z as i32],
            shift: [rest & 31, rest >> 8 & 31, rest >> 16 & 31],
            count: (rest >> 24) as usize,
        })
    }

    /// A child's two words; its box is rounded outward.
    fn child(&self, bounds: &Bounds<i32>, word: u32) -> [u32; CHILD] {
        let mut planes = [0u8; 6];
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            let steps = |x: i32| x.wrapping_sub(self.origin[i]) as u32;
            planes[i] = (steps(bounds.low[axis]) >> self.shift[i]).min(255) as u8;
            planes[i + 3] = steps(bounds.high[axis])
                .div_ceil(1 << self.shift[i])
                .min(255) as u8;
        }
        let [a, b, c, d, e, f] = planes;
        let [g, h] = (word as u16).to_le_bytes();
        [
            u32::from_le_bytes([a, b, c, d]),
            u32::from_le_bytes([e, f, g, h]),
        ]
    }
}

/// A ray along one axis.
///
/// Beyond a slope of 2⁻⁷ the distance of a plane is a product with the reciprocal 1/|d| ≤ 2⁷. A
/// flatter ray is not asked when it crosses planes of this axis, only whether a box holds one of
/// the coordinates it can take within its reach: a reciprocal would not fit, and a product with
/// it would lose all digits. Errors of the first kind, in ticks: one each for rounding the
/// origin's distance and the step's product, for the reciprocal (relative, the same in both
/// products, so less than 2⁻²⁷ of at most 2²³) and for the direction (2⁻³⁰ of at least 2⁻⁷, over
/// 2²³ ticks). `MARGIN` is their sum.
#[derive(Clone, Copy)]
struct Along {
    origin: i32,
    /// 1/|d| with 24 bits behind the point; 0 for a flat ray.
    inverse_q24: u32,
    negative: bool,
    /// How far a flat ray can go along this axis.
    drift: i32,
}

/// The steepest slope, with 30 bits behind the point, that counts as flat.
const FLAT_Q30: u32 = 1 << 23;

impl Along {
    #[inline(always)]
    fn new<S: Scalar>(origin: S, direction: S, reach: i32) -> Self {
        let slope_q30 = direction.slope_q30();
        let size = slope_q30.unsigned_abs();
        let inverse_q24 = if size <= FLAT_Q30 {
            0
        } else {
            // size · 2^zeros / 2³² is in [½, 1), its reciprocal y in (1, 2]; 1/|d| = y 2^(zeros − 2).
            let zeros = size.leading_zeros();
            let y_q30 = crate::scalar::reciprocal_q30(size << zeros);
            y_q30 >> 8u32.saturating_sub(zeros)
        };
        Self {
            origin: origin.grid(),
            inverse_q24,
            negative: slope_q30 < 0,
            drift: (reach >> 7).saturating_add(MARGIN << TICK_BITS),
        }
    }

    /// Against the planes of one node.
    #[inline(always)]
    fn at(&self, header: &Header, axis: usize) -> Slab {
        let shift = header.shift[axis];
        let apart = header.origin[axis].wrapping_sub(self.origin);
        if self.inverse_q24 == 0 {
            // In steps of the node, rounded outward.
            let low = (-(apart as i64) - i64::from(self.drift)) >> shift;
            let high = (-(apart as i64) + i64::from(self.drift)) >> shift;
            return Slab {
                near: low.clamp(-1, 256) as i32,
                far: high.clamp(-1, 256) as i32,
                step_q16: 0,
                shift: 0,
                negative: false,
            };
        }
        // The inverse is below 2³¹.
        let product = multiply::signed(apart, self.inverse_q24 as i32);
        let product = if self.negative { -product } else { product };
        let ticks = (product >> (24 + TICK_BITS)) as i32;
        Slab {
            near: ticks.wrapping_sub(MARGIN),
            far: ticks.wrapping_add(MARGIN),
            step_q16: self.inverse_q24 >> 8,
            shift: 24u32.saturating_sub(shift),
            negative: self.negative,
        }
    }
}

/// The planes of one node along one axis, as a ray comes to them: the ticks of the node's origin
/// and per step, or for a flat ray (`step_q16` = 0) the steps that it can touch.
#[derive(Clone, Copy)]
struct Slab {
    near: i32,
    far: i32,
    step_q16: u32,
    shift: u32,
    negative: bool,
}

impl Slab {
    /// Narrows the ray to what lies between two planes of a child. False if nothing is left.
    #[inline(always)]
    fn clip(&self, low: u32, high: u32, enter: &mut i32, exit: &mut i32) -> bool {
        if self.step_q16 == 0 {
            return high as i32 >= self.near && low as i32 <= self.far;
        }
        let below = |steps: u32| ((steps * self.step_q16) >> self.shift) as i32;
        let above = |steps: u32| ((steps * (self.step_q16 + 1)) >> self.shift) as i32 + 1;
        let (near, far) = if self.negative {
            (
                self.near.wrapping_sub(above(high)),
                self.far.wrapping_sub(below(low)),
            )
        } else {
            (
                self.near.wrapping_add(below(low)),
                self.far.wrapping_add(above(high)),
            )
        };
        *enter = near.max(*enter);
        *exit = far.min(*exit);
        *enter <= *exit
    }
}

/// A distance on the grid in ticks, rounded up and with the margin.
#[inline(always)]
fn ticks(grid: i32) -> i32 {
    (grid >> TICK_BITS) + 1 + MARGIN
}

impl Packed<'_> {
    #[inline(always)]
    fn walk<S: Scalar, O: Observer, const ANY: bool, const NEEDS: Needs>(
        &self,
        search: &mut Search<'_, S, O, ANY, NEEDS>,
        stack: &mut PackedStack,
    ) {
        let reach = search.limit.grid();
        let (o, d) = (search.ray.origin, search.ray.direction);
        let along = [
            Along::new(o.x, d.x, reach),
            Along::new(o.y, d.y, reach),
            Along::new(o.z, d.z, reach),
        ];
        let mut limit = ticks(reach);
        let mut at = 0;
        let mut waiting = 0usize;
        while let Some(header) = Header::read(self.words, at) {
            search.observer.step();
            let slabs = [0, 1, 2].map(|i| along[i].at(&header, i));
            let base = waiting;
            let children = self.words.get(at + HEADER..).unwrap_or_default();
            for &[first, second] in children.as_chunks::<CHILD>().0.iter().take(header.count) {
                let (mut enter, mut exit) = (0, limit);
                let met = slabs[0].clip(first & 255, first >> 24, &mut enter, &mut exit)
                    && slabs[1].clip(first >> 8 & 255, second & 255, &mut enter, &mut exit)
                    && slabs[2].clip(first >> 16 & 255, second >> 8 & 255, &mut enter, &mut exit);
                if !met || waiting >= PACKED_STACK {
                    continue;
                }
                let mut place = waiting;
                while !ANY && place > base && stack.0[place - 1].1 < enter {
                    stack.0[place] = stack.0[place - 1];
                    place -= 1;
                }
                stack.0[place] = ((second >> 16) as u16, enter);
                waiting += 1;
            }
            at = loop {
                if waiting == 0 {
                    return;
                }
                waiting -= 1;
                let Some(&(word, enter)) = stack.0.get(waiting) else {
                    return;
                };
                if !ANY && enter > limit {
                    continue;
                }
                let word = u32::from(word);
                if word & LEAF == 0 {
                    break word as usize * CHILD;
                }
                let start = (word & !LEAF) as usize;
                if search.list(self.links.get(start..).unwrap_or_default()) {
                    return;
                }
                limit = ticks(search.limit.grid());
            };
        }
    }
}

impl<S: Scalar, const NEEDS: Needs> Accelerator<S, NEEDS> for Packed<'_> {
    type Stack = PackedStack;

    #[inline(never)]
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, NEEDS>,
        ray: &Ray<S>,
        stack: &mut PackedStack,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        let mut search = Search::<_, _, false, NEEDS>::new(scene, ray, scene.reach, observer);
        self.walk(&mut search, stack);
        search.hit()
    }

    #[inline(never)]
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, NEEDS>,
        ray: &Ray<S>,
        limit: S,
        stack: &mut PackedStack,
        observer: &mut O,
    ) -> Option<ObjectRef> {
        let mut search = Search::<_, _, true, NEEDS>::new(scene, ray, limit, observer);
        self.walk(&mut search, stack);
        search.found
    }
}
