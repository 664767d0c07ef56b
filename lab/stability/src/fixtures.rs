//! Scenes of a single shape.

use crate::number::{Number, slack};
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::ray::{Aabb, Ray};
use octray_core::shape::{Bands, Cone, Cuboid, Outlines, Plane, Polygon, Shapes, Sphere};
use octray_core::vec3::{Axis, Vec3, vec3};

/// Returns no shapes.
pub fn nothing<'a, S: Number>() -> Shapes<'a, S> {
    Shapes {
        spheres: &[],
        triangles: &[],
        polygons: &[],
        cones: &[],
        cuboids: &[],
        outlines: Outlines {
            corners: &[],
            bands: &[],
            edges: &[],
        },
        patches: &[],
        normals: &[],
        slack: slack::<S>(),
    }
}

/// Returns one sphere.
pub fn sphere<S: Number>(sphere: &Sphere<S>) -> Shapes<'_, S> {
    Shapes {
        spheres: std::slice::from_ref(sphere),
        ..nothing()
    }
}

/// Returns one box.
pub fn cuboid<S: Number>(cuboid: &Cuboid<S>) -> Shapes<'_, S> {
    Shapes {
        cuboids: std::slice::from_ref(cuboid),
        ..nothing()
    }
}

/// Returns one cone.
pub fn cone<S: Number>(cone: &Cone<S>) -> Shapes<'_, S> {
    Shapes {
        cones: std::slice::from_ref(cone),
        ..nothing()
    }
}

/// Returns one polygon.
pub fn polygon<'a, S: Number>(polygon: &'a Polygon<S>, corners: &'a [[S; 2]]) -> Shapes<'a, S> {
    Shapes {
        polygons: std::slice::from_ref(polygon),
        outlines: Outlines {
            corners,
            bands: &[],
            edges: &[],
        },
        ..nothing()
    }
}

/// Returns the only object of its kind.
pub const fn only(kind: ObjectKind) -> ObjectRef {
    ObjectRef::new(kind, 0)
}

/// Returns a polygon in a plane, with so few corners that it needs no bands. Its box is unbounded.
pub fn outline<S: Number>(normal: Vec3<S>, offset: S, corners: &[[S; 2]]) -> Polygon<S> {
    let all = vec3(S::MAX, S::MAX, S::MAX);
    Polygon {
        plane: Plane {
            normal,
            offset,
            axis: largest(normal),
        },
        first: 0,
        count: corners.len() as u32,
        bounds: Aabb {
            low: -all,
            high: all,
        },
        bands: Bands {
            first: 0,
            count: 0,
            low: S::ZERO,
            scale: S::ONE.reciprocal(),
        },
    }
}

/// Returns the corners of a square of side 2 `half` around the origin.
pub fn square<S: Number>(half: f64) -> [[S; 2]; 4] {
    [[-half, -half], [half, -half], [half, half], [-half, half]].map(|c| c.map(S::from_f64))
}

/// Returns the axis of the largest component.
pub fn largest<S: Number>(v: Vec3<S>) -> Axis {
    let (x, y, z) = (v.x.abs(), v.y.abs(), v.z.abs());
    if x >= y && x >= z {
        Axis::X
    } else if y >= z {
        Axis::Y
    } else {
        Axis::Z
    }
}

/// Returns where a ray hits the only shape of a kind, and the unit normal there.
pub fn hit<S: Number>(
    shapes: &Shapes<'_, S>,
    kind: ObjectKind,
    ray: &Ray<S>,
    limit: S,
) -> Option<(S, Vec3<S>)> {
    let t = shapes.hit(only(kind), ray, limit, &mut ())?;
    Some((t, shapes.contact(only(kind), ray, t).outward))
}
