//! A scene under construction, whoever makes it: each part is checked, and added if it can be rendered.

use crate::check::{self, Fault, Oddity};
use crate::model::{Light, Object, Point, Scene, Shape, Surface};

impl Scene {
    /// Adds a light.
    pub(crate) fn add_light(&mut self, light: Light) -> Result<(), Fault> {
        check::light(&light)?;
        self.lights.push(light);
        Ok(())
    }

    /// Adds a surface and returns its index. An opaque one has no inside: whatever its refraction index, it becomes 1.
    pub(crate) fn add_surface(&mut self, mut surface: Surface) -> Result<u32, Fault> {
        if surface.refract == 0.0 && surface.ior.is_finite() {
            surface.ior = 1.0;
        }
        check::surface(&surface)?;
        let index = u32::try_from(self.surfaces.len()).map_err(|_| Fault::TooLarge)?;
        self.surfaces.push(surface);
        Ok(index)
    }

    /// Adds a sphere, a cone or a box.
    pub(crate) fn add_solid(&mut self, shape: Shape, surface: u32) -> Result<(), Fault> {
        self.add_object(Object { shape, surface }).map(drop)
    }

    /// Adds a polygon, or a patch if there is a normal at each vertex. Returns what is odd about it, if anything; what
    /// has no area is left out.
    pub(crate) fn add_polygon(
        &mut self,
        corners: impl ExactSizeIterator<Item = (Point, Option<Point>)>,
        is_patch: bool,
        surface: u32,
    ) -> Result<Option<Oddity>, Fault> {
        let count = u32::try_from(corners.len()).map_err(|_| Fault::TooLarge)?;
        let (vertices, normals) = (self.vertices.len(), self.normals.len());
        for (vertex, normal) in corners {
            self.vertices.push(vertex);
            self.normals.extend(normal);
        }
        let index = |index| u32::try_from(index).map_err(|_| Fault::TooLarge);
        let added = index(self.vertices.len())
            .and_then(|_| Ok((index(vertices)?, index(normals)?)))
            .and_then(|(first, first_normal)| {
                let shape = match is_patch {
                    true => Shape::Patch {
                        first,
                        count,
                        first_normal,
                    },
                    false => Shape::Polygon { first, count },
                };
                self.add_object(Object { shape, surface })
            });
        if added.is_err() {
            self.vertices.truncate(vertices);
            self.normals.truncate(normals);
        }
        match added {
            Err(Fault::Collinear) => Ok(Some(Oddity::NoArea)),
            checked => checked,
        }
    }

    fn add_object(&mut self, object: Object) -> Result<Option<Oddity>, Fault> {
        let oddity = check::object(self, &object)?;
        self.objects.push(object);
        Ok(oddity)
    }
}
