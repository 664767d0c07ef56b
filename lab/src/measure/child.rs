//! Programs that are run, with patience and no more.

use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

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

/// What it told.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Told {
    /// On standard output.
    pub output: String,
    /// On standard error.
    pub errors: String,
}

/// Runs a program to its end, or to the end of patience.
///
/// # Errors
/// [`Error::Failed`] if it cannot be run, [`Error::Interrupted`] if the user asked to stop.
pub fn run(
    mut command: Command,
    patience: Duration,
    interrupt: &Interrupt,
) -> Result<(Ended, Told), Error> {
    let name = command.get_program().to_string_lossy().into_owned();
    let failed = |cause| Error::Failed(format!("cannot run {name}: {cause}"));
    let mut child = (command.stdin(Stdio::null()))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(failed)?;
    // Pipes are read all the time, for a program stops when one is full.
    let output = child.stdout.take().map(read);
    let errors = child.stderr.take().map(read);
    let begin = Instant::now();
    let mut pause = Duration::from_millis(1);
    let ended = loop {
        if let Some(status) = child.try_wait().map_err(failed)? {
            break status
                .code()
                .map_or(Ended::Killed, |code| Ended::Exited { code });
        }
        if interrupt.requested() {
            stop(&mut child);
            return Err(Error::Interrupted);
        }
        if begin.elapsed() > patience {
            stop(&mut child);
            break Ended::Late;
        }
        thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(50));
    };
    let text = |reader: Option<thread::JoinHandle<Vec<u8>>>| {
        let bytes = reader.and_then(|reader| reader.join().ok());
        String::from_utf8_lossy(&bytes.unwrap_or_default()).into_owned()
    };
    let told = Told {
        output: text(output),
        errors: text(errors),
    };
    Ok((ended, told))
}

/// What cannot be ended has ended already.
fn stop(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

fn read(mut pipe: impl Read + Send + 'static) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        // What came before a failure is still told.
        let _ = pipe.read_to_end(&mut bytes);
        bytes
    })
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str, patience: Duration) -> (Ended, Told) {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        run(command, patience, &Interrupt::new()).unwrap()
    }

    #[test]
    fn how_a_program_ends_and_what_it_tells() {
        let long = Duration::from_secs(60);
        let (ended, told) = shell("echo a; echo b >&2; exit 7", long);
        assert_eq!(ended, Ended::Exited { code: 7 });
        assert_eq!((&*told.output, &*told.errors), ("a\n", "b\n"));
        assert_eq!(shell("kill -9 $$", long).0, Ended::Killed);
    }

    #[test]
    fn more_than_a_pipe_holds_does_not_stop_it() {
        let (ended, told) = shell("head -c 300000 /dev/zero", Duration::from_secs(60));
        assert_eq!(ended, Ended::Exited { code: 0 });
        assert_eq!(told.output.len(), 300_000);
    }

    #[test]
    fn a_program_without_end_is_ended() {
        let (ended, _) = shell("exec sleep 600", Duration::from_millis(30));
        assert_eq!(ended, Ended::Late);
    }

    #[test]
    fn an_interrupt_ends_it() {
        let interrupt = Interrupt::new();
        interrupt.request();
        let mut command = Command::new("sleep");
        command.arg("600");
        let result = run(command, Duration::from_secs(60), &interrupt);
        assert!(matches!(result, Err(Error::Interrupted)));
    }

    #[test]
    fn a_missing_program_is_named() {
        let command = Command::new("/nowhere/emulator");
        let result = run(command, Duration::from_secs(1), &Interrupt::new());
        let text = result.unwrap_err().to_string();
        assert!(text.starts_with("cannot run /nowhere/emulator: "), "{text}");
    }
}
