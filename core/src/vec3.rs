//! Vectors of three numbers, with dot products that round once.

use crate::scalar::Scalar;
use core::ops::{Add, Index, IndexMut, Mul, Neg, Sub};

/// A point, a direction or a colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Vec3<S> {
    /// First component; red of a colour.
    pub x: S,
    /// Second component; green of a colour.
    pub y: S,
    /// Third component; blue of a colour.
    pub z: S,
}

/// The vector of three components.
#[inline(always)]
pub const fn vec3<S>(x: S, y: S, z: S) -> Vec3<S> {
    Vec3 { x, y, z }
}

impl<S: Scalar> Vec3<S> {
    /// The null vector; black.
    pub const ZERO: Self = vec3(S::ZERO, S::ZERO, S::ZERO);

    /// The components in order.
    #[inline(always)]
    pub fn to_array(self) -> [S; 3] {
        [self.x, self.y, self.z]
    }

    /// The dot product, rounded once.
    #[inline(always)]
    pub fn dot(self, other: Self) -> S {
        S::narrow(self.dot_wide(other))
    }

    /// The dot product, not rounded.
    #[inline(always)]
    pub fn dot_wide(self, other: Self) -> S::Wide {
        S::product(self.x, other.x) + S::product(self.y, other.y) + S::product(self.z, other.z)
    }

    /// The dot product with itself, not rounded.
    #[inline(always)]
    pub fn square_wide(self) -> S::Wide {
        self.x.square() + self.y.square() + self.z.square()
    }

    /// The cross product; each component is rounded once.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        let part = |a, b, c, d| S::narrow(S::product(a, b) - S::product(c, d));
        vec3(
            part(self.y, other.z, self.z, other.y),
            part(self.z, other.x, self.x, other.z),
            part(self.x, other.y, self.y, other.x),
        )
    }

    /// The unit vector in this direction, and the length.
    #[inline(always)]
    pub fn unit(self) -> (Self, S) {
        let ([x, y, z], length) = S::unit(self.to_array());
        (vec3(x, y, z), length)
    }

    /// The product component by component, as light of one colour on a surface of another.
    #[inline(always)]
    pub fn times(self, other: Self) -> Self {
        vec3(self.x * other.x, self.y * other.y, self.z * other.z)
    }

    /// The largest absolute value of a component.
    #[inline(always)]
    pub fn size(self) -> S {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }
}

impl<S> Vec3<S> {
    /// Applies a function to each component.
    #[inline(always)]
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Vec3<T> {
        vec3(f(self.x), f(self.y), f(self.z))
    }
}

impl<S: Scalar> From<[S; 3]> for Vec3<S> {
    #[inline(always)]
    fn from([x, y, z]: [S; 3]) -> Self {
        vec3(x, y, z)
    }
}

impl<S> Index<Axis> for Vec3<S> {
    type Output = S;
    #[inline(always)]
    fn index(&self, axis: Axis) -> &S {
        match axis {
            Axis::X => &self.x,
            Axis::Y => &self.y,
            Axis::Z => &self.z,
        }
    }
}

impl<S> IndexMut<Axis> for Vec3<S> {
    #[inline(always)]
    fn index_mut(&mut self, axis: Axis) -> &mut S {
        match axis {
            Axis::X => &mut self.x,
            Axis::Y => &mut self.y,
            Axis::Z => &mut self.z,
        }
    }
}

impl<S: Scalar> Add for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        vec3(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<S: Scalar> Sub for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        vec3(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<S: Scalar> Mul<S> for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: S) -> Self {
        vec3(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<S: Scalar> Neg for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        vec3(-self.x, -self.y, -self.z)
    }
}

/// One of the three axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Axis {
    /// The first.
    #[default]
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    /// All three, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The two other axes, in order.
    #[inline(always)]
    pub fn others(self) -> (Self, Self) {
        match self {
            Self::X => (Self::Y, Self::Z),
            Self::Y => (Self::X, Self::Z),
            Self::Z => (Self::X, Self::Y),
        }
    }
}
