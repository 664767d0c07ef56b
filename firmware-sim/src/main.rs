//! Firmware for a board without an operating system: renders the scene that the build script baked, and reports the
//! picture's hash and the maximum stack depth by semihosting. Exit codes: 0 success, 101 panic, 102 fault, 103 stack
//! overflow, 104 missing capacity for rays.
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
    eprintln!(
        "octray-firmware runs on boards: build it with --target thumbv6m-none-eabi, for example"
    );
    std::process::exit(2);
}
