//! Mistakes in a scene file, and warnings about it. Each has a kind and a place, and is drawn as text only on request.

mod draw;
mod warning;
pub(crate) mod words;

pub use warning::{MOST_WARNINGS, Warning, WarningKind, Warnings};

use crate::check::Fault;
use crate::word::{Keyword, Span};
use std::fmt;

/// The number of mistakes that are kept; of more, only their existence is recorded.
pub const MOST: usize = 20;

/// What is wrong.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum MistakeKind {
    /// The file has no token at all.
    Empty,
    /// A control character: this is not a text file. Reading stops here.
    Binary,
    /// A word where a keyword must be.
    UnknownKeyword,
    /// A number where a keyword must be.
    StrayNumber,
    /// A word where a number must be.
    NotANumber,
    /// `nan`, `inf`, or a number too large for `f64`.
    NotFinite,
    /// A keyword with a wrong count of numbers.
    Count {
        /// The keyword.
        keyword: Keyword,
        /// How many numbers follow it.
        found: usize,
        /// Where the keyword stands; the mistake's place may be lines below.
        begins: Span,
    },
    /// A polygon or patch with more or fewer numbers than its vertices need.
    VertexCount {
        /// [`Keyword::Polygon`] or [`Keyword::Patch`].
        keyword: Keyword,
        /// How many vertices it announces.
        vertices: u32,
        /// How many numbers follow the announcement.
        found: usize,
    },
    /// Something of the thesis's dialect, [`Keyword::Surface`] or [`Keyword::Resolution`], in a file whose viewpoint is
    /// NFF's: what its numbers mean cannot be told.
    MixedDialects {
        /// The keyword.
        keyword: Keyword,
    },
    /// A word of extensions of NFF that have textures. Only the first is reported.
    Texture,
    /// The whole file is in Sense8's format, which is called NFF too. Reading stops here.
    Sense8,
    /// A number of vertices that is not whole, negative, or beyond `u32`.
    NotACount,
    /// A word other than `parallel` and `perspective` after `view`, or none.
    View,
    /// An object before the first surface.
    NoSurface,
    /// A checker that does not follow a surface.
    LooseChecker,
    /// A second occurrence of something that a scene has once.
    Duplicate {
        /// The keyword.
        keyword: Keyword,
        /// Where it stands the first time.
        first: Span,
    },
    /// No viewpoint.
    NoViewpoint,
    /// A camera of which parts are missing.
    Incomplete {
        /// The keywords that are missing.
        missing: Vec<Keyword>,
    },
    /// `from` beside a viewpoint in the thesis's form.
    TwoEyes,
    /// A value that no scene can have.
    Fault(Fault),
}

/// One mistake.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What is wrong.
    pub kind: MistakeKind,
    /// Where; a part of one line if possible.
    pub span: Span,
}

/// The mistakes of one source, in its order. As an error it is never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostics {
    /// Up to [`MOST`] of them.
    pub list: Vec<Diagnostic>,
    /// Whether there were more.
    pub more: bool,
}

impl Diagnostics {
    /// Draws every mistake: what it is, `path:line:column` (from 1, columns in characters), the line with carets under
    /// the span, what was found and what was expected. A long line is cut to the neighbourhood of the span; control
    /// characters are escaped. `source` must be the text that was parsed; `path` is only displayed.
    pub fn draw(&self, path: &str, source: &str) -> String {
        draw::draw(self, path, source)
    }
}

/// How many mistakes there are, and where the first is. Only with the source can more be said: by
/// [`draw`](Diagnostics::draw).
impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let least = if self.more { "at least " } else { "" };
        let plural = if self.list.len() == 1 { "" } else { "s" };
        write!(f, "{least}{} mistake{plural} in the scene", self.list.len())?;
        match self.list.first() {
            Some(first) => write!(f, ", the first at byte {}", first.span.start),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Diagnostics {}

/// Collects the mistakes that the parser finds.
#[derive(Debug, Default)]
pub(crate) struct Sink {
    pub(crate) warnings: Warnings,
    list: Vec<Diagnostic>,
    more: bool,
    hopeless: bool,
}

impl Sink {
    pub(crate) fn push(&mut self, kind: MistakeKind, span: Span) {
        self.hopeless |= matches!(
            kind,
            MistakeKind::Binary | MistakeKind::Empty | MistakeKind::Sense8
        );
        let known = |mistake: &Diagnostic| mistake.kind == MistakeKind::Texture;
        if kind == MistakeKind::Texture && self.list.iter().any(known) {
            return;
        }
        if self.list.len() < MOST {
            self.list.push(Diagnostic { kind, span });
        } else {
            self.more = true;
        }
    }

    /// Whether no mistake was found so far.
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether there are too many mistakes, or one after which reading on is pointless.
    pub(crate) fn ends_reading(&self) -> bool {
        self.more || self.hopeless
    }

    /// Returns `value` with the warnings if no mistake was found.
    pub(crate) fn into_result<T>(self, value: T) -> Result<(T, Warnings), Diagnostics> {
        let Self {
            warnings,
            mut list,
            more,
            ..
        } = self;
        if list.is_empty() {
            return Ok((value, warnings));
        }
        list.sort_by_key(|mistake| mistake.span.start);
        Err(Diagnostics { list, more })
    }
}

#[cfg(test)]
mod tests {
    use crate::parse;

    #[test]
    fn without_the_source_mistakes_are_counted_and_the_first_is_placed() {
        let message = parse("  x").unwrap_err().to_string();
        assert_eq!(message, "2 mistakes in the scene, the first at byte 2");
    }
}
