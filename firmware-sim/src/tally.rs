//! Counts of rays, steps and tests in 32 bits, for cores on which 64 cost more.

use octray_core::observe::{Observer, RayKind};
use octray_core::shape::Kind;

/// Counts; they wrap at 2³².
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Rays by [`RayKind`].
    pub rays: [u32; 4],
    /// Shadow rays that met something.
    pub blocked: u32,
    /// Nodes of the tree visited.
    pub steps: u32,
    /// Object tests.
    pub tests: u32,
    /// The most rays that ever waited.
    pub deepest: u32,
}

impl Observer for Tally {
    #[inline(always)]
    fn ray(&mut self, kind: RayKind) {
        let count = &mut self.rays[kind as usize & 3];
        *count = count.wrapping_add(1);
    }
    #[inline(always)]
    fn blocked(&mut self) {
        self.blocked = self.blocked.wrapping_add(1);
    }
    #[inline(always)]
    fn step(&mut self, _children: usize) {
        self.steps = self.steps.wrapping_add(1);
    }
    #[inline(always)]
    fn test(&mut self, _: Kind, _met: bool) {
        self.tests = self.tests.wrapping_add(1);
    }
    #[inline(always)]
    fn pending(&mut self, count: usize) {
        self.deepest = self.deepest.max(count as u32);
    }
}
