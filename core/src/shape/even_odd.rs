//! Whether a point is inside a polygon: even–odd over its edges.

use crate::scalar::Scalar;

/// Whether a point's horizontal line to the right crosses the edge from `a` to `b`. The edge owns
/// its lower end and not its upper one, and is always looked at from its lower end, so that two
/// polygons that share it agree.
#[inline(always)]
pub(super) fn crosses<S: Scalar>(a: [S; 2], b: [S; 2], p: [S; 2]) -> bool {
    let upward = a[1] <= p[1];
    if upward == (b[1] <= p[1]) {
        return false;
    }
    let (low, high) = if upward { (a, b) } else { (b, a) };
    S::product(p[0] - low[0], high[1] - low[1]) < S::product(high[0] - low[0], p[1] - low[1])
}

/// The same for an edge whose lower end is known.
#[inline(always)]
pub(super) fn crosses_upward<S: Scalar>([low, high]: [[S; 2]; 2], p: [S; 2]) -> bool {
    low[1] <= p[1]
        && p[1] < high[1]
        && S::product(p[0] - low[0], high[1] - low[1]) < S::product(high[0] - low[0], p[1] - low[1])
}

/// Whether a projected point is inside a polygon: even–odd over its edges.
#[inline(always)]
pub(crate) fn encloses<S: Scalar>(corners: &[[S; 2]], p: [S; 2]) -> bool {
    let Some(&last) = corners.last() else {
        return false;
    };
    let mut inside = false;
    let mut a = last;
    for &b in corners {
        inside ^= crosses(a, b, p);
        a = b;
    }
    inside
}
