//! The sweeps, one file per method.

pub mod coincident;
pub mod cone;
pub mod depth;
pub mod glass;
pub mod ground;
pub mod mirror;
pub mod offset;
pub mod plane;
pub mod polygon;
pub mod power;
pub mod range_limits;
pub mod slab;
pub mod sphere;
pub mod subpixel;
pub mod voxel;

use crate::method::Method;

/// Every method.
pub static ALL: &[Method] = &[
    Method::of::<sphere::Sphere>(),
    Method::of::<ground::Ground>(),
    Method::of::<plane::Plane>(),
    Method::of::<polygon::Polygon>(),
    Method::of::<slab::Slab>(),
    Method::of::<cone::Thin>(),
    Method::of::<cone::Apex>(),
    Method::of::<cone::Far>(),
    Method::of::<mirror::Mirror>(),
    Method::of::<glass::Glass>(),
    Method::of::<glass::Critical>(),
    Method::of::<power::Power>(),
    Method::of::<offset::Offset>(),
    Method::of::<voxel::Voxel>(),
    Method::of::<coincident::Coincident>(),
    Method::of::<subpixel::SubPixel>(),
    Method::of::<depth::Depth>(),
    Method::of::<range_limits::RangeLimits>(),
];
