//! The axis-aligned box.

use super::contact::Contact;
use crate::ray::{Aabb, Ray};
use crate::scalar::Tolerance;
use crate::vec3::{Axis, Vec3, vec3};

/// A box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Cuboid<S> {
    /// Its least corner.
    pub low: Vec3<S>,
    /// Its greatest corner.
    pub high: Vec3<S>,
}

impl<S> Cuboid<S> {
    /// The box between its least and its greatest corner.
    pub const fn new(low: Vec3<S>, high: Vec3<S>) -> Self {
        Self { low, high }
    }
}

/// Where a ray crosses the slabs of a box: distance and axis, going in and coming out.
struct Crossing<S> {
    entry: (S, Axis),
    exit: (S, Axis),
}

impl<S: Tolerance> Cuboid<S> {
    /// The slab method (Kay and Kajiya 1986). A ray parallel to a slab is inside of it all along,
    /// its faces included, or outside; nothing is divided. A ray through an edge meets the box: the far
    /// side is taken as far away as rounding can have moved it (Ize, "Robust BVH Ray Traversal", 2013).
    #[inline(always)]
    fn cross(&self, ray: &Ray<S>) -> Option<Crossing<S>> {
        let mut entry = (-S::MAX, Axis::X);
        let mut exit = (S::MAX, Axis::X);
        for axis in Axis::ALL {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            let (low, high) = (self.low[axis] - o, self.high[axis] - o);
            if d == S::ZERO {
                if low > S::ZERO || high < S::ZERO {
                    return None;
                }
                continue;
            }
            let reciprocal = d.reciprocal();
            let (a, b) = (
                low.times_reciprocal(reciprocal),
                high.times_reciprocal(reciprocal),
            );
            let (near, far) = if d < S::ZERO { (b, a) } else { (a, b) };
            if near > entry.0 {
                entry = (near, axis);
            }
            if far < exit.0 {
                exit = (far, axis);
            }
        }
        (entry.0 <= exit.0.with_rounding_margin()).then_some(Crossing { entry, exit })
    }

    #[inline(always)]
    pub(super) fn hit(&self, ray: &Ray<S>, limit: S, slack: S) -> Option<S> {
        let crossing = self.cross(ray)?;
        let t = if crossing.entry.0 > S::ZERO {
            crossing.entry.0
        } else {
            crossing.exit.0
        };
        let in_box = || S::HITS_WITHIN_SLACK || self.bounds(slack).contains(ray.at(t));
        (t > S::ZERO && t <= limit && in_box()).then_some(t)
    }

    /// Where a ray that starts on a face and goes inward leaves the box.
    #[inline(always)]
    pub(super) fn hit_again(&self, ray: &Ray<S>, limit: S, slack: S) -> Option<S> {
        let (t, _) = self.cross(ray)?.exit;
        let in_box = || S::HITS_WITHIN_SLACK || self.bounds(slack).contains(ray.at(t));
        (t > S::ZERO && t <= limit && in_box()).then_some(t)
    }

    /// Whether faces hold the ray's end, to within `slack`, and it arrives there before it is inside the box: from
    /// beyond one of these faces, or all the way from inside.
    #[inline(always)]
    pub(super) fn ends(&self, ray: &Ray<S>, end: Vec3<S>, slack: S) -> bool {
        let (mut held, mut from_beyond, mut from_inside) = (false, false, true);
        for axis in Axis::ALL {
            let (from, to) = (ray.origin[axis], end[axis]);
            // How far the two are outside of either face.
            for (from, to) in [
                (self.low[axis] - from, self.low[axis] - to),
                (from - self.high[axis], to - self.high[axis]),
            ] {
                if to > slack {
                    return false;
                }
                if to >= -slack {
                    held = true;
                    from_beyond |= from >= to.min(S::ZERO);
                }
                from_inside &= from <= S::ZERO;
            }
        }
        held && (from_beyond || from_inside)
    }

    /// The box that all hits lie in.
    #[inline(always)]
    pub(super) fn bounds(&self, slack: S) -> Aabb<S> {
        let slack = vec3(slack, slack, slack);
        Aabb {
            low: self.low - slack,
            high: self.high + slack,
        }
    }

    /// The point goes back onto the face that the ray crosses.
    #[inline(always)]
    pub(super) fn contact(&self, ray: &Ray<S>, t: S) -> Contact<S> {
        let mut point = ray.at(t);
        let mut outward = Vec3::ZERO;
        if let Some(Crossing { entry, exit }) = self.cross(ray) {
            let enters = entry.0 > S::ZERO;
            let axis = if enters { entry.1 } else { exit.1 };
            // Going up an axis, a ray enters by the low face and leaves by the high one.
            let low = (ray.direction[axis] > S::ZERO) == enters;
            point[axis] = if low { self.low[axis] } else { self.high[axis] };
            outward[axis] = if low { -S::ONE } else { S::ONE };
        }
        Contact {
            point,
            outward,
            curvature_extent: S::ZERO,
            closed: true,
        }
    }
}
