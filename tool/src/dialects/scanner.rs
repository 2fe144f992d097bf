//! Reading the characters of one line: what the lexers of all dialects share.

use crate::diagnostics::Diagnostic;
use crate::source::{Span, Text};

/// A place in a source text, moving forward.
#[derive(Clone, Debug)]
pub struct Scanner<'a> {
    text: &'a str,
    file: usize,
    /// The position of the text in its file.
    start: usize,
    /// The position of the next character in the text.
    at: usize,
}

impl<'a> Scanner<'a> {
    /// At the beginning of the lines.
    pub fn new(lines: Text<'a>) -> Scanner<'a> {
        Scanner {
            text: lines.text,
            file: lines.file,
            start: lines.start,
            at: 0,
        }
    }

    /// Byte position of the next character in its file.
    pub fn position(&self) -> usize {
        self.start + self.at
    }

    /// The next character.
    pub fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// The text from here on.
    pub fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or("")
    }

    /// Takes the next character.
    pub fn advance(&mut self) -> Option<char> {
        let next = self.peek()?;
        self.at += next.len_utf8();
        Some(next)
    }

    /// Takes `expected` if it comes next.
    pub fn take(&mut self, expected: &str) -> bool {
        let found = self.rest().starts_with(expected);
        if found {
            self.at += expected.len();
        }
        found
    }

    /// Takes characters as long as they are `wanted`.
    pub fn take_while(&mut self, wanted: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c| !wanted(c)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// The text from a byte position to here.
    pub fn text_from(&self, start: usize) -> &'a str {
        let start = start.saturating_sub(self.start);
        self.text.get(start..self.at).unwrap_or("")
    }

    /// The span from a byte position to here.
    pub fn span_from(&self, start: usize) -> Span {
        Span {
            file: self.file,
            start,
            end: self.position(),
        }
    }

    /// Takes a decimal number without sign: `5`, `5.`, `.5`, `5.25`. `None` when there is no digit;
    /// nothing is taken then.
    pub fn decimal(&mut self) -> Option<&'a str> {
        let start = self.at;
        let digit = |c: char| c.is_ascii_digit();
        let whole = self.take_while(digit);
        let mut digits = whole.len();
        if self.peek() == Some('.') {
            self.advance();
            digits += self.take_while(digit).len();
        }
        if digits == 0 {
            self.at = start;
            return None;
        }
        self.text.get(start..self.at)
    }
}

impl<'a> Scanner<'a> {
    /// Takes a decimal number; a point without digits is an error.
    pub fn digits(&mut self) -> Result<&'a str, Diagnostic> {
        let start = self.position();
        self.decimal().ok_or_else(|| {
            self.advance();
            self.error(start, "a point without digits is not a number")
        })
    }

    /// The value of the number `text` that began at `start` and ends here; another point is an error.
    pub fn number(&mut self, start: usize, text: &str) -> Result<f64, Diagnostic> {
        if self.peek() == Some('.') {
            self.take_while(|c| c.is_ascii_digit() || c == '.');
            return Err(self.error(start, "a number with two decimal points"));
        }
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(self.error(start, "this is not a number")),
        }
    }

    /// Takes a text between double quotes, which must end on its line.
    pub fn quoted(&mut self) -> Result<&'a str, Diagnostic> {
        let start = self.position();
        self.advance();
        let text = self.take_while(|c| c != '"' && c != '\n');
        if self.take("\"") {
            return Ok(text);
        }
        Err(
            Diagnostic::error(self.span_from(start), "this text does not end")
                .help("put a \" at its end, on the same line"),
        )
    }

    /// An error about what stands from a byte position to here.
    pub fn error(&self, start: usize, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(self.span_from(start), message)
    }
}

/// Whether a character says nothing: the blanks of all keyboards and word processors, and the fillers
/// with which programs that were sent over a serial line begin and end. What an editor may show as the
/// end of a line (vertical tab, form feed, line separators) is none of them.
pub fn is_blank(c: char) -> bool {
    matches!(
        c,
        ' ' | '\t' | '\0' | '\u{1a}' | '\u{11}' | '\u{13}' | '\u{a0}' | '\u{1680}' | '\u{2000}'
            ..='\u{200a}' | '\u{202f}' | '\u{205f}' | '\u{3000}' | '\u{feff}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scanner(text: &str) -> Scanner<'_> {
        Scanner::new(Text::from(text))
    }

    #[test]
    fn decimals_in_all_their_forms() {
        for (text, taken) in [
            ("5", "5"),
            ("5.X", "5."),
            (".7Y", ".7"),
            ("10.25 ", "10.25"),
            ("1.2.3", "1.2"),
        ] {
            assert_eq!(scanner(text).decimal(), Some(taken));
        }
        let mut scanner = scanner(".X");
        assert_eq!(scanner.decimal(), None);
        assert_eq!(scanner.position(), 0);
    }

    #[test]
    fn positions_are_bytes() {
        let mut scanner = scanner("ñX");
        scanner.advance();
        assert_eq!(scanner.position(), 2);
        assert_eq!(scanner.advance(), Some('X'));
        assert_eq!(scanner.advance(), None);
    }
}
