//! On a board without operating system: renders the scene that the build script has baked, and reports the picture's
//! hash, what was counted and the deepest stack by semihosting. Exit code 0 if all went well, 101 after a panic, 102
//! after a fault, 103 if the stack ran out, 104 if rays found no room.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;

// Linked for its names, which are those of the compiler's routines.
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
