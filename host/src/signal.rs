//! Ctrl-C, termination and hang-up of the terminal: the work is asked to stop, and the process ends soon whether it
//! listens or not.
//!
//! Long loops poll the [`Interrupt`]: between tiles and rays, while files are written, while programs run. All else
//! (parsing, conversion, trees, a pipe that nobody writes to) is short or waits for something that may never come; there
//! the process ends after [`GRACE`], its temporary files removed.

use octray_render::interrupt::Interrupt;
use octray_render::output;
use std::io;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;

/// The exit code after Ctrl-C, as in shells: 128 and the number of the signal.
pub const INTERRUPTED: u8 = 130;

/// How long the work may take to stop by itself.
pub const GRACE: Duration = Duration::from_millis(400);

/// What arrived.
#[derive(Debug)]
pub struct Signals {
    /// The request to stop.
    pub interrupt: Interrupt,
    code: Arc<AtomicU8>,
}

impl Signals {
    /// Watches for signals on a thread of its own.
    ///
    /// # Errors
    /// If the system does not let us.
    pub fn watch() -> io::Result<Self> {
        let signals = Self {
            interrupt: Interrupt::new(),
            code: Arc::new(AtomicU8::new(INTERRUPTED)),
        };
        let (interrupt, code) = (signals.interrupt.clone(), Arc::clone(&signals.code));
        system::on_first_signal(move |number| {
            code.store(number, Ordering::Relaxed);
            interrupt.request();
            std::thread::sleep(GRACE);
            output::discard_temporaries();
            number
        })?;
        Ok(signals)
    }

    /// The exit code of an interrupted process.
    pub fn exit_code(&self) -> ExitCode {
        self.code.load(Ordering::Relaxed).into()
    }
}

#[cfg(unix)]
mod system {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::iterator::Signals;
    use std::io;
    use std::sync::Arc;
    use std::thread;

    /// Calls `stop` with the exit code once a signal arrives, and ends the process with what it returns.
    pub(super) fn on_first_signal(stop: impl FnOnce(u8) -> u8 + Send + 'static) -> io::Result<()> {
        // A file that grows beyond its limit is an error of writing, no end without a word.
        signal_hook::flag::register(SIGXFSZ, Arc::default())?;
        let mut signals = Signals::new([SIGINT, SIGTERM])?;
        if !is_ignored(SIGHUP) {
            signals.add_signal(SIGHUP)?;
        }
        let wait = move || {
            if let Some(signal) = signals.forever().next() {
                let code = stop(128 + signal as u8);
                // Not `std::process::exit`, whose handlers may wait for what the other threads hold.
                signal_hook::low_level::exit(code.into());
            }
        };
        thread::Builder::new().spawn(wait).map(drop)
    }

    /// Whether whoever started the process wants it to ignore a signal, as `nohup` does; told on Linux only.
    fn is_ignored(signal: i32) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        ignored.unwrap_or(0) >> (signal - 1) & 1 != 0
    }
}

#[cfg(not(unix))]
mod system {
    use super::INTERRUPTED;
    use std::io;

    /// Calls `stop` with the exit code on Ctrl-C, and ends the process with what it returns.
    pub(super) fn on_first_signal(stop: impl FnOnce(u8) -> u8 + Send + 'static) -> io::Result<()> {
        let mut stop = Some(stop);
        ctrlc::set_handler(move || {
            if let Some(stop) = stop.take() {
                std::process::exit(stop(INTERRUPTED).into());
            }
        })
        .map_err(io::Error::other)
    }
}
