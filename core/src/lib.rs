//! Whitted ray tracing without allocator, generic over its arithmetic.
//!
//! The modules, in the order in which data passes through them:
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`scalar`], [`quantize`] | number formats: floating, approximate and fixed point; conversion from and to `f64` |
//! | [`vec3`], [`ray`] | vectors, rays, axis-aligned bounding boxes (AABB) |
//! | [`object`], [`shape`] | spheres, cones, boxes, polygons: where a ray meets them, and their surface there |
//! | [`scene`], [`camera`] | slices of shapes, surfaces and lights; where rays start |
//! | [`checker`] | surfaces of two colours |
//! | [`features`] | what a scene uses, so that no code for the rest is linked |
//! | [`accel`] | which objects a ray is tested against: an 8-wide BVH, the same in little memory, octrees, or all of them |
//! | [`trace`], `shade` | Whitted's recursion on a bounded stack; the light of a surface |
//! | [`frame`] | a picture, its active region, and the rows that one thread renders |
//! | [`observe`] | counts of rays, steps and tests, at no cost if nobody counts |
//!
//! All memory is lent by the caller: there is no allocator and no static. No operation panics on
//! any number. The same scene in the same format gives the same bytes on every target. Unsafe code is
//! denied but in one module of two square root instructions (`scalar::root`).
//!
//! The feature `fixed`, off by default, converts [`Fixed`](scalar::Fixed) and [`Fixed64`](scalar::Fixed64) from and to the
//! numbers of the crate `fixed`.
//!
//! A sphere in 16.16 fixed point:
//!
//! ```
//! use octray_core::accel::BruteForce;
//! use octray_core::camera::{Camera, Projection};
//! use octray_core::frame::{Frame, Region};
//! use octray_core::object::{ObjectKind, ObjectRef};
//! use octray_core::quantize::Quantize;
//! use octray_core::scalar::{Fixed, Intensity, Scalar};
//! use octray_core::scene::{Attributes, Light, Scene, Surface};
//! use octray_core::shape::{Shapes, Sphere};
//! use octray_core::trace::Tracer;
//! use octray_core::vec3::{Vec3, vec3};
//!
//! type S = Fixed<16>;
//! let v = |x, y, z| vec3(S::from_f64(x), S::from_f64(y), S::from_f64(z));
//!
//! let spheres = [Sphere { centre: v(0.0, 0.0, 0.0), radius: S::ONE }];
//! let shapes = Shapes { spheres: &spheres, ..Shapes::empty(S::from_f64(0.001)) };
//! let attributes = [Attributes::new(0, 0)];
//! let surfaces = [Surface { diffuse: v(0.9, 0.6, 0.2), ..Surface::default() }];
//! let lights = [Light::new(v(3.0, 4.0, 5.0), v(1.0, 1.0, 1.0))];
//! let scene: Scene<S> = Scene::new(
//!     shapes, &attributes, &surfaces, &lights, Vec3::ZERO, S::from_f64(16.0));
//!
//! let objects = [ObjectRef::new(ObjectKind::Sphere, 0)];
//! let tracer = Tracer {
//!     scene: &scene,
//!     accelerator: &BruteForce(&objects),
//!     max_depth: 0,
//!     cut_off: S::ZERO,
//! };
//! let camera = Camera {
//!     origin: v(0.0, 0.0, 4.0),
//!     forward: v(0.0, 0.0, -1.0),
//!     right: v(0.4, 0.0, 0.0),
//!     up: v(0.0, 0.3, 0.0),
//!     projection: Projection::Perspective,
//! };
//! let frame = Frame::new(camera, 64, 48, 1, 1, Region { columns: 0..64, rows: 0..48 });
//!
//! let mut picture = [[[0u8; 3]; 64]; 48];
//! let (mut stack, mut shadow_cache) = ((), [None; 1]);
//! let mut workspace = tracer.workspace(&mut [], &mut stack, &mut shadow_cache)?;
//! frame.render(0..48, &tracer, &mut workspace, &mut (), |x, y, colour| {
//!     picture[y as usize][x as usize] = colour.to_array().map(S::level);
//! });
//! assert_eq!(picture[0][0], [0, 0, 0]);
//! assert_eq!(picture[20][36], [181, 120, 40]);
//! # Ok::<(), octray_core::trace::WorkspaceTooSmall>(())
//! ```
#![no_std]
#![deny(unsafe_code)]

pub mod accel;
mod array;
pub mod camera;
pub mod checker;
pub mod features;
pub mod frame;
pub mod object;
pub mod observe;
pub mod quantize;
pub mod ray;
pub mod scalar;
pub mod scene;
mod shade;
pub mod shape;
pub mod trace;
pub mod vec3;
pub mod world;

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
