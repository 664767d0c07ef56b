//! Renders scenes on threads, in any arithmetic with any tree, chosen at run time.
//!
//! The modules, in the order of the data:
//!
//! | module | does |
//! | --- | --- |
//! | [`engine`] | a scene made ready in one arithmetic with one tree, whoever traces it |
//! | [`packets`], [`deal`], [`threads`], [`assembly`] | the picture cut into tiles, scheduled on threads, put together |
//! | [`mod@trace`], [`stats`] | a scene traced, and what it cost |
//! | [`cost`] | what parts of a picture cost, estimated from counted events |
//! | [`picture`], [`output`] | pictures, and files that appear whole or not at all |
//! | [`metric`], [`heat`] | how far apart two pictures are, in numbers and as a picture |
//! | [`facts`] | what is in a scene, counted |
//! | [`interrupt`], [`progress`], [`error`] | a request to stop, how far the work is, what can go wrong |

mod apart;
pub mod assembly;
mod build;
pub mod cost;
pub mod deal;
pub mod engine;
pub mod error;
pub mod facts;
mod grown;
pub mod heat;
pub mod interrupt;
pub mod metric;
pub mod output;
pub mod packet;
pub mod packets;
pub mod picture;
pub mod progress;
mod ready;
pub mod stats;
pub mod threads;
pub mod trace;
pub mod work;

pub use engine::Engine;
