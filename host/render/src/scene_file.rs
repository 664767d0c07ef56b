//! Scene files as the commands read them.

use crate::error::Error;
use octray_scenes::model::Scene;
use std::io::{self, Write};
use std::path::Path;

/// Reads a scene. What is odd about it but harmless is told on standard error.
///
/// # Errors
/// [`Error::Scene`] with its mistakes drawn.
pub fn read(path: &Path) -> Result<Scene, Error> {
    let (scene, warnings) = octray_scenes::read_with_warnings(path)?;
    if !warnings.is_empty() {
        // A failure to print cannot be reported.
        let _ = writeln!(io::stderr().lock(), "{warnings}\n");
    }
    Ok(scene)
}
