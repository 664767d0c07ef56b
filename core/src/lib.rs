//! Whitted ray tracing without allocator, generic over its arithmetic.
//!
//! The modules, in the order in which data meets them:
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`scalar`] | the numbers: what the tracer asks of them, floating, approximate and fixed |
//! | [`vec3`], [`ray`] | vectors, rays, boxes |
//! | [`shape`] | spheres, cones, boxes, polygons: where a ray meets them, and their surface there |
//! | [`scene`], [`camera`] | slices of shapes, surfaces and lights; where rays start |
//! | [`features`] | what a scene does without, so that no code for it is linked |
//! | [`accel`] | which shapes a ray has to be tested against: three trees in lent memory, or none |
//! | [`frame`] | a picture, its active region, and the rows that one thread renders |
//! | [`trace`], `shade` | Whitted's recursion on a bounded stack; the light of a surface |
//! | [`observe`] | who counts rays, steps and tests, at no cost if nobody does |
#![no_std]
#![deny(unsafe_code)]

pub mod accel;
pub mod camera;
pub mod features;
pub mod frame;
pub mod object;
pub mod observe;
pub mod ray;
pub mod scalar;
pub mod scene;
mod shade;
pub mod shape;
pub mod trace;
pub mod vec3;
