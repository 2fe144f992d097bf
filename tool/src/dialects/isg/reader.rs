//! Reading the characters of one block.

use crate::diagnostics::Diagnostic;
use crate::dialects::scanner::{Scanner, is_blank};
use crate::source::{Span, Text};

/// The outcome of parsing a part of a block.
pub type Parsed<T> = Result<T, Diagnostic>;

/// A place in a cleaned text. Nothing is read beyond the end of the line.
#[derive(Clone, Debug)]
pub struct Reader<'a> {
    scanner: Scanner<'a>,
    /// How deep brackets are nested where the reader is.
    pub depth: u32,
    /// How many operators of the block's arithmetic were taken so far.
    pub operators: u32,
}

impl<'a> Reader<'a> {
    /// At the beginning of the lines.
    pub fn new(text: Text<'a>) -> Reader<'a> {
        Reader {
            scanner: Scanner::new(text),
            depth: 0,
            operators: 0,
        }
    }

    /// Whether the text is at its end.
    pub fn is_finished(&self) -> bool {
        self.scanner.peek().is_none()
    }

    /// Byte position of the next character.
    pub fn position(&self) -> usize {
        self.scanner.position()
    }

    /// The text from here on.
    pub fn rest(&self) -> &'a str {
        self.scanner.rest()
    }

    /// The span from a byte position to here.
    pub fn span_from(&self, start: usize) -> Span {
        self.scanner.span_from(start)
    }

    /// The next character, in upper case; `None` at the end of the line.
    pub fn peek(&self) -> Option<char> {
        self.scanner
            .peek()
            .filter(|next| *next != '\n')
            .map(|next| next.to_ascii_uppercase())
    }

    /// The character after the next one, in upper case.
    pub fn peek_second(&self) -> Option<char> {
        let mut rest = self.scanner.rest().chars();
        rest.next().filter(|first| *first != '\n')?;
        rest.next()
            .filter(|next| *next != '\n')
            .map(|next| next.to_ascii_uppercase())
    }

    /// Takes the next character.
    pub fn advance(&mut self) {
        if self.peek().is_some() {
            self.scanner.advance();
        }
    }

    /// Leaves out blanks.
    pub fn blanks(&mut self) {
        self.scanner.take_while(is_blank);
    }

    /// Leaves out blanks; whether the line is at its end then.
    pub fn is_at_end(&mut self) -> bool {
        self.blanks();
        self.peek().is_none()
    }

    /// Takes a symbol if it comes next, after blanks.
    pub fn take(&mut self, symbol: &str) -> bool {
        self.blanks();
        self.scanner.take(symbol)
    }

    /// Takes a symbol that must come next.
    pub fn expect(&mut self, symbol: &str) -> Parsed<()> {
        match self.take(symbol) {
            true => Ok(()),
            false => Err(self.error(format!("`{symbol}` is missing here"))),
        }
    }

    /// The letters, digits and `_` that come next, in upper case; nothing is taken.
    pub fn name_ahead(&self) -> String {
        let rest = self.rest();
        let end = rest.find(|c: char| !is_name(c)).unwrap_or(rest.len());
        rest[..end].to_ascii_uppercase()
    }

    /// Takes a name.
    pub fn name(&mut self) -> String {
        self.scanner.take_while(is_name).to_ascii_uppercase()
    }

    /// Takes this name if it comes next, after blanks.
    pub fn keyword(&mut self, name: &str) -> bool {
        self.blanks();
        let found = self.name_ahead() == name;
        if found {
            self.name();
        }
        found
    }

    /// Takes characters as long as they are `wanted`, on this line.
    pub fn take_while(&mut self, wanted: impl Fn(char) -> bool) -> &'a str {
        self.scanner.take_while(|c| c != '\n' && wanted(c))
    }

    /// Takes a number without sign.
    pub fn decimal(&mut self) -> Option<&'a str> {
        self.scanner.decimal()
    }

    /// A text between quotation marks, if one comes next.
    pub fn text(&mut self) -> Parsed<Option<String>> {
        self.blanks();
        let start = self.position();
        if !self.scanner.take("\"") {
            return Ok(None);
        }
        let text = self.take_while(|c| c != '"').to_string();
        if !self.scanner.take("\"") {
            return Err(
                Diagnostic::error(self.span_from(start), "this text does not end")
                    .help("put a \" at its end, on the same line"),
            );
        }
        Ok(Some(text))
    }

    /// The text from a byte position on this line to here.
    pub fn text_from(&self, start: usize) -> &'a str {
        self.scanner.text_from(start)
    }

    /// Goes to the beginning of the next line.
    pub fn next_line(&mut self) {
        self.take_while(|_| true);
        self.scanner.take("\n");
        self.depth = 0;
    }

    /// Where the next word stands; at the end of the line, that place.
    pub fn word_span(&self) -> Span {
        let mut ahead = self.clone();
        ahead.blanks();
        let start = ahead.position();
        if ahead.name().is_empty() {
            ahead.advance();
        }
        ahead.span_from(start)
    }

    /// An error at the next word.
    pub fn error(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(self.word_span(), message)
    }

    /// An error at the next word, with advice.
    pub fn error_with_help(&self, message: impl Into<String>, help: &str) -> Diagnostic {
        Diagnostic::error(self.word_span(), message).help(help)
    }
}

fn is_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}
