//! From a parsed scene to what octray traces.
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`mod@quantise`] | a scene in the numbers of one arithmetic, placed and scaled |
//! | [`tree`] | trees of a quantised scene, in memory of their own |
//! | [`target`] | what a target's core is good at, as far as it decides which tree is best |
//! | [`plan`] | what is chosen about a scene before it is baked, and the file that carries it |
//! | [`mod@bake`] | a scene, its tree and its picture as Rust source, for targets without files |

pub mod bake;
pub mod plan;
pub mod quantise;
pub mod target;
pub mod tree;
