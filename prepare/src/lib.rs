//! From a parsed scene to what octray traces.
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`settings`] | what there is to choose, with its defaults: [`RenderSettings`] |
//! | [`mod@format`] | the one list of number formats, and the way from a name to a type |
//! | [`mod@quantise`] | a scene in the numbers of one format, placed and scaled |
//! | [`saturation`] | counts saturations of fixed point, by thread |
//! | [`tree`] | trees of a quantised scene, in memory of their own |
//! | [`target`] | what a target's core is good at, as far as it decides which tree is best |
//! | [`plan`] | what is chosen about a scene before it is baked, and the file that carries it |
//! | [`mod@bake`] | a scene, its tree and its picture as Rust source, for targets without files |
//! | [`choice`] | names of what is chosen from a list |

pub mod bake;
pub mod choice;
pub mod format;
pub mod plan;
pub mod quantise;
pub mod saturation;
pub mod settings;
pub mod target;
pub mod tree;

pub use format::{Arith, Format};
pub use settings::{FirmwareTree, Link, PixelsPerRay, RenderSettings, TreeKind, TreeSettings};

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
