//! Walking over the tokens of one block.

use super::token::{Symbol, Token, TokenKind};
use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// The outcome of parsing a part of a block.
pub type Parsed<T> = Result<T, Box<Diagnostic>>;

/// The tokens of one block, without its comment and its end.
#[derive(Clone, Debug)]
pub struct Cursor<'a> {
    tokens: &'a [Token],
    at: usize,
    end: Span,
}

impl<'a> Cursor<'a> {
    /// At the first of `tokens`; `end` is where the block ends, for messages.
    pub fn new(tokens: &'a [Token], end: Span) -> Cursor<'a> {
        Cursor { tokens, at: 0, end }
    }

    /// The next token.
    pub fn peek(&self) -> Option<&'a TokenKind> {
        self.peek_at(0)
    }

    /// The token after `ahead` others.
    pub fn peek_at(&self, ahead: usize) -> Option<&'a TokenKind> {
        self.tokens.get(self.at + ahead).map(|token| &token.kind)
    }

    /// Whether the block is at its end.
    pub fn is_at_end(&self) -> bool {
        self.at >= self.tokens.len()
    }

    /// Where the next token stands; at the end, the end of the block.
    pub fn span(&self) -> Span {
        self.tokens
            .get(self.at)
            .map_or(self.end, |token| token.span)
    }

    /// Where the token before stands.
    pub fn last_span(&self) -> Span {
        self.at
            .checked_sub(1)
            .and_then(|last| self.tokens.get(last))
            .map_or(self.span(), |token| token.span)
    }

    /// Takes the next token.
    pub fn advance(&mut self) -> Option<&'a Token> {
        let token = self.tokens.get(self.at)?;
        self.at += 1;
        Some(token)
    }

    /// Takes `symbol` if it comes next.
    pub fn take(&mut self, symbol: Symbol) -> bool {
        let found = self.is_symbol(0, symbol);
        self.at += usize::from(found);
        found
    }

    /// Whether `symbol` comes after `ahead` other tokens.
    pub fn is_symbol(&self, ahead: usize, symbol: Symbol) -> bool {
        self.peek_at(ahead) == Some(&TokenKind::Symbol(symbol))
    }

    /// Takes the name if it comes next.
    pub fn take_name(&mut self, name: &str) -> bool {
        let found = matches!(self.peek(), Some(TokenKind::Name(next)) if next == name);
        self.at += usize::from(found);
        found
    }

    /// Takes the letter if it comes next.
    pub fn take_letter(&mut self, letter: char) -> bool {
        let found = self.peek() == Some(&TokenKind::Letter(letter));
        self.at += usize::from(found);
        found
    }

    /// Takes `symbol`, or says that it is missing.
    pub fn expect(&mut self, symbol: Symbol, shown: &str) -> Parsed<()> {
        if self.take(symbol) {
            return Ok(());
        }
        Err(self.error(format!("`{shown}` is missing here")))
    }

    /// Takes a whole number without sign.
    pub fn whole(&mut self, what: &str) -> Parsed<u32> {
        match self.peek() {
            Some(TokenKind::Number(number))
                if number.fract() == 0.0 && *number <= f64::from(u32::MAX) =>
            {
                self.at += 1;
                Ok(*number as u32)
            }
            _ => Err(self.error(format!("{what} must be a whole number"))),
        }
    }

    /// Whether the next token follows the last one without a blank.
    pub fn is_adjacent(&self) -> bool {
        self.span().start == self.last_span().end
    }

    /// An error at the next token.
    pub fn error(&self, message: impl Into<String>) -> Box<Diagnostic> {
        Box::new(Diagnostic::error(self.span(), message))
    }
}
