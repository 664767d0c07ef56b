//! Counts of steps and tests in 32 bits, for cores on which 64 cost more.

use octray_core::object::ObjectKind;
use octray_core::observe::{Observer, RayObserver};

/// Counts; they wrap at 2³².
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Nodes of the tree visited.
    pub steps: u32,
    /// Object tests.
    pub tests: u32,
}

impl<S> RayObserver<S> for Tally {}

impl Observer for Tally {
    #[inline(always)]
    fn step(&mut self, _children: usize) {
        self.steps = self.steps.wrapping_add(1);
    }
    #[inline(always)]
    fn test(&mut self, _: ObjectKind, _met: bool) {
        self.tests = self.tests.wrapping_add(1);
    }
}
