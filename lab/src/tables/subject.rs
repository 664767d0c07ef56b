//! The scenes of the tables, and their variants.

use octray_prepare::{PixelsPerRay, TreeKind, Walk};
use octray_render::error::Error;
use octray_scenes::model::Scene;

/// A scene that comes with octray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subject {
    /// Its name.
    pub name: &'static str,
    source: &'static str,
}

/// Balls that one plane cuts: in it, an octree of them is a quadtree.
pub const PLANE: Subject = Subject {
    name: "plane",
    source: include_str!("plane.scene"),
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
    /// Parses the scene's file.
    ///
    /// # Errors
    /// [`Error::Scene`] if it has mistakes.
    pub fn scene(&self) -> Result<Scene, Error> {
        octray_scenes::parse(self.source)
            .map_err(|mistakes| Error::Scene(mistakes.draw(self.name, self.source)))
    }
}

/// A variant of a scene, and how it is traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneVariant {
    /// The scene.
    pub subject: Subject,
    /// The number of its first lights to keep; all if `None`.
    pub lights: Option<usize>,
    /// The number of its objects to keep, evenly chosen; all if `None`.
    pub surfaces: Option<usize>,
    /// Whether nothing reflects or transmits light.
    pub opaque: bool,
    /// Whether there are a quarter more columns and rows, which show more around the same picture.
    pub larger: bool,
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// The octree.
    pub tree: TreeKind,
    /// How rays go through it.
    pub walk: Walk,
}

impl SceneVariant {
    /// Returns the unchanged scene, with one ray per pixel and the default tree.
    pub fn of(subject: Subject) -> Self {
        Self {
            subject,
            lights: None,
            surfaces: None,
            opaque: false,
            larger: false,
            pixels_per_ray: PixelsPerRay::One,
            tree: TreeKind::Bvh8,
            walk: Walk::Ordered,
        }
    }

    /// Keeps the first `lights` of `all` lights.
    pub fn with_lights(self, lights: usize, all: usize) -> Self {
        Self {
            lights: (lights < all).then_some(lights),
            ..self
        }
    }

    /// Keeps `surfaces` of `all` surfaces.
    pub fn with_surfaces(self, surfaces: usize, all: usize) -> Self {
        Self {
            surfaces: (surfaces < all).then_some(surfaces),
            ..self
        }
    }

    /// Returns the scene of the variant.
    ///
    /// # Errors
    /// [`Error::Scene`] if it has mistakes.
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

    /// Returns the columns and rows of the picture, from those of the unchanged scene.
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
        for subject in FIGURES.into_iter().chain([PLANE]) {
            assert!(
                !subject.scene().unwrap().objects.is_empty(),
                "{}",
                subject.name
            );
        }
    }

    #[test]
    fn variants_have_their_documented_effect() {
        let scene_variant = SceneVariant::of(FIGURES[1]);
        let all = scene_variant.scene().unwrap();
        assert_eq!((all.lights.len(), all.objects.len()), (10, 16));
        let lights = SceneVariant {
            lights: Some(3),
            ..scene_variant
        };
        assert_eq!(lights.scene().unwrap().lights[..], all.lights[..3]);
        let few = SceneVariant {
            surfaces: Some(4),
            ..scene_variant
        };
        let every_fourth = [0, 4, 8, 12].map(|i| all.objects[i]);
        assert_eq!(few.scene().unwrap().objects, every_fourth);
        // With all surfaces it is the unchanged scene, which is traced once.
        assert_eq!(scene_variant.with_surfaces(16, 16), scene_variant);
        assert_eq!(scene_variant.with_lights(10, 10), scene_variant);
        assert_eq!(scene_variant.with_surfaces(4, 16), few);
        assert_eq!(scene_variant.with_lights(3, 10), lights);
        let opaque = SceneVariant {
            opaque: true,
            ..scene_variant
        };
        assert!(
            opaque
                .scene()
                .unwrap()
                .surfaces
                .iter()
                .all(|s| s.reflect == 0.0)
        );
        let larger = SceneVariant {
            larger: true,
            ..scene_variant
        }
        .scene()
        .unwrap();
        assert_eq!((larger.width, larger.height), (640, 640));
    }
}
