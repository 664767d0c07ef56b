//! Entities: a keyword and everything after it up to the next keyword.

use super::token::{Lexeme, Lexer, Token};
use crate::check::Fault;
use crate::diagnostic::{Diagnostic, MistakeKind, Sink};
use crate::model::Projection;
use crate::word::{self, Keyword, Span};
use std::ops::Range;

/// A keyword and what follows it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entity<'s> {
    pub(crate) keyword: Keyword,
    /// The place of the keyword.
    pub(crate) span: Span,
    /// The word after `view`.
    pub(crate) word: Option<Token<'s>>,
    /// Whether every number could be read. If not, the mistake has been reported and the numbers are meaningless.
    pub(crate) valid: bool,
    source: &'s str,
}

impl Entity<'_> {
    /// Returns the numbers if there are exactly `N`.
    pub(crate) fn exactly<const N: usize>(&self, numbers: &[f64]) -> Result<[f64; N], Diagnostic> {
        numbers.try_into().map_err(|_| self.count(numbers, &[N]))
    }

    /// Checks that none of `numbers` is negative; the first of them is the entity's number `first`.
    pub(crate) fn not_negative(&self, first: usize, numbers: &[f64]) -> Result<(), Diagnostic> {
        match numbers.iter().position(|&number| number < 0.0) {
            Some(index) => Err(self.fault(first + index..first + index + 1, Fault::Negative)),
            None => Ok(()),
        }
    }

    /// Returns the projection that `view` names.
    pub(crate) fn projection(&self, numbers: &[f64]) -> Result<Projection, Diagnostic> {
        let [] = self.exactly(numbers)?;
        match self.word.map(|word| word.text) {
            Some("parallel") => Ok(Projection::Parallel),
            Some("perspective") => Ok(Projection::Perspective),
            _ => {
                let span = self.word.map_or(self.span, |word| word.span());
                Err(Diagnostic {
                    kind: MistakeKind::View,
                    span,
                })
            }
        }
    }

    /// Returns a mistake: a count of `numbers` that none of `forms`, in ascending order, has. It is at the first number
    /// too many, or at the keyword if there are too few. Of several forms that are exceeded, it is the one that fills
    /// its line, as what follows belongs to something else.
    pub(crate) fn count(&self, numbers: &[f64], forms: &[usize]) -> Diagnostic {
        let found = numbers.len();
        let exceeded = || forms.iter().rev().filter(|form| **form < found);
        let fills_line = |form: &&usize| {
            self.tokens()
                .nth(**form)
                .is_some_and(|next| next.opens_line)
        };
        let form = exceeded().find(fills_line).or(exceeded().next());
        let kind = MistakeKind::Count {
            keyword: self.keyword,
            found,
            begins: self.span,
        };
        self.mistake(form.map_or(0..0, |form| *form..found), kind)
    }

    /// Returns the tokens from the first number on. Reads the entity again, which only mistakes need.
    fn tokens(&self) -> impl Iterator<Item = Token<'_>> {
        let words = usize::from(self.word.is_some());
        Lexer::new(self.source, self.span.end).skip(words)
    }

    /// Returns a mistake at the numbers `blamed`: a wrong value.
    pub(crate) fn fault(&self, blamed: Range<usize>, fault: Fault) -> Diagnostic {
        self.mistake(blamed, MistakeKind::Fault(fault))
    }

    /// Returns a mistake at the numbers `blamed`, or at the keyword if that range is empty.
    pub(crate) fn mistake(&self, blamed: Range<usize>, kind: MistakeKind) -> Diagnostic {
        Diagnostic {
            kind,
            span: self.span_of(blamed),
        }
    }

    /// Returns the place of the numbers in `range`, as far as they are on the line of the first; for an empty range,
    /// the place of the keyword. Reads the entity again.
    pub(crate) fn span_of(&self, range: Range<usize>) -> Span {
        let numbers = (self.tokens())
            .skip(range.start)
            .take_while(|token| matches!(token.lexeme(), Lexeme::Number(_)))
            .take(range.len());
        let mut span = None;
        for token in numbers {
            span = match span {
                None => Some(token.span()),
                Some(_) if token.opens_line => break,
                Some(Span { start, .. }) => Some(Span {
                    start,
                    end: token.span().end,
                }),
            };
        }
        span.unwrap_or(self.span)
    }
}

/// Reads entities one after the other, reports what belongs to none, and resumes at the next keyword.
#[derive(Debug)]
pub(crate) struct Entities<'s> {
    source: &'s str,
    lexer: Lexer<'s>,
    ahead: Option<(Token<'s>, Lexeme)>,
}

impl<'s> Entities<'s> {
    pub(crate) fn new(source: &'s str) -> Self {
        let mut entities = Self {
            source,
            lexer: Lexer::new(source, 0),
            ahead: None,
        };
        entities.advance();
        entities
    }

    /// Returns the next entity and stores its numbers in `numbers`; `None` at the end of the source.
    pub(crate) fn next(
        &mut self,
        numbers: &mut Vec<f64>,
        mistakes: &mut Sink,
    ) -> Option<Entity<'s>> {
        let (keyword, span) = self.seek(mistakes)?;
        let word = if keyword == Keyword::View {
            self.word()
        } else {
            None
        };
        let valid = self.numbers(numbers, mistakes);
        Some(Entity {
            keyword,
            span,
            word,
            valid,
            source: self.source,
        })
    }

    /// Skips to the next keyword and reports one mistake per line that begins with anything else.
    fn seek(&mut self, mistakes: &mut Sink) -> Option<(Keyword, Span)> {
        let mut reported = false;
        loop {
            let (token, lexeme) = self.ahead?;
            let kind = match lexeme {
                Lexeme::Keyword(keyword) => {
                    self.advance();
                    return Some((keyword, token.span()));
                }
                Lexeme::Binary => MistakeKind::Binary,
                Lexeme::Word if word::belongs_to_textures(token.text) => MistakeKind::Texture,
                Lexeme::Word => MistakeKind::UnknownKeyword,
                _ => MistakeKind::StrayNumber,
            };
            if !reported || (token.opens_line && kind == MistakeKind::UnknownKeyword) {
                mistakes.push(kind, token.span());
                reported = true;
            }
            if mistakes.ends_reading() {
                return None;
            }
            self.advance();
        }
    }

    /// Returns the word after `view`, if there is one.
    fn word(&mut self) -> Option<Token<'s>> {
        let (token, lexeme) = self.ahead?;
        (lexeme == Lexeme::Word).then(|| {
            self.advance();
            token
        })
    }

    /// Reads the following numbers and returns whether all of them are valid. A word on a new line ends them: it is a
    /// misspelt keyword rather than a misspelt number.
    fn numbers(&mut self, numbers: &mut Vec<f64>, mistakes: &mut Sink) -> bool {
        numbers.clear();
        let mut valid = true;
        while let Some((token, lexeme)) = self.ahead {
            match lexeme {
                Lexeme::Number(number) => {
                    numbers.push(number);
                    self.advance_over(numbers);
                    continue;
                }
                Lexeme::Keyword(_) => break,
                Lexeme::Binary => return false,
                Lexeme::Word if token.opens_line => break,
                Lexeme::NotFinite => mistakes.push(MistakeKind::NotFinite, token.span()),
                _ if word::belongs_to_textures(token.text) => {
                    mistakes.push(MistakeKind::Texture, token.span());
                }
                Lexeme::Malformed | Lexeme::Word => {
                    mistakes.push(MistakeKind::NotANumber, token.span());
                }
            }
            valid = false;
            if mistakes.ends_reading() {
                break;
            }
            self.advance();
            // The rest of the line is meant as a comment.
            while token.text.contains('#') && self.ahead.is_some_and(|(next, _)| !next.opens_line) {
                self.advance();
            }
        }
        valid
    }

    /// Appends the following numbers to `numbers` and stops at the first token that is not one. Nearly all tokens pass
    /// here without being stored.
    fn advance_over(&mut self, numbers: &mut Vec<f64>) {
        for token in &mut self.lexer {
            match token.lexeme() {
                Lexeme::Number(number) => numbers.push(number),
                lexeme => {
                    self.ahead = Some((token, lexeme));
                    return;
                }
            }
        }
        self.ahead = None;
    }

    fn advance(&mut self) {
        self.ahead = self.lexer.next().map(|token| (token, token.lexeme()));
    }
}
