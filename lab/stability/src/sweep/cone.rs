//! Cones: thin ones, near the apex, and from far away.

use crate::exact::{Exact, Exact3, add, angle, dot, exact, exact3, near, root, sub, times};
use crate::fixtures;
use crate::method::{About, Form, SEVEN_DECADES, SHIPPED, Sweep};
use crate::number::{self, Number, counted, exactly, floats};
use crate::random::{self, Random, dot as dot64};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::object::ObjectKind;
use octray_core::ray::Ray;
use octray_core::vec3::Vec3;
use octray_prepare::quantise::Prepared;
use octray_scenes::model::Shape;

const FORMS: &[Form] = &[
    Form {
        name: SHIPPED,
        label: "from the closest approach, root as c/q",
    },
    Form {
        name: "textbook",
        label: "quadratic from the ray's origin",
    },
];

const LIMITS: StateLimits = StateLimits {
    wrong: Some(limit(0.0, 0.05)),
    error: Some(limit(0.02, 0.5)),
    angle: Some(limit(0.05, 0.5)),
    ..StateLimits::NONE
};

/// Cones 1 to 10⁷ times as long as their radius, in a scene of about their length.
#[derive(Debug)]
pub struct Thin;

impl Sweep for Thin {
    const ABOUT: About = About {
        name: "cone-thin",
        title: "Thin cone",
        axis: "length / radius",
        unit: "radii in t",
        values: SEVEN_DECADES,
        home: 1.0,
        forms: FORMS,
        limits: LIMITS,
    };

    fn setting(value: f64) -> Setting {
        Truncated::around([0.6, 0.0, 0.8], 1.0, [1.0 / value, 0.5 / value]).seen([0.0, 1.5, 0.0])
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        sweep::<S>(10, |random| {
            let axis = random.direction();
            Case {
                cone: Truncated::around(axis, 1.0, [1.0 / value, 0.5 / value]),
                distance: random.between(1.0, 2.0),
                height: random.between(0.1, 0.9),
            }
        })
    }
}

/// Rays that hit a cone at 1/2 to 10⁻⁷ of its length from the apex.
#[derive(Debug)]
pub struct Apex;

impl Sweep for Apex {
    const ABOUT: About = About {
        name: "cone-apex",
        title: "Apex of a cone",
        axis: "length / distance from the apex",
        unit: "of the radius there in t",
        values: SEVEN_DECADES.split_at(1).1,
        home: 2.0,
        forms: FORMS,
        limits: LIMITS,
    };

    fn setting(value: f64) -> Setting {
        // A pixel's worth of the tip.
        let tip = Truncated::around([0.6, 0.0, 0.8], 1.0, [0.5, 0.0]);
        Setting::pixel(0.5 / value).and(tip.shape())
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        sweep::<S>(11, |random| {
            let axis = random.direction();
            Case {
                cone: Truncated::around(axis, 1.0, [0.5, 0.0]),
                distance: random.between(1.0, 2.0),
                height: 1.0 - 1.0 / value,
            }
        })
    }
}

/// Cones seen from 1 to 10⁷ times their length.
#[derive(Debug)]
pub struct Far;

impl Sweep for Far {
    const ABOUT: About = About {
        name: "cone-far",
        title: "Cone from far away",
        axis: "distance / length",
        unit: "radii in t",
        values: SEVEN_DECADES.split_at(1).1,
        home: 2.0,
        forms: FORMS,
        limits: LIMITS,
    };

    fn setting(value: f64) -> Setting {
        Truncated::around([0.6, 0.0, 0.8], 1.0, [0.4, 0.2]).seen([0.0, value, 0.0])
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        sweep::<S>(12, |random| {
            let axis = random.direction();
            Case {
                cone: Truncated::around(axis, 1.0, [0.4, 0.2]),
                distance: value,
                height: random.between(0.1, 0.9),
            }
        })
    }
}

/// A truncated cone, in scene units.
#[derive(Clone, Copy, Debug)]
struct Truncated {
    base: [f64; 3],
    top: [f64; 3],
    radii: [f64; 2],
}

impl Truncated {
    fn around(axis: [f64; 3], length: f64, radii: [f64; 2]) -> Self {
        Self {
            base: random::times(axis, -length / 2.0),
            top: random::times(axis, length / 2.0),
            radii,
        }
    }

    fn seen(&self, eye: [f64; 3]) -> Setting {
        Setting::of(self.shape(), eye)
    }

    fn shape(&self) -> Shape {
        Shape::Cone {
            base: self.base,
            base_radius: self.radii[0],
            top: self.top,
            top_radius: self.radii[1],
        }
    }
}

/// A cone, the distance of the ray's origin from it, and the share of its length at which the ray hits it.
struct Case {
    cone: Truncated,
    distance: f64,
    height: f64,
}

fn sweep<S: Number>(seed: u64, case: impl Fn(&mut Random) -> Case) -> Vec<ErrorStats> {
    let mut all_errors = vec![ErrorStats::default(); 2];
    let mut random = Random::new(seed);
    for aim in [-0.9, -0.5, 0.0, 0.5, 0.9, 1.15, 1.5, -2.0].repeat(4) {
        let case = case(&mut random);
        let cone = case.cone;
        let axis = random::add(cone.top, random::times(cone.base, -1.0));
        let length = dot64(axis, axis).sqrt();
        let axis = random::times(axis, 1.0 / length);
        let middle = random::add(cone.base, random::times(axis, case.height * length));
        let radius = cone.radii[0] + (cone.radii[1] - cone.radii[0]) * case.height;
        // Perpendicular to the axis, or at 45 degrees at most.
        let across = random.across(axis);
        let tilt = random::times(axis, random.between(-0.7, 0.7));
        let towards = random::times(random::add(across, tilt), -1.0);
        let aside = random::cross(axis, across);
        let eye = random::add(middle, random::times(towards, -case.distance));
        let Some(prepared) = cone.seen(eye).prepare::<S>() else {
            continue;
        };
        // From the target of the ray back to the eye, along the rounded direction.
        let direction = number::direction::<S>(towards);
        let aimed = random::add(middle, random::times(aside, aim * radius));
        let size = dot64(towards, towards).sqrt() * case.distance;
        let back = random::times(floats(direction), -prepared.world.length(size));
        let origin = random::add(prepared.world.point(aimed), back);
        let ray = number::ray(origin, direction);
        let local = exact(prepared.world.length(radius));
        compare(&prepared, &cone, &ray, &local, &mut all_errors);
    }
    all_errors
}

fn compare<S: Number>(
    prepared: &Prepared<S>,
    cone: &Truncated,
    ray: &Ray<S>,
    radius: &Exact,
    all_errors: &mut [ErrorStats],
) {
    let place = &prepared.world;
    let scale = exact(place.scale());
    let point = |p| times(&sub(&exact3(p), &exact3(place.centre)), &scale);
    let solid = Solid {
        base: point(cone.base),
        top: point(cone.top),
        radii: cone.radii.map(|r| exact(r) * &scale),
    };
    let truth = solid.first(&exactly(ray.origin), &exactly(ray.direction));
    let shapes = fixtures::cone(&prepared.scene.cones[0]);
    let numbers = Numbers {
        base: place.point(cone.base),
        top: place.point(cone.top),
        radii: cone.radii.map(|r| place.length(r)),
    };
    let found = [
        counted(|| fixtures::hit(&shapes, ObjectKind::Cone, ray, S::MAX)),
        counted(|| textbook(&numbers, ray)),
    ];
    for ((found, saturations), errors) in found.into_iter().zip(all_errors) {
        errors.saturations += saturations;
        errors.decide(truth.is_some(), found.is_some());
        if let (Some((t, normal)), Some((found, found_normal))) = (&truth, found) {
            errors.err(near(&((found.exact() - t) / radius)));
            errors.turn(angle(normal, &exactly(found_normal)));
        }
    }
}

/// The unrounded cone, in a format's scale.
struct Solid {
    base: Exact3,
    top: Exact3,
    radii: [Exact; 2],
}

impl Solid {
    /// Returns the first hit ahead: its parameter and the outward normal, not normalised.
    fn first(&self, origin: &Exact3, direction: &Exact3) -> Option<(Exact, Exact3)> {
        let along = sub(&self.top, &self.base);
        let square = dot(&along, &along);
        let widening = &self.radii[1] - &self.radii[0];
        let w = sub(origin, &self.base);
        // Height is y = y0 + y1 t in lengths of the axis; the radius there is r0 + r1 t.
        let y0 = dot(&w, &along) / &square;
        let y1 = dot(direction, &along) / &square;
        let r0 = &self.radii[0] + &widening * &y0;
        let r1 = &widening * &y1;
        let a = dot(direction, direction) - &y1 * &y1 * &square - &r1 * &r1;
        let b = dot(&w, direction) - &y0 * &y1 * &square - &r0 * &r1;
        let c = dot(&w, &w) - &y0 * &y0 * &square - &r0 * &r0;
        let discriminant = &b * &b - &a * &c;
        if discriminant < Exact::ZERO || a == Exact::ZERO {
            return None;
        }
        let root = root(&discriminant);
        let roots = [(-&b - &root) / &a, (-&b + &root) / &a];
        let in_order = if roots[0] < roots[1] { [0, 1] } else { [1, 0] };
        in_order.into_iter().map(|i| &roots[i]).find_map(|t| {
            let y = &y0 + &y1 * t;
            let on_it = *t > Exact::ZERO && y >= Exact::ZERO && y <= exact(1.0);
            on_it.then(|| {
                let point = add(&w, &times(direction, t));
                let radius = &r0 + &r1 * t;
                let lean = radius * &widening / &square;
                let normal = sub(&point, &times(&along, &(&y + lean)));
                (t.clone(), normal)
            })
        })
    }
}

/// The cone in a format's scale, before rounding.
struct Numbers {
    base: [f64; 3],
    top: [f64; 3],
    radii: [f64; 2],
}

/// Solves the quadratic in plain numbers: unit axis, slope, and −b ± √(b² − ac) over a.
fn textbook<S: Number>(cone: &Numbers, ray: &Ray<S>) -> Option<(S, Vec3<S>)> {
    let base: Vec3<S> = number::vector(cone.base);
    let (axis, length) = (number::vector::<S>(cone.top) - base).unit();
    let [first, last] = cone.radii.map(S::from_f64);
    let slope = (last - first).quotient(length);
    let w = ray.origin - base;
    let (rise, height) = (ray.direction.dot(axis), w.dot(axis));
    let (across, apart) = (ray.direction - axis * rise, w - axis * height);
    let (widening, radius) = (slope * rise, first + slope * height);
    let a = across.dot(across) - widening * widening;
    let b = across.dot(apart) - widening * radius;
    let c = apart.dot(apart) - radius * radius;
    let discriminant = b * b - a * c;
    if discriminant < S::ZERO {
        return None;
    }
    let root = discriminant.sqrt();
    let (x, y) = ((-b - root).quotient(a), (root - b).quotient(a));
    let (x, y) = if y < x { (y, x) } else { (x, y) };
    [x, y].into_iter().find_map(|t| {
        let h = height + rise * t;
        (t > S::ZERO && h >= S::ZERO && h <= length).then(|| {
            let radial = (apart + across * t).unit().0;
            (t, (radial - axis * slope).unit().0)
        })
    })
}
