//! Points in polygons: on and near vertices, edges and diagonals.

use crate::exact::Exact;
use crate::fixtures::{self, outline, polygon};
use crate::method::{About, Form, SHIPPED, Sweep};
use crate::number::{Number, counted, span, vector};
use crate::random::Random;
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::object::ObjectKind;
use octray_core::ray::Ray;

/// Queries at 10⁻¹ to 10⁻⁹ of a polygon's size from its vertices, edges and diagonals, and from the lines on which the
/// thesis's ray hits a vertex; and exactly on them. A hit means a point inside.
#[derive(Debug)]
pub struct Polygon;

impl Sweep for Polygon {
    const ABOUT: About = About {
        name: "polygon",
        title: "Point in polygon",
        axis: "size / distance from vertices, edges, diagonals; last: on them",
        unit: "",
        values: &[
            1e1,
            2e1,
            5e1,
            1e2,
            2e2,
            5e2,
            1e3,
            2e3,
            5e3,
            1e4,
            1e5,
            1e6,
            1e7,
            1e8,
            1e9,
            f64::INFINITY,
        ],
        home: 1e1,
        forms: &[
            Form {
                name: SHIPPED,
                label: "closed edges",
            },
            Form {
                name: "thesis",
                label: "ray through the middle of an edge that meets no vertex",
            },
            Form {
                name: "thesis without remedy",
                label: "ray through the middle of the first edge",
            },
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            ..StateLimits::NONE
        },
    };

    fn setting(_: f64) -> Setting {
        Setting::pixel(1.0)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); Self::ABOUT.forms.len()];
        for query in queries::<S>(value) {
            let truth = inside(&query);
            let found = forms().map(|form| counted(|| form(query)));
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.saturations += saturations;
                errors.decide(truth.unwrap_or(found), found);
            }
        }
        all_errors
    }
}

/// The half width of [`square`], in units of 1/16 of the star's half width.
pub const REACH: i32 = 17;

/// A star with four points, in those units.
pub const STAR: [[f64; 2]; 8] = [
    [16.0, 0.0],
    [4.0, 4.0],
    [0.0, 16.0],
    [-4.0, 4.0],
    [-16.0, 0.0],
    [-4.0, -4.0],
    [0.0, -16.0],
    [4.0, -4.0],
];

/// A query: is a point in the star?
#[derive(Clone, Copy, Debug)]
pub struct Query<S> {
    /// The star's corners.
    pub corners: [[S; 2]; 8],
    /// The point.
    pub point: [S; 2],
}

/// The answers for one point.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// The point, in units of 1/16 of the star's half width.
    pub point: [f64; 2],
    /// The exact answer: whether it is inside. Of a point that is on an edge but for rounding either is right.
    pub truth: Option<bool>,
    /// The answer of each form.
    pub found: [bool; 3],
}

/// The forms, in the order of [`Polygon::ABOUT`].
fn forms<S: Number>() -> [fn(Query<S>) -> bool; 3] {
    [shipped, thesis, thesis_without_remedy]
}

/// Returns the answers for a square of points around the star, half a unit apart. Many lie on its edges, their
/// diagonals, and the lines on which the thesis's ray hits a vertex.
pub fn square<S: Number>() -> Vec<Answer> {
    let unit = span::<S>() / 4.0 / 16.0;
    let corners = STAR.map(|c| c.map(|x| S::from_f64(x * unit)));
    let steps = || (-2 * REACH..=2 * REACH).map(|i| f64::from(i) / 2.0);
    let answer = |point: [f64; 2]| {
        let query = Query {
            corners,
            point: point.map(|x| S::from_f64(x * unit)),
        };
        Answer {
            point,
            truth: inside(&query),
            found: forms().map(|form| form(query)),
        }
    };
    steps()
        .flat_map(|y| steps().map(move |x| answer([x, y])))
        .collect()
}

/// Returns the queries at a distance of the star's half width over `value`.
pub fn queries<S: Number>(value: f64) -> Vec<Query<S>> {
    let mut random = Random::new(8);
    let unit = span::<S>() / 4.0 / 16.0;
    let corners = STAR.map(|c| c.map(|x| S::from_f64(x * unit)));
    let middle = |a: [f64; 2], b: [f64; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    let next = |i: usize, by: usize| STAR[(i + by) % STAR.len()];
    let sight = middle(STAR[0], STAR[1]);
    let mut points = Vec::new();
    for (i, &corner) in STAR.iter().enumerate() {
        points.push(corner);
        for share in [0.125, 0.5, 0.75] {
            let along = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
            points.push(along(corner, next(i, 1)));
            points.push(along(next(1, 2 * i), next(5, 2 * i)));
            // Beyond the point, its ray hits the vertex.
            points.push(along(
                corner,
                [2.0 * corner[0] - sight[0], 2.0 * corner[1] - sight[1]],
            ));
        }
    }
    let off = 16.0 / value;
    let near = |p: [f64; 2]| {
        let mut aside = || {
            if random.between(0.0, 1.0) < 0.5 {
                -off
            } else {
                off
            }
        };
        let point = [p[0] + aside(), p[1] + aside()];
        Query {
            corners,
            point: point.map(|x| S::from_f64(x * unit)),
        }
    };
    points.into_iter().map(near).collect()
}

/// Applies the rule of `docs/MODEL.md` exactly: even–odd, and edges belong to the polygon. `None` for a point that is so near
/// an edge that rounding may put it there.
pub fn inside<S: Number>(query: &Query<S>) -> Option<bool> {
    let [x, y] = query.point;
    let reach = x.abs().max(y.abs()).max(S::from_f64(height::<S>()));
    let room = S::coordinate_error(reach).exact();
    let point = query.point.map(S::exact);
    let corners = query.corners.map(|c| c.map(S::exact));
    let (mut odd, mut near) = (false, false);
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
        let [u, v] = [0, 1].map(|i| &high[i] - &low[i]);
        let rest = (&point[0] - &low[0]) * &v - &u * (&point[1] - &low[1]);
        let within = |i: usize, room: &Exact| {
            let (least, most) = if a[i] < b[i] {
                (&a[i], &b[i])
            } else {
                (&b[i], &a[i])
            };
            least - room <= point[i] && point[i] <= most + room
        };
        if rest == Exact::ZERO && within(0, &Exact::ZERO) && within(1, &Exact::ZERO) {
            return Some(true);
        }
        let size = |x: &Exact| if *x < Exact::ZERO { -x } else { x.clone() };
        // The room of octray's test is √2 times as wide at most.
        near |=
            size(&rest) <= &room * (size(&u) + size(&v)) && within(0, &room) && within(1, &room);
        if low[1] <= point[1] && point[1] < high[1] {
            odd ^= rest < Exact::ZERO;
        }
    }
    (!near).then_some(odd)
}

/// How far above the polygon rays start.
fn height<S: Number>() -> f64 {
    span::<S>() / 8.0
}

/// Applies octray's test: the polygon lies in z = 0, and the ray is perpendicular to it.
pub fn shipped<S: Number>(query: Query<S>) -> bool {
    let [x, y] = query.point;
    let height = S::from_f64(height::<S>());
    let ray = Ray::new([x, y, height].into(), vector([0.0, 0.0, -1.0]));
    let star = outline(vector([0.0, 0.0, 1.0]), S::ZERO, &query.corners);
    fixtures::hit(
        &polygon(&star, &query.corners),
        ObjectKind::Polygon,
        &ray,
        S::MAX,
    )
    .is_some()
}

/// Applies the thesis's rule with its remedies (pages 14 to 16). A point is inside if it is a vertex ("pre-inside").
/// Otherwise a line goes from it through the middle of an edge: the first one whose line meets no vertex. The point is
/// inside if the line intersects an odd number of edges.
pub fn thesis<S: Number>(query: Query<S>) -> bool {
    let Query { corners, point } = query;
    if corners.contains(&point) {
        return true;
    }
    let none = S::product(S::ZERO, S::ZERO);
    let meets_none = |edge: &usize| {
        let along = along(query, *edge);
        let mut areas = corners
            .iter()
            .map(|corner| area(minus(*corner, point), along));
        areas.all(|area| area != none)
    };
    // If each line meets a vertex, the first is as good as any.
    let edge = (0..corners.len()).find(meets_none).unwrap_or_default();
    crosses_oddly(query, edge)
}

/// The same without remedies: the line goes through the middle of the first edge, and a vertex is no special case.
pub fn thesis_without_remedy<S: Number>(query: Query<S>) -> bool {
    crosses_oddly(query, 0)
}

fn minus<S: Number>(a: [S; 2], b: [S; 2]) -> [S; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn area<S: Number>(a: [S; 2], b: [S; 2]) -> S::Wide {
    S::product(a[0], b[1]) - S::product(a[1], b[0])
}

/// From the point to the middle of an edge.
fn along<S: Number>(query: Query<S>, edge: usize) -> [S; 2] {
    let half = S::from_f64(0.5);
    let [a, b] = [edge, edge + 1].map(|i| query.corners[i % query.corners.len()]);
    // Halve first, so that the sum fits.
    let middle = [0, 1].map(|k| a[k] * half + b[k] * half);
    minus(middle, query.point)
}

/// Whether the line from the point through the middle of an edge intersects an odd number of edges.
fn crosses_oddly<S: Number>(query: Query<S>, edge: usize) -> bool {
    let none = S::product(S::ZERO, S::ZERO);
    let along = along(query, edge);
    let mut odd = false;
    let next = query.corners.iter().cycle().skip(1);
    for (a, b) in query.corners.iter().zip(next) {
        let (edge, to_edge) = (minus(*b, *a), minus(*a, query.point));
        let mut below = area(along, edge);
        let mut on_ray = area(to_edge, edge);
        let mut on_edge = area(to_edge, along);
        if below < none {
            (below, on_ray, on_edge) = (none - below, none - on_ray, none - on_edge);
        }
        // Both parameters are these over `below`: compared, not divided. Parallel edges do not intersect.
        odd ^= none < below && none <= on_ray && none <= on_edge && on_edge <= below;
    }
    odd
}
