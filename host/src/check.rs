//! `octray check`: prints what is in a scene, or what is wrong with it.

use octray_render::counts::SceneCounts;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::scene_file;
use octray_scenes::name::Shown;
use std::path::PathBuf;

/// Reads each scene and prints one line per scene with its contents.
///
/// # Errors
/// [`Error::Scene`] with the mistakes of all refused scenes, after the other scenes were reported.
pub fn run(scenes: &[PathBuf], interrupt: &Interrupt) -> Result<(), Error> {
    let mut refused = Vec::new();
    for path in scenes {
        interrupt.check()?;
        match scene_file::read(path) {
            Ok(scene) => output::write_stdout(interrupt, |out| {
                let (name, facts) = (Shown(path), SceneCounts::of(&scene));
                writeln!(
                    out,
                    "{name}: {facts}, {} x {} pixels",
                    scene.width, scene.height
                )
            })?,
            Err(Error::Scene(text)) => refused.push(text),
            Err(other) => return Err(other),
        }
    }
    if refused.is_empty() {
        Ok(())
    } else {
        Err(Error::Scene(refused.join("\n\n")))
    }
}
