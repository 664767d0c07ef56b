//! Scene files of octray: all that reads, checks, writes and generates them.
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`mod@parse`] | reads a scene file of either dialect: text to [`model::Scene`] |
//! | [`diagnostic`] | says what is wrong with a file, where, and what was expected |
//! | [`check`] | the promises a scene keeps, for the parser and for scenes made otherwise |
//! | [`model`] | the parsed scene: `f64`, scene units, nothing derived |
//! | [`mod@generate`] | scenes of any size from a seed |
//! | [`mod@quantise`] | a [`model::Scene`] in the numbers of one arithmetic, placed and scaled |
//! | [`tree`] | octrees of a quantised scene, in memory of their own |
//! | [`plan`] | what is chosen about a scene before it is baked, and the file that carries it |
//! | [`target`] | what a target's core is good at, as far as it decides which tree is best |
//! | [`mod@bake`] | a scene, its tree and its picture as Rust source, for targets without files |
//! | [`mod@write`] | a [`model::Scene`] to text that parses to the same |
//!
//! ```
//! let scene = octray_scenes::parse("v 0 0 500  f 1 0.5 0.2 0.8 0.2 10 0 1  s 0 0 -50 40")?;
//! assert_eq!(scene.objects.len(), 1);
//!
//! let source = "v 0 0 500\ns 1 2 3";
//! let mistakes = octray_scenes::parse(source).unwrap_err();
//! assert!(mistakes.draw("my.scene", source).starts_with("my.scene:2:1: error: "));
//! # Ok::<(), octray_scenes::diagnostic::Diagnostics>(())
//! ```

pub mod bake;
pub mod check;
pub mod diagnostic;
pub mod generate;
pub mod model;
pub mod parse;
pub mod plan;
pub mod quantise;
pub mod saturation;
pub mod target;
pub mod tree;
pub mod write;

pub use generate::generate;
pub use parse::{ReadError, parse, read};
pub use write::write;
