//! Objects: where a ray hits them, and the normals there.

use super::cone::Cone;
use super::polygon::Polygon;
use super::read::Surface;
use super::vector::{Ray, V3};

/// A shape with its surface.
#[derive(Debug)]
pub(super) struct Object {
    pub(super) shape: Shape,
    pub(super) surface: Surface,
    /// Centre and radius of a sphere around the shape, slightly too large; it only saves time.
    bound: (V3, f64),
}

/// The shapes of the model.
#[derive(Debug)]
pub(super) enum Shape {
    Sphere { centre: V3, radius: f64 },
    Cone(Cone),
    Cuboid { centre: V3, half: V3 },
    Polygon(Polygon),
}

/// The orientation of a surface at a point of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facing {
    /// The outward geometric normal.
    pub(super) geometric: V3,
    /// The normal for shading; it differs from the geometric one only on patches.
    pub(super) shading: V3,
    /// Whether the surface has an inside, so that a ray along the geometric normal leaves it.
    pub(super) solid: bool,
}

impl Object {
    pub(super) fn new(shape: Shape, surface: Surface) -> Self {
        let (centre, radius) = shape.bounding_sphere();
        let size = radius + centre.x.abs() + centre.y.abs() + centre.z.abs();
        let bound = (centre, radius * (1.0 + 1e-6) + size * 1e-9);
        Self {
            shape,
            surface,
            bound,
        }
    }

    /// Returns the least t with 0 < t < `limit` at which a ray hits the object.
    pub(super) fn hit(&self, ray: &Ray, limit: f64) -> Option<f64> {
        let (centre, radius) = self.bound;
        let to_centre = centre - ray.origin;
        let middle = to_centre.dot(ray.direction);
        let beside = to_centre - ray.direction * middle;
        if beside.dot(beside) > radius * radius || middle + radius < 0.0 || middle - radius > limit
        {
            return None;
        }
        self.shape.hit(ray).filter(|&t| t < limit)
    }
}

impl Shape {
    /// Returns the least t > 0 at which a ray hits the shape.
    pub(super) fn hit(&self, ray: &Ray) -> Option<f64> {
        match self {
            Self::Sphere { centre, radius } => hit_sphere(*centre, *radius, ray),
            Self::Cone(cone) => cone.hit(ray),
            Self::Cuboid { centre, half } => hit_cuboid(*centre, *half, ray),
            Self::Polygon(polygon) => polygon.hit(ray),
        }
    }

    /// Returns the orientation of the surface at a point of it.
    pub(super) fn facing(&self, point: V3) -> Facing {
        let solid = |normal| Facing {
            geometric: normal,
            shading: normal,
            solid: true,
        };
        match self {
            Self::Sphere { centre, .. } => solid((point - *centre).unit()),
            Self::Cone(cone) => solid(cone.normal(point)),
            Self::Cuboid { centre, half } => solid(cuboid_normal(*centre, *half, point)),
            Self::Polygon(polygon) => Facing {
                geometric: polygon.normal,
                shading: polygon.shading_normal(point),
                solid: false,
            },
        }
    }

    fn bounding_sphere(&self) -> (V3, f64) {
        match self {
            Self::Sphere { centre, radius } => (*centre, *radius),
            Self::Cone(cone) => cone.bounding_sphere(),
            Self::Cuboid { centre, half } => (*centre, half.length()),
            Self::Polygon(polygon) => polygon.bounding_sphere(),
        }
    }
}

/// Computes the sphere's discriminant from the part of the centre's direction perpendicular to the ray, and the nearer
/// root without a difference of similar numbers.
fn hit_sphere(centre: V3, radius: f64, ray: &Ray) -> Option<f64> {
    let to_centre = centre - ray.origin;
    let middle = to_centre.dot(ray.direction);
    let across = to_centre - ray.direction * middle;
    let discriminant = radius * radius - across.dot(across);
    if discriminant < 0.0 {
        return None;
    }
    let q = middle + discriminant.sqrt().copysign(middle);
    let distance = to_centre.length();
    let product = (distance - radius) * (distance + radius);
    least_positive([q, product / q])
}

/// Applies the slab method; the box is closed, so a ray in the plane of a face hits it.
fn hit_cuboid(centre: V3, half: V3, ray: &Ray) -> Option<f64> {
    let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let low = centre[axis] - half[axis] - ray.origin[axis];
        let high = centre[axis] + half[axis] - ray.origin[axis];
        let d = ray.direction[axis];
        if d == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
        } else {
            enter = enter.max((low / d).min(high / d));
            leave = leave.min((low / d).max(high / d));
        }
    }
    if enter <= leave {
        least_positive([enter, leave])
    } else {
        None
    }
}

/// Returns the normal of the face nearest to a point.
fn cuboid_normal(centre: V3, half: V3, point: V3) -> V3 {
    let p = point - centre;
    let outside = V3::new(p.x.abs() - half.x, p.y.abs() - half.y, p.z.abs() - half.z);
    let only = |axis: usize| {
        if outside[axis] == outside.x.max(outside.y).max(outside.z) {
            p[axis].signum()
        } else {
            0.0
        }
    };
    match [only(0), only(1), only(2)] {
        [x, _, _] if x != 0.0 => V3::new(x, 0.0, 0.0),
        [_, y, _] if y != 0.0 => V3::new(0.0, y, 0.0),
        [_, _, z] => V3::new(0.0, 0.0, z),
    }
}

/// Returns the lesser of those roots that are numbers and above 0.
pub(super) fn least_positive(roots: [f64; 2]) -> Option<f64> {
    roots
        .into_iter()
        .filter(|&t| t > 0.0 && t.is_finite())
        .min_by(f64::total_cmp)
}
