//! What is odd about a scene file but does not keep it from being rendered.

use super::draw;
use crate::check::Oddity;
use crate::word::{Keyword, Span};

/// As many warnings are kept with their places; the others are counted.
pub const MOST_WARNINGS: usize = 5;

/// What is odd.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum WarningKind {
    /// A polygon or patch without area. It is left out of the scene: no ray could hit it.
    NoArea {
        /// [`Keyword::Polygon`] or [`Keyword::Patch`].
        keyword: Keyword,
    },
    /// A vertex equal to the one before it, or the last equal to the first.
    RepeatedVertex {
        /// Whether it is the first of the polygon's vertices.
        first: bool,
    },
    /// A vertex off the plane of the others by more than usual rounding, but not by much.
    Uneven {
        /// Its distance from the plane, in scene units.
        distance: f64,
    },
}

impl WarningKind {
    /// Returns the warning about a polygon or a patch, and the vertex that it is about, if it is about one.
    pub(crate) fn of(oddity: Oddity, keyword: Keyword) -> (Self, Option<usize>) {
        match oddity {
            Oddity::NoArea => (Self::NoArea { keyword }, None),
            Oddity::RepeatedVertex { vertex } => {
                let first = vertex == 0;
                (Self::RepeatedVertex { first }, Some(vertex))
            }
            Oddity::Uneven { vertex, distance } => (Self::Uneven { distance }, Some(vertex)),
        }
    }
}

/// One warning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warning {
    /// What is odd.
    pub kind: WarningKind,
    /// Where.
    pub span: Span,
}

/// The warnings about one source, in its order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Warnings {
    /// Up to [`MOST_WARNINGS`] of them.
    pub list: Vec<Warning>,
    /// How many more there were.
    pub more: usize,
}

impl Warnings {
    /// Draws the warnings as [`Diagnostics::draw`](super::Diagnostics::draw) draws mistakes; empty if there are none.
    pub fn draw(&self, path: &str, source: &str) -> String {
        draw::warnings(self, path, source)
    }

    /// Adds a warning; `span` is only called if it is kept.
    pub(crate) fn push(&mut self, kind: WarningKind, span: impl FnOnce() -> Span) {
        if self.list.len() < MOST_WARNINGS {
            self.list.push(Warning { kind, span: span() });
        } else {
            self.more += 1;
        }
    }
}
