//! The laboratory of octray: measurements, and their analysis.
//!
//! | module | the command of that name |
//! | --- | --- |
//! | [`measure`] | the cost of frames on emulated boards |
//! | [`chart`] | accuracy against cost |
//! | [`plan`] | the least that a scene needs on a microcontroller |
//! | [`schedule`], [`simulate`] | `octray schedule`: how well processors share a picture |
//! | [`tables`] | the thesis's tables |
//! | [`stability`] | where methods hold, degrade and break |
//! | [`report`] | all of it on one page |
//!
//! [`canvas`] is the drawing surface of charts and maps, `page` that of pages; [`budget`] bounds the rays that are traced to find something out.

pub mod budget;
pub mod canvas;
pub mod chart;
pub mod measure;
mod page;
pub mod plan;
pub mod report;
pub mod schedule;
pub mod simulate;
pub mod stability;

pub mod tables;
