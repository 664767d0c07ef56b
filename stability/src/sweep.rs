//! The sweeps, one file for each method.

pub mod ground;
pub mod power;
pub mod sphere;

use crate::method::Method;

/// Every method.
pub static ALL: &[Method] = &[
    Method::of::<sphere::Sphere>(),
    Method::of::<ground::Ground>(),
    Method::of::<power::Power>(),
];
