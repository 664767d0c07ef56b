//! Runs a program on an emulated board and counts its instructions.

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

/// The result of a run on a board.
#[derive(Clone, Debug)]
pub struct Run {
    /// The names and values that it printed.
    pub values: BTreeMap<String, String>,
    /// Its instructions between the marks.
    pub count: Count,
}

/// Runs emulated boards.
#[derive(Debug)]
pub struct Emulator<'a> {
    /// The plugin that counts instructions.
    pub plugin: &'a Path,
    /// The timeout of a run.
    pub patience: Duration,
    /// Functions to watch, separated by colons; see the plugin.
    pub watch: &'a str,
}

impl Emulator<'_> {
    /// Runs a program and returns its result, or a text that states why there is none.
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
        let (ended, output) = child::run(command, self.patience, interrupt)?;
        let text = [output.stdout, output.stderr].concat();
        if let Some(why) = failure(ended, &text, self.patience) {
            return Ok(Err(why));
        }
        let report = fs::read_to_string(&report).unwrap_or_default();
        Ok(Count::parse(&report)
            .map(|count| Run {
                values: values(&text),
                count,
            })
            .ok_or_else(|| format!("the emulator counted nothing: {}", last_line(&text))))
    }
}

/// Formats a path as a value in QEMU's options, where commas are doubled.
fn option(path: &Path) -> String {
    path.to_string_lossy().replace(',', ",,")
}

/// Returns why a run gives no measurement. The exit codes are the firmware's.
fn failure(ended: Ended, text: &str, patience: Duration) -> Option<String> {
    Some(match ended {
        Ended::Exited { code: 0 } => return None,
        Ended::Exited { code: 101 } => "panicked".into(),
        Ended::Exited { code: 102 } => "trapped".into(),
        Ended::Exited { code: 103 } => "stack overflow".into(),
        Ended::Exited { code: 104 } => format!("not enough capacity: {}", last_line(text)),
        Ended::Exited { code } => format!("exit code {code}: {}", last_line(text)),
        // A Cortex-M locks up if it finds no stack for the fault that it is in: the stack has left the memory.
        Ended::Killed if fatal_line(text).starts_with("Lockup") => {
            format!("stack overflow: {}", fatal_line(text))
        }
        Ended::Killed => format!("crashed: {}", fatal_line(text)),
        Ended::Late => format!("no end within {} s", patience.as_secs()),
    })
}

/// Returns QEMU's message before it gave up, for example that a fault met no handler.
fn fatal_line(text: &str) -> &str {
    text.lines()
        .find_map(|line| line.strip_prefix("qemu: fatal: "))
        .unwrap_or_else(|| last_line(text))
}

fn last_line(text: &str) -> &str {
    text.trim().lines().next_back().unwrap_or("no output")
}

/// Parses lines of a name and a value.
fn values(text: &str) -> BTreeMap<String, String> {
    (text.lines())
        .filter_map(|line| line.split_once(' '))
        .map(|(name, value)| (name.into(), value.into()))
        .collect()
}

/// Returns the version that the emulator reports.
pub fn version(board: &Board) -> String {
    let output = Command::new(board.emulator()).arg("--version").output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let text = text.unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    line.strip_prefix("QEMU emulator version ")
        .map_or_else(|| "unknown".into(), |version| format!("QEMU {version}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_run_is_described() {
        let why = |ended| failure(ended, "a b\nlast\n", Duration::from_secs(9)).unwrap();
        assert_eq!(why(Ended::Exited { code: 101 }), "panicked");
        assert_eq!(why(Ended::Exited { code: 102 }), "trapped");
        assert_eq!(why(Ended::Exited { code: 103 }), "stack overflow");
        let dropped = failure(
            Ended::Exited { code: 104 },
            "hash 1\ndropped 3\n",
            Duration::ZERO,
        );
        assert_eq!(dropped.as_deref(), Some("not enough capacity: dropped 3"));
        assert_eq!(why(Ended::Exited { code: 1 }), "exit code 1: last");
        assert_eq!(why(Ended::Killed), "crashed: last");
        assert_eq!(why(Ended::Late), "no end within 9 s");
        let text = "qemu: fatal: Lockup\nR00=0\n";
        let why = failure(Ended::Killed, text, Duration::ZERO);
        assert_eq!(why.as_deref(), Some("stack overflow: Lockup"));
        let text = "qemu: fatal: Trying to execute code outside RAM\n";
        let why = failure(Ended::Killed, text, Duration::ZERO).unwrap();
        assert!(why.starts_with("crashed: Trying"), "{why}");
        let well = Ended::Exited { code: 0 };
        assert_eq!(failure(well, "", Duration::ZERO), None);
    }

    #[test]
    fn commas_in_paths_stay_in_paths() {
        assert_eq!(option(Path::new("/a,b/c")), "/a,,b/c");
    }

    #[test]
    fn values_are_read_by_name() {
        let values = values("scene a b\nhash 12\nwarning\n");
        assert_eq!(values["hash"], "12");
        assert_eq!(values["scene"], "a b");
        assert_eq!(values.len(), 2);
    }
}
