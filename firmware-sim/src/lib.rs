//! octray where there is little: a scene rendered packet by packet into a strip buffer of a few
//! rows, and each strip drawn into any [`DrawTarget`].
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`mod@render`] | from packets of rays to strips of pixels to a display |
//! | [`dither`] | a display of few colours that shows the mean of more |
//! | [`tally`] | counts of steps and tests in 32 bits |
//! | [`hash`] | a display that keeps nothing but the picture's hash |
//!
//! The binary `octray-firmware` renders the scene that the build script has baked on Cortex-M and
//! RISC-V boards, and tells the picture's hash by semihosting. Where there is an operating system, it
//! is the panel simulator: it reads any scene, and shows what a panel would. `octray-kernels` calls
//! single operations of the tracer, for `octray measure --kernels` to count.
//!
//! [`DrawTarget`]: embedded_graphics_core::draw_target::DrawTarget
#![no_std]
#![forbid(unsafe_code)]

pub mod dither;
pub mod hash;
pub mod render;
pub mod tally;

pub use render::render;
