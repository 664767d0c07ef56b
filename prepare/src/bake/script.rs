//! Baking in the build script of a program.

use super::{BakeError, BakeOptions, Baked, bake};
use crate::format::Arith;
use crate::range::OutOfRange;
use crate::settings::{FirmwareTree, RenderSettings, TreeSettings};
use octray_scenes::check;
use octray_scenes::model::Point;
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};
use std::{env, fs, process};

/// A scene file that a build script bakes.
///
/// ```no_run
/// // build.rs
/// use octray_prepare::Arith;
///
/// octray_prepare::bake::file("ball.scene").size(64, 48).arith(Arith::I16F16).write();
/// ```
///
/// The program includes what is written, in a module of its own: `include!(concat!(env!("OUT_DIR"), "/ball.rs"));`.
#[derive(Clone, Debug)]
#[must_use = "write or source bakes the scene"]
pub struct Script {
    path: PathBuf,
    settings: RenderSettings,
    tree: FirmwareTree,
    room: Option<[Point; 2]>,
}

/// Returns a script that bakes this scene file, relative to the package, with octray's defaults: the arithmetic `auto`,
/// the scene's own size, 8 bounces, and the compact BVH if it is cheaper than none on the target.
pub fn file(path: impl Into<PathBuf>) -> Script {
    Script {
        path: path.into(),
        settings: RenderSettings {
            arith: Arith::Auto,
            ..RenderSettings::DEFAULT
        },
        tree: FirmwareTree::AUTO,
        room: None,
    }
}

/// Why a build script cannot bake a scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ScriptError {
    /// The scene file cannot be read, or has mistakes.
    Scene(String),
    /// A setting is outside its range.
    Setting(OutOfRange),
    /// The scene cannot be baked.
    Bake(PathBuf, BakeError),
    /// The source cannot be written.
    Write(PathBuf, String),
}

impl Display for ScriptError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(why) => f.write_str(why),
            Self::Setting(why) => why.fmt(f),
            Self::Bake(path, why) => write!(f, "{}: {why}", path.display()),
            Self::Write(path, why) => write!(f, "{}: {why}", path.display()),
        }
    }
}

impl std::error::Error for ScriptError {}

impl Script {
    /// Columns and rows of the picture; the framing stays.
    pub fn size(mut self, width: u32, height: u32) -> Self {
        self.settings.size = Some((width, height));
        self
    }

    /// The arithmetic.
    pub fn arith(mut self, arith: Arith) -> Self {
        self.settings.arith = arith;
        self
    }

    /// The maximum number of bounces of a ray.
    pub fn max_depth(mut self, max_depth: u32) -> Self {
        self.settings.max_depth = max_depth;
        self
    }

    /// All settings of the rendering. Of the tree's only the leaf size is used.
    pub fn settings(mut self, settings: RenderSettings) -> Self {
        self.settings = settings;
        self
    }

    /// The tree, and whether the device builds it.
    pub fn tree(mut self, tree: FirmwareTree) -> Self {
        self.tree = tree;
        self
    }

    /// Two opposite corners of a box in which objects, lights and the viewpoint are to have room to move.
    pub fn room(mut self, from: Point, to: Point) -> Self {
        self.room = Some([from, to]);
        self
    }

    /// Returns the baked scene for a target triple, or for this machine if `None`.
    ///
    /// # Errors
    /// If a setting is outside its range, or the scene file cannot be read or baked.
    pub fn source(&self, target: Option<&str>) -> Result<Baked, ScriptError> {
        self.settings.check().map_err(ScriptError::Setting)?;
        let mut scene = octray_scenes::read(&self.path)
            .map_err(|error| ScriptError::Scene(error.to_string()))?;
        scene.room = self.room;
        check::scene(&scene).map_err(|error| ScriptError::Scene(error.to_string()))?;
        let format = self.settings.arith.format(&scene, self.settings.max_depth);
        let kind = self.tree.kind_for(scene.objects.len(), format, target);
        let name = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let options = BakeOptions {
            settings: RenderSettings {
                tree: TreeSettings {
                    kind,
                    ..self.settings.tree
                },
                ..self.settings
            },
            on_device: self.tree.on_device,
            target,
            ..BakeOptions::new(&name, self.settings)
        };
        bake(&scene, &options).map_err(|error| ScriptError::Bake(self.path.clone(), error))
    }

    /// Writes the source for the target of the build to `OUT_DIR`, under the scene file's name with the ending `.rs`.
    /// Cargo runs the script again when the scene file changes. A mistake is told as an error of the build.
    pub fn write(&self) {
        println!("cargo::rerun-if-changed=build.rs");
        println!("cargo::rerun-if-changed={}", self.path.display());
        let target = env::var("TARGET").ok();
        let written = self.source(target.as_deref()).and_then(|baked| {
            if let Some(what) = &baked.too_fine {
                println!("cargo::warning={}: {what}", self.path.display());
            }
            let name = self.path.with_extension("rs");
            let name = name.file_name().unwrap_or_default();
            let path = Path::new(&env::var_os("OUT_DIR").unwrap_or_default()).join(name);
            fs::write(&path, baked.source)
                .map_err(|error| ScriptError::Write(path, error.to_string()))
        });
        if let Err(error) = written {
            for line in error.to_string().lines() {
                println!("cargo::error={line}");
            }
            process::exit(1);
        }
    }
}
