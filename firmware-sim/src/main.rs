//! On a board without operating system: renders the scene that the build script has baked, and tells
//! the picture's hash, what was counted and the deepest stack by semihosting. Exit code 0 if all
//! went well, 101 after a panic, 102 after a fault, 103 if the stack ran out, 104 if rays found no room.
//!
//! Elsewhere: the panel simulator, which draws a scene file as such a board would. Exit codes are
//! those of `octray`.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod board;
#[cfg(not(target_os = "none"))]
mod panel;

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
fn main() -> std::process::ExitCode {
    octray::launch(std::env::args_os(), |args: panel::PanelArgs, interrupt| {
        panel::run(&args.job()?, interrupt)
    })
}
