//! On a PC: a simulated panel, and its pictures as an animation.

use crate::ball::{Bounce, baked};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use embedded_graphics_simulator::SimulatorDisplay;
use octray_embedded::dither::Dithered;
use octray_embedded::hash::HashPanel;
use octray_render::picture::{Animation, Picture};
use std::error::Error;
use std::fs::File;

/// Until the ball is back where it was.
const PICTURES: u32 = 26;

pub fn run() -> Result<(), Box<dyn Error>> {
    let (width, height) = (baked::WIDTH, baked::HEIGHT);
    let mut bounce = Bounce::new()?;
    let mut file = File::create("bounce.apng")?;
    let mut animation = Animation::begin(&mut file, (width, height), PICTURES, 20)?;
    for _ in 0..PICTURES {
        let mut hash = HashPanel::new(width, height);
        bounce.draw(&mut hash)?;
        println!("{:016x}", hash.hash());
        let mut display = SimulatorDisplay::<Rgb565>::new(Size::new(width, height));
        bounce.draw(&mut Dithered { panel: &mut display, ordered: true })?;
        animation.add(&shown(&display)?)?;
        bounce.step();
        bounce.fits()?;
        bounce.refit();
    }
    animation.finish()?;
    Ok(())
}

/// What the panel shows.
fn shown(display: &SimulatorDisplay<Rgb565>) -> Result<Picture, Box<dyn Error>> {
    let (width, height) = (baked::WIDTH, baked::HEIGHT);
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x as i32, y as i32)));
    let level = |place: (i32, i32)| {
        let colour: Rgb888 = display.get_pixel(place.into()).into();
        [colour.r(), colour.g(), colour.b()]
    };
    Picture::from_levels(width, height, places.map(level).collect()).ok_or("no picture".into())
}
