//! Light along rays.

use super::Counts;
use super::read::{Scene, Surface};
use super::vector::{Ray, V3};

/// The distance by which a ray starts off a surface, relative to the coordinates' size, and by which a shadow ray ends
/// before a light, relative to its length.
const APART: f64 = 1e-9;

/// A scene with the limits of its recursion.
pub(super) struct Tracer<'a> {
    pub(super) scene: &'a Scene,
    pub(super) max_depth: u32,
    pub(super) cut_off: f64,
}

/// The point where a ray hit an object.
struct Meeting {
    point: V3,
    /// The size of the coordinates from which the point was computed.
    size: f64,
    /// The geometric normal at the point.
    geometric: V3,
}

impl Tracer<'_> {
    /// Returns the light along a primary ray, not clamped.
    pub(super) fn eye_ray(&self, ray: &Ray, counts: &mut Counts) -> V3 {
        if self.cut_off > 1.0 {
            return V3::ZERO;
        }
        counts.primary += 1;
        self.light_along(ray, 1.0, 0, counts)
    }

    /// Returns the object that a ray hits first, and its distance.
    pub(super) fn nearest(&self, ray: &Ray) -> Option<(usize, f64)> {
        let mut nearest = None;
        let mut limit = f64::INFINITY;
        for (index, object) in self.scene.objects.iter().enumerate() {
            if let Some(t) = object.hit(ray, limit) {
                nearest = Some((index, t));
                limit = t;
            }
        }
        nearest
    }

    /// Returns the light along a ray of this weight after `depth` bounces.
    fn light_along(&self, ray: &Ray, weight: f64, depth: u32, counts: &mut Counts) -> V3 {
        let Some((index, t)) = self.nearest(ray) else {
            return self.sky(ray.direction.unit());
        };
        if depth == 0 {
            counts.eye_hits += 1;
        }
        let object = &self.scene.objects[index];
        let surface = &object.surface;
        let incoming = ray.direction;
        let point = ray.at(t);
        let facing = object.shape.facing(point);
        let size = ray
            .origin
            .x
            .abs()
            .max(ray.origin.y.abs())
            .max(ray.origin.z.abs())
            + t;
        let meeting = Meeting {
            point,
            size,
            geometric: facing.geometric,
        };

        let normal = if facing.shading.dot(incoming) > 0.0 {
            -facing.shading
        } else {
            facing.shading
        };
        let mirrored = incoming - normal * (2.0 * incoming.dot(normal));

        let (ambient, diffuse) = colours(surface, point);
        let mut local = ambient;
        for light in &self.scene.lights {
            let to_light = (light.position - point).unit();
            let cosine = normal.dot(to_light);
            if cosine > 0.0 && !self.blocked(&meeting, light.position, counts) {
                let gloss = mirrored.dot(to_light).max(0.0).powf(surface.shine);
                local = local
                    + light
                        .colour
                        .times(diffuse * cosine + surface.specular * gloss);
            }
        }

        let mut sum = local * (1.0 - surface.refract);
        let worth_tracing =
            |weight: f64| weight > 0.0 && weight >= self.cut_off && depth < self.max_depth;

        let leaving = facing.solid && facing.geometric.dot(incoming) > 0.0;
        let kn = if leaving {
            1.0 / surface.ior
        } else {
            surface.ior
        };
        let transmitted = refract(incoming, normal, kn);
        // At total internal reflection the share that would be transmitted is mirrored, too.
        let share_reflected = if transmitted.is_some() {
            surface.reflect
        } else {
            surface.reflect + surface.refract
        };

        let weight_reflected = weight * share_reflected;
        if worth_tracing(weight_reflected) {
            counts.reflected += 1;
            let ray = meeting.leave(mirrored);
            sum =
                sum + self.light_along(&ray, weight_reflected, depth + 1, counts) * share_reflected;
        }

        let weight_transmitted = weight * surface.refract;
        if let Some(transmitted) = transmitted
            && worth_tracing(weight_transmitted)
        {
            counts.transmitted += 1;
            let ray = meeting.leave(transmitted);
            sum = sum
                + self.light_along(&ray, weight_transmitted, depth + 1, counts) * surface.refract;
        }
        sum
    }

    /// Returns the light along a ray of unit direction that hits nothing.
    fn sky(&self, direction: V3) -> V3 {
        let [low, high] = self.scene.sky;
        let up = (self.scene.view.aim.as_ref()).map_or(V3::new(0.0, 1.0, 0.0), |aim| aim.up.unit());
        low + (high - low) * ((1.0 + direction.dot(up)) / 2.0)
    }

    /// Returns whether any surface lies between a point and a light.
    fn blocked(&self, meeting: &Meeting, light: V3, counts: &mut Counts) -> bool {
        counts.shadow += 1;
        let start = meeting.leave(light - meeting.point).origin;
        let ray = Ray::new(start, light - start);
        let limit = (light - start).length() * (1.0 - APART);
        let blocked = self
            .scene
            .objects
            .iter()
            .any(|object| object.hit(&ray, limit).is_some());
        counts.blocked += u64::from(blocked);
        blocked
    }
}

impl Meeting {
    /// Returns the ray from this point in a direction; it starts off the surface, on the side of its direction.
    fn leave(&self, direction: V3) -> Ray {
        let off = (self.size * APART).copysign(self.geometric.dot(direction));
        Ray::new(self.point + self.geometric * off, direction)
    }
}

/// Returns ambient and diffuse colour of a surface at a point. A point that is in a plane between cubes of a checker to
/// within rounding counts to the upper one.
fn colours(surface: &Surface, point: V3) -> (V3, V3) {
    let Some(checker) = &surface.checker else {
        return (surface.ambient, surface.diffuse);
    };
    let cube = |x: f64| (x / checker.size + 1e-9).floor();
    let sum = cube(point.x) + cube(point.y) + cube(point.z);
    match sum.rem_euclid(2.0) == 1.0 {
        true => (checker.ambient, checker.diffuse),
        false => (surface.ambient, surface.diffuse),
    }
}

/// Returns the direction of the transmitted ray by Snell's law: sin θ1 = `kn` · sin θ2, with `kn` = n2/n1, or `None` at
/// total internal reflection. The unit normal faces the unit incoming direction.
pub(super) fn refract(incoming: V3, normal: V3, kn: f64) -> Option<V3> {
    let cosine1 = -incoming.dot(normal);
    let along = (incoming + normal * cosine1) * (1.0 / kn);
    let cosine2_squared = 1.0 - along.dot(along);
    (cosine2_squared >= 0.0).then(|| along - normal * cosine2_squared.sqrt())
}
