//! Arguments of `octray render` that move the camera.

use crate::job::{FrameFiles, FramesJob, ViewPath};
use clap::{Args, value_parser};
use octray_render::error::Error;
use octray_render::output;
use octray_render::picture::{Format, Target};
use std::path::PathBuf;

/// Arguments that move the camera.
#[derive(Clone, Debug, Args)]
pub(super) struct FramesArgs {
    /// Render N pictures along a path, as numbered files: out-0001.png and so on for -o out.png
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=9999), help_heading = FRAMES)]
    frames: Option<u32>,
    /// Turn the camera about what it looks at, by this many degrees; with --frames N frame I by (I - 1) / N of them, so that
    /// 360 closes the circle
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = degrees, conflicts_with = "path", help_heading = FRAMES)]
    orbit: Option<f64>,
    /// Move the camera through the views in a file, which has on each line a view as a scene file has it:
    /// v x y z at x y z up x y z angle a [one picture for each view without --frames]
    #[arg(long, value_name = "FILE", verbatim_doc_comment, help_heading = FRAMES)]
    path: Option<PathBuf>,
    /// Write one animated PNG instead of numbered pictures; so does an output that ends in .apng
    #[arg(long, help_heading = FRAMES)]
    apng: bool,
    /// Frames per second of an animated PNG [default: 10]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1000), help_heading = FRAMES)]
    fps: Option<u16>,
}

const FRAMES: &str = "Moving camera";

/// Frames per second.
const PER_SECOND: u16 = 10;

impl FramesArgs {
    /// Returns whether there may be several pictures.
    pub(super) fn is_used(&self) -> bool {
        self.frames.is_some() || self.path.is_some()
    }

    /// Returns the frames, if there may be several, and by how many degrees the camera of a single picture is turned.
    ///
    /// # Errors
    /// [`Error::Usage`] if they contradict each other or the output.
    pub(super) fn job(self, output: &Target) -> Result<(Option<FramesJob>, f64), Error> {
        let usage = |text: &str| Err(Error::Usage(text.into()));
        let ends_so = |extension: &std::ffi::OsStr| extension.eq_ignore_ascii_case("apng");
        let animated = self.apng || output.path.extension().is_some_and(ends_so);
        if self.fps.is_some() && !animated {
            return usage("--fps is for animations: use --apng, or an output that ends in .apng");
        }
        if !self.is_used() {
            return match animated {
                true => usage("an animation needs --frames or --path"),
                false => Ok((None, self.orbit.unwrap_or(0.0))),
            };
        }
        if animated && output.format != Format::Png {
            return usage("an animation is a PNG: let the output end in .apng or .png");
        }
        if !animated && output::is_stdout(&output.path) {
            return usage("numbered pictures need a name: use '-o NAME.png', or --apng");
        }
        let path = match (self.path, self.orbit) {
            (Some(path), _) => ViewPath::File(path),
            (None, Some(degrees)) => ViewPath::Orbit(degrees),
            (None, None) => return usage("--frames needs a path: --orbit DEGREES or --path FILE"),
        };
        let frames = FramesJob {
            count: self.frames,
            path,
            files: match animated {
                true => FrameFiles::Animation {
                    per_second: self.fps.unwrap_or(PER_SECOND),
                },
                false => FrameFiles::Numbered,
            },
        };
        Ok((Some(frames), 0.0))
    }
}

/// The most degrees: a thousand turns. Far beyond, a step between two numbers is a turn.
const MOST_DEGREES: f64 = 360_000.0;

/// Parses a number of degrees.
fn degrees(text: &str) -> Result<f64, String> {
    let number = (text.parse().ok()).filter(|degrees: &f64| degrees.abs() <= MOST_DEGREES);
    number.ok_or_else(|| {
        format!(
            "expected a number of degrees such as 360 or -45.5, from -{MOST_DEGREES} to {MOST_DEGREES}"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_orbit_is_endless() {
        assert_eq!(degrees("-45.5"), Ok(-45.5));
        assert_eq!(degrees("360000"), Ok(360_000.0));
        for wrong in ["1e300", "-360001", "inf", "nan", "", "x"] {
            let message = degrees(wrong).unwrap_err();
            assert!(message.ends_with("from -360000 to 360000"), "{message}");
        }
    }
}
