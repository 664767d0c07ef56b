//! Instructions of this machine, counted by Valgrind's Callgrind: exact, and the same every time.

use super::setting::Setting;
use crate::measure::child::{self, Ended};
use octray_prepare::RenderSettings;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::render::TRACING;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// Runs this very program under Callgrind.
#[derive(Debug)]
pub struct Callgrind {
    octray: PathBuf,
}

/// A rendering that takes longer has no end.
const PATIENCE: Duration = Duration::from_secs(3600);

impl Callgrind {
    /// Looks for Valgrind.
    ///
    /// # Errors
    /// [`Error::Failed`] with how to install it.
    pub fn find() -> Result<Self, Error> {
        let version = Command::new("valgrind")
            .arg("--version")
            .stdin(Stdio::null())
            .output();
        if !version.is_ok_and(|output| output.status.success()) {
            return Err(Error::Failed(
                "valgrind is missing, which counts instructions: apt-get install valgrind, \
                 or see https://valgrind.org"
                    .into(),
            ));
        }
        let octray = env::current_exe()
            .map_err(|cause| Error::Failed(format!("cannot find this program: {cause}")))?;
        Ok(Self { octray })
    }

    /// The instructions of tracing a scene with these settings on one thread: without start-up, without the
    /// tree's building, without the picture's file. In words why there is no count.
    ///
    /// # Errors
    /// [`Error::Interrupted`]; [`Error::Failed`] if Valgrind cannot be run.
    pub fn count(
        &self,
        scene: &Path,
        setting: &RenderSettings,
        interrupt: &Interrupt,
    ) -> Result<Result<f64, String>, Error> {
        let folder = tempfile::tempdir()
            .map_err(|cause| Error::Failed(format!("cannot make a temporary folder: {cause}")))?;
        let (file, picture) = (folder.path().join("count"), folder.path().join("a.ppm"));
        let mut command = Command::new("valgrind");
        command
            .args(arguments(&file))
            .arg(&self.octray)
            .args(["render", "--stats=none", "--threads=1"])
            .args(setting.render_arguments())
            .arg("--output")
            .args([&picture, scene]);
        let (ended, output) = child::run(command, PATIENCE, interrupt)?;
        if ended != (Ended::Exited { code: 0 }) {
            let last = output.stderr.trim().lines().next_back();
            let why = last.unwrap_or("it wrote nothing");
            return Ok(Err(format!("not counted: {why}")));
        }
        let report = fs::read_to_string(&file).map_err(|cause| Error::read(&file, cause))?;
        Ok(total(&report).ok_or_else(|| {
            format!("not counted: this program was stripped of its symbols, {TRACING} among them")
        }))
    }
}

/// Makes Callgrind count nothing but tracing.
fn arguments(file: &Path) -> [String; 3] {
    [
        "--tool=callgrind".into(),
        format!("--toggle-collect={TRACING}"),
        format!("--callgrind-out-file={}", file.display()),
    ]
}

/// What comes before the path of octray in a command that counts.
pub(super) fn command() -> String {
    format!("valgrind --tool=callgrind --toggle-collect={TRACING}")
}

/// All that Callgrind counted, if it is anything.
fn total(report: &str) -> Option<f64> {
    report
        .lines()
        .find_map(|line| line.strip_prefix("totals: ")?.trim().parse::<f64>().ok())
        .filter(|total| *total > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_total_is_read_and_none_is_no_count() {
        assert_eq!(
            total("events: Ir\n\nfn=(1)\n1 2\ntotals: 123\n"),
            Some(123.0)
        );
        assert_eq!(total("events: Ir\ntotals: 0\n"), None);
        assert_eq!(total(""), None);
    }
}
