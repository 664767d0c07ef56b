//! What the tests of octray share: a slow, obvious renderer to compare the real one with, and
//! random scenes, and octray called as its command calls it.

pub mod oracle;
pub mod shot;
/// Beside what tests core with it.
#[path = "../../core/tests/support/strew.rs"]
pub mod strew;
