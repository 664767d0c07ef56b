//! octray in firmware: a scene rendered into a strip buffer of a few rows, and each strip drawn into any
//! [`DrawTarget`].
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`mod@render`] | from rays to strips of pixels to a display |
//! | [`dither`] | a display of few colours that shows the mean of more |
//! | [`tally`] | counts of steps and tests in 32 bits |
//! | [`hash`] | a display that keeps nothing but the picture's hash |
//!
//! [`DrawTarget`]: embedded_graphics_core::draw_target::DrawTarget
#![no_std]
#![forbid(unsafe_code)]

pub mod dither;
pub mod hash;
pub mod render;
pub mod tally;

pub use render::render;

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
