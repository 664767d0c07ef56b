//! Tokens: texts between white space, with their places in the source.
//!
//! A comment begins at `#` after white space or a word. Within a number it does not: C runtimes write `1.#INF`.

use crate::word::{Keyword, Span};

/// One token.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Token<'s> {
    /// Its characters; never empty.
    pub(crate) text: &'s str,
    /// Its first byte in the source.
    pub(crate) start: usize,
    /// Whether it is the first token of its line. This affects only error messages.
    pub(crate) opens_line: bool,
}

/// The meaning of a token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lexeme {
    Keyword(Keyword),
    /// A finite number.
    Number(f64),
    /// `nan`, `inf`, or a number beyond `f64`.
    NotFinite,
    /// Begins like a number but is not one.
    Malformed,
    /// Any other word.
    Word,
    /// Contains a control character: this is not a text file.
    Binary,
}

fn begins_number(byte: u8) -> bool {
    matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.')
}

impl Token<'_> {
    pub(crate) fn span(&self) -> Span {
        Span {
            start: self.start,
            end: self.start + self.text.len(),
        }
    }

    pub(crate) fn lexeme(&self) -> Lexeme {
        let numeric = begins_number(self.text.as_bytes()[0]);
        if !numeric && let Some(keyword) = Keyword::of(self.text) {
            return Lexeme::Keyword(keyword);
        }
        match self.text.parse::<f64>() {
            Err(_) if numeric && is_not_finite_in_c(self.text) => Lexeme::NotFinite,
            Ok(number) if number.is_finite() => Lexeme::Number(number),
            Ok(_) => Lexeme::NotFinite,
            Err(_) if self.text.chars().any(char::is_control) => Lexeme::Binary,
            Err(_) if numeric => Lexeme::Malformed,
            Err(_) => Lexeme::Word,
        }
    }
}

/// Whether a text is infinity or no number as old C runtimes write it, with any digits after it.
fn is_not_finite_in_c(text: &str) -> bool {
    let named = |(number, name): (&str, &str)| {
        let digits = number.trim_start_matches(['+', '-']).trim_end_matches('.');
        let name = name.trim_end_matches(|c: char| c.is_ascii_digit());
        digits.bytes().all(|digit| digit.is_ascii_digit())
            && (["INF", "IND", "NAN", "QNAN", "SNAN"].iter())
                .any(|known| name.eq_ignore_ascii_case(known))
    };
    text.split_once('#').is_some_and(named)
}

/// Splits a source into tokens. Its only state is its place.
#[derive(Clone, Debug)]
pub(crate) struct Lexer<'s> {
    source: &'s str,
    at: usize,
}

impl<'s> Lexer<'s> {
    /// Reads `source` from byte `at`, a character boundary.
    pub(crate) fn new(source: &'s str, at: usize) -> Self {
        Self { source, at }
    }
}

impl<'s> Iterator for Lexer<'s> {
    type Item = Token<'s>;

    fn next(&mut self) -> Option<Token<'s>> {
        #[cfg(test)]
        tests::count_token();
        let bytes = self.source.as_bytes();
        let mut at = self.at;
        let mut opens_line = at == 0;
        loop {
            match *bytes.get(at)? {
                b'\n' => opens_line = true,
                b' ' | b'\t' | b'\r' | 0x0b | 0x0c => {}
                b'#' => {
                    at += bytes[at..]
                        .iter()
                        .take_while(|&&b| b != b'\n' && b != b'\r')
                        .count();
                    continue;
                }
                0xef if at == 0 && self.source.starts_with('\u{feff}') => at += 2,
                _ => break,
            }
            at += 1;
        }
        let start = at;
        let numeric = begins_number(bytes[start]);
        at += bytes[at..]
            .iter()
            .take_while(|&&b| !matches!(b, b' ' | b'\t'..=b'\r') && (numeric || b != b'#'))
            .count();
        self.at = at;
        Some(Token {
            text: &self.source[start..at],
            start,
            opens_line,
        })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use std::cell::Cell;

    thread_local!(static TOKENS: Cell<usize> = const { Cell::new(0) });

    pub(super) fn count_token() {
        TOKENS.set(TOKENS.get() + 1);
    }

    /// Returns how many tokens this thread requested during `run`.
    pub(in crate::parse) fn tokens_read(run: impl FnOnce()) -> usize {
        let before = TOKENS.get();
        run();
        TOKENS.get() - before
    }

    fn texts(source: &str) -> Vec<&str> {
        Lexer::new(source, 0).map(|token| token.text).collect()
    }

    #[test]
    fn white_space_and_comments_separate_tokens() {
        assert_eq!(
            texts("a\tb\r\nc\x0bd\x0ce  f"),
            ["a", "b", "c", "d", "e", "f"]
        );
        assert_eq!(texts("a#x y\n2 # z\r\nc#\n#1"), ["a", "2", "c"]);
        assert_eq!(texts("1.#INF -1#2 a"), ["1.#INF", "-1#2", "a"]);
        assert_eq!(texts("\u{feff}v 1"), ["v", "1"]);
        assert_eq!(texts(" \n# only\n"), [""; 0]);
    }

    #[test]
    fn a_comment_ends_at_a_lone_carriage_return() {
        assert_eq!(texts("a # b\rc"), ["a", "c"]);
    }

    #[test]
    fn a_token_knows_its_place() {
        let tokens: Vec<_> = Lexer::new("v é\n s", 0).collect();
        assert_eq!(tokens[1].span(), Span { start: 2, end: 4 });
        assert_eq!(tokens[2].span(), Span { start: 6, end: 7 });
        assert_eq!(
            tokens.iter().map(|t| t.opens_line).collect::<Vec<_>>(),
            [true, false, true]
        );
    }

    #[test]
    fn lexemes() {
        let lexeme = |text| {
            Token {
                text,
                start: 0,
                opens_line: false,
            }
            .lexeme()
        };
        for (text, number) in [
            ("-1.5e3", -1500.0),
            ("+.5", 0.5),
            ("7.", 7.0),
            ("1e-999", 0.0),
        ] {
            assert_eq!(lexeme(text), Lexeme::Number(number), "{text}");
        }
        for text in [
            "nan",
            "NaN",
            "-inf",
            "Infinity",
            "1e999",
            "1.#INF",
            "-1.#IND",
            "1.#QNAN0",
            "+1.#inf00",
            "1#SNAN",
        ] {
            assert_eq!(lexeme(text), Lexeme::NotFinite, "{text}");
        }
        for text in [
            "1.2.3", "-", "1,5", "0x10", ".", "1#", "1.#INFO", "1.5x#INF",
        ] {
            assert_eq!(lexeme(text), Lexeme::Malformed, "{text}");
        }
        assert_eq!(lexeme("box"), Lexeme::Keyword(Keyword::Cuboid));
        assert_eq!(lexeme("Box"), Lexeme::Word);
        assert_eq!(lexeme("a\0"), Lexeme::Binary);
    }
}
