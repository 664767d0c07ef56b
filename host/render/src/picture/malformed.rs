//! What is said of a file that is no picture.

use std::io::{self, ErrorKind};

/// The error for a file that does not keep to its format.
pub(super) fn malformed(what: impl Into<String>) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, what.into())
}
