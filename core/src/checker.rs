//! Surfaces of two colours, in cubes like those of a chessboard.

use crate::accel::AccelScalar;
use crate::vec3::Vec3;

/// The colours of a surface in every second cube of space, and which those are.
///
/// A coordinate's cube is found in integers, on the [grid](AccelScalar::to_grid): ⌊(x − origin) · cells / 2^shift⌋.
/// So the picture does not depend on how an arithmetic divides.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Checker<S> {
    /// [`Surface::ambient`](crate::scene::Surface::ambient) in these cubes.
    pub ambient: Vec3<S>,
    /// [`Surface::diffuse`](crate::scene::Surface::diffuse) in these cubes.
    pub diffuse: Vec3<S>,
    /// A corner of a cube, on the grid; less than it really is by what rounding takes from a coordinate, so that a surface
    /// in a plane between cubes is in one of them.
    pub origin: [i32; 3],
    /// Cubes per step of the grid along each axis, times 2^`shift`, below 2³¹; 0 along an axis on which the scene is in
    /// one cube.
    pub cells: [u32; 3],
    /// At most 63.
    pub shift: u8,
    /// Whether the cube above `origin` on all axes is one of these.
    pub odd: bool,
}

impl<S: AccelScalar> Checker<S> {
    /// Whether a point is in one of these cubes.
    #[inline(always)]
    pub fn contains(&self, point: Vec3<S>) -> bool {
        let mut sum = i64::from(self.odd);
        let sides = self.origin.into_iter().zip(self.cells);
        for (x, (origin, cells)) in point.to_array().into_iter().zip(sides) {
            let steps = i64::from(x.to_grid()) - i64::from(origin);
            sum += (steps * i64::from(cells)) >> (self.shift & 63);
        }
        sum & 1 != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3::vec3;

    #[test]
    fn cubes_alternate_along_every_axis_and_below_the_origin() {
        // Cubes of side 0.25, from 0 on; on the grid 2^29 is 1.
        let checker = Checker::<f32> {
            ambient: Vec3::ZERO,
            diffuse: Vec3::ZERO,
            origin: [0; 3],
            cells: [1 << 30; 3],
            shift: 57,
            odd: false,
        };
        for (x, y, z) in [
            (0.1, 0.1, 0.1),
            (0.3, 0.3, 0.1),
            (-0.1, -0.2, 0.7),
            (-0.1, 0.3, 1.1),
        ] {
            assert!(!checker.contains(vec3(x, y, z)), "{x} {y} {z}");
            assert!(checker.contains(vec3(x, y + 0.25, z)), "{x} {y} {z}");
            assert!(checker.contains(vec3(x, y, z - 0.25)), "{x} {y} {z}");
            assert!(
                !checker.contains(vec3(x + 0.25, y, z + 0.25)),
                "{x} {y} {z}"
            );
        }
    }
}
