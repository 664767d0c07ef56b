//! A plan: everything that is chosen about a scene before it is baked, and the small file that carries
//! it to `octray bake --plan` and to the firmware's build.
//!
//! The file is TOML. What was chosen holds for one scene only (the rays that wait were counted), so the plan names
//! its [`fingerprint()`].
//!
//! ```
//! # #[cfg(feature = "plan-files")] {
//! use octray_prepare::plan::Plan;
//!
//! let plan: Plan = r#"
//!     scene = "0123456789abcdef"
//!     arith = "i18f14"
//!     size = "64x48"
//!     pixels-per-ray = 1
//!     max-depth = 3
//!     cut-off = 0.001953125
//!     tree = "compact-bvh8"
//!     tree-depth = 2
//!     leaf-size = 4
//!     rays = 1
//! "#.parse()?;
//! assert_eq!(plan.max_depth, 3);
//! assert_eq!(plan.to_string().parse(), Ok(plan));
//! # }
//! # Ok::<(), octray_prepare::plan::PlanError>(())
//! ```

#[cfg(feature = "plan-files")]
mod file;

use crate::bake::BakeOptions;
use crate::format::{Arith, Format};
use crate::settings::{PixelsPerRay, RenderSettings, TreeKind, TreeSettings};
use fnv::FnvHasher;
use octray_core::accel;
use octray_scenes::model::Scene;
use std::fmt::{self, Display, Formatter};
use std::hash::Hasher;
use std::num::NonZeroU32;
use thiserror::Error;

/// What is chosen about a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The [`fingerprint()`] of the scene.
    pub scene: u64,
    /// The number format.
    pub format: Format,
    /// Columns and rows, 1 to 65535 each.
    pub size: (u32, u32),
    /// Pixels that one ray colours.
    pub pixels_per_ray: PixelsPerRay,
    /// The most bounces.
    pub max_depth: u32,
    /// Rays of less weight are not traced, 0 to 1.
    pub cut_off: f64,
    /// How the [`TreeKind::CompactBvh8`] is built that finds the objects; `None` if every ray tries every object.
    pub tree: Option<accel::BuildOptions>,
    /// Whether the device builds it.
    pub on_device: bool,
    /// How many rays can wait at once.
    pub rays: usize,
}

/// Tells scenes apart: FNV-1a, 64 bits, over the text that [`write()`](octray_scenes::write()) makes of the scene. So
/// comments, spaces and the dialect of its file do not count.
///
/// # Panics
/// As [`write()`](octray_scenes::write()).
pub fn fingerprint(scene: &Scene) -> u64 {
    let mut text = Vec::new();
    // Nothing fails where there is memory.
    octray_scenes::write(scene, &mut text).unwrap_or_default();
    let mut hasher = FnvHasher::default();
    hasher.write(&text);
    hasher.finish()
}

impl Plan {
    /// The settings that were chosen.
    pub fn settings(&self) -> RenderSettings {
        let tree = match self.tree {
            None => TreeSettings::of(TreeKind::None),
            Some(accel::BuildOptions { depth, leaf_size }) => TreeSettings {
                depth: Some(depth),
                leaf_size: NonZeroU32::new(leaf_size),
                ..TreeSettings::of(TreeKind::CompactBvh8)
            },
        };
        RenderSettings {
            arith: Arith::In(self.format),
            tree,
            size: Some(self.size),
            pixels_per_ray: self.pixels_per_ray,
            max_depth: self.max_depth,
            cut_off: self.cut_off,
            ..RenderSettings::DEFAULT
        }
    }

    /// What to bake of its scene, which is called `name`.
    ///
    /// # Errors
    /// [`PlanError::Scene`] if it is another scene's plan.
    pub fn options<'a>(&self, scene: &Scene, name: &'a str) -> Result<BakeOptions<'a>, PlanError> {
        if self.scene != fingerprint(scene) {
            return Err(PlanError::Scene);
        }
        Ok(BakeOptions {
            name,
            settings: self.settings(),
            on_device: self.on_device,
            target: None,
            rays: Some(self.rays),
        })
    }
}

/// As [`FromStr`](std::str::FromStr) reads it, with feature `plan-files`.
impl Display for Plan {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            scene,
            format,
            size: (width, height),
            pixels_per_ray,
            max_depth,
            cut_off,
            tree,
            on_device,
            rays,
        } = self;
        let kind = match (tree, on_device) {
            (None, _) => "none",
            (Some(_), false) => "compact-bvh8",
            (Some(_), true) => "device",
        };
        let (arith, pixels_per_ray) = (format.name(), pixels_per_ray.number());
        write!(
            f,
            "scene = \"{scene:016x}\"\narith = \"{arith}\"\nsize = \"{width}x{height}\"\n\
             pixels-per-ray = {pixels_per_ray}\nmax-depth = {max_depth}\ncut-off = {cut_off}\ntree = \"{kind}\"\n"
        )?;
        if let Some(accel::BuildOptions { depth, leaf_size }) = tree {
            write!(f, "tree-depth = {depth}\nleaf-size = {leaf_size}\n")?;
        }
        writeln!(f, "rays = {rays}")
    }
}

/// What is wrong with a plan.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlanError {
    /// Its text is no TOML, or a key or a value is not what a plan has: line, column, the line, what was expected.
    #[error("plan: {0}")]
    Text(String),
    /// It has the format of before plans were TOML: a name and a value to a line.
    #[error(
        "plan: written by an older octray, as `name value` and not `name = value`: plan it again"
    )]
    Old,
    /// It was made for another scene.
    #[error("plan: made for another scene, or for this one before it was changed: plan it again")]
    Scene,
}

#[cfg(feature = "plan-files")]
impl From<toml::de::Error> for PlanError {
    fn from(error: toml::de::Error) -> Self {
        Self::Text(error.to_string().trim_end().into())
    }
}

#[cfg(all(test, feature = "plan-files"))]
mod tests {
    use super::*;

    pub(super) fn example() -> Plan {
        Plan {
            scene: 0x12,
            format: Format::I18F14,
            size: (160, 120),
            pixels_per_ray: PixelsPerRay::Four,
            max_depth: 5,
            cut_off: 1.0 / 512.0,
            tree: Some(accel::BuildOptions {
                depth: 3,
                leaf_size: 2,
            }),
            on_device: false,
            rays: 2,
        }
    }

    #[test]
    fn what_is_written_is_read_back() {
        let plan = example();
        let grown = accel::BuildOptions {
            depth: 1,
            leaf_size: 9,
        };
        for (tree, on_device) in [(None, false), (Some(grown), true), (plan.tree, false)] {
            let plan = Plan {
                tree,
                on_device,
                ..plan.clone()
            };
            assert_eq!(format!("# a comment\n\n{plan}").parse(), Ok(plan));
        }
    }

    #[test]
    fn a_plan_is_of_one_scene() {
        let scene = |text| octray_scenes::parse(text).unwrap();
        let ball = "v 0 0 500 f 1 0.5 0.2 0.8 0.2 10 0 1 s 0 0 -50 40";
        let planned = Plan {
            scene: fingerprint(&scene(ball)),
            ..example()
        };
        let commented = ball.replace(" s ", " # a ball\n s ");
        assert!(planned.options(&scene(&commented), "ball").is_ok());
        let glass = ball.replace("10 0 1", "10 0.5 1.5");
        let refused = planned.options(&scene(&glass), "ball");
        assert_eq!(refused, Err(PlanError::Scene));
    }
}
