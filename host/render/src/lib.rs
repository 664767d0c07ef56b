//! Renders scenes on threads, in any arithmetic with any tree, chosen at run time.
//!
//! A scene made in code, rendered in fixed point, as a PNG file:
//!
//! ```
//! use octray_render::{Arith, RenderSettings, SceneBuilder, Surface, render};
//!
//! let mut scene = SceneBuilder::look([0.0, 2.0, 6.0], [0.0, 0.7, 0.0], 40.0); // from, at, angle
//! scene.background([0.3, 0.5, 0.8]);
//! scene.light([4.0, 6.0, 4.0], 1.0);
//! scene.sphere([0.0, 1.0, 0.0], 1.0, Surface::glossy([0.8, 0.2, 0.1], 30.0, 0.2));
//! let floor = [[-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0], [-9.0, 0.0, -9.0]];
//! scene.polygon(&floor, Surface::matt([0.6; 3]));
//! let settings = RenderSettings { arith: Arith::I16F16, size: Some((320, 240)), ..Default::default() };
//! let rendering = render(&scene.build()?, &settings)?;
//! println!("{} rays in {:?}", rendering.counters.all_rays(), rendering.render);
//! rendering.save("red-ball.png")?;
//! # std::fs::remove_file("red-ball.png")?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! With [`scenes::read`]`("ball.scene")?` in place of `scene.build()?` the scene comes from a file.
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
/// Scenes: files, [`SceneBuilder`], and the [`model`](octray_scenes::model) of both.
pub use octray_scenes as scenes;
pub use octray_scenes::builder::SceneBuilder;
pub use octray_scenes::model::{Camera, Projection, Scene, Surface};
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
