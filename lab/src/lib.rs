//! The laboratory of octray: what measures it, and what the measurements say.
//!
//! | module | the command of that name |
//! | --- | --- |
//! | [`measure`] | what frames cost on emulated boards |
//! | [`chart`] | speed against accuracy |
//! | [`plan`] | the least a scene needs on a small target |
//! | [`schedule`], [`simulate`] | `octray schedule`: how well a picture is shared among processors |
//! | [`tables`] | the thesis's tables |
//! | [`stability`] | where methods hold, degrade and break |
//! | [`report`] | all of it on one page |
//!
//! [`canvas`] is what charts and maps are drawn on.

pub mod canvas;
pub mod chart;
pub mod measure;
pub mod plan;
pub mod report;
pub mod schedule;
pub mod simulate;
pub mod stability;

pub mod tables;
