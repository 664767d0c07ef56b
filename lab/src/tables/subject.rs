//! The scenes of the tables, and their variants.

use octray_prepare::{PixelsPerRay, TreeKind, Walk};
use octray_render::error::Error;
use octray_scenes::model::Scene;
use octray_scenes::reduce::Reduction;

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
    /// What is left out of it.
    pub reduction: Reduction,
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
            reduction: Reduction::default(),
            larger: false,
            pixels_per_ray: PixelsPerRay::One,
            tree: TreeKind::Bvh8,
            walk: Walk::Ordered,
        }
    }

    /// Returns the scene with its first lights.
    pub fn lit(subject: Subject, lights: usize) -> Self {
        let reduction = Reduction {
            lights: Some(lights),
            opaque: false,
        };
        Self {
            reduction,
            ..Self::of(subject)
        }
    }

    /// Makes it opaque.
    pub fn opaque(mut self) -> Self {
        self.reduction.opaque = true;
        self
    }

    /// One ray for each 2 × 2 pixels.
    pub fn four_pixels_per_ray(mut self) -> Self {
        self.pixels_per_ray = PixelsPerRay::Four;
        self
    }

    /// Returns the scene of the variant.
    ///
    /// # Errors
    /// [`Error::Scene`] if it has mistakes, [`Error::Failed`] if it has too few lights.
    pub fn scene(&self) -> Result<Scene, Error> {
        let mut scene = self.subject.scene()?;
        (self.reduction.apply(&mut scene))
            .map_err(|error| Error::Failed(format!("{}: {error}", self.subject.name)))?;
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
        let all = SceneVariant::of(FIGURES[1]).scene().unwrap();
        assert_eq!((all.lights.len(), all.objects.len()), (10, 16));
        let lit = SceneVariant::lit(FIGURES[1], 3);
        assert_eq!(lit.scene().unwrap().lights[..], all.lights[..3]);
        let opaque = lit.opaque().scene().unwrap();
        assert!(opaque.surfaces.iter().all(|s| s.reflect == 0.0));
        assert_eq!(opaque.lights.len(), 3);
        let larger = SceneVariant {
            larger: true,
            ..lit
        };
        let larger = larger.scene().unwrap();
        assert_eq!((larger.width, larger.height), (640, 640));
        let message = SceneVariant::lit(FIGURES[3], 7).scene().unwrap_err();
        assert!(
            message
                .to_string()
                .contains("figure-22: the first 7 lights")
        );
    }
}
