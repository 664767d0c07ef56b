//! A ray on the grid, exactly: which planes it has passed where, by integer products and no quotient.

use super::node::OctreeNode;
use crate::accel::bound::BoundScalar;
use crate::accel::scalar::AccelScalar;
use crate::array::map3;
use crate::ray::Ray;
use crate::vec3::{Axis, Vec3};

/// A place on a line: where it has gone `way` along an axis on which it goes at `speed`. So the
/// distance is `way` / `speed`, in 2³⁰ grid units.
///
/// A way is below 2³² and a speed at most 2³¹, so that two places are compared exactly in 64 bits.
#[derive(Clone, Copy)]
pub(super) struct Place {
    way: u64,
    speed: u64,
}

impl Place {
    /// Where the ray starts.
    pub(super) const START: Self = Self { way: 0, speed: 1 };

    #[inline(always)]
    fn is_before(self, other: Self) -> bool {
        self.way.wrapping_mul(other.speed) < other.way.wrapping_mul(self.speed)
    }

    /// Whether the place is at least so far from the start, in grid units.
    #[inline(always)]
    pub(super) fn is_beyond(self, distance: i32) -> bool {
        let distance = u64::from(Ord::max(distance, 0).unsigned_abs());
        self.way << 30 >= distance.wrapping_mul(self.speed)
    }
}

/// A line along one axis.
#[derive(Clone, Copy)]
struct Along {
    origin: i64,
    /// The size of the direction's component, with 30 bits behind the point.
    speed: u64,
    backward: bool,
}

impl Along {
    /// The way to a plane; negative behind the start.
    #[inline(always)]
    fn way(&self, plane: i32) -> i64 {
        let way = i64::from(plane) - self.origin;
        if self.backward { -way } else { way }
    }

    /// Whether the line is at a plane or beyond it.
    #[inline(always)]
    fn has_passed(&self, plane: i32, at: Place) -> bool {
        let way = self.way(plane);
        way <= 0 || way.unsigned_abs().wrapping_mul(at.speed) <= self.speed.wrapping_mul(at.way)
    }
}

/// The planes of a box on the grid as a line meets them along one axis.
#[derive(Clone, Copy)]
struct Slab {
    near: i32,
    far: i32,
}

/// A ray on the grid. A box holds those of its places where it is at the near plane of each axis or
/// beyond and not yet at the far one. So of boxes side by side exactly one holds a place.
#[derive(Clone, Copy)]
pub(super) struct Line(Vec3<Along>);

impl Line {
    #[inline(always)]
    pub(super) fn new<S: AccelScalar>(ray: &Ray<S>) -> Self {
        let [x, y, z] = map3(Axis::ALL, |axis| {
            let direction = ray.direction[axis].direction_q30();
            Along {
                origin: i64::from(ray.origin[axis].to_grid()),
                speed: u64::from(direction.unsigned_abs()),
                backward: direction < 0,
            }
        });
        Self(Vec3 { x, y, z })
    }

    #[inline(always)]
    fn slab<B: BoundScalar>(&self, cell: &OctreeNode<B>, axis: Axis) -> Slab {
        let bounds = &cell.bounds;
        let (low, high) = (bounds.low[axis].to_grid(), bounds.high[axis].to_grid());
        let (near, far) = if self.0[axis].backward {
            (high, low)
        } else {
            (low, high)
        };
        Slab { near, far }
    }

    /// Whether a cell holds a place.
    #[inline(always)]
    pub(super) fn is_in<B: BoundScalar>(&self, cell: &OctreeNode<B>, at: Place) -> bool {
        Axis::ALL.into_iter().all(|axis| {
            let Slab { near, far } = self.slab(cell, axis);
            self.0[axis].has_passed(near, at) && !self.0[axis].has_passed(far, at)
        })
    }

    /// Which of the eight octants of a cell, in their order, holds a place of the cell.
    #[inline(always)]
    pub(super) fn octant<B: BoundScalar>(&self, cells: &[OctreeNode<B>; 8], at: Place) -> usize {
        let centre = cells[0].bounds.high;
        (Axis::ALL.into_iter()).fold(0, |octant, axis| {
            let along = self.0[axis];
            let high = along.has_passed(centre[axis].to_grid(), at) != along.backward;
            octant | usize::from(high) << axis as usize
        })
    }

    /// A face through which a cell has been left, if it has.
    #[inline(always)]
    pub(super) fn has_left<B: BoundScalar>(&self, cell: &OctreeNode<B>, at: Place) -> Option<Face> {
        (Axis::ALL.into_iter())
            .find(|axis| self.0[*axis].has_passed(self.slab(cell, *axis).far, at))
            .map(|axis| self.face(axis))
    }

    /// The first place from `at` on that a cell holds.
    #[inline(always)]
    pub(super) fn enter<B: BoundScalar>(&self, cell: &OctreeNode<B>, at: Place) -> Option<Place> {
        let mut first = at;
        for axis in Axis::ALL {
            let along = self.0[axis];
            let near = self.slab(cell, axis).near;
            if along.has_passed(near, first) {
                continue;
            }
            if along.speed == 0 {
                return None;
            }
            first = Place {
                way: along.way(near).unsigned_abs(),
                speed: along.speed,
            };
        }
        self.is_in(cell, first).then_some(first)
    }

    /// Where the line leaves a cell that holds one of its places, and through which face; never if the
    /// ray has no direction.
    #[inline(always)]
    pub(super) fn exit<B: BoundScalar>(&self, cell: &OctreeNode<B>) -> Option<(Place, Face)> {
        let mut first: Option<(Place, Axis)> = None;
        for axis in Axis::ALL {
            let along = self.0[axis];
            if along.speed == 0 {
                continue;
            }
            let place = Place {
                way: along.way(self.slab(cell, axis).far).unsigned_abs(),
                speed: along.speed,
            };
            if first.is_none_or(|(other, _)| place.is_before(other)) {
                first = Some((place, axis));
            }
        }
        first.map(|(place, axis)| (place, self.face(axis)))
    }

    fn face(&self, axis: Axis) -> Face {
        Face {
            axis,
            low: self.0[axis].backward,
        }
    }
}

/// A face of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Face {
    /// The axis across it.
    pub(super) axis: Axis,
    /// Whether it is the cell's low one.
    pub(super) low: bool,
}

impl Face {
    /// All six, in the order of their links.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        let faces = |axis| [true, false].map(|low| Self { axis, low });
        Axis::ALL.into_iter().flat_map(faces)
    }

    /// Its link's place.
    #[inline(always)]
    pub(super) const fn index(self) -> usize {
        2 * self.axis as usize + !self.low as usize
    }
}
