//! Running a program on an emulated board, its instructions counted.

use super::board::Board;
use super::child::{self, Ended};
use super::count::Count;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// What a program did on a board.
#[derive(Clone, Debug)]
pub struct Run {
    /// What it told: names and values.
    pub told: BTreeMap<String, String>,
    /// Its instructions between the marks.
    pub count: Count,
}

/// Runs emulated boards.
#[derive(Debug)]
pub struct Emulator<'a> {
    /// The plugin that counts.
    pub plugin: &'a Path,
    /// How long a run may take.
    pub patience: Duration,
    /// Functions to watch, separated by colons; see the plugin.
    pub watch: &'a str,
}

impl Emulator<'_> {
    /// Runs a program; what it did, or in words why that is not known.
    ///
    /// # Errors
    /// [`Error::Interrupted`]; [`Error::Failed`] if the emulator cannot be run.
    pub fn run(
        &self,
        board: &Board,
        program: &Path,
        interrupt: &Interrupt,
    ) -> Result<Result<Run, String>, Error> {
        let folder = tempfile::tempdir()
            .map_err(|cause| Error::Failed(format!("cannot make a temporary folder: {cause}")))?;
        let report = folder.path().join("count");
        let mut command = Command::new(board.emulator());
        command.args(["-M", board.machine]);
        if board.machine == "virt" {
            command.args(["-bios", "none"]);
        }
        let (plugin, out) = (option(self.plugin), option(&report));
        command
            .args(["-semihosting-config", "enable=on,target=native"])
            .args(["-display", "none", "-monitor", "none", "-serial", "none"])
            .arg("-plugin")
            .arg(format!("{plugin},out={out},watch={}", self.watch))
            .arg("-kernel")
            .arg(program);
        let (ended, told) = child::run(command, self.patience, interrupt)?;
        let text = [told.output, told.errors].concat();
        if let Some(why) = failure(ended, &text, self.patience) {
            return Ok(Err(why));
        }
        let report = fs::read_to_string(&report).unwrap_or_default();
        Ok(Count::parse(&report)
            .map(|count| Run {
                told: values(&text),
                count,
            })
            .ok_or_else(|| format!("the emulator counted nothing: {}", last_line(&text))))
    }
}

/// A path as a value among QEMU's options, where a comma is written twice.
fn option(path: &Path) -> String {
    path.to_string_lossy().replace(',', ",,")
}

/// Why a run is no measurement; the exit codes are the firmware's.
fn failure(ended: Ended, told: &str, patience: Duration) -> Option<String> {
    Some(match ended {
        Ended::Exited { code: 0 } => return None,
        Ended::Exited { code: 101 } => "panicked".into(),
        Ended::Exited { code: 102 } => "trapped".into(),
        Ended::Exited { code: 103 } => "stack overflow".into(),
        Ended::Exited { code: 104 } => format!("too little room: {}", last_line(told)),
        Ended::Exited { code } => format!("exit code {code}: {}", last_line(told)),
        Ended::Killed => format!("crashed: {}", fatal_line(told)),
        Ended::Late => format!("no end within {} s", patience.as_secs()),
    })
}

/// What QEMU said before it gave up, such as that a fault met no handler.
fn fatal_line(text: &str) -> &str {
    text.lines()
        .find_map(|line| line.strip_prefix("qemu: fatal: "))
        .unwrap_or_else(|| last_line(text))
}

fn last_line(text: &str) -> &str {
    text.trim()
        .lines()
        .next_back()
        .unwrap_or("nothing was told")
}

/// Lines of a name and a value.
fn values(text: &str) -> BTreeMap<String, String> {
    (text.lines())
        .filter_map(|line| line.split_once(' '))
        .map(|(name, value)| (name.into(), value.into()))
        .collect()
}

/// The emulator's own version, as it tells it.
pub fn version(board: &Board) -> String {
    let told = Command::new(board.emulator()).arg("--version").output();
    let text = told.map(|told| String::from_utf8_lossy(&told.stdout).into_owned());
    let text = text.unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    line.strip_prefix("QEMU emulator version ")
        .map_or_else(|| "unknown".into(), |version| format!("QEMU {version}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_failed_is_told_in_words() {
        let why = |ended| failure(ended, "a b\nlast\n", Duration::from_secs(9)).unwrap();
        assert_eq!(why(Ended::Exited { code: 101 }), "panicked");
        assert_eq!(why(Ended::Exited { code: 102 }), "trapped");
        assert_eq!(why(Ended::Exited { code: 103 }), "stack overflow");
        let dropped = failure(
            Ended::Exited { code: 104 },
            "hash 1\ndropped 3\n",
            Duration::ZERO,
        );
        assert_eq!(dropped.as_deref(), Some("too little room: dropped 3"));
        assert_eq!(why(Ended::Exited { code: 1 }), "exit code 1: last");
        assert_eq!(why(Ended::Killed), "crashed: last");
        assert_eq!(why(Ended::Late), "no end within 9 s");
        let told = "qemu: fatal: Lockup\nR00=0\n";
        let why = failure(Ended::Killed, told, Duration::ZERO);
        assert_eq!(why.as_deref(), Some("crashed: Lockup"));
        let well = Ended::Exited { code: 0 };
        assert_eq!(failure(well, "", Duration::ZERO), None);
    }

    #[test]
    fn commas_in_paths_stay_in_paths() {
        assert_eq!(option(Path::new("/a,b/c")), "/a,,b/c");
    }

    #[test]
    fn values_are_read_by_name() {
        let told = values("scene a b\nhash 12\nwarning\n");
        assert_eq!(told["hash"], "12");
        assert_eq!(told["scene"], "a b");
        assert_eq!(told.len(), 2);
    }
}
