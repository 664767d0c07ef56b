//! Prepares a parsed scene for tracing.
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`settings`] | the settings of a rendering, with their defaults: [`RenderSettings`] |
//! | [`range`] | whether they are in their ranges |
//! | [`mod@format`], [`dispatch`] | the list of number formats, and the conversion of a name into a type |
//! | [`limits`] | bounds of values that cannot be scaled, so that nothing overflows |
//! | [`mod@quantise`] | places and scales a scene in the numbers of one format |
//! | [`samples`] | how many rays a pixel gets |
//! | [`saturation`] | counts saturations of fixed point per thread |
//! | [`tree`] | builds trees of a quantised scene in heap memory |
//! | [`mod@prepare`] | instantiates quantising and building trees once per format |
//! | [`target`] | the cost of hit tests on a target, which decides how trees are built |
//! | [`plan`] | the settings that are chosen before a scene is baked, and their file |
//! | [`mod@bake`] | writes a scene, its tree and its picture as Rust source, for targets without a file system |
//! | [`literal`] | writes numbers of every format as Rust source |
//! | [`choice`] | names of the values of fixed lists |

pub mod bake;
pub mod choice;
pub mod dispatch;
pub mod format;
pub mod limits;
pub mod literal;
pub mod plan;
pub mod prepare;
pub mod quantise;
pub mod range;
pub mod samples;
pub mod saturation;
pub mod settings;
pub mod target;
pub mod tree;

pub use format::{Arith, Format};
pub use prepare::Prepare;
pub use samples::{Adaptive, Samples};
pub use settings::{
    FirmwareTree, Link, PixelsPerRay, RenderSettings, TreeKind, TreeSettings, Walk,
};

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
