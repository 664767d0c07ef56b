//! Names and excerpts of files as messages show them: whatever they contain, a line stays a line, and a terminal obeys
//! nothing.

use std::fmt;
use std::path::Path;

/// The name of a file as messages show it: control characters are escaped.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a>(pub &'a Path);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&line(&self.0.to_string_lossy()))
    }
}

/// Returns `text` on one line. Line ends, tabs and other control characters, and those that change the order of text,
/// are escaped as in Rust.
pub fn line(text: &str) -> String {
    escape(text, false)
}

/// The same with white space as blanks: excerpts keep their columns.
pub(crate) fn escaped(text: &str) -> String {
    escape(text, true)
}

fn escape(text: &str, blanks: bool) -> String {
    let hostile = |c: char| {
        c.is_control()
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
    };
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\t' | '\r' | '\u{b}' | '\u{c}' if blanks => escaped.push(' '),
            c if hostile(c) => escaped.extend(c.escape_default()),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_one_line_without_commands_for_the_terminal() {
        let name = Path::new("a\nb\u{1b}[2J\tc\u{202e}é.scene");
        let shown = Shown(name).to_string();
        assert_eq!(shown, r"a\nb\u{1b}[2J\tc\u{202e}é.scene");
    }
}
