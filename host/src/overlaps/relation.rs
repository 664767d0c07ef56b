//! How two shapes lie to each other.
//!
//! Spheres and boxes are closed, cones (which have no caps), polygons and patches are open. Two shapes *cross* if points of
//! one surface lie on both sides of the other; one is *inside* a closed one if none of its surface is outside. Shapes that
//! only touch, also along a common edge or face, do neither, and coplanar polygons touch. All tests are exact up to `slack`
//! but those of cones: two are compared along [`LINES`] lines and [`CIRCLES`] circles of each, and flat shapes meet those circles.

use super::body::{Body, Cone, Polygon, length, minus};
use octray_scenes::model::Point;
use octray_scenes::point::{add, cross, dot, times};
use std::f64::consts::TAU;

/// Lines of a cone that are tested against another cone.
const LINES: u32 = 256;

/// Circles of a cone, from its base to its top, that are tested against another shape.
pub(super) const CIRCLES: u32 = 65;

/// How two shapes lie to each other, if they do not just lie apart or touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    /// Their surfaces pass through each other.
    Cross,
    /// The first is inside the second.
    Inside,
    /// The second is inside the first.
    Around,
}

/// Tells how `a` lies to `b`. What is closer than `slack` touches.
pub(super) fn relation(a: &Body, b: &Body, slack: f64) -> Option<Relation> {
    let turned = |relation| match relation {
        Relation::Cross => Relation::Cross,
        Relation::Inside => Relation::Around,
        Relation::Around => Relation::Inside,
    };
    match (a, b) {
        (Body::Sphere(centre, radius), _) => sphere(*centre, *radius, b, slack),
        (_, Body::Sphere(centre, radius)) => sphere(*centre, *radius, a, slack).map(turned),
        (Body::Cuboid(low, high), _) => cuboid([*low, *high], b, slack),
        (_, Body::Cuboid(low, high)) => cuboid([*low, *high], a, slack).map(turned),
        (Body::Polygon(a), Body::Polygon(b)) => crossing(polygons(a, b, slack)),
        (Body::Polygon(a), Body::Cone(b)) | (Body::Cone(b), Body::Polygon(a)) => {
            crossing(cone_and_polygon(b, a, slack))
        }
        (Body::Cone(a), Body::Cone(b)) => {
            let part = |a, b| lines_cross(a, b, slack) || circles_cross(a, b, slack);
            crossing(part(a, b) || part(b, a))
        }
    }
}

fn crossing(crosses: bool) -> Option<Relation> {
    crosses.then_some(Relation::Cross)
}

/// A surface in one piece crosses a sphere if some of it is nearer to the centre than the radius and some of it farther.
fn sphere(centre: Point, radius: f64, other: &Body, slack: f64) -> Option<Relation> {
    let [least, most] = distances(other, centre);
    if least < radius - slack && most > radius + slack {
        return Some(Relation::Cross);
    }
    if most <= radius + slack {
        return Some(Relation::Around);
    }
    let is_inside = match other {
        Body::Sphere(around, outer) => length(minus(*around, centre)) + radius <= outer + slack,
        Body::Cuboid(low, high) => contains([*low, *high], centre) && least >= radius - slack,
        Body::Cone(_) | Body::Polygon(_) => false,
    };
    is_inside.then_some(Relation::Inside)
}

/// The least and the largest distance of a point from a surface.
fn distances(body: &Body, p: Point) -> [f64; 2] {
    match body {
        Body::Sphere(centre, radius) => {
            let distance = length(minus(*centre, p));
            [(distance - radius).abs(), distance + radius]
        }
        Body::Cone(cone) => cone.distances(p),
        Body::Cuboid(low, high) => {
            let out = [0, 1, 2].map(|i| (low[i] - p[i]).max(p[i] - high[i]));
            let far = [0, 1, 2].map(|i| (p[i] - low[i]).max(high[i] - p[i]));
            let nearest = out.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let least = match nearest > 0.0 {
                true => length(out.map(|c| c.max(0.0))),
                false => -nearest,
            };
            [least, length(far)]
        }
        Body::Polygon(polygon) => {
            let height = polygon.height(p);
            let foot = minus(p, times(polygon.normal, height));
            let least = match polygon.contains(foot) {
                true => height.abs(),
                false => polygon.rim_distance(p),
            };
            let far = polygon.vertices.iter().map(|v| length(minus(*v, p)));
            [least, far.fold(0.0, f64::max)]
        }
    }
}

/// A box and what is no sphere. What is not in the open box, made smaller by `slack`, only touches it.
fn cuboid([low, high]: [Point; 2], other: &Body, slack: f64) -> Option<Relation> {
    let [low_other, high_other] = other.bounds();
    let within = |a: [Point; 2], b: [Point; 2]| {
        (0..3).all(|i| a[0][i] >= b[0][i] - slack && a[1][i] <= b[1][i] + slack)
    };
    let (of_box, of_other) = ([low, high], [low_other, high_other]);
    let enters = match other {
        Body::Cuboid(..) => {
            let apart =
                |i: usize| low[i] >= high_other[i] - slack || low_other[i] >= high[i] - slack;
            if (0..3).any(apart) {
                return None;
            }
            if within(of_box, of_other) {
                return Some(Relation::Inside);
            }
            true
        }
        Body::Polygon(polygon) => polygon_enters(of_box, polygon, slack),
        Body::Cone(cone) => cone_enters(of_box, cone, slack),
        Body::Sphere(..) => false,
    };
    match enters {
        false => None,
        true if within(of_other, of_box) => Some(Relation::Around),
        true => Some(Relation::Cross),
    }
}

/// Whether a polygon has points in an open box.
fn polygon_enters(of_box: [Point; 2], polygon: &Polygon, slack: f64) -> bool {
    if polygon.edges().any(|edge| enters(of_box, edge, slack)) {
        return true;
    }
    // No edge is in the box: all of the plane in it belongs to the polygon, or nothing does.
    let corners = corners(of_box);
    let heights = corners.map(|corner| polygon.height(corner));
    let is_cut = heights.iter().any(|h| *h > slack) && heights.iter().any(|h| *h < -slack);
    let on_edges = box_edges(of_box).filter_map(|[a, b]| {
        let (ha, hb) = (polygon.height(a), polygon.height(b));
        let crosses = ha.min(hb) < -slack && ha.max(hb) > slack;
        crosses.then(|| add(a, times(minus(b, a), ha / (ha - hb))))
    });
    let on_corners = corners
        .iter()
        .zip(heights)
        .filter(|(_, h)| h.abs() <= slack);
    let points: Vec<_> = on_edges
        .chain(on_corners.map(|(corner, _)| *corner))
        .collect();
    // The middle of what ends the plane in the box is in the box.
    let sum = points.iter().fold([0.0; 3], |sum, p| add(sum, *p));
    is_cut && polygon.contains(times(sum, 1.0 / points.len() as f64))
}

/// Whether the side of a cone has points in an open box.
fn cone_enters([low, high]: [Point; 2], cone: &Cone, slack: f64) -> bool {
    let inner = [low.map(|c| c + slack), high.map(|c| c - slack)];
    let line = cone.line(0.0);
    // A line of the side; else what is in the box ends at an edge of it, or at an end of the cone.
    enters(inner, line, 0.0)
        || box_edges(inner).any(|edge| !cone.crossings(edge, 0.0).is_empty())
        || faces(inner)
            .iter()
            .any(|face| circles_pass(cone, face, 0.0))
        || contains(inner, line[0])
}

/// Whether a circle of a cone passes through the side of another one: one of its points is inside, and the next one
/// outside. So parallel cylinders are found, whose lines never meet.
fn circles_cross(cone: &Cone, other: &Cone, slack: f64) -> bool {
    cone.circles(CIRCLES).any(|(middle, radius)| {
        let out = |i: u32| other.outside(cone.around(middle, radius, angle(i)), slack);
        (0..LINES).any(|i| match (out(i), out(i + 1)) {
            (Some(a), Some(b)) => a.min(b) < -slack && a.max(b) > slack,
            _ => false,
        })
    })
}

/// Whether a cone's side and a polygon cross: along an edge of either, or all around the cone.
fn cone_and_polygon(cone: &Cone, polygon: &Polygon, slack: f64) -> bool {
    polygon
        .edges()
        .any(|edge| !cone.crossings(edge, slack).is_empty())
        || circles_pass(cone, polygon, slack)
        || passes(cone.line(0.0), polygon, slack)
}

/// Whether a circle of a cone passes through a polygon.
fn circles_pass(cone: &Cone, polygon: &Polygon, slack: f64) -> bool {
    let along = cross(cone.axis, polygon.normal);
    let sine = length(along);
    if sine < 1e-9 {
        return false;
    }
    let along = times(along, 1.0 / sine);
    let down = cross(along, cone.axis);
    cone.circles(CIRCLES).any(|(middle, radius)| {
        // In the circle's plane the polygon's plane is a line at this distance.
        let away = polygon.height(middle) / dot(down, polygon.normal);
        if away.abs() >= radius - slack {
            return false;
        }
        let foot = minus(middle, times(down, away));
        let half = (radius * radius - away * away).sqrt();
        [half, -half].iter().any(|half| {
            let p = add(foot, times(along, *half));
            polygon.contains(p) && polygon.rim_distance(p) > slack
        })
    })
}

/// Whether the line between two points passes through a polygon.
fn passes([a, b]: [Point; 2], polygon: &Polygon, slack: f64) -> bool {
    let (ha, hb) = (polygon.height(a), polygon.height(b));
    if ha.min(hb) >= -slack || ha.max(hb) <= slack {
        return false;
    }
    let p = add(a, times(minus(b, a), ha / (ha - hb)));
    polygon.contains(p) && polygon.rim_distance(p) > slack
}

/// The angle of one of [`LINES`] lines.
fn angle(line: u32) -> f64 {
    TAU * f64::from(line) / f64::from(LINES)
}

/// Whether lines of one cone's side pass through the other's.
fn lines_cross(a: &Cone, b: &Cone, slack: f64) -> bool {
    let mut lines = (0..LINES).map(|i| a.line(angle(i)));
    lines.any(|line| !b.crossings(line, slack).is_empty())
}

/// Two polygons cross where both have points on both sides of the other's plane.
fn polygons(a: &Polygon, b: &Polygon, slack: f64) -> bool {
    let along = cross(a.normal, b.normal);
    if length(along) < 1e-9 {
        return false;
    }
    let along = times(along, 1.0 / length(along));
    let pieces = |of: &Polygon, plane: &Polygon| {
        let side = |sign: f64| sections(of, plane, along, sign, slack);
        common(&side(1.0), &side(-1.0))
    };
    let shared = common(&pieces(a, b), &pieces(b, a));
    shared.iter().any(|[from, to]| to - from > slack)
}

/// Where the part of a polygon on one side of a plane borders on the plane: pieces of the line in both, in order.
fn sections(of: &Polygon, plane: &Polygon, along: Point, sign: f64, slack: f64) -> Vec<[f64; 2]> {
    let height = |p| sign * plane.height(p);
    let mut places: Vec<_> = of
        .edges()
        .filter(|[a, b]| (height(*a) > slack) != (height(*b) > slack))
        .map(|[a, b]| {
            let (ha, hb) = (height(a), height(b));
            let share = (ha / (ha - hb)).clamp(0.0, 1.0);
            dot(along, add(a, times(minus(b, a), share)))
        })
        .collect();
    places.sort_by(f64::total_cmp);
    places.as_chunks::<2>().0.to_vec()
}

/// What two lists of pieces in order have in common.
fn common(a: &[[f64; 2]], b: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
    pairs
        .map(|(a, b)| [a[0].max(b[0]), a[1].min(b[1])])
        .filter(|[from, to]| from < to)
        .collect()
}

/// Whether the line between two points is in an open box for longer than `slack`.
fn enters([low, high]: [Point; 2], [a, b]: [Point; 2], slack: f64) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for i in 0..3 {
        let way = b[i] - a[i];
        let (low, high) = (low[i] + slack, high[i] - slack);
        if way == 0.0 {
            if a[i] <= low || a[i] >= high {
                return false;
            }
            continue;
        }
        let (one, other) = ((low - a[i]) / way, (high - a[i]) / way);
        from = from.max(one.min(other));
        to = to.min(one.max(other));
    }
    (to - from) * length(minus(b, a)) > slack
}

fn contains([low, high]: [Point; 2], p: Point) -> bool {
    (0..3).all(|i| low[i] < p[i] && p[i] < high[i])
}

/// The corners of a box; bit i of the index tells which of both along axis i.
fn corners([low, high]: [Point; 2]) -> [Point; 8] {
    std::array::from_fn(|corner| {
        [0, 1, 2].map(|i| {
            if corner >> i & 1 == 0 {
                low[i]
            } else {
                high[i]
            }
        })
    })
}

fn box_edges(of_box: [Point; 2]) -> impl Iterator<Item = [Point; 2]> {
    let corners = corners(of_box);
    (0..3).flat_map(move |axis| {
        let starts = (0..8).filter(move |corner| corner >> axis & 1 == 0);
        starts.map(move |corner| [corners[corner], corners[corner | 1 << axis]])
    })
}

fn faces(of_box: [Point; 2]) -> Vec<Polygon> {
    let corners = corners(of_box);
    let face = |axis: usize, side: usize| {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let start = side << axis;
        let around = [start, start | u, start | u | v, start | v];
        Polygon::new(around.map(|corner| corners[corner]).to_vec())
    };
    let all = (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]);
    all.filter_map(|(axis, side)| face(axis, side)).collect()
}
