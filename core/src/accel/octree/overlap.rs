//! Whether an object's surface touches a cell: never "no" where a ray can find a hit in the cell,
//! and seldom "yes" elsewhere.

use super::LinkBy;
use crate::accel::boxes::{to_bounds, widened};
use crate::accel::scalar::AccelScalar;
use crate::object::{ObjectKind, ObjectRef};
use crate::ray::Aabb;
use crate::scalar::Scalar;
use crate::shape::{Cone, Plane, Polygon, Shapes, Triangle, encloses};
use crate::vec3::{Axis, Vec3, vec3};

/// Whether `object` belongs into the cell. All tests take the cell wider by the margin within which a
/// ray is known on the grid, and tests of surfaces by twice the scene's slack: once bounds how far a
/// computed hit lies off its surface, and polygons have a rim of about that width.
pub(super) fn overlaps<S: AccelScalar>(
    shapes: &Shapes<'_, S>,
    object: ObjectRef,
    cell: &Aabb<S::Bound>,
    link: LinkBy,
) -> bool {
    let cell = &widened(cell);
    let bounds = to_bounds(shapes.bounds(object));
    let overlap = Axis::ALL
        .into_iter()
        .all(|a| bounds.low[a] <= cell.high[a] && cell.low[a] <= bounds.high[a]);
    if !overlap || link == LinkBy::Box {
        return overlap;
    }
    let slack = shapes.slack + shapes.slack;
    let slack = vec3(slack, slack, slack);
    let cell = Aabb {
        low: cell.low.map(S::from_bound) - slack,
        high: cell.high.map(S::from_bound) + slack,
    };
    let i = object.index();
    match object.kind() {
        ObjectKind::Sphere => shapes
            .spheres
            .get(i)
            .is_none_or(|s| sphere_surface(s.centre, s.radius, shapes.slack, &cell)),
        ObjectKind::Cuboid => shapes.cuboids.get(i).is_none_or(|c| {
            // The surface alone: no ray meets it in a cell wholly inside.
            Axis::ALL
                .into_iter()
                .any(|a| cell.low[a] <= c.low[a] || cell.high[a] >= c.high[a])
        }),
        ObjectKind::Cone => shapes.cones.get(i).is_none_or(|c| cone_side(c, &cell)),
        ObjectKind::Triangle => shapes
            .triangles
            .get(i)
            .is_none_or(|Triangle { plane, corners, .. }| polygon(plane, corners, &cell)),
        ObjectKind::Polygon => shapes.polygons.get(i).is_none_or(|p: &Polygon<S>| {
            p.corners(shapes.outlines.corners)
                .is_none_or(|corners| polygon(&p.plane, corners, &cell))
        }),
    }
}

/// A sphere's surface: the cell's nearest point lies inside of it and its farthest outside
/// (Arvo, "A simple method for box-sphere intersection testing", Graphics Gems, 1990).
fn sphere_surface<S: Scalar>(centre: Vec3<S>, radius: S, slack: S, cell: &Aabb<S>) -> bool {
    let (mut nearest, mut farthest) = (Vec3::ZERO, Vec3::ZERO);
    for a in Axis::ALL {
        let (below, above) = (cell.low[a] - centre[a], centre[a] - cell.high[a]);
        nearest[a] = below.max(above).max(S::ZERO);
        farthest[a] = below.abs().max(above.abs());
    }
    let (outer, inner) = (radius + slack, (radius - slack).max(S::ZERO));
    nearest.dot_wide(nearest) <= S::product(outer, outer)
        && farthest.dot_wide(farthest) >= S::product(inner, inner)
}

/// A cone's side against the sphere around the cell.
fn cone_side<S: Scalar>(cone: &Cone<S>, cell: &Aabb<S>) -> bool {
    let half = |low: S, high: S| (high - low).quotient(S::ONE + S::ONE);
    let sides = vec3(
        half(cell.low.x, cell.high.x),
        half(cell.low.y, cell.high.y),
        half(cell.low.z, cell.high.z),
    );
    let (_, radius) = sides.unit();
    let radius = radius + radius.quotient(S::ONE + S::ONE); // room for an approximate root
    let w = cell.low + sides - cone.centre;
    if w.dot_wide(w) > S::product(cone.bounding_radius + radius, cone.bounding_radius + radius) {
        return false;
    }
    let height = w.dot(cone.axis);
    let (_, distance) = (w - cone.axis * height).unit();
    let half_length = cone.half_length.to_global(cone.exponent);
    let mid_radius = cone.mid_radius.to_global(cone.exponent);
    let apart = cone.cos * (distance - mid_radius) - cone.sin * height;
    apart.abs() <= radius && height.abs() <= half_length + radius
}

/// A polygon, exactly: it touches a cell if one of its edges does, or if it contains a point of
/// the cell's cut with its plane (Green and Hatch, "Fast polygon-cube intersection testing",
/// Graphics Gems V, 1995). In the polygon's projection the cut is bounded by the cell's two
/// other sides and by two lines on which the third coordinate reaches the cell's faces.
fn polygon<S: Scalar>(plane: &Plane<S>, corners: &[[S; 2]], cell: &Aabb<S>) -> bool {
    // The corners of the cell lowest and highest along the normal lie on either side.
    let (mut low, mut high) = (cell.low, cell.high);
    for a in Axis::ALL {
        if plane.normal[a] < S::ZERO {
            (low[a], high[a]) = (high[a], low[a]);
        }
    }
    let offset = S::product(plane.offset, S::ONE);
    let below = S::narrow(plane.normal.dot_wide(low) - offset);
    let above = S::narrow(plane.normal.dot_wide(high) - offset);
    if below > S::ZERO || above < S::ZERO {
        return false;
    }
    let (u, v) = plane.axis.others();
    let w = plane.axis;
    // Distances inside of the six bounds, for a point of the plane given by its projection.
    let inside = |p: [S; 2]| {
        let rest = S::narrow(
            offset - S::product(plane.normal[u], p[0]) - S::product(plane.normal[v], p[1]),
        );
        let depth = rest.quotient(plane.normal[w]);
        [
            p[0] - cell.low[u],
            cell.high[u] - p[0],
            p[1] - cell.low[v],
            cell.high[v] - p[1],
            depth - cell.low[w],
            cell.high[w] - depth,
        ]
    };
    let Some(&last) = corners.last() else {
        return false;
    };
    let mut from = inside(last);
    for &corner in corners {
        let to = inside(corner);
        if clip(from, to) {
            return true;
        }
        from = to;
    }
    // No edge touches the cell: the polygon holds the whole cut or nothing of it. The diagonal
    // through the plane gives a point.
    let along = (-below).quotient(above - below);
    let point = low + (high - low) * along;
    encloses(corners, [point[u], point[v]])
}

/// Whether a part of the segment is inside all bounds, given its ends' distances inside of each.
fn clip<S: Scalar>(from: [S; 6], to: [S; 6]) -> bool {
    let (mut start, mut end) = (S::ZERO, S::ONE);
    for (a, b) in from.into_iter().zip(to) {
        if a < S::ZERO && b < S::ZERO {
            return false;
        }
        if a < S::ZERO {
            start = start.max((-a).quotient(b - a));
        } else if b < S::ZERO {
            end = end.min(a.quotient(a - b));
        }
    }
    start <= end
}
