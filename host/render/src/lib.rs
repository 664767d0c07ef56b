//! Renders scenes on threads, in any arithmetic with any tree, chosen at run time.
//!
//! ```
//! use octray_render::{Arith, RenderSettings};
//!
//! let scene = octray_scenes::parse(
//!     "v 0 0 500  l 200 300 400 1  f 0.1 0.1 0.1  0.7 0.3 0.2  0.4 0.4 0.4  30 0.2 0  s 0 0 -50 140",
//! )?;
//! for arith in [Arith::F32, Arith::I16F16] {
//!     let settings = RenderSettings { arith, size: Some((64, 48)), ..RenderSettings::default() };
//!     let rendering = octray_render::render(&scene, &settings)?;
//!     println!("{}: {} rays", rendering.format, rendering.counters.all_rays());
//!     # let folder = std::env::temp_dir();
//!     std::fs::write(folder.join(format!("{}.png", rendering.format)), rendering.picture.png()?)?;
//!     # std::fs::remove_file(folder.join(format!("{}.png", rendering.format)))?;
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`renderer`] | a scene prepared in one format with one tree, whoever traces it |
//! | [`schedule`] | how many threads, which tiles, in which order |
//! | [`tile`], [`scheduler`], [`threads`], [`framebuffer`] | the picture cut into tiles, assigned to threads, put together |
//! | [`wire`] | lines where the object that is seen changes |
//! | [`adaptive`] | antialiasing with more rays only where neighbouring ones differ |
//! | [`mod@render`], [`stats`] | a scene rendered, and what it cost |
//! | [`pixel_trace`] | what the rays of one pixel meet |
//! | [`cost`] | what parts of a picture cost, estimated from counted events |
//! | [`picture`], [`output`] | pictures, and files that are written atomically |
//! | [`scene_file`] | reads scenes for commands, telling their warnings |
//! | [`metric`], [`heat`] | how far apart two pictures are, in numbers and as a picture |
//! | [`counts`] | what is in a scene, counted |
//! | [`interrupt`], [`progress`], [`error`] | a request to stop and a budget of rays, how far the work is, what can go wrong |

pub mod adaptive;
mod build;
mod cache_padded;
pub mod cost;
pub mod counts;
pub mod error;
pub mod framebuffer;
pub mod heat;
pub mod interrupt;
pub mod metric;
pub mod output;
mod owned;
pub mod picture;
pub mod pixel_trace;
mod prepared;
pub mod progress;
pub mod render;
pub mod renderer;
pub mod scene_file;
pub mod schedule;
pub mod scheduler;
pub mod stats;
pub mod threads;
pub mod tile;
mod watch;
pub mod wire;

pub use error::Error;
pub use octray_prepare::{
    Adaptive, Arith, Format, PixelsPerRay, RenderSettings, TreeKind, TreeSettings,
};
pub use picture::Picture;
pub use render::{Rendering, render};
pub use schedule::Schedule;

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// So are those of the project's.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct ProjectReadme;
