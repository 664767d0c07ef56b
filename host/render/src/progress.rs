//! How far the work is.

/// Receives how far the work is, from any thread. `()` ignores it.
pub trait Progress: Sync {
    /// There are so many steps, none of them done.
    fn start(&self, steps: usize);

    /// One more step is done.
    fn step(&self);
}

impl Progress for () {
    fn start(&self, _: usize) {}

    fn step(&self) {}
}

/// A progress bar on standard error, there only when that is a terminal; it vanishes when dropped.
#[cfg(feature = "terminal")]
#[derive(Debug)]
pub struct Bar(indicatif::ProgressBar);

#[cfg(feature = "terminal")]
impl Bar {
    /// A bar titled `what`, of no length yet; invisible unless standard error is a terminal.
    pub fn new(what: &'static str) -> Self {
        let bar = indicatif::ProgressBar::new(0).with_message(what);
        let style = "{msg} {wide_bar} {percent:>3} %  {eta} left";
        Self(match indicatif::ProgressStyle::with_template(style) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        })
    }
}

#[cfg(feature = "terminal")]
impl Progress for Bar {
    fn start(&self, steps: usize) {
        self.0.set_length(steps as u64);
    }

    fn step(&self) {
        // Cheap: the bar is drawn only some times a second.
        self.0.inc(1);
    }
}

#[cfg(feature = "terminal")]
impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
