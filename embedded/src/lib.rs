//! octray in firmware: a scene rendered into a strip buffer of a few rows, and each strip drawn into any
//! [`DrawTarget`].
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`renderer`] | [`Renderer`]: owns the memory to render with, whose size is known when the program is compiled |
//! | [`mod@scene`] | [`scene!`]: a baked scene and the renderer that suits it |
//! | [`tree`] | [`DeviceTree`]: a tree in memory of its own, for things that move |
//! | [`mod@render`] | from rays to strips of pixels to a display, in memory that is lent |
//! | [`dither`], [`diffusion`] | a display of few colours, or of black and white, that shows the mean of more |
//! | [`marks`] | what is to be measured in an emulator |
//! | [`tally`] | counts of steps and tests in 32 bits |
//! | [`hash`] | a display that keeps nothing but the picture's hash |
//!
//! [`DrawTarget`]: embedded_graphics_core::draw_target::DrawTarget
#![no_std]
#![deny(unsafe_code)]

pub mod diffusion;
pub mod dither;
pub mod hash;
pub mod marks;
pub mod render;
pub mod renderer;
pub mod scene;
pub mod tally;
pub mod tree;

pub use render::render;
pub use renderer::{DrawError, Renderer};
pub use tree::DeviceTree;

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
