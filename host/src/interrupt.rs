//! A request to stop: set by Ctrl-C, polled by whatever takes long.

use crate::error::Error;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The exit code of a process that was interrupted, as shells have it for Ctrl-C.
pub const EXIT_CODE: i32 = 130;

/// A flag that long work polls; clones share it.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// A flag that only [`Interrupt::request`] sets.
    pub fn new() -> Self {
        Self::default()
    }

    /// A flag that Ctrl-C, a termination or a hang-up of the terminal sets; a second one ends the process at
    /// once, in case it is stuck where nothing polls. May be called once in a process.
    ///
    /// # Errors
    /// [`Error::Failed`] when the system refuses the handler.
    pub fn on_signal() -> Result<Self, Error> {
        let interrupt = Self::new();
        let flag = interrupt.clone();
        ctrlc::set_handler(move || {
            if flag.requested() {
                std::process::exit(EXIT_CODE);
            }
            flag.request();
        })
        .map_err(|cause| Error::Failed(format!("cannot watch for Ctrl-C: {cause}")))?;
        Ok(interrupt)
    }

    /// Ask the work to stop.
    pub fn request(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the work was asked to stop.
    pub fn requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// [`Error::Interrupted`] once the work was asked to stop.
    pub fn check(&self) -> Result<(), Error> {
        if self.requested() {
            Err(Error::Interrupted)
        } else {
            Ok(())
        }
    }
}
