//! Reading the characters of one line: what the lexers of all dialects share.

use crate::source::Span;

/// A place in a source text, moving forward.
#[derive(Clone, Debug)]
pub struct Scanner<'a> {
    text: &'a str,
    file: usize,
    at: usize,
}

impl<'a> Scanner<'a> {
    /// At the beginning of the text of the file with this index.
    pub fn new(file: usize, text: &'a str) -> Scanner<'a> {
        Scanner { text, file, at: 0 }
    }

    /// Byte position of the next character.
    pub fn position(&self) -> usize {
        self.at
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
        self.text.get(start..self.at).unwrap_or("")
    }

    /// The span from a byte position to here.
    pub fn span_from(&self, start: usize) -> Span {
        Span {
            file: self.file,
            start,
            end: self.at,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_in_all_their_forms() {
        for (text, taken) in [
            ("5", "5"),
            ("5.X", "5."),
            (".7Y", ".7"),
            ("10.25 ", "10.25"),
            ("1.2.3", "1.2"),
        ] {
            assert_eq!(Scanner::new(0, text).decimal(), Some(taken));
        }
        let mut scanner = Scanner::new(0, ".X");
        assert_eq!(scanner.decimal(), None);
        assert_eq!(scanner.position(), 0);
    }

    #[test]
    fn positions_are_bytes() {
        let mut scanner = Scanner::new(0, "ñX");
        scanner.advance();
        assert_eq!(scanner.position(), 2);
        assert_eq!(scanner.advance(), Some('X'));
        assert_eq!(scanner.advance(), None);
    }
}
