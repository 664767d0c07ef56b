//! Drawing mistakes beside the lines they are on.

use super::{Diagnostic, Diagnostics, Kind, MOST, words};
use crate::parse::Span;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};

/// How many characters of a line are shown before, inside and after a span.
const BEFORE: usize = 50;
const INSIDE: usize = 60;
const AFTER: usize = 30;

pub(super) fn draw(diagnostics: &Diagnostics, path: &str, source: &str) -> String {
    let path = escaped(path);
    let renderer = Renderer::plain();
    let mistakes = diagnostics.list.iter();
    let mut drawn: Vec<String> = mistakes
        .map(|mistake| renderer.render(&[group(mistake, &path, source)]))
        .collect();
    if diagnostics.more {
        drawn.push(format!(
            "and more: only the first {MOST} mistakes are shown"
        ));
    }
    drawn.join("\n\n")
}

fn group(mistake: &Diagnostic, path: &str, source: &str) -> Group<'static> {
    let excerpt = Excerpt::new(source, mistake.span);
    let (title, label) = words::describe(&mistake.kind, &excerpt.inside);
    let place = format!("{path}:{}:{}: error", excerpt.line, excerpt.column);
    let group = Level::ERROR
        .with_name(place)
        .primary_title(title)
        .element(excerpt.snippet(AnnotationKind::Primary, label));
    match &mistake.kind {
        Kind::Duplicate { first, .. } => {
            let label = "the first one".to_owned();
            group.element(Excerpt::new(source, *first).snippet(AnnotationKind::Context, label))
        }
        _ => group,
    }
}

/// A span and its neighbourhood on its line, escaped and cut to a readable length.
struct Excerpt {
    line: usize,
    column: usize,
    before: String,
    inside: String,
    after: String,
}

impl Excerpt {
    fn new(source: &str, span: Span) -> Self {
        let line_start = source[..span.start]
            .rfind('\n')
            .map_or(0, |newline| newline + 1);
        let line_end = source[span.start..]
            .find('\n')
            .map_or(source.len(), |n| span.start + n);
        let span_end = span.end.min(line_end);
        let before = &source[line_start..span.start];
        let after = source[span_end..line_end].trim_end();
        let (before, hidden) = match before.char_indices().nth_back(BEFORE - 1) {
            Some((start, _)) if start > 0 => (&before[start..], "..."),
            _ => (before, ""),
        };
        Self {
            line: source[..line_start].matches('\n').count() + 1,
            column: source[line_start..span.start].chars().count() + 1,
            before: format!("{hidden}{}", escaped(before)),
            inside: shortened(&source[span.start..span_end], INSIDE),
            after: shortened(after, AFTER),
        }
    }

    fn snippet<'a>(&self, kind: AnnotationKind, label: String) -> Snippet<'a, Annotation<'a>> {
        let start = self.before.len();
        let end = start + self.inside.len();
        Snippet::source(format!("{}{}{}", self.before, self.inside, self.after))
            .line_start(self.line)
            .annotation(kind.span(start..end).label(label))
    }
}

/// The first `most` characters of `text`, escaped, and a sign if there were more.
fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}...", escaped(&text[..end])),
        None => escaped(text),
    }
}

/// `text` without white space other than blanks, and with control characters, and those that
/// change the order of text, as Rust escapes them.
fn escaped(text: &str) -> String {
    let hostile = |c: char| {
        c.is_control()
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
    };
    text.chars()
        .fold(String::with_capacity(text.len()), |mut escaped, c| {
            match c {
                '\t' | '\r' | '\u{b}' | '\u{c}' => escaped.push(' '),
                c if hostile(c) => escaped.extend(c.escape_default()),
                c => escaped.push(c),
            }
            escaped
        })
}
