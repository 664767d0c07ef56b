//! Polygons and patches.

use super::vector::{Ray, V3};

/// A planar polygon, or a patch if it has vertex normals.
#[derive(Debug)]
pub(super) struct Polygon {
    vertices: Vec<V3>,
    normals: Option<Vec<V3>>,
    /// Unit normal of the plane; the vertices turn around it by the right-hand rule.
    pub(super) normal: V3,
}

impl Polygon {
    pub(super) fn new(vertices: Vec<V3>, normals: Option<Vec<V3>>) -> Self {
        assert!(
            vertices.len() >= 3,
            "a polygon of {} vertices",
            vertices.len()
        );
        let first = vertices[0];
        let double_area = edges(&vertices)
            .map(|(a, b)| (a - first).cross(b - first))
            .fold(V3::ZERO, |sum, cross| sum + cross);
        // The largest triangle of the first vertex and two others, where lobes cancel in the sum.
        let largest = vertices
            .iter()
            .flat_map(|&a| vertices.iter().map(move |&b| (a - first).cross(b - first)))
            .max_by(|a, b| a.length().total_cmp(&b.length()))
            .unwrap_or(double_area);
        let cancels = double_area.length() < 1e-3 * largest.length();
        Self {
            vertices,
            normals,
            normal: if cancels { largest } else { double_area }.unit(),
        }
    }

    /// Returns the t > 0 at which a ray hits the polygon; a ray in its plane does not.
    pub(super) fn hit(&self, ray: &Ray) -> Option<f64> {
        let t = self.normal.dot(self.vertices[0] - ray.origin) / self.normal.dot(ray.direction);
        (t > 0.0 && t.is_finite() && self.contains(ray.at(t))).then_some(t)
    }

    /// Returns whether a point of the plane is inside, by the even-odd rule, or on an edge but for rounding.
    ///
    /// The polygon is projected along the largest component of its normal. An edge counts if the line from the point in
    /// the direction of growing u crosses it. It owns its lower end (in v) but not its upper end.
    fn contains(&self, point: V3) -> bool {
        let (u, v) = match self.normal.largest_axis() {
            0 => (1, 2),
            1 => (0, 2),
            _ => (0, 1),
        };
        let crosses = |&(a, b): &(V3, V3)| {
            let (low, high) = if a[v] <= b[v] { (a, b) } else { (b, a) };
            if point[v] < low[v] || point[v] >= high[v] {
                return false;
            }
            let share = (point[v] - low[v]) / (high[v] - low[v]);
            point[u] < low[u] + (high[u] - low[u]) * share
        };
        let on_edge = |(a, b): (V3, V3)| {
            let along = b - a;
            let share = (point - a).dot(along) / along.dot(along);
            let nearest = a + along * share.clamp(0.0, 1.0);
            (point - nearest).length() <= 1e-13 * (point.length() + along.length())
        };
        edges(&self.vertices).filter(crosses).count() % 2 == 1 || edges(&self.vertices).any(on_edge)
    }

    /// Returns the unit normal for shading at a point: on a patch, interpolated over the triangle of the fan that
    /// contains the point or is nearest to it.
    pub(super) fn shading_normal(&self, point: V3) -> V3 {
        let Some(normals) = &self.normals else {
            return self.normal;
        };
        let mut best = (f64::NEG_INFINITY, self.normal);
        for k in 1..self.vertices.len() - 1 {
            let (a, b, c) = (self.vertices[0], self.vertices[k], self.vertices[k + 1]);
            let area = |p: V3, q: V3, r: V3| self.normal.dot((q - p).cross(r - p));
            let whole = area(a, b, c);
            let (wa, wb, wc) = (
                area(point, b, c) / whole,
                area(a, point, c) / whole,
                area(a, b, point) / whole,
            );
            let least = wa.min(wb).min(wc);
            if whole != 0.0 && least > best.0 {
                best = (
                    least,
                    normals[0] * wa + normals[k] * wb + normals[k + 1] * wc,
                );
            }
        }
        best.1.unit()
    }

    pub(super) fn bounding_sphere(&self) -> (V3, f64) {
        let count = self.vertices.len() as f64;
        let centre = self.vertices.iter().fold(V3::ZERO, |sum, &v| sum + v) * (1.0 / count);
        (
            centre,
            self.vertices
                .iter()
                .map(|&v| (v - centre).length())
                .fold(0.0, f64::max),
        )
    }
}

/// Returns the edges of a closed outline.
fn edges(vertices: &[V3]) -> impl Iterator<Item = (V3, V3)> + '_ {
    vertices
        .iter()
        .copied()
        .zip(vertices.iter().copied().cycle().skip(1))
}
