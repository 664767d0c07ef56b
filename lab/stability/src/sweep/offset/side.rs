//! Rays that leave one side of one shape, and should not hit that shape on their way.

use crate::mock_accelerator;
use crate::number::{self, Number, counted};
use crate::random::{Random, add, cross, dot, times};
use crate::setting::Setting;
use crate::state::ErrorStats;
use octray_core::accel::Hit;
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::ray::Ray;
use octray_prepare::quantise::Prepared;
use octray_scenes::model::Shape;

/// A shape around the origin, of size 1 at most.
#[derive(Clone, Copy, Debug)]
pub(super) enum Body {
    Sphere,
    /// A side without caps, of these radii at its lower and its upper end; its height is 1.
    Cone(f64, f64),
    Cuboid,
    Square,
}

/// A side of a shape: `true` is the inner one. A square has two that are alike.
pub(super) type Side = (Body, bool);

/// Every shape from both sides.
pub(super) const SIDES: [Side; 12] = [
    (Body::Sphere, false),
    (Body::Sphere, true),
    (Body::Cone(0.5, 0.5), false),
    (Body::Cone(0.5, 0.5), true),
    (Body::Cone(0.05, 0.05), false),
    (Body::Cone(0.05, 0.05), true),
    (Body::Cone(0.5, 0.1), false),
    (Body::Cone(0.5, 0.1), true),
    (Body::Cuboid, false),
    (Body::Cuboid, true),
    (Body::Square, false),
    (Body::Square, true),
];

const CASES: usize = 48;
const RADIUS: f64 = 0.5;
const SIDES_OF_CUBOID: [f64; 3] = [0.8, 0.5, 0.6];

impl Body {
    const fn kind(self) -> ObjectKind {
        match self {
            Self::Sphere => ObjectKind::Sphere,
            Self::Cone(..) => ObjectKind::Cone,
            Self::Cuboid => ObjectKind::Cuboid,
            Self::Square => ObjectKind::Polygon,
        }
    }

    /// Returns the shape at a size, along an axis, with an eye that makes the scene no larger than it has to be.
    fn setting(self, size: f64, axis: [f64; 3], eye: [f64; 3]) -> Setting {
        let eye = times(eye, size);
        let end = |share: f64| times(axis, share * size);
        match self {
            Self::Sphere => Setting::of(
                Shape::Sphere {
                    centre: [0.0; 3],
                    radius: RADIUS * size,
                },
                eye,
            ),
            Self::Cone(base, top) => Setting::of(
                Shape::Cone {
                    base: end(-0.5),
                    base_radius: base * size,
                    top: end(0.5),
                    top_radius: top * size,
                },
                eye,
            ),
            Self::Cuboid => Setting::of(
                Shape::Cuboid {
                    centre: [0.0; 3],
                    size: SIDES_OF_CUBOID.map(|side| side * size),
                },
                eye,
            ),
            Self::Square => {
                let [a, b] = across(axis).map(|v| times(v, RADIUS * size));
                let corner = |x: f64, y: f64| add(times(a, x), times(b, y));
                let corners = [
                    corner(-1.0, -1.0),
                    corner(1.0, -1.0),
                    corner(1.0, 1.0),
                    corner(-1.0, 1.0),
                ];
                Setting::empty(eye).and_polygon(&corners)
            }
        }
    }

    /// Returns a point of the shape, 0.98 of the way from the middle: inside, if it has an inside.
    fn within(self, axis: [f64; 3], random: &mut Random) -> [f64; 3] {
        match self {
            Self::Sphere => times(random.direction(), 0.98 * RADIUS),
            Self::Cone(base, top) => {
                let height = random.between(-0.49, 0.49);
                let radius = 0.98 * (base + (top - base) * (height + 0.5));
                add(times(axis, height), times(random.across(axis), radius))
            }
            Self::Cuboid => {
                let [x, y, z] = SIDES_OF_CUBOID.map(|side| 0.49 * side);
                let mut point = [
                    random.between(-x, x),
                    random.between(-y, y),
                    random.between(-z, z),
                ];
                let face = (random.between(0.0, 3.0) as usize).min(2);
                point[face] = [x, y, z][face].copysign(point[face]);
                point
            }
            Self::Square => {
                let [a, b] = across(axis);
                let [x, y] = [(); 2].map(|()| random.between(-0.49, 0.49));
                add(times(a, x), times(b, y))
            }
        }
    }
}

/// Returns two unit vectors that are perpendicular to an axis and to each other.
fn across(axis: [f64; 3]) -> [[f64; 3]; 2] {
    let other = if axis[0].abs() < 0.5 {
        [1.0, 0.0, 0.0]
    } else {
        [0.0, 1.0, 0.0]
    };
    let a = cross(axis, other);
    let a = times(a, 1.0 / dot(a, a).sqrt());
    [a, cross(axis, a)]
}

/// Measures the rays that leave a side of a shape of this size.
pub(super) fn measure<S: Number>((body, inner): Side, size: f64) -> ErrorStats {
    let mut errors = ErrorStats::default();
    let mut random = Random::new(15);
    for _ in 0..CASES {
        let axis = random.direction();
        let aim = body.within(axis, &mut random);
        let solid = !matches!(body, Body::Square);
        let eye = if solid && inner {
            times(body.within(axis, &mut random), 0.5)
        } else {
            let side = if inner { -1.0 } else { 1.0 };
            let beside = times(random.across(axis), random.between(0.8, 2.0));
            add(beside, times(axis, side * random.between(0.2, 0.8)))
        };
        let towards = number::direction::<S>(add(aim, times(eye, -1.0)));
        let Some(prepared) = body.setting(size, axis, eye).prepare::<S>() else {
            return errors;
        };
        let eye = prepared.world.point(times(eye, size));
        let ray = number::ray(eye, towards);
        let ahead = if solid && inner {
            Ahead::To(body.within(axis, &mut random))
        } else {
            Ahead::At(random.between(0.05, 1.0))
        };
        let (met, saturations) = counted(|| meets(&prepared, body, &ray, ahead, size, &mut random));
        errors.saturations += saturations;
        if let Some(met) = met {
            errors.decide(false, met);
        }
    }
    errors
}

/// Where a ray goes that leaves a surface.
enum Ahead {
    /// To a point inside, in sizes.
    To([f64; 3]),
    /// Away from the shape, at an angle to the surface of this sine.
    At(f64),
}

/// Returns whether a ray that leaves the shape where another hits it, on that one's side, hits it on its way. `None` if
/// that side is not hit.
fn meets<S: Number>(
    prepared: &Prepared<S>,
    body: Body,
    ray: &Ray<S>,
    ahead: Ahead,
    size: f64,
    random: &mut Random,
) -> Option<bool> {
    let shapes = prepared.scene.shapes();
    let object = ObjectRef::new(body.kind(), 0);
    let t = shapes.hit(object, ray, prepared.scene.diameter, &mut ())?;
    let contact = shapes.contact(object, ray, t);
    let hit = Hit { t, object };
    let seen = mock_accelerator::leaving(shapes, mock_accelerator::mirror(), ray, hit);
    let mut leaving = *seen.follow.first()?;
    let from = number::floats(leaving.origin);
    let limit = match ahead {
        Ahead::To(aim) => {
            let way = add(prepared.world.point(times(aim, size)), times(from, -1.0));
            leaving.direction = number::vector::<S>(way).unit().0;
            S::from_f64(dot(way, way).sqrt())
        }
        Ahead::At(sine) => {
            let outward = number::floats(contact.outward);
            // The ray came from the outer side, or did so through an open end.
            let side = dot(outward, number::floats(ray.direction));
            if contact.closed && side > 0.0 {
                return None;
            }
            let outward = times(outward, 1f64.copysign(-side));
            let along = times(random.across(outward), (1.0 - sine * sine).sqrt());
            leaving.direction = number::direction::<S>(add(along, times(outward, sine)));
            prepared.scene.diameter
        }
    };
    Some(shapes.blocks(object, &leaving, limit, None, &mut ()))
}
