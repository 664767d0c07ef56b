//! Checks whether vertices lie in one plane.
//!
//! The plane goes through the first vertex *o*, the vertex *a* farthest from it and the vertex *b* farthest from the
//! line *oa*. Every vertex is *o* + α(*a* − *o*) + β(*b* − *o*) with |β| ≤ 1 and |α| ≤ 2. However thin the polygon, if
//! each vertex is off a common plane by at most δ, it is off this plane by at most δ(1 + |1 − α − β| + |α| + |β|) ≤ 8δ.
//! The sum over the edges (Newell's normal) does not work: it is 0 for a symmetric bow tie, which is allowed.
//!
//! Files often hold six significant digits. This rounding moves a coordinate by up to 5e-6 of its value and a vertex
//! off the plane by up to √3 times that; 8δ is then 7e-5 of the largest coordinate. Therefore the tolerance is **1e-4
//! of the largest absolute coordinate, but no less than 1e-4 and no more than 1e-2 of the polygon's size**, where the
//! size is the distance from *o* to *a*. Beyond that, up to **1e-3 of its size** (three decimals), the polygon is
//! accepted as odd: it is drawn flat, and may not quite meet its neighbours.

use super::Fault;
use crate::model::Point;
use crate::point::{cross, dot};

/// A polygon counts as a line if its height is at most this fraction of its longest side.
const THINNEST: f64 = 1e-9;

/// A polygon may be off its plane by this fraction of its size, with a warning.
const UNEVEN: f64 = 1e-3;

/// What is odd about a polygon, but no mistake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Oddity {
    /// All vertices on one line: it cannot be rendered, and is left out.
    NoArea,
    /// A vertex equal to the one before it, 0 if the last one equals the first.
    RepeatedVertex { vertex: usize },
    /// A vertex at some distance, in scene units, from the plane of the others.
    Uneven { vertex: usize, distance: f64 },
}

/// Checks three or more finite vertices: not all on a line, all in a plane. Works for coordinates of any magnitude.
pub(super) fn polygon(vertices: &[Point]) -> Result<Option<Oddity>, Fault> {
    let unit = largest(
        &mut vertices
            .iter()
            .map(|vertex| half_difference(vertex, &vertices[0])),
    );
    if unit < f64::MIN_POSITIVE {
        return Err(Fault::Collinear);
    }
    // From here on, lengths are divided by 2 · `unit`, so that squares stay in range.
    let scale = 1.0 / unit;
    let offset = |vertex: &Point| half_difference(vertex, &vertices[0]).map(|d| d * scale);
    let coordinate = largest(vertices.iter().copied()) * 0.5 * scale;

    let a = farthest(vertices.iter().map(offset));
    let size = length(a);
    let normal = farthest(vertices.iter().map(|vertex| cross(a, offset(vertex))));
    let height = length(normal) / size;
    if height <= THINNEST * size {
        return Err(Fault::Collinear);
    }

    let normal = normal.map(|component| component / (height * size));
    let distance = |vertex: &Point| dot(normal, offset(vertex)).abs();
    let (vertex, distance) =
        vertices
            .iter()
            .map(distance)
            .enumerate()
            .fold(
                (0, 0.0),
                |worst, this| if this.1 > worst.1 { this } else { worst },
            );
    let usual = (1e-4 * coordinate).clamp(1e-4 * size, 1e-2 * size);
    let most = usual.max(UNEVEN * size);
    let told = |length: f64| 2.0 * length * unit;
    if distance > most {
        return Err(Fault::NotPlanar {
            vertex,
            distance: told(distance),
            tolerance: told(most),
        });
    }
    if distance > usual {
        let distance = told(distance);
        return Ok(Some(Oddity::Uneven { vertex, distance }));
    }
    let before = vertices.iter().cycle().skip(vertices.len() - 1);
    let repeated = vertices.iter().zip(before).position(|(a, b)| a == b);
    Ok(repeated.map(|vertex| Oddity::RepeatedVertex { vertex }))
}

/// Returns half of `a − b`, which cannot overflow.
pub(super) fn half_difference(a: &Point, b: &Point) -> Point {
    [
        a[0] * 0.5 - b[0] * 0.5,
        a[1] * 0.5 - b[1] * 0.5,
        a[2] * 0.5 - b[2] * 0.5,
    ]
}

/// Returns `vector` scaled to length 1, or `None` if it is zero.
pub(super) fn unit(vector: Point) -> Option<Point> {
    let largest = vector
        .iter()
        .fold(0.0, |largest: f64, number| largest.max(number.abs()));
    (largest > 0.0).then(|| {
        let scaled = vector.map(|number| number / largest);
        let length = length(scaled);
        scaled.map(|number| number / length)
    })
}

pub(super) fn length(vector: Point) -> f64 {
    dot(vector, vector).sqrt()
}

/// Returns the largest absolute coordinate of `points`.
fn largest(points: impl Iterator<Item = Point>) -> f64 {
    points
        .flatten()
        .fold(0.0, |largest, number| largest.max(number.abs()))
}

/// Returns the longest of `vectors`, the first if several are equal, or zero if there are none.
fn farthest(vectors: impl Iterator<Item = Point>) -> Point {
    vectors.fold([0.0; 3], |longest, vector| {
        if dot(vector, vector) > dot(longest, longest) {
            vector
        } else {
            longest
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SQUARE: [Point; 4] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];

    fn six_digits(number: f64) -> f64 {
        format!("{number:.5e}").parse().unwrap()
    }

    #[test]
    fn bow_ties_and_bridged_holes_are_polygons() {
        let [a, b, c, d] = SQUARE;
        assert_eq!(polygon(&[a, c, b, d]), Ok(None));
        // A hole, joined by an edge that is traversed twice.
        let hole = [
            [0.2, 0.2, 0.0],
            [0.4, 0.6, 0.0],
            [0.6, 0.2, 0.0],
            [0.2, 0.2, 0.0],
        ];
        assert_eq!(polygon(&[&[a, b, c, d, a], &hole[..]].concat()), Ok(None));
    }

    #[test]
    fn thin_is_not_collinear() {
        assert_eq!(
            polygon(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-6, 0.0]]),
            Ok(None)
        );
        let line = [
            [1.1, 2.2, 3.3],
            [2.2, 4.4, 6.6],
            [0.3, 0.6, 0.9],
            [1.0, 2.0, 3.0],
        ];
        assert_eq!(polygon(&line), Err(Fault::Collinear));
    }

    #[test]
    fn size_and_place_do_not_matter() {
        for scale in [1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e307] {
            let scaled = SQUARE.map(|vertex| vertex.map(|number| (number - 0.5) * scale));
            assert_eq!(polygon(&scaled), Ok(None), "{scale}");
            let mut bent = scaled;
            bent[2][2] += 0.02 * scale;
            assert!(
                matches!(polygon(&bent), Err(Fault::NotPlanar { .. })),
                "{scale}"
            );
            let line = [0.0, 0.5, -1.0].map(|along| [along * scale; 3]);
            assert_eq!(polygon(&line), Err(Fault::Collinear), "{scale}");
        }
        for far in [1e3, 1e6, 1e12] {
            let mut moved = SQUARE.map(|vertex| vertex.map(|number| number + far));
            assert_eq!(polygon(&moved), Ok(None), "{far}");
            moved[2][2] += 0.25;
            assert!(
                matches!(polygon(&moved), Err(Fault::NotPlanar { .. })),
                "{far}"
            );
        }
    }

    #[test]
    fn the_largest_numbers_do_not_overflow() {
        let huge = f64::MAX;
        let corner = |x: f64, y: f64| [x * huge, y * huge, huge];
        let vertices = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        assert_eq!(polygon(&vertices), Ok(None));
        assert_eq!(
            unit([huge, huge, 0.0]).map(|u| u[0] == u[1] && length(u) < 1.01),
            Some(true)
        );
    }

    #[test]
    fn three_decimals_are_odd_and_more_is_no_plane() {
        let [a, b, c, d] = SQUARE;
        let bent = |by: f64| polygon(&[a, b, [c[0], c[1], by], d]);
        assert_eq!(bent(1e-4), Ok(None));
        let Ok(Some(Oddity::Uneven { distance, .. })) = bent(0.001) else {
            panic!("{:?}", bent(0.001));
        };
        assert!((0.0005..0.0011).contains(&distance), "{distance}");
        assert!(matches!(bent(0.004), Err(Fault::NotPlanar { .. })));
    }

    #[test]
    fn a_repeated_vertex_is_odd_unless_nothing_is_left() {
        let [a, b, c, d] = SQUARE;
        let repeated = |vertex| Ok(Some(Oddity::RepeatedVertex { vertex }));
        assert_eq!(polygon(&[a, b, b, c]), repeated(2));
        assert_eq!(polygon(&[a, b, d, a]), repeated(0));
        assert_eq!(polygon(&[a, b, b]), Err(Fault::Collinear));
        assert_eq!(polygon(&[a, a, a, a]), Err(Fault::Collinear));
    }

    proptest! {
        /// The claim of this module's documentation, also for polygons ten times as far away as they are large, and for
        /// slivers.
        #[test]
        fn six_digits_are_enough(
            frame in prop::array::uniform3(prop::array::uniform3(-1.0..1.0)),
            far in 0.0..10.0,
            thin in prop_oneof![Just(1.0), Just(1e-3)],
            places in prop::collection::vec((-1.0..1.0, -1.0..1.0), 4..12),
            scale in -9..9,
        ) {
            let [o, u, v] = frame;
            let scale = 10f64.powi(scale);
            let vertices: Vec<Point> = places
                .iter()
                .map(|(x, y)| {
                    [0, 1, 2].map(|i| six_digits(scale * (far * o[i] + x * u[i] + thin * y * v[i])))
                })
                .collect();
            let verdict = polygon(&vertices);
            prop_assert!(!matches!(verdict, Err(Fault::NotPlanar { .. })), "{:?}", verdict);
        }

        #[test]
        fn nothing_finite_panics(
            vertices in prop::collection::vec(prop::array::uniform3(any::<f64>()), 3..6)
        ) {
            let finite = vertices.iter().flatten().all(|number| number.is_finite());
            prop_assume!(finite);
            if let Err(Fault::NotPlanar { vertex, .. }) = polygon(&vertices) {
                prop_assert!(vertex < vertices.len());
            }
        }
    }
}
