//! IEEE 754 binary32 in integers, for cores without a floating-point unit.
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
