//! Draws mistakes beside their lines.

use super::{Diagnostic, Diagnostics, MistakeKind, Warnings, words};
use crate::name::escaped;
use crate::word::Span;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};

/// How many characters of a line are shown before, inside and after a span.
const BEFORE: usize = 40;
const INSIDE: usize = 50;
const AFTER: usize = 40;

pub(super) fn draw(diagnostics: &Diagnostics, path: &str, source: &str) -> String {
    let path = escaped(path);
    let renderer = Renderer::plain();
    let mistakes = diagnostics.list.iter();
    let mut drawn: Vec<String> = mistakes
        .map(|mistake| renderer.render(&[group(mistake, &path, source)]))
        .collect();
    if diagnostics.more {
        drawn.push(words::only_the_first());
    }
    drawn.join("\n\n")
}

pub(super) fn warnings(warnings: &Warnings, path: &str, source: &str) -> String {
    let path = escaped(path);
    let renderer = Renderer::plain();
    let list = warnings.list.iter();
    let mut drawn: Vec<String> = list
        .map(|warning| {
            let excerpt = Excerpt::new(source, warning.span);
            let (title, label) = words::warn(&warning.kind);
            let place = format!("{path}:{}:{}: warning", excerpt.line, excerpt.column);
            let group = Level::WARNING
                .with_name(place)
                .primary_title(title)
                .element(excerpt.snippet(AnnotationKind::Primary, label));
            renderer.render(&[group])
        })
        .collect();
    if warnings.more > 0 {
        drawn.push(format!("{path}: {}", words::more_warnings(warnings.more)));
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
        MistakeKind::Duplicate { first, .. } => {
            let label = "the first one".to_owned();
            group.element(Excerpt::new(source, *first).snippet(AnnotationKind::Context, label))
        }
        MistakeKind::Count {
            begins, keyword, ..
        } => {
            let begins = Excerpt::new(source, *begins);
            match begins.line == excerpt.line {
                true => group,
                false => {
                    let label = format!("the `{}` that the numbers follow", keyword.text());
                    group.element(begins.snippet(AnnotationKind::Context, label))
                }
            }
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

/// Returns the first `most` characters of `text`, escaped, and an ellipsis if there were more.
fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}...", escaped(&text[..end])),
        None => escaped(text),
    }
}

#[cfg(test)]
mod tests {
    fn drawn(source: &str) -> String {
        crate::parse(source).unwrap_err().draw("x.scene", source)
    }

    #[test]
    fn hostile_characters_are_escaped() {
        let drawn = drawn("v 0 0 1\nsp\u{202e}here 1 # \u{1b}[31m\u{9d}\t\r\n");
        assert!(
            drawn.contains("unknown keyword `sp\\u{202e}here`"),
            "{drawn}"
        );
        assert!(drawn.contains("\\u{1b}[31m\\u{9d}"), "{drawn}");
        assert!(
            !drawn.contains(|c: char| c.is_control() && c != '\n'),
            "{drawn}"
        );
    }

    #[test]
    fn a_megabyte_on_one_line_is_not_shown() {
        let many = "s 0 0 0 1 ".repeat(100_000);
        let drawn = drawn(&format!(
            "v 0 0 1 f 1 1 1 1 0 0 0 0 {many} s 0 0 0 0 {many}"
        ));
        assert!(
            drawn.starts_with("x.scene:1:1000036: error: sphere with radius 0\n"),
            "{drawn}"
        );
        assert!(drawn.len() < 500, "{drawn}");
    }

    #[test]
    fn columns_count_characters_and_carets_follow_wide_ones() {
        let drawn = drawn("v 0 0 1 b \u{e9}\u{4e2d} 0 0");
        assert!(drawn.starts_with("x.scene:1:11: error:"), "{drawn}");
        let caret = drawn.lines().find(|line| line.contains('^')).unwrap();
        assert_eq!(caret.find('^'), Some(14), "{drawn}");
        assert!(caret.contains("^^^ "), "{drawn}");
    }

    #[test]
    fn a_span_at_the_end_of_the_source_can_be_drawn() {
        for source in ["", "\n", "f", "f\n", "# \u{e9}", "\u{feff}"] {
            assert!(drawn(source).contains('^'), "{source:?}");
        }
    }
}
