//! What an item buffer holds: for each primary ray a list of objects. For views in perspective.

use octray_core::accel::Hit;
use octray_core::frame::Frame;
use octray_core::object::ObjectRef;
use octray_core::observe::Observer;
use octray_core::quantize::Quantize;
use octray_core::ray::Ray;
use octray_core::scene::Scene;
use octray_core::vec3::{Axis, Vec3};
use octray_scenes::point;
use std::ops::Range;

/// For each primary ray the objects that it may meet, and how far away at least, the nearest first.
#[derive(Default)]
pub(super) struct Lists<S> {
    objects: Vec<(S, ObjectRef)>,
    /// Where each ray's list begins in `entries`.
    heads: Vec<u32>,
    /// A place in `objects`, and the next entry.
    pub(super) entries: Vec<(u32, u32)>,
}

/// The end of a list.
const END: u32 = u32::MAX;

impl<S: Quantize> Lists<S> {
    /// No entries for so many rays. The objects are in order of their boxes' distances from the eye.
    fn empty(scene: &Scene<'_, S>, eye: Vec3<S>, rays: usize) -> Self {
        let from_eye = |object| {
            let bounds = scene.shapes.bounds(object);
            let axes = Axis::ALL.map(|axis| {
                let [low, eye, high] = [bounds.low, eye, bounds.high].map(|p| p[axis].to_f64());
                (low - eye).max(eye - high).max(0.0)
            });
            let away = axes.iter().map(|a| a * a).sum::<f64>().sqrt();
            S::from_f64((away - wider(scene)).max(0.0))
        };
        let refs = scene.shapes.refs();
        let mut objects: Vec<_> = refs.map(|object| (from_eye(object), object)).collect();
        objects.sort_by(|(a, _), (b, _)| a.to_f64().total_cmp(&b.to_f64()));
        Self {
            objects,
            heads: vec![END; rays],
            entries: Vec::with_capacity(4 * rays),
        }
    }

    /// Puts an object before those that are in a list.
    fn put(&mut self, ray: usize, object: usize) {
        let next = std::mem::replace(&mut self.heads[ray], self.entries.len() as u32);
        self.entries.push((object as u32, next));
    }

    /// The objects whose boxes rays meet.
    pub(super) fn of_boxes(scene: &Scene<'_, S>, rays: &[Ray<S>]) -> Self {
        let eye = rays.first().map_or(Vec3::ZERO, |ray| ray.origin);
        let mut lists = Self::empty(scene, eye, rays.len());
        for i in (0..lists.objects.len()).rev() {
            for (number, ray) in rays.iter().enumerate() {
                if meets_box(scene, ray, lists.objects[i].1) {
                    lists.put(number, i);
                }
            }
        }
        lists
    }

    /// The objects of whose boxes a rectangle of pixels shows all, a pixel wider on each side.
    pub(super) fn of_rectangles(scene: &Scene<'_, S>, frame: &Frame<S>) -> Self {
        let (camera, params) = (frame.camera(), frame.params());
        let active = &params.active;
        let wide = active.columns.len();
        let mut lists = Self::empty(scene, camera.origin, wide * active.rows.len());
        let [forward, right, up] =
            [camera.forward, camera.right, camera.up].map(|v| v.to_array().map(S::to_f64));
        for i in (0..lists.objects.len()).rev() {
            let bounds = scene.shapes.bounds(lists.objects[i].1);
            let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            for corner in 0..8 {
                let corner_at = Axis::ALL.map(|axis| {
                    let side = [bounds.low, bounds.high][corner >> axis as usize & 1];
                    side[axis].to_f64() - camera.origin[axis].to_f64()
                });
                // The corner is a·(forward + x·right + y·up).
                let whole = determinant(forward, right, up);
                let a = determinant(corner_at, right, up) / whole;
                let place = match a > 1e-6 {
                    true => [
                        (1.0 + determinant(forward, corner_at, up) / whole / a)
                            * f64::from(params.width),
                        (1.0 - determinant(forward, right, corner_at) / whole / a)
                            * f64::from(params.height),
                    ],
                    // Beside or behind the eye: it may be anywhere.
                    false => [f64::INFINITY; 2],
                };
                for axis in 0..2 {
                    low[axis] = low[axis].min(place[axis] / 2.0 - 1.0);
                    high[axis] = high[axis].max(place[axis] / 2.0 + 1.0);
                    if a <= 1e-6 {
                        low[axis] = f64::NEG_INFINITY;
                    }
                }
            }
            let span = |axis: usize, of: &Range<u32>| {
                (low[axis].max(0.0) as u32).max(of.start)..(high[axis].ceil() as u32).min(of.end)
            };
            let columns = span(0, &active.columns);
            for row in span(1, &active.rows) {
                for column in columns.clone() {
                    let ray = (row - active.rows.start) as usize * wide;
                    lists.put(ray + (column - active.columns.start) as usize, i);
                }
            }
        }
        lists
    }

    /// The first hit of a ray among the objects of its list.
    pub(super) fn first<O: Observer>(
        &self,
        number: usize,
        scene: &Scene<'_, S>,
        ray: &Ray<S>,
        observer: &mut O,
    ) -> Option<Hit<S>> {
        let (mut found, mut limit) = (None, scene.diameter);
        let mut next = self.heads[number];
        while let Some(&(place, after)) = self.entries.get(next as usize) {
            let (least, object) = self.objects[place as usize];
            if least > limit {
                break;
            }
            let hit = scene.shapes.hit(object, ray, limit, observer);
            observer.test(object.kind(), hit.is_some());
            let id = |object| scene.attributes_of(object).id;
            if let Some(t) = hit
                && (t < limit || found.is_none_or(|found| id(object) < id(found)))
            {
                (found, limit) = (Some(object), t);
            }
            next = after;
        }
        found.map(|object| Hit { t: limit, object })
    }
}

/// How much wider boxes are taken than they are: more than rays are off in these formats.
fn wider<S: Quantize>(scene: &Scene<'_, S>) -> f64 {
    scene.diameter.to_f64() / 4096.0
}

fn meets_box<S: Quantize>(scene: &Scene<'_, S>, ray: &Ray<S>, object: ObjectRef) -> bool {
    let (bounds, wider) = (scene.shapes.bounds(object), wider(scene));
    let (mut enter, mut exit) = (0.0f64, f64::INFINITY);
    for axis in Axis::ALL {
        let [origin, direction] = [ray.origin, ray.direction].map(|v| v[axis].to_f64());
        let near = (bounds.low[axis].to_f64() - wider - origin) / direction;
        let far = (bounds.high[axis].to_f64() + wider - origin) / direction;
        // Of a ray in a plane of the box they are NaN, which is passed over.
        enter = enter.max(near.min(far));
        exit = exit.min(near.max(far));
    }
    enter <= exit
}

fn determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    point::dot(a, point::cross(b, c))
}
