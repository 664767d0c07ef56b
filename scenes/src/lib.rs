//! scenes
pub mod model;
