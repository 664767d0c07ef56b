//! Rays, and axis-aligned bounding boxes (AABB).

use crate::object::ObjectRef;
use crate::scalar::Scalar;
use crate::vec3::{Axis, Vec3};

/// A half line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ray<S> {
    /// Where it starts.
    pub origin: Vec3<S>,
    /// Where it goes; a unit vector, so that the ray's parameter t is a distance.
    pub direction: Vec3<S>,
    /// What it leaves.
    pub from: Departure,
}

/// What a ray leaves: the surface of an object, to its outer or its inner side, or nothing.
///
/// Every shape is flat, or part of the boundary of a convex solid. So a ray never meets a flat surface again that it
/// leaves, nor a solid that it leaves outward; leaving inward, it meets the boundary once more. That holds whatever
/// the rounding, while the intersection that the ray starts from is computed at a t that only should be ≤ 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub struct Departure(ObjectRef);

impl Departure {
    /// The ray starts in free space.
    pub const NOWHERE: Self = Self(ObjectRef::NONE);

    /// The ray leaves the surface of an object; `inward` against its outward normal.
    #[inline(always)]
    pub const fn new(object: ObjectRef, inward: bool) -> Self {
        Self(object.marked_last(inward))
    }

    /// Whether the ray leaves this object.
    #[inline(always)]
    pub const fn leaves(self, object: ObjectRef) -> bool {
        self.0.is_same(object)
    }

    /// Whether the ray leaves against the object's outward normal.
    #[inline(always)]
    pub const fn is_inward(self) -> bool {
        self.0.is_last()
    }
}

impl Default for Departure {
    #[inline(always)]
    fn default() -> Self {
        Self::NOWHERE
    }
}

impl<S: Scalar> Ray<S> {
    /// The ray from a point in free space.
    #[inline(always)]
    pub const fn new(origin: Vec3<S>, direction: Vec3<S>) -> Self {
        Self {
            origin,
            direction,
            from: Departure::NOWHERE,
        }
    }

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
