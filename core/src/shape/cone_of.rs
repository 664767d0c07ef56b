//! A cone's numbers from its ends.

use super::cone::Cone;
use crate::quantize::Quantize;
use crate::vec3::Vec3;
use crate::world::{World, length, local_exponent, rounded_up, vector};

impl<S: Quantize> Cone<S> {
    /// The side of the cone between two circles across its axis, in scene units: around `base` and around `top`, which
    /// differ, with radii ≥ 0, not both 0.
    pub fn new(
        world: &World,
        base: [f64; 3],
        base_radius: f64,
        top: [f64; 3],
        top_radius: f64,
    ) -> Self {
        let along = Vec3::from(top) - Vec3::from(base);
        let middle = (Vec3::from(base) + Vec3::from(top)) * 0.5;
        let height = length(along);
        let rise = top_radius - base_radius;
        let slant = libm::hypot(height, rise);
        let bounding_radius = libm::hypot(height / 2.0, base_radius.max(top_radius));
        // Scaled by 2^exponent, the bounding sphere's radius is in [½, 1).
        let scaled = world.length(bounding_radius);
        let exponent = local_exponent::<S>(scaled);
        let local = |x: f64| S::from_f64(libm::scalbn(world.length(x), exponent.into()));
        let is_flat = rise.abs() > Self::FLAT * height;
        Self {
            centre: world.place(middle.to_array()),
            axis: vector((along * (1.0 / height)).to_array()),
            half_length: local(height / 2.0),
            mid_radius: local((base_radius + top_radius) / 2.0),
            sin: S::from_f64(rise / slant),
            cos: S::from_f64(height / slant),
            half_widening: local(if is_flat { rise.abs() / 2.0 } else { 0.0 }),
            bounding_radius: rounded_up(scaled + world.slack::<S>().to_f64()),
            exponent,
            bounds: world.bounds(cone_box(base, base_radius, top, top_radius), 0.0),
        }
    }
}

/// The low and the high corner of the box around the side of a cone between two circles, in scene units: around `base`
/// and around `top`, which differ.
pub fn cone_box(base: [f64; 3], base_radius: f64, top: [f64; 3], top_radius: f64) -> [[f64; 3]; 2] {
    // A circle of radius r perpendicular to the axis a extends r √(1 − aᵢ²) along axis i.
    let axis = [0, 1, 2].map(|i| top[i] - base[i]);
    let square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    let reach = axis.map(|a| libm::sqrt((1.0 - a * a / square).max(0.0)));
    let low = |i: usize| (base[i] - base_radius * reach[i]).min(top[i] - top_radius * reach[i]);
    let high = |i: usize| (base[i] + base_radius * reach[i]).max(top[i] + top_radius * reach[i]);
    [[0, 1, 2].map(low), [0, 1, 2].map(high)]
}
