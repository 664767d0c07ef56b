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

use crate::diagnostic::{Diagnostics, MistakeKind, Sink, Warnings};
use crate::input;
use crate::model::Scene;
use crate::name::Shown;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

pub use crate::word::{Keyword, Span};

/// Reads a scene from its text.
///
/// # Errors
/// All mistakes up to [`MOST`](crate::diagnostic::MOST), in the order of the source.
pub fn parse(source: &str) -> Result<Scene, Diagnostics> {
    parse_with_warnings(source).map(|(scene, _)| scene)
}

/// Reads a scene from its text. What is odd about it but harmless is returned beside it.
///
/// # Errors
/// Those of [`parse`].
pub fn parse_with_warnings(source: &str) -> Result<(Scene, Warnings), Diagnostics> {
    parse_telling(source, |_| {})
}

/// Returns the lines, counted from 1, on which the objects of a scene begin, in the order of [`Scene::objects`].
pub fn object_lines(source: &str) -> Vec<u32> {
    let mut lines = Vec::new();
    let (mut line, mut counted) = (1, 0);
    let _ = parse_telling(source, |start| {
        let between = source[counted..start].bytes();
        line += between.filter(|byte| *byte == b'\n').count() as u32;
        counted = start;
        lines.push(line);
    });
    lines
}

/// Reads a scene; where each object begins is told.
fn parse_telling(
    source: &str,
    mut begins: impl FnMut(usize),
) -> Result<(Scene, Warnings), Diagnostics> {
    let source = without_dos_end(source);
    let mut mistakes = Sink::default();
    if let Some(span) = sense8(source) {
        mistakes.push(MistakeKind::Sense8, span);
        return mistakes.into_result(Scene::default());
    }
    let mut entities = entity::Entities::new(source);
    let mut builder = build::Builder::default();
    let mut numbers = Vec::new();
    while let Some(entity) = entities.next(&mut numbers, &mut mistakes) {
        let before = builder.objects();
        builder.add(&entity, &numbers, &mut mistakes);
        if builder.objects() > before {
            begins(entity.span.start);
        }
        if mistakes.ends_reading() {
            break;
        }
    }
    let scene = builder.finish(source, &mut mistakes);
    mistakes.into_result(scene)
}

/// Returns the source without the control-Z that ends files of DOS, and what is behind it if that is no text.
fn without_dos_end(source: &str) -> &str {
    let text = source.trim_end_matches(|c: char| matches!(c, '\u{1a}' | '\0') || c.is_whitespace());
    match source[text.len()..].find('\u{1a}') {
        Some(end) => &source[..text.len() + end],
        None => source,
    }
}

/// Returns the place of the word with which a file in Sense8's format begins, after comments of either format.
fn sense8(source: &str) -> Option<Span> {
    let is_comment = |line: &&str| {
        let line = line.trim();
        line.is_empty() || line.starts_with("//") || line.starts_with('#')
    };
    let line = source
        .trim_start_matches('\u{feff}')
        .lines()
        .find(|line| !is_comment(line))?;
    let word = line.split_whitespace().next()?;
    let start = word.as_ptr() as usize - source.as_ptr() as usize;
    word.eq_ignore_ascii_case("nff").then_some(Span {
        start,
        end: start + word.len(),
    })
}

/// Reads a scene from a file, a pipe or, if the path is `-`, standard input.
///
/// # Errors
/// If there is no such file, it is a folder or a device, cannot be read or is too large, or it contains mistakes.
/// Displayed, the error holds all mistakes, drawn with their lines.
pub fn read(path: impl AsRef<Path>) -> Result<Scene, ReadError> {
    read_with_warnings(path).map(|(scene, _)| scene)
}

/// Reads a scene as [`read`] does. Returned beside it is what is odd about it but harmless, drawn; empty if nothing is.
///
/// # Errors
/// Those of [`read`].
pub fn read_with_warnings(path: impl AsRef<Path>) -> Result<(Scene, String), ReadError> {
    read_with_lines(path).map(|(scene, warnings, _)| (scene, warnings))
}

/// Reads a scene as [`read_with_warnings`] does. Returned as well are the [`object_lines`], once they are asked for.
///
/// # Errors
/// Those of [`read`].
pub fn read_with_lines(
    path: impl AsRef<Path>,
) -> Result<(Scene, String, impl FnOnce() -> Vec<u32>), ReadError> {
    let path = path.as_ref();
    let source = input::read_text(path, input::MOST_SCENE).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => ReadError::NotFound { path: path.into() },
        io::ErrorKind::IsADirectory | io::ErrorKind::InvalidInput => {
            ReadError::NotAFile { path: path.into() }
        }
        _ => ReadError::Unreadable {
            path: path.into(),
            error,
        },
    })?;
    let name = match input::is_stdin(path) {
        true => "standard input".into(),
        false => path.to_string_lossy(),
    };
    match parse_with_warnings(&source) {
        Ok((scene, warnings)) => {
            let warnings = warnings.draw(&name, &source);
            Ok((scene, warnings, move || object_lines(&source)))
        }
        Err(diagnostics) => Err(ReadError::Mistakes {
            drawn: diagnostics.draw(&name, &source),
            diagnostics,
        }),
    }
}

/// Why reading a scene failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// No such file.
    #[error("error: {}: no such file", Shown(path))]
    NotFound {
        /// The requested path.
        path: PathBuf,
    },
    /// A folder or a device.
    #[error("error: {}: not a file", Shown(path))]
    NotAFile {
        /// The requested path.
        path: PathBuf,
    },
    /// The system refused to read it.
    #[error("error: {}: cannot be read: {error}", Shown(path))]
    Unreadable {
        /// The requested path.
        path: PathBuf,
        /// The system's reason.
        #[source]
        error: io::Error,
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
