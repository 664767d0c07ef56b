//! Shapes as the tests of pairs want them, in `f64` and in scene units.

use octray_scenes::model::{Point, Scene, Shape};
use octray_scenes::point::{add, cross, dot, times};

/// A shape.
#[derive(Clone, Debug)]
pub(super) enum Body {
    /// Centre and radius.
    Sphere(Point, f64),
    /// Low and high corner.
    Cuboid(Point, Point),
    /// The side of a truncated cone.
    Cone(Cone),
    /// A polygon or a patch.
    Polygon(Polygon),
}

/// The side of a truncated cone or cylinder.
#[derive(Clone, Debug)]
pub(super) struct Cone {
    /// The middle of its base.
    pub(super) base: Point,
    /// The unit vector to its top.
    pub(super) axis: Point,
    /// How far away that is.
    pub(super) height: f64,
    /// Radii at the base and at the top.
    pub(super) radii: [f64; 2],
    /// Unit vectors across the axis and each other.
    across: [Point; 2],
}

/// A planar polygon, inside by the even–odd rule.
#[derive(Clone, Debug)]
pub(super) struct Polygon {
    pub(super) vertices: Vec<Point>,
    /// The plane: its unit normal, and how far it is from the origin along that.
    pub(super) normal: Point,
    pub(super) offset: f64,
}

impl Body {
    /// The shape of an object; `None` if a polygon has no plane, which the parser leaves out.
    pub(super) fn of(scene: &Scene, shape: &Shape) -> Option<Self> {
        Some(match *shape {
            Shape::Sphere { centre, radius } => Self::Sphere(centre, radius),
            Shape::Cuboid { centre, size } => {
                let half = times(size, 0.5);
                Self::Cuboid(add(centre, times(half, -1.0)), add(centre, half))
            }
            Shape::Cone {
                base,
                base_radius,
                top,
                top_radius,
            } => {
                let along = minus(top, base);
                let height = length(along);
                let axis = times(along, 1.0 / height);
                let least = (0..3).min_by(|&a, &b| axis[a].abs().total_cmp(&axis[b].abs()))?;
                let mut other = [0.0; 3];
                other[least] = 1.0;
                let first = unit(cross(axis, other))?;
                Self::Cone(Cone {
                    base,
                    axis,
                    height,
                    radii: [base_radius, top_radius],
                    across: [first, cross(axis, first)],
                })
            }
            Shape::Polygon { first, count } | Shape::Patch { first, count, .. } => {
                let vertices = &scene.vertices[first as usize..][..count as usize];
                Self::Polygon(Polygon::new(vertices.to_vec())?)
            }
        })
    }

    /// Its low and high corner.
    pub(super) fn bounds(&self) -> [Point; 2] {
        let around = |points: &[Point]| {
            let all = |pick: fn(f64, f64) -> f64, start: f64| {
                [0, 1, 2].map(|i| points.iter().map(|p| p[i]).fold(start, pick))
            };
            [
                all(f64::min, f64::INFINITY),
                all(f64::max, f64::NEG_INFINITY),
            ]
        };
        match self {
            Self::Sphere(centre, radius) => [-radius, *radius].map(|r| centre.map(|c| c + r)),
            Self::Cuboid(low, high) => [*low, *high],
            Self::Polygon(polygon) => around(&polygon.vertices),
            Self::Cone(cone) => {
                let ends = [(0.0, cone.radii[0]), (cone.height, cone.radii[1])];
                let corners = ends.map(|(height, radius)| {
                    let centre = add(cone.base, times(cone.axis, height));
                    // How far a circle reaches along each axis of space.
                    let reach = cone.axis.map(|c| radius * (1.0 - c * c).max(0.0).sqrt());
                    [minus(centre, reach), add(centre, reach)]
                });
                around(corners.as_flattened())
            }
        }
    }
}

impl Polygon {
    /// A polygon in the plane of its vertices; `None` if they are on a line.
    pub(super) fn new(vertices: Vec<Point>) -> Option<Self> {
        let middle = times(
            vertices.iter().fold([0.0; 3], |sum, v| add(sum, *v)),
            1.0 / vertices.len() as f64,
        );
        let triangle = |[a, b]: [Point; 2]| cross(minus(a, middle), minus(b, middle));
        let sum = edges(&vertices).fold([0.0; 3], |sum, edge| add(sum, triangle(edge)));
        let around: f64 = edges(&vertices).map(|[a, b]| length(minus(b, a))).sum();
        let normal = match length(sum) > 1e-6 * around * around {
            true => sum,
            // The lobes of a crossing outline cancel: the largest triangle of an edge and a vertex.
            false => edges(&vertices)
                .flat_map(|[a, b]| {
                    let others = vertices.iter();
                    others.map(move |c| cross(minus(b, a), minus(*c, a)))
                })
                .max_by(|a, b| length(*a).total_cmp(&length(*b)))?,
        };
        let normal = unit(normal)?;
        Some(Self {
            offset: dot(normal, middle),
            normal,
            vertices,
        })
    }

    /// How far a point is before the plane.
    pub(super) fn height(&self, p: Point) -> f64 {
        dot(self.normal, p) - self.offset
    }

    /// Its edges.
    pub(super) fn edges(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        edges(&self.vertices)
    }

    /// Whether a point of the plane is inside.
    pub(super) fn contains(&self, p: Point) -> bool {
        let largest = (0..3).max_by(|&a, &b| self.normal[a].abs().total_cmp(&self.normal[b].abs()));
        let (u, v) = [(1, 2), (2, 0), (0, 1)][largest.unwrap_or(0)];
        let right = |[a, b]: &[Point; 2]| {
            if (a[v] > p[v]) == (b[v] > p[v]) {
                return false;
            }
            a[u] + (p[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u]) > p[u]
        };
        self.edges().filter(right).count() % 2 == 1
    }

    /// How far a point is from the nearest edge.
    pub(super) fn rim_distance(&self, p: Point) -> f64 {
        let distances = self.edges().map(|edge| segment_distance(edge, p));
        distances.fold(f64::INFINITY, f64::min)
    }
}

impl Cone {
    /// The line of the side at an angle about the axis, from the base to the top.
    pub(super) fn line(&self, angle: f64) -> [Point; 2] {
        let (sine, cosine) = angle.sin_cos();
        let out = add(times(self.across[0], cosine), times(self.across[1], sine));
        let top = add(self.base, times(self.axis, self.height));
        [
            add(self.base, times(out, self.radii[0])),
            add(top, times(out, self.radii[1])),
        ]
    }

    /// At least two circles, from its base to its top, as far from each other: middle and radius.
    pub(super) fn circles(&self, count: u32) -> impl Iterator<Item = (Point, f64)> + '_ {
        (0..count).map(move |i| {
            let share = f64::from(i) / f64::from(count - 1);
            let middle = add(self.base, times(self.axis, self.height * share));
            let radius = self.radii[0] * (1.0 - share) + self.radii[1] * share;
            (middle, radius)
        })
    }

    /// The point of a circle at an angle about the axis.
    pub(super) fn around(&self, middle: Point, radius: f64, angle: f64) -> Point {
        let (sine, cosine) = angle.sin_cos();
        let out = add(times(self.across[0], cosine), times(self.across[1], sine));
        add(middle, times(out, radius))
    }

    /// How much farther from the axis a point is than the side; `None` beyond the ends.
    pub(super) fn outside(&self, p: Point, slack: f64) -> Option<f64> {
        let from = minus(p, self.base);
        let height = dot(from, self.axis);
        let radius = self.radii[0] + (self.radii[1] - self.radii[0]) * height / self.height;
        let out = length(minus(from, times(self.axis, height)));
        (slack..self.height - slack)
            .contains(&height)
            .then_some(out - radius)
    }

    /// Where a line from `a` to `b` passes through the side, as shares of the way; it must not just touch it, nor end on it.
    pub(super) fn crossings(&self, [a, b]: [Point; 2], slack: f64) -> Vec<f64> {
        let (from, way) = (minus(a, self.base), minus(b, a));
        let (h0, h1) = (dot(from, self.axis), dot(way, self.axis));
        let slope = (self.radii[1] - self.radii[0]) / self.height;
        // |from + t way|² − h² = (r₀ + slope h)², h = h₀ + t h₁.
        let (r0, r1) = (self.radii[0] + slope * h0, slope * h1);
        let square = dot(way, way) - h1 * h1 - r1 * r1;
        let half = dot(from, way) - h0 * h1 - r0 * r1;
        let rest = dot(from, from) - h0 * h0 - r0 * r0;
        let size = dot(way, way);
        let roots = if square.abs() < 1e-12 * size {
            vec![-rest / (2.0 * half)]
        } else {
            let under = half * half - square * rest;
            if under <= 0.0 {
                return Vec::new();
            }
            let root = under.sqrt();
            vec![(-half - root) / square, (-half + root) / square]
        };
        let shortest = slack / size.sqrt();
        if let [a, b] = *roots
            && (a - b).abs() < shortest.sqrt().min(1e-4)
        {
            return Vec::new();
        }
        let is_real = |t: &f64| {
            let height = h0 + t * h1;
            (shortest..1.0 - shortest).contains(t)
                && (slack..self.height - slack).contains(&height)
                && r0 + t * r1 > 0.0
        };
        roots.into_iter().filter(is_real).collect()
    }

    /// The least and the largest distance of a point from the side.
    pub(super) fn distances(&self, p: Point) -> [f64; 2] {
        let from = minus(p, self.base);
        let height = dot(from, self.axis);
        let out = length(minus(from, times(self.axis, height)));
        // In the plane of the axis and the point the side is a line on either side of the axis.
        let ends = |sign: f64| {
            [(0.0, self.radii[0]), (self.height, self.radii[1])]
                .map(|(height, radius)| [sign * radius, height, 0.0])
        };
        let here = [out, height, 0.0];
        let least = segment_distance(ends(1.0), here);
        let [a, b] = ends(-1.0).map(|end| length(minus(end, here)));
        [least, a.max(b)]
    }
}

fn edges(vertices: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    let next = vertices.iter().cycle().skip(1);
    vertices.iter().zip(next).map(|(a, b)| [*a, *b])
}

/// How far a point is from the line between two others.
pub(super) fn segment_distance([a, b]: [Point; 2], p: Point) -> f64 {
    let (way, from) = (minus(b, a), minus(p, a));
    let share = dot(from, way) / dot(way, way);
    // A line without length has no direction.
    let share = if share.is_nan() {
        0.0
    } else {
        share.clamp(0.0, 1.0)
    };
    length(minus(from, times(way, share)))
}

pub(super) fn minus(a: Point, b: Point) -> Point {
    add(a, times(b, -1.0))
}

pub(super) fn length(v: Point) -> f64 {
    v[0].hypot(v[1]).hypot(v[2])
}

fn unit(v: Point) -> Option<Point> {
    let length = length(v);
    (length > 0.0).then(|| times(v, 1.0 / length))
}
