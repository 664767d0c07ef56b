//! A glossy ball and a glass one on a checkered floor: made in code, rendered in fixed point, saved as a PNG file.

use octray_render::{Arith, Error, RenderSettings, SceneBuilder, Surface, render};

fn main() -> Result<(), Error> {
    let mut scene = SceneBuilder::look([0.0, 2.2, 7.0], [0.0, 0.8, 0.0], 32.0); // from, at, angle
    scene.sky([0.9, 0.95, 1.0], [0.25, 0.45, 0.8]);
    scene.light([4.0, 6.0, 5.0], 0.9);
    scene.light([-6.0, 5.0, 3.0], 0.3);
    let red = Surface::glossy([0.85, 0.2, 0.12], 60.0, 0.15);
    scene.sphere([-1.1, 1.0, 0.0], 1.0, red);
    scene.sphere([1.2, 0.8, 1.0], 0.8, Surface::glass(1.5));
    let floor = [
        [-9.0, 0.0, 9.0],
        [9.0, 0.0, 9.0],
        [9.0, 0.0, -9.0],
        [-9.0, 0.0, -9.0],
    ];
    let light_grey = Surface::matt([0.8; 3]);
    scene.polygon(&floor, light_grey.checkered(1.0, Surface::matt([0.35; 3])));

    let settings = RenderSettings {
        arith: Arith::I16F16,
        size: Some((320, 240)),
        samples: 2,
        ..RenderSettings::default()
    };
    let rendering = render(&scene.build()?, &settings)?;
    rendering.save("hello.png")?;
    println!("hello.png: hash {:016x}", rendering.picture.hash());
    Ok(())
}
