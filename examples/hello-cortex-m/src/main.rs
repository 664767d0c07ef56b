//! Renders a baked scene on an emulated micro:bit, and prints the picture's hash, which is that of
//! `octray render scenes/figure-22.scene --arith auto --size 64x48`.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use octray_embedded::hash::HashPanel;
use semihosting::{println, process};

octray_embedded::scene! { mod figure = "figure-22"; }

#[entry]
fn main() -> ! {
    // In its place: the driver of your display, any `DrawTarget` of embedded-graphics.
    let mut display = HashPanel::new(figure::WIDTH, figure::HEIGHT);
    let mut renderer = figure::Renderer::new();
    let drawn = renderer.draw(&figure::FRAME, &figure::TRACER, &mut display);
    println!(
        "{} in {}: hash {:016x}",
        figure::NAME,
        figure::ARITH,
        display.hash()
    );
    process::exit(i32::from(drawn.is_err()))
}
