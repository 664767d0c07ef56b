//! Converts parsed shapes to the tracer's. Everything that can be computed beforehand is, in `f64`.

use super::camera::{length, unit};
use super::extent::shape_box;
use super::{Placement, Quantised, down, up, vector};
use octray_core::object::ObjectKind;
use octray_core::quantize::Quantize;
use octray_core::ray::Aabb;
use octray_core::scene::Attributes;
use octray_core::shape::{Bands, Cone, Cuboid, Patch, Plane, Polygon, Sphere, Triangle};
use octray_core::vec3::{Axis, Vec3};
use octray_scenes::model::{Object, Point, Scene, Shape};
use octray_scenes::point::{add, cross, dot, times};

impl<S: Quantize> Quantised<S> {
    /// Adds an object with its identity.
    pub(super) fn add(&mut self, scene: &Scene, id: u32, object: &Object, place: &Placement) {
        let mut patch = Attributes::FLAT;
        let kind = match object.shape {
            Shape::Sphere { centre, radius } => {
                self.spheres.push(Sphere {
                    centre: vector(place.point(centre)),
                    radius: at_least_one_step(place.length(radius)),
                });
                ObjectKind::Sphere
            }
            Shape::Cuboid { .. } => {
                let [low, high] = shape_box(scene, &object.shape);
                self.cuboids.push(Cuboid {
                    low: vector(place.point(low)),
                    high: vector(place.point(high)),
                });
                ObjectKind::Cuboid
            }
            Shape::Cone { .. } => {
                let cone = self.cone(scene, &object.shape, place);
                self.cones.push(cone);
                ObjectKind::Cone
            }
            Shape::Polygon { first, count } => self.polygon(scene, first, count, place),
            Shape::Patch {
                first,
                count,
                first_normal,
            } => {
                let kind = self.polygon(scene, first, count, place);
                patch = self.patches.len() as u32;
                self.patch(scene, first, count, first_normal, place);
                kind
            }
        };
        self.attributes[kind as usize].push(Attributes {
            id,
            surface: object.surface,
            patch,
        });
    }

    /// Returns a box of the scene in the format's numbers, rounded outward and widened by slack and `more`.
    fn bounds(&self, [low, high]: [Point; 2], more: f64, place: &Placement) -> Aabb<S> {
        let more = place.length(more) + self.slack.to_f64();
        Aabb {
            low: Vec3::from(place.point(low).map(|x| down::<S>(x - more))),
            high: Vec3::from(place.point(high).map(|x| up::<S>(x + more))),
        }
    }

    fn cone(&self, scene: &Scene, shape: &Shape, place: &Placement) -> Cone<S> {
        let Shape::Cone {
            base,
            base_radius,
            top,
            top_radius,
        } = *shape
        else {
            return Cone::default();
        };
        let along = add(top, times(base, -1.0));
        let height = length(along);
        let rise = top_radius - base_radius;
        let slant = height.hypot(rise);
        let bounding_radius = (height / 2.0).hypot(base_radius.max(top_radius));
        // Scaled by 2^exponent, the bounding sphere's radius is in [½, 1).
        let scaled = place.length(bounding_radius);
        let exponent = if S::FRACTION_BITS.is_some() {
            (-(scaled.log2().floor()) - 1.0).clamp(-31.0, 31.0) as i8
        } else {
            0
        };
        let local = |x: f64| S::from_f64(place.length(x) * 2f64.powi(i32::from(exponent)));
        Cone {
            centre: vector(place.point(times(add(base, top), 0.5))),
            axis: vector(times(along, 1.0 / height)),
            half_length: local(height / 2.0),
            mid_radius: local((base_radius + top_radius) / 2.0),
            sin: S::from_f64(rise / slant),
            cos: S::from_f64(height / slant),
            bounding_radius: up(scaled + self.slack.to_f64()),
            exponent,
            bounds: self.bounds(shape_box(scene, shape), 0.0, place),
        }
    }

    /// Adds a triangle or a polygon. Its plane passes through the vertices' middle along Newell's normal; vertices that
    /// are off the plane (a file has few digits) widen the box.
    fn polygon(&mut self, scene: &Scene, first: u32, count: u32, place: &Placement) -> ObjectKind {
        let vertices = &scene.vertices[first as usize..][..count as usize];
        let middle = times(
            vertices.iter().fold([0.0; 3], |sum, v| add(sum, *v)),
            1.0 / f64::from(count),
        );
        let from_middle = |v: Point| add(v, times(middle, -1.0));
        let next = vertices.iter().cycle().skip(1);
        let normal = unit(vertices.iter().zip(next).fold([0.0; 3], |sum, (a, b)| {
            add(sum, cross(from_middle(*a), from_middle(*b)))
        }));
        let off_plane = vertices
            .iter()
            .map(|v| dot(normal, from_middle(*v)).abs())
            .fold(0.0, f64::max);
        let sizes = normal.map(f64::abs);
        let axis = if sizes[0] >= sizes[1] && sizes[0] >= sizes[2] {
            Axis::X
        } else if sizes[1] >= sizes[2] {
            Axis::Y
        } else {
            Axis::Z
        };
        // The offset belongs to the rounded normal.
        let rounded: Vec3<S> = vector(normal);
        let offset = dot(rounded.to_array().map(S::to_f64), place.point(middle));
        let plane = Plane {
            normal: rounded,
            offset: S::from_f64(offset),
            axis,
        };
        let (u, v) = axis.others();
        let corner = |p: &Point| {
            let p = place.point(*p);
            [S::from_f64(p[u as usize]), S::from_f64(p[v as usize])]
        };
        let shape = Shape::Polygon { first, count };
        // Rounding tilts the plane by up to one step per unit of length.
        let bounds = self.bounds(shape_box(scene, &shape), 2.0 * off_plane, place);
        if let [a, b, c] = vertices {
            self.triangles.push(Triangle {
                plane,
                corners: [corner(a), corner(b), corner(c)],
                depth: [bounds.low[axis], bounds.high[axis]],
            });
            return ObjectKind::Triangle;
        }
        let first = self.corners.len() as u32;
        self.corners.extend(vertices.iter().map(corner));
        let bands = self.bands(&bounds, v, first as usize);
        self.polygons.push(Polygon {
            plane,
            first,
            count,
            bounds,
            bands,
        });
        ObjectKind::Polygon
    }

    /// Divides the polygon whose corners were added last into bands: half as many as its edges, or fewer if most edges
    /// cross most bands.
    fn bands(&mut self, bounds: &Aabb<S>, v: Axis, first: usize) -> Bands<S> {
        let corners = &self.corners[first..];
        let low = bounds.low[v];
        let mut bands = Bands {
            first: self.bands.len() as u32,
            count: corners.len() as u32 / 2,
            low,
            scale: (bounds.high[v] - low).reciprocal(),
        };
        let edges: Vec<_> = (corners.iter().zip(corners.iter().cycle().skip(1)))
            .filter(|(a, b)| a[1] != b[1])
            .map(|(a, b)| if a[1] < b[1] { [*a, *b] } else { [*b, *a] })
            .collect();
        loop {
            if bands.count < 4 {
                bands.count = 0;
                return bands;
            }
            let passed = |edge: &[[S; 2]; 2]| bands.of(edge[0][1])..=bands.of(edge[1][1]);
            let all: usize = edges.iter().map(|edge| passed(edge).count()).sum();
            if all > 8 * corners.len() {
                bands.count /= 2;
                continue;
            }
            // Where each band's edges begin; then they are put there, in the order of the outline.
            let mut places = vec![0; bands.count as usize];
            for band in edges.iter().flat_map(passed) {
                places[band as usize] += 1;
            }
            let mut next = self.edges.len();
            for place in &mut places {
                self.bands.push(next as u32);
                next += std::mem::replace(place, next);
            }
            self.bands.push(next as u32);
            self.edges.resize(next, Default::default());
            for edge in &edges {
                for band in passed(edge) {
                    let place = &mut places[band as usize];
                    self.edges[*place] = *edge;
                    *place += 1;
                }
            }
            return bands;
        }
    }

    /// Adds the normals of the patch whose polygon was added last.
    fn patch(&mut self, scene: &Scene, first: u32, count: u32, normal: u32, place: &Placement) {
        let [low, high] = shape_box(scene, &Shape::Polygon { first, count });
        let size = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
        let exponent = if S::FRACTION_BITS.is_some() {
            (-(place.length(size).log2().floor()) - 1.0).clamp(-31.0, 31.0) as i8
        } else {
            0
        };
        let local = if S::FRACTION_BITS.is_some() {
            1.0
        } else {
            place.length(size)
        };
        self.patches.push(Patch {
            first_normal: self.normals.len() as u32,
            exponent,
            least_area: S::from_f64(local * local * 1e-9),
        });
        // Their lengths are weights of the interpolation; only their ratios count.
        let normals = &scene.normals[normal as usize..][..count as usize];
        let longest = normals.iter().map(|n| length(*n)).fold(0.0, f64::max);
        self.normals.extend(
            normals
                .iter()
                .map(|n| vector::<S>(times(*n, 1.0 / longest))),
        );
    }
}

/// Rounds a radius; it must not become 0.
fn at_least_one_step<S: Quantize>(x: f64) -> S {
    let near = S::from_f64(x);
    if near > S::ZERO { near } else { up(x) }
}
