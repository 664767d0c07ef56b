//! A ball bounces on a mirror floor.
//!
//! `cargo run --release` draws some pictures on an emulated micro:bit and prints a hash of each;
//! `cargo run --release --target x86_64-unknown-linux-gnu` draws them on a simulated panel of 16 bits per pixel, and
//! writes them as `bounce.apng`.
#![cfg_attr(target_os = "none", no_std, no_main)]

mod ball;
#[cfg(target_os = "none")]
mod board;
#[cfg(not(target_os = "none"))]
mod panel;

#[cfg(not(target_os = "none"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    panel::run()
}
