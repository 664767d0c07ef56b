//! Exact references: binary floats of 512 bits.
//!
//! Sums and products of a few numbers of any tested format are exact; quotients, roots and powers are right to 150
//! digits.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// A number of 512 bits.
pub type Exact = FBig<HalfEven, 2>;

/// A point or a direction.
pub type Exact3 = [Exact; 3];

const BITS: usize = 512;

/// Returns the exact value of a finite `x`; the largest `f64` for infinity or NaN.
pub fn exact(x: f64) -> Exact {
    let finite = if x.is_nan() {
        f64::MAX
    } else {
        x.clamp(f64::MIN, f64::MAX)
    };
    let number = Exact::try_from(finite).unwrap_or(Exact::ZERO);
    number.with_precision(BITS).value()
}

/// Returns the nearest `f64`.
pub fn near(x: &Exact) -> f64 {
    x.to_f64().value()
}

/// Returns the square root; 0 for a negative number.
pub fn root(x: &Exact) -> Exact {
    if *x > Exact::ZERO {
        x.sqrt()
    } else {
        exact(0.0)
    }
}

/// Returns the exact values of three numbers.
pub fn exact3(v: [f64; 3]) -> Exact3 {
    v.map(exact)
}

/// Returns the sum.
pub fn add(a: &Exact3, b: &Exact3) -> Exact3 {
    [&a[0] + &b[0], &a[1] + &b[1], &a[2] + &b[2]]
}

/// Returns the difference.
pub fn sub(a: &Exact3, b: &Exact3) -> Exact3 {
    [&a[0] - &b[0], &a[1] - &b[1], &a[2] - &b[2]]
}

/// Returns the multiple.
pub fn times(a: &Exact3, factor: &Exact) -> Exact3 {
    [&a[0] * factor, &a[1] * factor, &a[2] * factor]
}

/// Returns the dot product.
pub fn dot(a: &Exact3, b: &Exact3) -> Exact {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// Returns the cross product.
pub fn cross(a: &Exact3, b: &Exact3) -> Exact3 {
    [
        &a[1] * &b[2] - &a[2] * &b[1],
        &a[2] * &b[0] - &a[0] * &b[2],
        &a[0] * &b[1] - &a[1] * &b[0],
    ]
}

/// Returns the length.
pub fn length(a: &Exact3) -> Exact {
    root(&dot(a, a))
}

/// Returns the unit vector; the null vector stays as it is.
pub fn unit(a: &Exact3) -> Exact3 {
    let length = length(a);
    if length == Exact::ZERO {
        return a.clone();
    }
    [&a[0] / &length, &a[1] / &length, &a[2] / &length]
}

/// Returns the angle between two directions, in radians, 0 to π; π if one of them is null.
pub fn angle(a: &Exact3, b: &Exact3) -> f64 {
    let sine = length(&cross(a, b));
    let cosine = dot(a, b);
    if sine == Exact::ZERO && cosine <= Exact::ZERO {
        return core::f64::consts::PI;
    }
    libm::atan2(near(&sine), near(&cosine))
}
