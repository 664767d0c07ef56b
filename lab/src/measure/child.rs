//! Programs that are run, with patience and no more.

use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use std::fs::File;
use std::io::{self, Read, Seek};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use wait_timeout::ChildExt;

/// How long an interrupt goes unseen at most.
const POLL: Duration = Duration::from_millis(50);

/// How a program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// By itself.
    Exited {
        /// Its exit code.
        code: i32,
    },
    /// By a signal.
    Killed,
    /// It did not in time, and was ended.
    Late,
}

/// What it wrote.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Output {
    /// On standard output.
    pub stdout: String,
    /// On standard error.
    pub stderr: String,
}

/// Runs a program to its end, or to the end of patience.
///
/// # Errors
/// [`Error::Failed`] if it cannot be run, [`Error::Interrupted`] if the user asked to stop.
pub fn run(
    mut command: Command,
    patience: Duration,
    interrupt: &Interrupt,
) -> Result<(Ended, Output), Error> {
    let name = command.get_program().to_string_lossy().into_owned();
    let failed = |cause| Error::Failed(format!("cannot run {name}: {cause}"));
    // Files, not pipes: a program stops when a pipe is full.
    let (stdout, stderr) = (tempfile::tempfile(), tempfile::tempfile());
    let (stdout, stderr) = (stdout.map_err(failed)?, stderr.map_err(failed)?);
    // A group of its own, which ends with it: cargo alone would leave its compilers behind.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let mut child = (command.stdin(Stdio::null()))
        .stdout(stdout.try_clone().map_err(failed)?)
        .stderr(stderr.try_clone().map_err(failed)?)
        .spawn()
        .map_err(failed)?;
    let begin = Instant::now();
    let ended = loop {
        let left = patience.saturating_sub(begin.elapsed());
        if let Some(status) = child.wait_timeout(left.min(POLL)).map_err(failed)? {
            break (status.code()).map_or(Ended::Killed, |code| Ended::Exited { code });
        }
        if interrupt.requested() || left.is_zero() {
            end(&mut child);
            interrupt.check()?;
            break Ended::Late;
        }
    };
    let written = Output {
        stdout: text(stdout).map_err(failed)?,
        stderr: text(stderr).map_err(failed)?,
    };
    Ok((ended, written))
}

/// Ends a program and what it has started. What cannot be ended has ended already.
fn end(child: &mut Child) {
    #[cfg(unix)]
    {
        use rustix::process::{Pid, Signal, kill_process_group};
        if let Some(group) = Pid::from_raw(child.id() as i32) {
            let _ = kill_process_group(group, Signal::KILL);
        }
    }
    let _ = child.kill();
    let _ = child.wait();
}

/// All that was written into a file.
fn text(mut file: File) -> io::Result<String> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::thread;

    fn shell(script: &str, patience: Duration) -> (Ended, Output) {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        run(command, patience, &Interrupt::new()).unwrap()
    }

    #[test]
    fn how_a_program_ends_and_what_it_writes() {
        let long = Duration::from_secs(60);
        let (ended, output) = shell("echo a; echo b >&2; exit 7", long);
        assert_eq!(ended, Ended::Exited { code: 7 });
        assert_eq!((&*output.stdout, &*output.stderr), ("a\n", "b\n"));
        assert_eq!(shell("kill -9 $$", long).0, Ended::Killed);
    }

    #[test]
    fn more_than_a_pipe_holds_does_not_stop_it() {
        let (ended, output) = shell("head -c 300000 /dev/zero", Duration::from_secs(60));
        assert_eq!(ended, Ended::Exited { code: 0 });
        assert_eq!(output.stdout.len(), 300_000);
    }

    #[test]
    fn a_program_without_end_is_ended() {
        let (ended, _) = shell("exec sleep 600", Duration::from_millis(30));
        assert_eq!(ended, Ended::Late);
    }

    #[test]
    fn an_interrupt_ends_it_within_a_second() {
        let interrupt = Interrupt::new();
        let mut command = Command::new("sleep");
        command.arg("600");
        let result = thread::scope(|scope| {
            let run = scope.spawn(|| run(command, Duration::from_secs(60), &interrupt));
            thread::sleep(Duration::from_millis(100));
            let begin = Instant::now();
            interrupt.request();
            let result = run.join().unwrap();
            assert!(begin.elapsed() < Duration::from_secs(1));
            result
        });
        assert!(matches!(result, Err(Error::Interrupted)));
    }

    #[test]
    fn what_it_has_started_ends_with_it() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("id");
        // The shell waits for a program of its own.
        let script = format!("sleep 600 & echo $! > {}; wait", file.display());
        let (ended, _) = shell(&script, Duration::from_millis(300));
        assert_eq!(ended, Ended::Late);
        let id = std::fs::read_to_string(file).unwrap();
        let id = rustix::process::Pid::from_raw(id.trim().parse().unwrap()).unwrap();
        let begin = Instant::now();
        while rustix::process::test_kill_process(id).is_ok() && !is_dead(id) {
            assert!(begin.elapsed() < Duration::from_secs(10), "it still runs");
            thread::sleep(POLL);
        }
    }

    /// Whether a process has ended, but nobody has asked how.
    fn is_dead(id: rustix::process::Pid) -> bool {
        let status = std::fs::read_to_string(format!("/proc/{}/stat", id.as_raw_nonzero()));
        status.is_ok_and(|status| status.contains(") Z "))
    }

    #[test]
    fn a_missing_program_is_named() {
        let command = Command::new("/nowhere/emulator");
        let result = run(command, Duration::from_secs(1), &Interrupt::new());
        let text = result.unwrap_err().to_string();
        assert!(text.starts_with("cannot run /nowhere/emulator: "), "{text}");
    }
}
