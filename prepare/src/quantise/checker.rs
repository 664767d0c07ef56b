//! Checkers and skies.

use super::vector;
use octray_core::checker::Checker;
use octray_core::quantize::Quantize;
use octray_core::scene::Sky;
use octray_core::world::World;
use octray_scenes::model::{self, Camera};
use octray_scenes::point::{add, times};

/// Steps of the grid: coordinates are below 2³¹ of them.
const FARTHEST: f64 = (1u64 << 31) as f64;

/// Converts a checker.
///
/// The origin is the corner of a cube nearest to the middle of the scene, so that few bits of the cubes' size are
/// multiplied up. On an axis on which no side of a cube lies in the scene, all is in one cube.
pub(super) fn checker<S: Quantize>(checker: &model::Checker, world: &World) -> Checker<S> {
    let side = world.length(checker.size) * f64::from(S::ONE.to_grid());
    // 2^shift / side is in [2³⁰, 2³¹) if that can be.
    let shift = (30 + side.log2().ceil() as i32).clamp(0, 63);
    let cells = (2f64.powi(shift) / side)
        .round()
        .min(f64::from(u32::MAX >> 1)) as u32;
    // What a hit that was put back onto its surface can be off.
    let rounding = S::coordinate_error(S::from_f64(world.length(world.diagonal))).to_grid();
    let mut odd = false;
    let mut cells_of_axis = [cells; 3];
    let origin = [0, 1, 2].map(|i| {
        let middle = world.centre[i] / checker.size;
        let corner = middle.round();
        let steps = (corner - middle) * side;
        let is_far = steps.abs() >= FARTHEST - 1.0 - f64::from(rounding);
        let cube = if is_far { middle.floor() } else { corner };
        odd ^= cube.rem_euclid(2.0) == 1.0;
        if is_far {
            cells_of_axis[i] = 0;
            return 0;
        }
        steps.round() as i32 - rounding - 1
    });
    Checker {
        ambient: vector(checker.ambient),
        diffuse: vector(checker.diffuse),
        origin,
        cells: cells_of_axis,
        shift: shift as u8,
        odd,
    }
}

/// Converts a sky; null if the background is of one colour.
pub(super) fn sky<S: Quantize>(scene: &model::Scene) -> Sky<S> {
    let Some(zenith) = scene.zenith else {
        return Sky::default();
    };
    let up = match scene.camera {
        Camera::Thesis { .. } => [0.0, 1.0, 0.0],
        Camera::Nff { up, .. } => {
            // Of any length, however large.
            let largest = up.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            super::camera::unit(times(up, 1.0 / largest))
        }
    };
    let rise = times(add(zenith, times(scene.background, -1.0)), 0.5);
    Sky {
        rise: vector(rise),
        up: vector::<S>(up),
    }
}
