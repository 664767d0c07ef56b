//! A comb-shaped polygon. The cost of a polygon's edges is learnt from it, because the polygons of other scenes have
//! few edges, or few at any height.

use octray_render::error::Error;
use octray_scenes::model::Scene;
use std::fmt::Write;

/// Returns a comb with this many upright teeth before a slightly mirroring wall. A horizontal line through the teeth
/// crosses both edges of each tooth, so bands save nothing.
///
/// # Errors
/// If it is not a valid scene: without teeth.
pub fn comb(teeth: u32) -> Result<Scene, Error> {
    let mut text = String::from(
        "v 20 10 150 at 0 0 0 up 0 1 0 angle 50 resolution 64 48 b 0.2 0.3 0.4 l 60 90 140 0.8 l -80 20 90 0.4 \
         f 0.1 0.1 0.1 0.6 0.5 0.4 0 0 0 1 0.2 0 p 4 -99 -70 -30 99 -70 -30 99 70 -30 -99 70 -30 \
         f 0.1 0.1 0.1 0.3 0.5 0.7 0.2 0.2 0.2 20 0.1 0 ",
    );
    let _ = write!(text, "p {} 60 -45 0 -60 -45 0", 2 * teeth + 3);
    for edge in 0..=2 * teeth {
        let x = 60.0 * (f64::from(edge) / f64::from(teeth) - 1.0);
        let y = if edge % 2 == 0 { -35 } else { 35 };
        let _ = write!(text, " {x} {y} 0");
    }
    octray_scenes::parse(&text).map_err(|why| Error::Scene(why.draw("comb", &text)))
}
