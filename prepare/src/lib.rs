//! From a parsed scene to what octray traces.
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`settings`] | what there is to choose, with its defaults: [`RenderSettings`] |
//! | [`mod@format`], [`dispatch`] | the one list of number formats, and the way from a name to a type |
//! | [`limits`] | what cannot be scaled: bounds of all values, so that nothing overflows |
//! | [`mod@quantise`] | a scene in the numbers of one format, placed and scaled |
//! | [`saturation`] | counts saturations of fixed point, by thread |
//! | [`tree`] | trees of a quantised scene, in memory of their own |
//! | [`mod@prepare`] | quantising and building trees, compiled once for each format |
//! | [`target`] | what a target's core is good at, as far as it decides which tree is best |
//! | [`plan`] | what is chosen about a scene before it is baked, and the file that carries it |
//! | [`mod@bake`] | a scene, its tree and its picture as Rust source, for targets without files |
//! | [`literal`] | numbers of every format as Rust source |
//! | [`choice`] | names of what is chosen from a list |

pub mod bake;
pub mod choice;
pub mod dispatch;
pub mod format;
pub mod limits;
pub mod literal;
pub mod plan;
pub mod prepare;
pub mod quantise;
pub mod saturation;
pub mod settings;
pub mod target;
pub mod tree;

pub use format::{Arith, Format};
pub use prepare::Prepare;
pub use settings::{FirmwareTree, Link, PixelsPerRay, RenderSettings, TreeKind, TreeSettings};

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
