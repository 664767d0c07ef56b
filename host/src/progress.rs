//! A progress bar on standard error, there only when that is a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// A progress bar that threads share; it vanishes when dropped.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar titled `what`, of no length yet; invisible unless standard error is a terminal.
    pub fn new(what: &'static str) -> Self {
        let bar = ProgressBar::new(0).with_message(what);
        let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %  {eta} left");
        Self(match style {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        })
    }

    /// A bar that never shows.
    pub fn hidden() -> Self {
        Self(ProgressBar::hidden())
    }

    /// Set how many steps there are.
    pub fn start(&self, steps: usize) {
        self.0.set_length(steps as u64);
    }

    /// One more step is done. Cheap: the bar is drawn only some times a second.
    pub fn step(&self) {
        self.0.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
