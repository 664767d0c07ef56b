//! The plane of a polygon's vertices.

use super::camera::unit;
use octray_scenes::model::Point;
use octray_scenes::point::{add, cross, dot, times};

/// The unit normal of the plane that vertices span.
///
/// It is that of Newell's sum, to which every edge contributes, so that the noise of written digits averages out. Where
/// lobes of an outline that crosses itself cancel in that sum, noise is what is left of it: then it is the normal
/// of the widest triangle of the first vertex, the one farthest from it and any third.
///
/// `middle` is the mean of the vertices; sums are taken from there, where they cancel least.
pub(super) fn normal(vertices: &[Point], middle: Point) -> Point {
    let Some(&first) = vertices.first() else {
        return [0.0; 3];
    };
    let from_first = |v: &Point| add(*v, times(first, -1.0));
    let longest = |a: Point, b: Point| if dot(b, b) > dot(a, a) { b } else { a };
    let far = vertices.iter().map(from_first).fold([0.0; 3], longest);
    let widest = (vertices.iter().map(|v| cross(far, from_first(v)))).fold([0.0; 3], longest);
    let from_middle = |v: &Point| add(*v, times(middle, -1.0));
    let next = vertices.iter().cycle().skip(1);
    let newell = vertices.iter().zip(next).fold([0.0; 3], |sum, (a, b)| {
        add(sum, cross(from_middle(a), from_middle(b)))
    });
    if 16.0 * dot(newell, newell) < dot(widest, widest) {
        unit(widest)
    } else {
        unit(newell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lobes_that_cancel_leave_the_plane_of_the_vertices() {
        // Z order, once exactly and once with a vertex off by what three decimals leave.
        for noise in [0.0, 5e-4, -5e-4] {
            let z = [
                [0.0, 0.0, 0.0],
                [2.0, 0.0, noise],
                [0.0, 1.0, 0.0],
                [2.0, 1.0, 0.0],
            ];
            let n = normal(&z, [1.0, 0.5, noise / 4.0]);
            assert!(n[2].abs() > 0.999_999, "{n:?}");
        }
    }

    #[test]
    fn what_turns_left_faces_up() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| [x, y, 7.0]);
        assert_eq!(normal(&square, [0.5, 0.5, 7.0]), [0.0, 0.0, 1.0]);
    }
}
