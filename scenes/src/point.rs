//! Sums and products of points, with the same bits on every machine.

use crate::model::Point;

/// The sum.
pub fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The multiple.
pub fn times(a: Point, factor: f64) -> Point {
    a.map(|number| number * factor)
}

/// The dot product. Squares beyond the range of `f64` are infinite.
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
pub fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cross_product_is_across_both() {
        let (a, b) = ([1.0, 2.0, 3.0], [-2.0, 0.5, 4.0]);
        let across = cross(a, b);
        assert_eq!([dot(across, a), dot(across, b)], [0.0; 2]);
        assert_eq!(cross([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        assert_eq!(add(times(a, 2.0), b), [0.0, 4.5, 10.0]);
    }
}
