//! On a board: a hash of each picture, by semihosting.

use crate::ball::{Bounce, baked};
use cortex_m_rt::entry;
use octray_embedded::hash::HashPanel;
use semihosting::{println, process};

/// How many pictures.
const PICTURES: u32 = 3;

#[entry]
fn main() -> ! {
    let Ok(mut bounce) = Bounce::new() else {
        println!("no room for the tree");
        process::exit(1);
    };
    for _ in 0..PICTURES {
        // In its place: the driver of your display.
        let mut display = HashPanel::new(baked::WIDTH, baked::HEIGHT);
        if bounce.draw(&mut display).is_err() {
            process::exit(1);
        }
        println!("{:016x}", display.hash());
        bounce.step();
        if bounce.fits().is_err() {
            process::exit(1);
        }
        bounce.refit();
    }
    process::exit(0)
}
