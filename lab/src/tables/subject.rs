//! The scenes of the tables, and their variants.

use octray_prepare::{PixelsPerRay, TreeKind};
use octray_render::error::Error;
use octray_scenes::model::Scene;

/// A scene that comes with octray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subject {
    /// Its name.
    pub name: &'static str,
    source: &'static str,
}

/// Balls whose centres lie in one plane, seen straight on: an octree of it is almost a quadtree.
pub const FLAT: Subject = Subject {
    name: "flat",
    source: include_str!("flat.scene"),
};

/// The thesis's figures 19 to 23.
pub const FIGURES: [Subject; 5] = [
    Subject {
        name: "figure-19",
        source: include_str!("../../../scenes/figure-19.scene"),
    },
    Subject {
        name: "figure-20",
        source: include_str!("../../../scenes/figure-20.scene"),
    },
    Subject {
        name: "figure-21",
        source: include_str!("../../../scenes/figure-21.scene"),
    },
    Subject {
        name: "figure-22",
        source: include_str!("../../../scenes/figure-22.scene"),
    },
    Subject {
        name: "figure-23",
        source: include_str!("../../../scenes/figure-23.scene"),
    },
];

impl Subject {
    /// The scene as its file has it.
    ///
    /// # Errors
    /// [`Error::Scene`] if it holds mistakes.
    pub fn scene(&self) -> Result<Scene, Error> {
        octray_scenes::parse(self.source)
            .map_err(|mistakes| Error::Scene(mistakes.draw(self.name, self.source)))
    }
}

/// A scene in a variant, and how it is traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// The scene.
    pub subject: Subject,
    /// Its first lights only, so many; all if `None`.
    pub lights: Option<usize>,
    /// So many of its objects, evenly chosen; all if `None`.
    pub surfaces: Option<usize>,
    /// Nothing reflects or lets light through.
    pub opaque: bool,
    /// A quarter more columns and rows, which show more around the same picture.
    pub larger: bool,
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// The octree.
    pub tree: TreeKind,
}

impl Trial {
    /// The scene as it is, a ray for each pixel, with the default tree.
    pub fn of(subject: Subject) -> Self {
        Self {
            subject,
            lights: None,
            surfaces: None,
            opaque: false,
            larger: false,
            pixels_per_ray: PixelsPerRay::One,
            tree: TreeKind::Bvh8,
        }
    }

    /// With the first lights only, so many of `all`.
    pub fn with_lights(self, lights: usize, all: usize) -> Self {
        Self {
            lights: (lights < all).then_some(lights),
            ..self
        }
    }

    /// With so many surfaces of `all`.
    pub fn with_surfaces(self, surfaces: usize, all: usize) -> Self {
        Self {
            surfaces: (surfaces < all).then_some(surfaces),
            ..self
        }
    }

    /// The scene in its variant.
    ///
    /// # Errors
    /// [`Error::Scene`] if it holds mistakes.
    pub fn scene(&self) -> Result<Scene, Error> {
        let mut scene = self.subject.scene()?;
        if let Some(lights) = self.lights {
            scene.lights.truncate(lights);
        }
        let all = scene.objects.len();
        if let Some(few) = self.surfaces.filter(|few| *few < all) {
            let chosen = (0..few).map(|i| scene.objects[i * all / few]);
            scene.objects = chosen.collect();
        }
        if self.opaque {
            for surface in &mut scene.surfaces {
                surface.reflect = 0.0;
                surface.refract = 0.0;
            }
        }
        let (width, height) = self.resized((scene.width, scene.height));
        (scene.width, scene.height) = (width, height);
        Ok(scene)
    }

    /// Columns and rows of the picture, of what they are in the first variant.
    pub fn resized(&self, (width, height): (u32, u32)) -> (u32, u32) {
        match self.larger {
            true => (width * 5 / 4, height * 5 / 4),
            false => (width, height),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_read() {
        for subject in FIGURES.into_iter().chain([FLAT]) {
            assert!(
                !subject.scene().unwrap().objects.is_empty(),
                "{}",
                subject.name
            );
        }
    }

    #[test]
    fn the_flat_scene_is_flat_and_seen_straight_on() {
        use octray_scenes::model::{Camera, Projection, Shape};
        let scene = FLAT.scene().unwrap();
        for object in &scene.objects {
            let Shape::Sphere { centre, .. } = object.shape else {
                panic!("{object:?}")
            };
            assert_eq!(centre[2], 0.0);
        }
        let Camera::Thesis { projection, .. } = scene.camera else {
            panic!("{:?}", scene.camera)
        };
        assert_eq!(projection, Projection::Parallel);
    }

    #[test]
    fn variants_change_what_they_say() {
        let trial = Trial::of(FIGURES[1]);
        let all = trial.scene().unwrap();
        assert_eq!((all.lights.len(), all.objects.len()), (10, 16));
        let lights = Trial {
            lights: Some(3),
            ..trial
        };
        assert_eq!(lights.scene().unwrap().lights[..], all.lights[..3]);
        let few = Trial {
            surfaces: Some(4),
            ..trial
        };
        let every_fourth = [0, 4, 8, 12].map(|i| all.objects[i]);
        assert_eq!(few.scene().unwrap().objects, every_fourth);
        // All of them are the scene as it is, which is traced once.
        assert_eq!(trial.with_surfaces(16, 16), trial);
        assert_eq!(trial.with_lights(10, 10), trial);
        assert_eq!(trial.with_surfaces(4, 16), few);
        assert_eq!(trial.with_lights(3, 10), lights);
        let opaque = Trial {
            opaque: true,
            ..trial
        };
        assert!(
            opaque
                .scene()
                .unwrap()
                .surfaces
                .iter()
                .all(|s| s.reflect == 0.0)
        );
        let larger = Trial {
            larger: true,
            ..trial
        }
        .scene()
        .unwrap();
        assert_eq!((larger.width, larger.height), (640, 640));
    }
}
