//! Portable random numbers and directions: no function's last digit depends on the machine.

use crate::model::Point;
use crate::point::{add, cross, dot, times};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A stream of random numbers.
pub(super) struct Random(Pcg64Mcg);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Returns a number evenly distributed from `low` to below `high`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        // An `f64` in [0, 1) holds at most 53 random bits.
        let fraction = (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * fraction
    }

    /// Returns an integer evenly distributed from 0 to `count` − 1.
    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.between(0.0, count as f64) as usize).min(count - 1)
    }

    /// Returns a unit vector; every direction is equally likely.
    pub(super) fn direction(&mut self) -> Point {
        loop {
            let point = [(); 3].map(|()| self.between(-1.0, 1.0));
            let square = dot(point, point);
            if (0.01..1.0).contains(&square) {
                return times(point, 1.0 / square.sqrt());
            }
        }
    }
}

/// Returns the unit vector in the plane after `turn` of a full turn. The formula is rational, so directions are not
/// quite even within a quarter.
pub(super) fn circle(turn: f64) -> [f64; 2] {
    let quarters = (turn - turn.floor()) * 4.0;
    let t = quarters.fract();
    let (cos, sin) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    match quarters as u32 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// Returns two unit vectors that form a right-handed frame with the unit vector `axis`.
pub(super) fn across(axis: Point) -> [Point; 2] {
    let helper = if axis[0].abs() < 0.6 {
        [1.0, 0.0, 0.0]
    } else {
        [0.0, 1.0, 0.0]
    };
    let u = unit(cross(axis, helper));
    [u, cross(axis, u)]
}

/// Returns `axis`·z plus the point (x, y) of the plane across it, after `turn`.
pub(super) fn around(axis: Point, turn: f64, [x, y, z]: Point) -> Point {
    let [u, v] = across(axis);
    let [cos, sin] = circle(turn);
    let plane = add(times(u, x * cos - y * sin), times(v, x * sin + y * cos));
    add(plane, times(axis, z))
}

pub(super) fn unit(a: Point) -> Point {
    times(a, 1.0 / dot(a, a).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circle_is_round_and_turns_once() {
        let mut last = -1.0;
        for step in 0..400 {
            let [x, y] = circle(f64::from(step) / 400.0);
            assert!((x * x + y * y - 1.0).abs() < 1e-15);
            let angle = y.atan2(x).rem_euclid(std::f64::consts::TAU);
            assert!(angle > last, "step {step}");
            last = angle;
        }
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        let mut random = Random::new(1);
        for _ in 0..1000 {
            let axis = random.direction();
            let [u, v] = across(axis);
            for product in [dot(u, v), dot(u, axis), dot(v, axis)] {
                assert!(product.abs() < 1e-15);
            }
            assert!((dot(cross(u, v), axis) - 1.0).abs() < 1e-14);
        }
    }

    /// A seed's meaning includes the stream: a new generator would change every scene.
    #[test]
    fn the_stream_is_fixed() {
        let mut random = Random::new(1989);
        let numbers = [(); 3].map(|()| random.between(0.0, 1.0));
        assert_eq!(
            numbers,
            [
                0.9335628128916078,
                0.0026384282174121143,
                0.8518994078869323
            ]
        );
    }
}
