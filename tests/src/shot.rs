//! Renders pictures with octray, without its command line.

use octray_prepare::{Arith, RenderSettings, TreeKind};
use octray_render::interrupt::Interrupt;
use octray_render::render::{Rendering, render_with};
use octray_render::schedule::Schedule;
use octray_scenes::model::Scene;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Returns the scene files of the project, by name.
///
/// # Panics
/// If they cannot be listed, or there are none.
pub fn scene_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let entries = fs::read_dir(folder).expect("the scenes are beside the tests");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a folder can be listed").path())
        .filter(|path| path.extension().is_some_and(|e| e == "scene"))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

/// Returns a file's name without folder and extension.
pub fn stem(path: &Path) -> String {
    path.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

/// Reads a scene file.
///
/// # Panics
/// If it has mistakes.
pub fn read(path: &Path) -> Scene {
    octray_scenes::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The settings of a picture; the rest is as in the command.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// The settings.
    pub settings: RenderSettings,
}

impl Shot {
    /// Returns the command's defaults in this arithmetic.
    pub fn new(arith: Arith) -> Self {
        Self {
            settings: RenderSettings {
                arith,
                ..RenderSettings::DEFAULT
            },
        }
    }

    /// Sets the size.
    #[must_use]
    pub fn size(mut self, width: u32, height: u32) -> Self {
        self.settings.size = Some((width, height));
        self
    }

    /// Sets the kind of tree.
    #[must_use]
    pub fn tree(mut self, kind: TreeKind) -> Self {
        self.settings.tree.kind = kind;
        self
    }

    /// Renders the picture.
    ///
    /// # Panics
    /// If the scene does not fit the arithmetic.
    pub fn take(&self, scene: &Scene) -> Rendering {
        let work = Schedule {
            threads: NonZeroUsize::MIN,
            ..Schedule::default()
        };
        render_with(scene, &self.settings, &work, false, &(), &Interrupt::new())
            .unwrap_or_else(|e| panic!("{e}"))
    }
}
