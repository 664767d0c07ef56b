//! Scene files as the commands read them.

use crate::error::Error;
use octray_scenes::model::Scene;
use octray_scenes::name::Shown;
use octray_scenes::reduce::Reduction;
use std::io::{self, Write};
use std::path::Path;

/// What there is to say of a picture in which no ray of the camera meets anything.
pub const NOTHING_IN_SIGHT: &str =
    "no ray of the camera meets an object: the picture is all background";

/// Reads a scene. What is odd about it but harmless is told on standard error, and so is what it lacks.
///
/// # Errors
/// [`Error::Scene`] with its mistakes drawn.
pub fn read(path: &Path) -> Result<Scene, Error> {
    read_reduced(path, Reduction::default())
}

/// Reads a scene as [`read`] does, and leaves something out.
///
/// # Errors
/// [`Error::Scene`] with its mistakes drawn, [`Error::Usage`] if it has fewer lights than asked for.
pub fn read_reduced(path: &Path, reduction: Reduction) -> Result<Scene, Error> {
    let (scene, warnings) = octray_scenes::read_with_warnings(path)?;
    reduce(scene, &warnings, path, reduction)
}

/// Reads a scene as [`read_reduced`] does, and tells on which lines its objects begin.
///
/// # Errors
/// Those of [`read_reduced`].
pub fn read_with_lines(path: &Path, reduction: Reduction) -> Result<(Scene, Vec<u32>), Error> {
    let (scene, warnings, lines) = octray_scenes::read_with_lines(path)?;
    Ok((reduce(scene, &warnings, path, reduction)?, lines()))
}

fn reduce(
    mut scene: Scene,
    warnings: &str,
    path: &Path,
    reduction: Reduction,
) -> Result<Scene, Error> {
    if !warnings.is_empty() {
        // A failure to print cannot be reported.
        let _ = writeln!(io::stderr().lock(), "{warnings}\n");
    }
    reduction
        .apply(&mut scene)
        .map_err(|few| Error::Usage(format!("{}: {few}", Shown(path))))?;
    if scene.objects.is_empty() {
        note("the scene has no objects: the picture is all background");
    } else if scene.lights.is_empty() {
        note(
            "the scene has no lights: surfaces show ambient light, and what they mirror and let through",
        );
    }
    Ok(scene)
}

/// Tells something on standard error that is no mistake, but may not be meant.
pub fn note(text: &str) {
    // A failure to print cannot be reported.
    let _ = writeln!(io::stderr().lock(), "note: {text}");
}
