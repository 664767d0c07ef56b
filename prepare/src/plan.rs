//! A plan: everything that is chosen about a scene before it is baked, and the small file that carries
//! it to `octray bake --plan` and to the firmware's build.
//!
//! The file is text: a name and a value to a line, in any order, `#` starts a comment. What was chosen holds for
//! one scene only (the rays that wait were counted), so the plan names its [`fingerprint()`].
//!
//! ```
//! use octray_prepare::plan::Plan;
//!
//! let plan: Plan = "scene 0123456789abcdef\narith i18f14\nsize 64x48\npixels-per-ray 1\nmax-depth 3\n\
//!     cut-off 0.001953125\ntree compact-bvh8\ntree-depth 2\nleaf-size 4\nrays 1\n".parse()?;
//! assert_eq!(plan.max_depth, 3);
//! assert_eq!(plan.to_string().parse(), Ok(plan));
//! # Ok::<(), octray_prepare::plan::PlanError>(())
//! ```

use crate::bake::BakeOptions;
use crate::choice::Choice;
use crate::format::{Arith, Format};
use crate::settings::{PixelsPerRay, RenderSettings, TreeKind, TreeSettings};
use fnv::FnvHasher;
use octray_core::accel;
use octray_scenes::model::Scene;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::hash::Hasher;
use std::num::NonZeroU32;
use std::str::FromStr;
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

/// As [`FromStr`] reads it.
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
            "scene {scene:016x}\narith {arith}\nsize {width}x{height}\npixels-per-ray {pixels_per_ray}\n\
             max-depth {max_depth}\ncut-off {cut_off}\ntree {kind}\n"
        )?;
        if let Some(accel::BuildOptions { depth, leaf_size }) = tree {
            write!(f, "tree-depth {depth}\nleaf-size {leaf_size}\n")?;
        }
        writeln!(f, "rays {rays}")
    }
}

/// What is wrong with a plan's text.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlanError {
    /// A line that is no name and value, or a name that is not known or not for the first time.
    #[error("plan: unexpected line `{0}`")]
    Line(String),
    /// A name that is not there.
    #[error("plan: no line tells {0}")]
    Missing(&'static str),
    /// It was made for another scene.
    #[error("plan: made for another scene, or for this one before it was changed: plan it again")]
    Scene,
    /// A value that is none.
    #[error("plan: {name} {found}: expected {expected}")]
    Value {
        /// Of which name.
        name: &'static str,
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
}

impl FromStr for Plan {
    type Err = PlanError;

    fn from_str(text: &str) -> Result<Self, PlanError> {
        let mut lines = Lines::read(text)?;
        let whole = "a whole number";
        let pixels = "columns x rows, each from 1 to 65535, such as 160x120";
        let kinds = "compact-bvh8, device or none";
        let scene = lines.take("scene", "16 hexadecimal digits", |text| {
            let digits = text.len() == 16 && text.bytes().all(|digit| digit.is_ascii_hexdigit());
            u64::from_str_radix(text, 16).ok().filter(|_| digits)
        })?;
        let format = lines.take("arith", "an arithmetic", |name| match Arith::named(name) {
            Some(Arith::In(format)) => Some(format),
            _ => None,
        })?;
        let size = lines.take("size", pixels, |text| {
            let side = |text: &str| text.parse::<u16>().ok().filter(|side| *side > 0);
            let (width, height) = text.split_once('x')?;
            Some((side(width)?.into(), side(height)?.into()))
        })?;
        let pixels_per_ray = lines.take("pixels-per-ray", "1 or 4", PixelsPerRay::named)?;
        let max_depth = lines.take("max-depth", "0 to 64", |text| {
            text.parse().ok().filter(|n| *n <= 64)
        })?;
        let cut_off = lines.take("cut-off", "a number from 0 to 1", |text| {
            text.parse().ok().filter(|x| (0.0..=1.0).contains(x))
        })?;
        let kind = lines.take("tree", kinds, |text| Some(text.to_owned()))?;
        let tree = match &*kind {
            "none" => None,
            "compact-bvh8" | "packed" | "device" => Some(accel::BuildOptions {
                depth: lines.take("tree-depth", whole, |text| text.parse().ok())?,
                leaf_size: lines.take("leaf-size", whole, |text| text.parse().ok())?,
            }),
            _ => {
                return Err(PlanError::Value {
                    name: "tree",
                    found: kind,
                    expected: kinds,
                });
            }
        };
        let on_device = kind == "device";
        let rays = lines.take("rays", "0 to 65", |text| {
            text.parse().ok().filter(|n| *n <= 65)
        })?;
        match lines.0.pop_first() {
            Some((name, value)) => Err(PlanError::Line(format!("{name} {value}"))),
            None => Ok(Self {
                scene,
                format,
                size,
                pixels_per_ray,
                max_depth,
                cut_off,
                tree,
                on_device,
                rays,
            }),
        }
    }
}

/// Names and values that have not been taken yet.
struct Lines<'a>(BTreeMap<&'a str, &'a str>);

impl<'a> Lines<'a> {
    fn read(text: &'a str) -> Result<Self, PlanError> {
        let mut found = BTreeMap::new();
        let lines = (text.lines()).map(|line| line.split('#').next().unwrap_or_default().trim());
        for line in lines.filter(|line| !line.is_empty()) {
            let known =
                (line.split_once(' ')).map(|(name, value)| found.insert(name, value.trim()));
            if known != Some(None) {
                return Err(PlanError::Line(line.into()));
            }
        }
        Ok(Self(found))
    }

    fn take<T>(
        &mut self,
        name: &'static str,
        expected: &'static str,
        read: impl Fn(&str) -> Option<T>,
    ) -> Result<T, PlanError> {
        let found = self.0.remove(name).ok_or(PlanError::Missing(name))?;
        read(found).ok_or_else(|| PlanError::Value {
            name,
            found: found.into(),
            expected,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Plan {
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
    fn wrong_text_is_told() {
        let text = example().to_string();
        let with = |line: &str, other: &str| text.replace(line, other).parse::<Plan>().unwrap_err();
        for (line, other, told) in [
            ("rays 2\n", "", "plan: no line tells rays"),
            ("rays 2", "rays 2\nrays 2", "plan: unexpected line `rays 2`"),
            (
                "rays 2",
                "rays 2\nmoons 3",
                "plan: unexpected line `moons 3`",
            ),
            ("rays 2", "rays", "plan: unexpected line `rays`"),
            (
                "compact-bvh8",
                "oak",
                "plan: tree oak: expected compact-bvh8, device or none",
            ),
            (
                "i18f14",
                "i18f13",
                "plan: arith i18f13: expected an arithmetic",
            ),
            (
                "max-depth 5",
                "max-depth 65",
                "plan: max-depth 65: expected 0 to 64",
            ),
            (
                "0000000000000012",
                "12",
                "plan: scene 12: expected 16 hexadecimal digits",
            ),
            (
                "-ray 4",
                "-ray 2",
                "plan: pixels-per-ray 2: expected 1 or 4",
            ),
        ] {
            assert_eq!(with(line, other).to_string(), told);
        }
        assert!(matches!(with("160x120", "0x3"), PlanError::Value { .. }));
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
