//! What the tests of octray share: a slow, obvious renderer to compare the real one with, and
//! random scenes, and octray called as its command calls it.

pub mod oracle;
pub mod shot;
pub mod strew;
