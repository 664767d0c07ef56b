//! Rays that leave a surface: whether they hit it again (shadow acne), and whether they miss another close to it (light
//! leaks).

mod side;

use crate::method::{About, Form, SHIPPED, Sweep};
use crate::mock_accelerator;
use crate::number::{self, Number, counted};
use crate::random::{self, Random};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::accel::Hit;
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::ray::Ray;
use octray_core::vec3::Vec3;
use octray_prepare::quantise::Prepared;
use octray_scenes::model::Shape;
use side::SIDES;

/// Scenes of 10⁻⁴ to 10⁵ units. Rays leave a sphere or a square, and should hit another that is a hundredth of its size
/// away. A hit on the surface that they leave is a false hit. The forms named by shapes are the shipped one again, for
/// rays that leave one side of one shape: inside to another place in it, outside anywhere.
#[derive(Debug)]
pub struct Offset;

/// The distance between the surfaces, in sizes of the scene.
const GAP: f64 = 0.01;
/// The sphere that rays leave, and the next one.
const RADII: [f64; 2] = [1.0, 1.0 + GAP];
/// Half the side and the height of the square that rays leave, and of the next one.
const SQUARES: [[f64; 2]; 2] = [[1.0, 2.0], [2.0, 2.0 + GAP]];
/// The least distance of a hit, in scene units.
const EPSILON: f64 = 1e-4;

impl Sweep for Offset {
    const ABOUT: About = About {
        name: "offset",
        title: "Leaving a surface",
        axis: "size of the scene in its own units",
        unit: "",
        values: &[
            1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0,
            10.0, 20.0, 50.0, 1e2, 2e2, 5e2, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5,
        ],
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "scaled; rays start off the surface by an error bound",
            },
            Form {
                name: "epsilon",
                label: "not scaled; hits count beyond t = 0.0001",
            },
            Form {
                name: "sphere",
                label: "sphere",
            },
            Form {
                name: "sphere-inside",
                label: "sphere, inner side",
            },
            Form {
                name: "cylinder",
                label: "cylinder as long as wide",
            },
            Form {
                name: "cylinder-inside",
                label: "the same, inner side",
            },
            Form {
                name: "tube",
                label: "cylinder ten times as long as wide",
            },
            Form {
                name: "tube-inside",
                label: "the same, inner side",
            },
            Form {
                name: "cone",
                label: "cone",
            },
            Form {
                name: "cone-inside",
                label: "cone, inner side",
            },
            Form {
                name: "box",
                label: "box",
            },
            Form {
                name: "box-inside",
                label: "box, inner side",
            },
            Form {
                name: "square",
                label: "square",
            },
            Form {
                name: "square-behind",
                label: "square, other side",
            },
        ],
        limits: StateLimits {
            wrong: Some(limit(0.0, 0.05)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        let centre = [0.0; 3];
        // A detail as small as the gap must be resolved.
        surfaces(value).and(Shape::Sphere {
            centre,
            radius: GAP * value,
        })
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let sides = SIDES.map(|side| side::measure::<S>(side, value));
        let mut random = Random::new(14);
        let Some(prepared) = surfaces(value).prepare::<S>() else {
            all_errors.extend(sides);
            return all_errors;
        };
        for case in 0..96 {
            let kind = [ObjectKind::Sphere, ObjectKind::Polygon][case % 2];
            let (eye, aim, outward) = incidence(kind, &mut random);
            let towards = number::direction::<S>(random::add(aim, random::times(eye, -1.0)));
            // Away from the surface, at an angle of 3 to 90 degrees to it.
            let slant = random.between(0.05, 1.0);
            let across = random::times(random.across(outward), 1.0 - slant);
            let away = number::direction::<S>(random::add(across, random::times(outward, slant)));
            let eye = random::times(eye, value);
            let found = [
                counted(|| shipped(&prepared, kind, eye, [towards, away])),
                counted(|| epsilon(kind, value, eye, [towards, away])),
            ];
            for ((found, saturations), errors) in found.into_iter().zip(&mut all_errors) {
                errors.saturations += saturations;
                let [itself, next] = found.unwrap_or([true, false]);
                errors.decide(false, itself);
                errors.decide(true, next);
            }
        }
        all_errors.extend(sides);
        all_errors
    }
}

/// Returns a sphere and a square, and after each the one that a ray leaving it should hit.
fn surfaces(size: f64) -> Setting {
    let [inner, outer] = RADII.map(|radius| Shape::Sphere {
        centre: [0.0; 3],
        radius: radius * size,
    });
    let square = |[half, height]: [f64; 2]| {
        [[-half, -half], [half, -half], [half, half], [-half, half]]
            .map(|[x, y]| [x * size, y * size, height * size])
    };
    Setting::of(inner, [0.0, 0.0, 4.0 * size])
        .and(outer)
        .and_polygon(&square(SQUARES[0]))
        .and_polygon(&square(SQUARES[1]))
}

/// Returns an eye, a point of the sphere or the square that it looks at, and the normal there.
fn incidence(kind: ObjectKind, random: &mut Random) -> ([f64; 3], [f64; 3], [f64; 3]) {
    if kind == ObjectKind::Sphere {
        let outward = random.direction();
        let beside = random::times(random.across(outward), random.between(0.0, 2.0));
        let eye = random::add(random::times(outward, random.between(2.0, 3.0)), beside);
        return (eye, random::times(outward, RADII[0]), outward);
    }
    let mut place = |height| [random.between(-0.5, 0.5), random.between(-0.5, 0.5), height];
    (place(3.9), place(SQUARES[0][1]), [0.0, 0.0, 1.0])
}

/// Returns whether a ray that leaves the surface hits the same surface, and whether it hits the next one, or `None` if
/// the ray from the eye misses the surface.
fn shipped<S: Number>(
    prepared: &Prepared<S>,
    kind: ObjectKind,
    eye: [f64; 3],
    [towards, away]: [Vec3<S>; 2],
) -> Option<[bool; 2]> {
    let shapes = prepared.scene.shapes();
    let [from, next] = [0, 1].map(|i| ObjectRef::new(kind, i));
    let ray = number::ray(prepared.world.point(eye), towards);
    let t = shapes.hit(from, &ray, prepared.scene.diameter, &mut ())?;
    let hit = Hit { t, object: from };
    let seen = mock_accelerator::leaving(shapes, mock_accelerator::mirror(), &ray, hit);
    let mut leaving = *seen.follow.first()?;
    leaving.direction = away;
    let meets = |object| shapes.blocks(object, &leaving, prepared.scene.diameter, None, &mut ());
    Some([meets(from), meets(next)])
}

/// The same in scene units, where hits below a fixed distance do not count.
fn epsilon<S: Number>(
    kind: ObjectKind,
    size: f64,
    eye: [f64; 3],
    [towards, away]: [Vec3<S>; 2],
) -> Option<[bool; 2]> {
    let number = |x: f64| S::from_f64(x * size);
    let roots = |i: usize, ray: &Ray<S>| match kind {
        ObjectKind::Sphere => sphere(number(RADII[i]), ray),
        _ => square(SQUARES[i].map(number), ray),
    };
    let least = S::from_f64(EPSILON);
    let met = |i, ray: &Ray<S>| roots(i, ray).into_iter().flatten().find(|t| *t > least);
    let ray = number::ray(eye, towards);
    let leaving = Ray::new(ray.at(met(0, &ray)?), away);
    Some([0, 1].map(|i| met(i, &leaving).is_some()))
}

/// Returns where a line intersects a sphere around the origin.
fn sphere<S: Number>(radius: S, ray: &Ray<S>) -> [Option<S>; 2] {
    let middle = -ray.origin.dot(ray.direction);
    let apart = ray.at(middle);
    let discriminant = S::product(radius, radius) - apart.dot_wide(apart);
    if discriminant < S::product(S::ZERO, S::ZERO) {
        return [None; 2];
    }
    let half_chord = S::sqrt_wide(discriminant);
    [Some(middle - half_chord), Some(middle + half_chord)]
}

/// Returns where it intersects a square perpendicular to the z axis.
fn square<S: Number>([half, height]: [S; 2], ray: &Ray<S>) -> [Option<S>; 2] {
    let t = (height - ray.origin.z).quotient(ray.direction.z);
    let point = ray.at(t);
    let inside = point.x.abs() <= half && point.y.abs() <= half;
    [inside.then_some(t), None]
}
