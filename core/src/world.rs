//! The place of a scene in the numbers of a format: from scene units to numbers, rounded once.
//!
//! What is derived from a shape (a plane's normal, a cone's angle) is computed in `f64` and then rounded, so that a
//! scene that is made on a device is the scene that the host makes, to the bit. A device without a floating-point unit
//! links `f64` routines for it, a few kilobytes. Spheres, boxes and lights need none of it: their constructors take
//! numbers of the format.

use crate::quantize::Quantize;
use crate::ray::Aabb;
use crate::vec3::{Vec3, vec3};

/// The place of a scene in the numbers of a format: number = (coordinate − centre) · 2^exponent.
///
/// ```
/// use octray_core::scalar::Fixed;
/// use octray_core::world::World;
///
/// // All that takes part lies in a box of 24 x 6 x 8 units.
/// let world = World::around::<Fixed<16>>([-12.0, 0.0, 0.0], [12.0, 6.0, 8.0]);
/// assert_eq!((world.centre, world.exponent), ([0.0, 3.0, 4.0], 9));
/// let top = world.place::<Fixed<16>>([0.0, 6.0, 4.0]);
/// assert_eq!(top.y.to_bits(), 3 << (9 + 16));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct World {
    /// What becomes the origin, in scene units.
    pub centre: [f64; 3],
    /// The exponent of the scale.
    pub exponent: i32,
    /// The largest distance between two points of shapes, lights and viewpoint, in scene units.
    pub diagonal: f64,
    /// How far coordinates are off already, in scene units: a few roundings of the largest to `f64`.
    pub rounding: f64,
}

impl World {
    /// The place in format `S` of a scene whose shapes, viewpoint and lights, except far ones, all lie in this box, in
    /// scene units. The middle of the box becomes the origin. In fixed point the scale is the largest with which all
    /// coordinates, distances and differences of points fit; in floating point the diagonal becomes 1 to 2.
    pub fn around<S: Quantize>(low: [f64; 3], high: [f64; 3]) -> Self {
        let diagonal = length([0, 1, 2].map(|i| high[i] - low[i]).into());
        // Boxes are wider than their shapes, and rounding needs a small margin.
        let wider = diagonal * (1.0 + 4.0 * S::SLACK) * 1.001;
        // A ray that starts at the edge of the scene and is as long as the diagonal ends at 1½ diagonals.
        let room = if S::FRACTION_BITS.is_some() {
            S::MAX.to_f64() / 1.5
        } else {
            2.0
        };
        let far = |reach: f64, c: &f64| reach.max(c.abs());
        Self {
            centre: [0, 1, 2].map(|i| low[i] / 2.0 + high[i] / 2.0),
            exponent: if wider > 0.0 {
                libm::ilogb(room / wider)
            } else {
                0
            },
            diagonal,
            // Far from the origin this is more than the error of hits in f64.
            rounding: low.iter().chain(&high).fold(0.0, far) * 2.0 * f64::EPSILON,
        }
    }

    /// 2^exponent.
    pub fn scale(&self) -> f64 {
        power_of_two(self.exponent)
    }

    /// A point in scene units as numbers of the format, not rounded.
    pub fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let scale = self.scale();
        [0, 1, 2].map(|i| (p[i] - self.centre[i]) * scale)
    }

    /// A length in scene units as a number of the format, not rounded.
    pub fn length(&self, x: f64) -> f64 {
        x * self.scale()
    }

    /// A point in scene units, each coordinate rounded to nearest.
    pub fn place<S: Quantize>(&self, p: [f64; 3]) -> Vec3<S> {
        vector(self.point(p))
    }

    /// The radius of a shape, in scene units: rounded to nearest, but not to 0.
    pub fn radius<S: Quantize>(&self, x: f64) -> S {
        let near = S::from_f64(self.length(x));
        if near > S::ZERO {
            near
        } else {
            rounded_up(self.length(x))
        }
    }

    /// [`Shapes::slack`](crate::shape::Shapes::slack) of the scene.
    pub fn slack<S: Quantize>(&self) -> S {
        rounded_up(self.length((self.diagonal * S::SLACK).max(self.rounding)))
    }

    /// [`Scene::diameter`](crate::scene::Scene::diameter) of the scene.
    pub fn diameter<S: Quantize>(&self) -> S {
        rounded_up(self.length(self.diagonal) * (1.0 + 4.0 * S::SLACK))
    }

    /// A box in scene units, rounded outward and widened by the slack and `more`.
    pub(crate) fn bounds<S: Quantize>(&self, [low, high]: [[f64; 3]; 2], more: f64) -> Aabb<S> {
        let more = self.length(more) + self.slack::<S>().to_f64();
        let [low, high] = [low, high].map(|p| Vec3::from(self.point(p)));
        Aabb {
            low: low.map(|x| -rounded_up::<S>(more - x)),
            high: high.map(|x| rounded_up::<S>(x + more)),
        }
    }
}

/// A vector that is not placed, such as a direction or a colour: each component rounded to nearest.
pub(crate) fn vector<S: Quantize>([x, y, z]: [f64; 3]) -> Vec3<S> {
    vec3(x, y, z).map(S::from_f64)
}

/// Rounds up to a number of the format.
pub(crate) fn rounded_up<S: Quantize>(x: f64) -> S {
    let near = S::from_f64(x);
    if near.to_f64() >= x {
        return near;
    }
    let step = match S::FRACTION_BITS {
        Some(bits) => power_of_two(-(bits as i32)),
        None => x.abs() * power_of_two(-22),
    };
    S::from_f64(x + step)
}

/// 2^exponent.
pub(crate) fn power_of_two(exponent: i32) -> f64 {
    libm::scalbn(1.0, exponent)
}

/// The length of a vector, without overflow.
pub(crate) fn length(v: Vec3<f64>) -> f64 {
    libm::hypot(libm::hypot(v.x, v.y), v.z)
}

/// The unit vector in this direction.
pub(crate) fn unit(v: Vec3<f64>) -> Vec3<f64> {
    v * (1.0 / length(v))
}

/// The exponent that scales a length, a number of format `S`, to [½, 1); 0 in floating point, which needs no scale.
pub(crate) fn local_exponent<S: Quantize>(size: f64) -> i8 {
    match S::FRACTION_BITS {
        Some(_) => (-libm::ilogb(size).clamp(-40, 40) - 1).clamp(-31, 31) as i8,
        None => 0,
    }
}

/// The box of points.
pub(crate) fn box_of(points: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for p in points {
        for i in 0..3 {
            bounds[0][i] = bounds[0][i].min(p[i]);
            bounds[1][i] = bounds[1][i].max(p[i]);
        }
    }
    bounds
}
