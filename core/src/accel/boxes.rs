//! Boxes while a tree is built: unions, sides, centres.

use super::bound::BoundScalar;
use super::scalar::AccelScalar;
use crate::array::map3;
use crate::ray::Aabb;
use crate::vec3::{Axis, Vec3, vec3};

/// The empty box: its union with another is the other.
pub(super) fn empty_box<B: BoundScalar>() -> Aabb<B> {
    Aabb {
        low: vec3(B::MAX, B::MAX, B::MAX),
        high: vec3(B::MIN, B::MIN, B::MIN),
    }
}

/// The smallest box around two.
pub(super) fn union<B: BoundScalar>(a: Aabb<B>, b: Aabb<B>) -> Aabb<B> {
    let mut both = a;
    for axis in Axis::ALL {
        both.low[axis] = a.low[axis].min(b.low[axis]);
        both.high[axis] = a.high[axis].max(b.high[axis]);
    }
    both
}

/// What two boxes have in common; inverted on an axis on which they are apart.
pub(super) fn intersection<B: BoundScalar>(a: &Aabb<B>, b: &Aabb<B>) -> Aabb<B> {
    let mut common = *a;
    for axis in Axis::ALL {
        common.low[axis] = a.low[axis].max(b.low[axis]);
        common.high[axis] = a.high[axis].min(b.high[axis]);
    }
    common
}

/// The box wider on each side by the margin within which a ray is known on the grid.
pub(super) fn widened<B: BoundScalar>(bounds: &Aabb<B>) -> Aabb<B> {
    let mut wider = *bounds;
    for axis in Axis::ALL {
        wider.low[axis] = bounds.low[axis].lowered();
        wider.high[axis] = bounds.high[axis].raised();
    }
    wider
}

/// A shape's box in the numbers that trees hold boxes in, exactly.
pub(super) fn to_bounds<S: AccelScalar>(bounds: Aabb<S>) -> Aabb<S::Bound> {
    Aabb {
        low: bounds.low.map(S::to_bound),
        high: bounds.high.map(S::to_bound),
    }
}

/// The sides of a box, none of them negative.
pub(super) fn side_lengths<B: BoundScalar>(bounds: &Aabb<B>) -> [B; 3] {
    map3(Axis::ALL, |a| {
        if bounds.low[a] < bounds.high[a] {
            bounds.high[a].difference(bounds.low[a])
        } else {
            B::ZERO
        }
    })
}

/// The middle of a box.
pub(super) fn centroid<B: BoundScalar>(bounds: &Aabb<B>) -> Vec3<B> {
    let [x, y, z] = map3(Axis::ALL, |a| bounds.low[a].midpoint(bounds.high[a]));
    vec3(x, y, z)
}
