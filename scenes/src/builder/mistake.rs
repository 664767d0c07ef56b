//! What is wrong with a scene made in code, and what is odd about it: each with the place of the call.

use super::value::{Value, blamed};
use super::{Caller, Subject};
use crate::check::Fault;
use crate::diagnostic::{MOST, MOST_WARNINGS, WarningKind, words};
use std::fmt;
use std::panic::Location;

/// One mistake. Displayed, it is a line such as
/// `src/main.rs:9:7: error: sphere 2: radius -1: expected a radius above 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mistake {
    /// What is wrong.
    pub fault: Fault,
    /// What it is about: `sphere 2` is the second call that adds a sphere.
    pub subject: String,
    /// The wrong value with its name, if the fault is that of one.
    pub value: Option<String>,
    /// The call.
    pub caller: &'static Location<'static>,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: error: {}: ", self.caller, self.subject)?;
        if let Some(value) = &self.value {
            write!(f, "{value}: ")?;
        }
        match self.fault {
            // A file's numbers are finite, only their products may not be.
            Fault::NotFinite => f.write_str("expected finite numbers"),
            fault => f.write_str(&words::expected(&fault)),
        }
    }
}

/// The mistakes in one scene, in the order of the calls. As an error it is never empty; displayed, each is a line.
///
/// [`Debug`](fmt::Debug) shows the same lines: a `main` that returns this error prints it that way.
#[derive(Clone, PartialEq)]
pub struct Mistakes {
    /// Up to [`MOST`] of them.
    pub list: Vec<Mistake>,
    /// Whether there were more.
    pub more: bool,
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        lines(&self.list, f)?;
        match self.more {
            true => write!(f, "\n{}", words::only_the_first()),
            false => Ok(()),
        }
    }
}

impl fmt::Debug for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Mistakes {}

/// One warning. Displayed, it is a line such as
/// `src/main.rs:9:7: warning: polygon 1: left out: its vertices lie on one line`.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// What is odd.
    pub kind: WarningKind,
    /// What it is about: `polygon 1` is the first call that adds a polygon.
    pub subject: String,
    /// The vertex that it is about, from 0, if it is about one.
    pub vertex: Option<usize>,
    /// The call.
    pub caller: &'static Location<'static>,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: warning: {}: ", self.caller, self.subject)?;
        if let Some(vertex) = self.vertex {
            write!(f, "vertex {}: ", vertex + 1)?;
        }
        let (_, label) = words::warn(&self.kind);
        f.write_str(&label)
    }
}

/// The warnings about one scene, in the order of the calls. Displayed, each is a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Warnings {
    /// Up to [`MOST_WARNINGS`] of them.
    pub list: Vec<Warning>,
    /// How many more there were.
    pub more: usize,
}

impl fmt::Display for Warnings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        lines(&self.list, f)?;
        match self.more {
            0 => Ok(()),
            more => write!(f, "\n{}", words::more_warnings(more)),
        }
    }
}

fn lines(list: &[impl fmt::Display], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    for (index, line) in list.iter().enumerate() {
        let end = if index > 0 { "\n" } else { "" };
        write!(f, "{end}{line}")?;
    }
    Ok(())
}

/// Collects what calls do wrong.
#[derive(Clone, Debug, Default)]
pub(super) struct Sink {
    mistakes: Vec<Mistake>,
    more: bool,
    warnings: Warnings,
}

impl Sink {
    /// Keeps the mistake of a call with these values, of which one may be to blame.
    pub(super) fn mistake(
        &mut self,
        subject: Subject,
        fault: Fault,
        values: &[Value],
        caller: Caller,
    ) {
        if self.mistakes.len() == MOST {
            self.more = true;
            return;
        }
        self.mistakes.push(Mistake {
            fault,
            subject: subject.to_string(),
            value: blamed(&fault, values).map(Value::to_string),
            caller,
        });
    }

    pub(super) fn warning(
        &mut self,
        subject: Subject,
        kind: WarningKind,
        vertex: Option<usize>,
        caller: Caller,
    ) {
        if self.warnings.list.len() == MOST_WARNINGS {
            self.warnings.more += 1;
            return;
        }
        self.warnings.list.push(Warning {
            kind,
            subject: subject.to_string(),
            vertex,
            caller,
        });
    }

    /// Returns `value` with the warnings if there was no mistake.
    pub(super) fn into_result<T>(self, value: T) -> Result<(T, Warnings), Mistakes> {
        let (list, more) = (self.mistakes, self.more);
        match list.is_empty() {
            true => Ok((value, self.warnings)),
            false => Err(Mistakes { list, more }),
        }
    }
}
