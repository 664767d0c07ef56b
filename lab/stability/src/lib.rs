//! Finds where the methods of octray hold, where they degrade, and where they break: every form and its rivals, in
//! every arithmetic, against exact references.
//!
//! The modules, in the order of the data:
//!
//! | module | contents |
//! | --- | --- |
//! | [`exact`] | exact references: numbers of 512 bits |
//! | [`number`] | the tested arithmetics |
//! | [`random`] | random cases |
//! | [`fixtures`], [`mock_accelerator`] | scenes of a single shape; the rays that the tracer sends from them |
//! | [`state`] | the measures of a form, and their rating in three states |
//! | [`setting`] | the scene that belongs to a value, which decides whether the value is admitted |
//! | [`method`] | a method: its forms, the swept values, the limits |
//! | [`sweep`] | the methods, one file each |
//! | [`mod@survey`] | measures all of them; limits |
//! | [`record`] | the committed record that tests compare with |
//!
//! References are computed from the rounded numbers that a method receives. A method is not blamed for the rounding of
//! its input, unless a sweep says so.

pub mod exact;
pub mod fixtures;
pub mod method;
pub mod mock_accelerator;
pub mod number;
pub mod random;
pub mod record;
pub mod setting;
pub mod state;
pub mod survey;
pub mod sweep;
