//! Calls single operations of the tracer on a board, each many times, for an emulator's plugin to count. Arithmetic and
//! scene are those that the build script baked. Exit codes are those of `octray-firmware`.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;

// Linked for its symbols, which replace the compiler's routines.
#[cfg(all(target_os = "none", feature = "fast-soft-float"))]
use octray_soft_float as _;

/// The baked scene.
#[cfg(target_os = "none")]
#[allow(dead_code, unreachable_pub, reason = "written for any program")]
mod baked {
    include!(concat!(env!("OUT_DIR"), "/baked.rs"));
}

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("octray-kernels runs on boards: octray measure --kernels builds and runs it");
}
