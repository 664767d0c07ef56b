//! What can go wrong.

use octray_scenes::name::Shown;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A failure, with everything its message needs.
///
/// [`Debug`](fmt::Debug) shows the message too: a `main` that returns this error prints it that way.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// What is asked for contradicts itself or what it names: the caller is at fault.
    #[error("{0}")]
    Usage(String),
    /// A scene was refused; the text holds the drawn diagnostics, ready to print.
    #[error("{0}")]
    Scene(String),
    /// A file could not be read.
    #[error("cannot read {}: {source}", Shown(path))]
    Read {
        /// The file as the user named it.
        path: PathBuf,
        /// What the system or the decoder said.
        source: io::Error,
    },
    /// A file could not be written; nothing is left behind.
    #[error("cannot write {}: {source}", Shown(path))]
    Write {
        /// The file as the user named it.
        path: PathBuf,
        /// What the system or the encoder said.
        source: io::Error,
    },
    /// Standard output could not be written.
    #[error("cannot write to standard output: {0}")]
    Stdout(io::Error),
    /// Whoever read standard output has stopped; not a failure.
    #[error("standard output was closed")]
    BrokenPipe,
    /// Two pictures cannot be compared, being of different sizes (width, height).
    #[error("the pictures differ in size: {}x{} and {}x{}", .0.0, .0.1, .1.0, .1.1)]
    Sizes((u32, u32), (u32, u32)),
    /// Two pictures differ by more than the bounds given; one sentence for each bound.
    #[error("{}", .0.join("\n"))]
    Bounds(Vec<String>),
    /// Work that was accepted could not be done, for this reason.
    #[error("{0}")]
    Failed(String),
    /// The picture takes more rays than this, the budget of the work.
    #[error("the picture takes more than {} rays, not counting shadow rays", crate::counts::thousands(*.0))]
    TooManyRays(u64),
    /// The work was asked to stop.
    #[error("interrupted")]
    Interrupted,
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A scene that could not be made ready: it failed.
impl From<crate::renderer::PrepareError> for Error {
    fn from(error: crate::renderer::PrepareError) -> Self {
        Self::Failed(error.to_string())
    }
}

/// Settings that no picture can have.
impl From<octray_prepare::range::OutOfRange> for Error {
    fn from(error: octray_prepare::range::OutOfRange) -> Self {
        Self::Usage(error.to_string())
    }
}

/// A scene that violates what holds for all scenes.
impl From<octray_scenes::check::Broken> for Error {
    fn from(broken: octray_scenes::check::Broken) -> Self {
        Self::Scene(format!("error: {broken}"))
    }
}

/// A scene made in code that was refused, with its mistakes, a line each.
impl From<octray_scenes::builder::Mistakes> for Error {
    fn from(mistakes: octray_scenes::builder::Mistakes) -> Self {
        Self::Scene(mistakes.to_string())
    }
}

/// A scene that was refused, with its mistakes drawn.
impl From<octray_scenes::ReadError> for Error {
    fn from(error: octray_scenes::ReadError) -> Self {
        Self::Scene(error.to_string())
    }
}

impl Error {
    /// A failure to read `path`.
    pub fn read(path: &Path, source: io::Error) -> Self {
        Self::Read {
            path: path.to_owned(),
            source,
        }
    }

    /// A failure to write `path`.
    pub fn write(path: &Path, source: io::Error) -> Self {
        Self::Write {
            path: path.to_owned(),
            source,
        }
    }
}
