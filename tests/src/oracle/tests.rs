//! The oracle itself, tested against what can be worked out by hand.

mod light;
mod shapes;

use super::vector::{Ray, V3};

pub(super) fn v(x: f64, y: f64, z: f64) -> V3 {
    V3::new(x, y, z)
}

pub(super) fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-12, "{a} is not {b}");
}

pub(super) fn near(a: V3, b: V3) {
    assert!((a - b).length() < 1e-12, "{a:?} is not {b:?}");
}

/// A ray along −z from (x, y, 10).
pub(super) fn down(x: f64, y: f64) -> Ray {
    Ray::new(v(x, y, 10.0), v(0.0, 0.0, -1.0))
}
