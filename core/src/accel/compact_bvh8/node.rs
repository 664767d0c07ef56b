//! The words of the compact tree's nodes.

use crate::ray::Aabb;
use crate::vec3::Axis;

/// Words of a node before its children.
pub(super) const HEADER: usize = 2;
/// Words of a child.
pub(super) const CHILD: usize = 2;
/// Marks a child's place as that of a leaf.
pub(super) const LEAF: u32 = 1 << 15;

/// A node without its children, in ticks.
#[derive(Clone, Copy)]
pub(super) struct Header {
    pub(super) origin: [i32; 3],
    pub(super) shift: [u32; 3],
    pub(super) count: usize,
}

impl Header {
    /// The finest steps with which 255 of them span the box.
    pub(super) fn around(bounds: &Aabb<i32>, count: usize) -> Self {
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

    pub(super) fn words(&self) -> [u32; HEADER] {
        let [x, y, z] = self.origin.map(|c| c as u32 & 0xffff);
        let [sx, sy, sz] = self.shift;
        [
            x | y << 16,
            z | (sx | sy << 4 | sz << 8 | (self.count as u32) << 12) << 16,
        ]
    }

    #[inline(always)]
    pub(super) fn read(words: &[u32], at: usize) -> Option<Self> {
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
    pub(super) fn child(&self, bounds: &Aabb<i32>, word: u32) -> [u32; CHILD] {
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
