//! Scenes of octray: read from files, made in code, checked, written, generated.
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`mod@parse`] | reads a scene file of either dialect: text to [`model::Scene`] |
//! | [`builder`] | makes a scene in code, with the same checks: calls to [`model::Scene`] |
//! | [`diagnostic`] | describes what is wrong with a file, where, and what was expected |
//! | [`check`] | checks the invariants of a scene, for the parser, the builder and scenes made otherwise |
//! | [`model`] | the scene: `f64`, scene units, nothing derived |
//! | [`reduce`] | leaves out lights, mirrors and glass |
//! | [`mod@generate`] | generates scenes of any size from a seed |
//! | [`input`] | reads whole files, pipes and standard input, up to a bound |
//! | [`name`] | shows the names of files in messages |
//! | [`mod@write`] | writes a [`model::Scene`] as text that parses to the same scene |
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

mod add;
pub mod builder;
pub mod check;
pub mod diagnostic;
pub mod generate;
pub mod input;
pub mod model;
pub mod name;
pub mod parse;
pub mod point;
pub mod reduce;
mod surface;
mod word;
pub mod write;

pub use builder::SceneBuilder;
pub use generate::generate;
pub use parse::{
    ReadError, object_lines, parse, parse_with_warnings, read, read_with_lines, read_with_warnings,
};
pub use write::write;

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
