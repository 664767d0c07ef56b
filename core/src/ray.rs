//! Rays, and axis-aligned bounding boxes (AABB).

use crate::scalar::Scalar;
use crate::vec3::{Axis, Vec3};

/// A half line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ray<S> {
    /// Where it starts.
    pub origin: Vec3<S>,
    /// Where it goes; a unit vector, so that the ray's parameter t is a distance.
    pub direction: Vec3<S>,
}

impl<S: Scalar> Ray<S> {
    /// The point at distance `t`.
    #[inline(always)]
    pub fn at(&self, t: S) -> Vec3<S> {
        self.origin + self.direction * t
    }
}

/// An axis-aligned bounding box, closed: its faces belong to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Aabb<S> {
    /// Its least corner.
    pub low: Vec3<S>,
    /// Its greatest corner.
    pub high: Vec3<S>,
}

impl<S: Scalar> Aabb<S> {
    /// Whether a point lies in the box.
    #[inline(always)]
    pub fn contains(&self, p: Vec3<S>) -> bool {
        Axis::ALL
            .into_iter()
            .all(|a| self.low[a] <= p[a] && p[a] <= self.high[a])
    }
}
