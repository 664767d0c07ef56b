//! IEEE 754 binary32 arithmetic with integers, for cores without a floating-point unit. Numbers are passed as their
//! bits; results are rounded to nearest, ties to even, with subnormal numbers, infinities and -0.
//!
//! If an operand is NaN, the result is the first NaN, made quiet ([`sub`] flips the sign of its second operand, even of
//! a NaN). An invalid operation returns `7fc00000`. Normal numbers take the short path through every function; a cold
//! function handles the rest.
//!
//! With the feature `replace`, and on targets whose compiler calls routines for `f32`, the functions also have the
//! names of those routines, and the linker uses them instead.
#![no_std]

mod add;
mod bits;
mod compare;
mod convert;
mod divide;
mod multiply;
#[cfg(all(soft_f32, feature = "replace"))]
mod replace;
mod root;

pub use add::{add, sub};
pub use compare::{equal, less, less_equal, unordered};
pub use convert::{from_i32, from_u32, to_i32, to_u32};
pub use divide::div;
pub use multiply::mul;
pub use root::sqrt;

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
