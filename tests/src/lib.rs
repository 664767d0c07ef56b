//! What the tests of octray share: a slow, obvious renderer to compare the real one with.

pub mod oracle;
