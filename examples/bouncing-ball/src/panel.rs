//! On a PC: a simulated panel of 16 bits per pixel, and its pictures as an animation.

use crate::ball::{Bounce, baked};
use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
use embedded_graphics::geometry::Point;
use embedded_graphics::image::GetPixel;
use embedded_graphics::pixelcolor::raw::{LittleEndian, RawU16};
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use octray_embedded::dither::Dithered;
use octray_embedded::hash::HashPanel;
use std::error::Error;
use std::fs::File;

const WIDTH: usize = baked::WIDTH as usize;
const HEIGHT: usize = baked::HEIGHT as usize;
/// Twice until the ball is back where it was.
const PICTURES: u32 = 26;

type Panel = Framebuffer<
    Rgb565,
    RawU16,
    LittleEndian,
    WIDTH,
    HEIGHT,
    { buffer_size::<Rgb565>(WIDTH, HEIGHT) },
>;

pub fn run() -> Result<(), Box<dyn Error>> {
    let mut bounce = Bounce::new()?;
    let file = File::create("bounce.apng")?;
    let mut encoder = png::Encoder::new(file, baked::WIDTH, baked::HEIGHT);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_animated(PICTURES, 0)?;
    encoder.set_frame_delay(1, 20)?;
    let mut animation = encoder.write_header()?;
    for _ in 0..PICTURES {
        let mut hash = HashPanel::new(baked::WIDTH, baked::HEIGHT);
        bounce.draw(&mut hash)?;
        println!("{:016x}", hash.hash());
        let mut panel = Panel::new();
        bounce.draw(&mut Dithered {
            panel: &mut panel,
            ordered: true,
        })?;
        animation.write_image_data(&shown(&panel))?;
        bounce.step();
        bounce.fits()?;
        bounce.refit();
    }
    animation.finish()?;
    Ok(())
}

/// What the panel shows: red, green and blue of each pixel.
fn shown(panel: &Panel) -> Vec<u8> {
    let places = (0..HEIGHT as i32).flat_map(|y| (0..WIDTH as i32).map(move |x| Point::new(x, y)));
    let colours = places
        .filter_map(|place| panel.pixel(place))
        .map(Rgb888::from);
    colours
        .flat_map(|colour| [colour.r(), colour.g(), colour.b()])
        .collect()
}
