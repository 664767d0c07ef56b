//! Converts parsed shapes to the tracer's.

use super::Quantised;
use super::extent::shape_box;
use octray_core::object::ObjectKind;
use octray_core::quantize::Quantize;
use octray_core::ray::Aabb;
use octray_core::scene::Attributes;
use octray_core::shape::{Bands, Cone, Cuboid, Patch, Polygon, Sphere, Triangle};
use octray_core::vec3::{Axis, Vec3};
use octray_core::world::World;
use octray_scenes::model::{Object, Scene, Shape};

impl<S: Quantize> Quantised<S> {
    /// Adds an object with its identity.
    pub(super) fn add(&mut self, scene: &Scene, id: u32, object: &Object, world: &World) {
        let mut patch = Attributes::FLAT;
        let kind = match object.shape {
            Shape::Sphere { centre, radius } => {
                let (centre, radius) = (world.place(centre), world.radius(radius));
                self.spheres.push(Sphere::new(centre, radius));
                ObjectKind::Sphere
            }
            Shape::Cuboid { .. } => {
                let [low, high] = shape_box(scene, &object.shape).map(|p| world.place(p));
                self.cuboids.push(Cuboid::new(low, high));
                ObjectKind::Cuboid
            }
            Shape::Cone {
                base,
                base_radius,
                top,
                top_radius,
            } => {
                let cone = Cone::new(world, base, base_radius, top, top_radius);
                self.cones.push(cone);
                ObjectKind::Cone
            }
            Shape::Polygon { first, count } => self.polygon(scene, first, count, world),
            Shape::Patch {
                first,
                count,
                first_normal,
            } => {
                let kind = self.polygon(scene, first, count, world);
                patch = self.patches.len() as u32;
                let vertices = &scene.vertices[first as usize..][..count as usize];
                let normals = &scene.normals[first_normal as usize..][..count as usize];
                let stored = self.normals.len();
                self.normals.resize(stored + count as usize, Vec3::ZERO);
                let place = &mut self.normals[stored..];
                let of_vertices = Patch::new(world, vertices, normals, stored as u32, place);
                self.patches.push(of_vertices);
                kind
            }
        };
        self.attributes[kind as usize].push(Attributes {
            id,
            surface: object.surface,
            patch,
        });
    }

    /// Adds a triangle or a polygon.
    fn polygon(&mut self, scene: &Scene, first: u32, count: u32, world: &World) -> ObjectKind {
        let vertices = &scene.vertices[first as usize..][..count as usize];
        if let Some(three) = vertices.as_array() {
            self.triangles.push(Triangle::new(world, three));
            return ObjectKind::Triangle;
        }
        let first = self.corners.len();
        self.corners
            .resize(first + vertices.len(), Default::default());
        let corners = &mut self.corners[first..];
        let mut polygon = Polygon::new(world, vertices, first as u32, corners);
        let (_, v) = polygon.plane.axis.others();
        polygon.bands = self.bands(&polygon.bounds, v, first);
        self.polygons.push(polygon);
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
            .map(|(a, b)| if a[1] < b[1] { [*a, *b] } else { [*b, *a] })
            .collect();
        loop {
            if bands.count < 4 {
                bands.count = 0;
                return bands;
            }
            // With the rim in which an edge counts as met.
            let slack = self.slack;
            let passed =
                |edge: &[[S; 2]; 2]| bands.of(edge[0][1] - slack)..=bands.of(edge[1][1] + slack);
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
}
