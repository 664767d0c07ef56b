//! Random cases, the same on every machine.

pub use octray_scenes::point::{add, cross, dot, times};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A stream of random numbers.
#[derive(Debug)]
pub struct Random(Pcg64Mcg);

impl Random {
    /// Returns the stream of a seed.
    pub fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Returns a number evenly distributed from `low` to below `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let fraction = (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * fraction
    }

    /// Returns a unit vector; every direction is equally likely.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = [(); 3].map(|()| self.between(-1.0, 1.0));
            let square = dot(v, v);
            if (0.01..1.0).contains(&square) {
                return times(v, 1.0 / square.sqrt());
            }
        }
    }

    /// Returns a unit vector perpendicular to another.
    pub fn across(&mut self, v: [f64; 3]) -> [f64; 3] {
        loop {
            let other = self.direction();
            let side = add(other, times(v, -dot(v, other)));
            let square = dot(side, side);
            if square > 0.01 {
                return times(side, 1.0 / square.sqrt());
            }
        }
    }
}
