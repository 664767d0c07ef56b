//! Reads scene files: both dialects of `docs/MODEL.md` from one stream of tokens.
//!
//! `token` splits the source at white space. `entity` collects a keyword and the numbers up to the next keyword.
//! `build` turns each entity into its part of the scene and has it checked. `header` assembles the camera, whose parts
//! are spread over several keywords. Only the scene grows with the file, and every byte is read once; places are
//! searched again only for mistakes.

mod build;
mod entity;
mod header;
mod token;

use crate::diagnostic::{Diagnostics, Sink};
use crate::model::Scene;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

pub use crate::word::{Keyword, Span};

/// Reads a scene from its text.
///
/// # Errors
/// All mistakes up to [`MOST`](crate::diagnostic::MOST), in the order of the source.
pub fn parse(source: &str) -> Result<Scene, Diagnostics> {
    let mut mistakes = Sink::default();
    let mut entities = entity::Entities::new(source);
    let mut builder = build::Builder::default();
    let mut numbers = Vec::new();
    while let Some(entity) = entities.next(&mut numbers, &mut mistakes) {
        builder.add(&entity, &numbers, &mut mistakes);
        if mistakes.ends_reading() {
            break;
        }
    }
    let scene = builder.finish(source, &mut mistakes);
    mistakes.into_result(scene)
}

/// Reads a scene from a file.
///
/// # Errors
/// If there is no such file, it is not a regular file, cannot be read or is not UTF-8, or it contains mistakes.
/// Displayed, the error holds all mistakes, drawn with their lines.
pub fn read(path: impl AsRef<Path>) -> Result<Scene, ReadError> {
    let path = path.as_ref();
    let unreadable = |error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => ReadError::NotFound { path: path.into() },
        _ => ReadError::Unreadable {
            path: path.into(),
            error,
        },
    };
    // A pipe or a device might never end.
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(ReadError::NotAFile { path: path.into() });
    }
    let bytes = std::fs::read(path).map_err(unreadable)?;
    let source = String::from_utf8(bytes).map_err(|error| ReadError::NotText {
        path: path.into(),
        offset: error.utf8_error().valid_up_to(),
    })?;
    parse(&source).map_err(|diagnostics| ReadError::Mistakes {
        drawn: diagnostics.draw(&path.display().to_string(), &source),
        diagnostics,
    })
}

/// Why reading a scene failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// No such file.
    #[error("error: {}: no such file", .path.display())]
    NotFound {
        /// The requested path.
        path: PathBuf,
    },
    /// A folder, a pipe or a device.
    #[error("error: {}: not a file", .path.display())]
    NotAFile {
        /// The requested path.
        path: PathBuf,
    },
    /// The system refused to read it.
    #[error("error: {}: cannot be read: {error}", .path.display())]
    Unreadable {
        /// The requested path.
        path: PathBuf,
        /// The system's reason.
        #[source]
        error: io::Error,
    },
    /// Bytes that are not UTF-8.
    #[error("error: {}: not a text file: byte {offset} is not UTF-8", .path.display())]
    NotText {
        /// The requested path.
        path: PathBuf,
        /// The first wrong byte, counted from 0.
        offset: usize,
    },
    /// The text has mistakes.
    #[error("{drawn}")]
    Mistakes {
        /// The mistakes.
        diagnostics: Diagnostics,
        /// The mistakes drawn with their lines.
        drawn: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use token::tests::tokens_read;

    /// Linear time: each token is read once, and again only for the few kept mistakes.
    #[test]
    fn tokens_are_read_once() {
        let header = "v 0 0 1 f 1 1 1 1 0 0 0 0 ";
        let good = format!(
            "{header}{}",
            "s 0 0 0 1 p 3 0 0 0 1 0 0 1 1 0 ".repeat(1000)
        );
        let count = good.split_whitespace().count();
        let read = tokens_read(|| drop(parse(&good)));
        assert!(read <= count + 10, "{read} reads of {count} tokens");

        let many = "1 2 3 ".repeat(10_000);
        let bad = format!("{header}{}", format!("p 9 {many}").repeat(30));
        let count = bad.split_whitespace().count();
        let read = tokens_read(|| drop(parse(&bad)));
        assert!(read <= 2 * count, "{read} reads of {count} tokens");
    }

    #[test]
    fn a_mistake_is_not_reported_twice() {
        let kinds = |source| -> Vec<_> {
            parse(source)
                .unwrap_err()
                .list
                .into_iter()
                .map(|mistake| mistake.kind)
                .collect()
        };
        assert_eq!(kinds("v 0 0 nan at 1 2 3").len(), 1);
        assert_eq!(kinds("v 0 0 1 f 1 1 s 0 0 0 1 s 0 0 0 2").len(), 1);
        assert_eq!(kinds("v 0 0 1 s 0 0 0 1 s 0 0 0 2").len(), 1);
        assert_eq!(kinds("v from 1 2 at 0 0 0 up 0 1 0 angle 200").len(), 1);
        assert_eq!(kinds("\0\0 1 2 3 \0").len(), 1);
        assert_eq!(kinds("").len(), 1);
    }
}
