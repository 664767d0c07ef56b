//! Where the methods of octray hold, where they degrade, and where they break: every form beside
//! its rivals, in every arithmetic, against exact truth.
//!
//! The modules, in the order of the data:
//!
//! | module | |
//! | --- | --- |
//! | [`exact`] | truth: numbers of 512 bits |
//! | [`number`] | the arithmetics under test |
//! | [`random`] | cases |
//! | [`fixtures`], [`mock_accelerator`] | shapes one at a time; the rays that the tracer sends on from them |
//! | [`tally`] | what is measured of a case, and what that is worth: three states |
//! | [`setting`] | the scene that a value stands for: is it admitted? |
//! | [`method`] | a method: its forms, the values swept, the bounds |
//! | [`sweep`] | the methods, a file each |
//! | [`mod@survey`] | all of them measured; limits |
//! | [`record`] | the committed record that the tests hold them to |
//!
//! Truth is what the very numbers say that a method is given: it is not blamed for the rounding of
//! its input, unless a sweep says so.

pub mod exact;
pub mod fixtures;
pub mod method;
pub mod mock_accelerator;
pub mod number;
pub mod random;
pub mod record;
pub mod setting;
pub mod survey;
pub mod sweep;
pub mod tally;
