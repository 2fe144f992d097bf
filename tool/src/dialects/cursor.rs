//! Walking over the tokens of one block: what the parsers of dialects share.

use super::token::{Token, TokenKind};
use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// The outcome of parsing a part of a block.
pub type Parsed<T> = Result<T, Diagnostic>;

/// The tokens of one block, without its comment and its end.
#[derive(Clone, Debug)]
pub struct Cursor<'a, S, P> {
    tokens: &'a [Token<S, P>],
    at: usize,
    end: Span,
    /// How many operators of its arithmetic were taken so far.
    pub operators: u32,
}

impl<'a, S: Copy + PartialEq, P> Cursor<'a, S, P> {
    /// At the first of `tokens`; `end` is where the block ends, for messages.
    pub fn new(tokens: &'a [Token<S, P>], end: Span) -> Cursor<'a, S, P> {
        Cursor {
            tokens,
            at: 0,
            end,
            operators: 0,
        }
    }

    /// The next token.
    pub fn peek(&self) -> Option<&'a TokenKind<S, P>> {
        self.peek_at(0)
    }

    /// The token after `ahead` others.
    pub fn peek_at(&self, ahead: usize) -> Option<&'a TokenKind<S, P>> {
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
    pub fn advance(&mut self) -> Option<&'a Token<S, P>> {
        let token = self.tokens.get(self.at)?;
        self.at += 1;
        Some(token)
    }

    /// Takes the next token if it is `wanted`.
    fn take_if(&mut self, wanted: impl Fn(&TokenKind<S, P>) -> bool) -> bool {
        let found = self.peek().is_some_and(wanted);
        self.at += usize::from(found);
        found
    }

    /// Takes `symbol` if it comes next.
    pub fn take(&mut self, symbol: S) -> bool {
        self.take_if(|kind| kind.symbol() == Some(symbol))
    }

    /// Whether `symbol` comes after `ahead` other tokens.
    pub fn is_symbol(&self, ahead: usize, symbol: S) -> bool {
        let next = self.peek_at(ahead).and_then(TokenKind::symbol);
        next == Some(symbol)
    }

    /// Takes the name if it comes next.
    pub fn take_name(&mut self, name: &str) -> bool {
        self.take_if(|kind| kind.name() == Some(name))
    }

    /// Takes the letter if it comes next.
    pub fn take_letter(&mut self, letter: char) -> bool {
        self.take_if(|kind| kind.letter() == Some(letter))
    }

    /// Takes `symbol`, or says that it is missing.
    pub fn expect(&mut self, symbol: S, shown: &str) -> Parsed<()> {
        if self.take(symbol) {
            return Ok(());
        }
        Err(self.error(format!("`{shown}` is missing here")))
    }

    /// Takes a whole number without sign.
    pub fn whole(&mut self, what: &str) -> Parsed<u32> {
        match self.peek().and_then(TokenKind::number) {
            Some(number) if number.fract() == 0.0 && number <= f64::from(u32::MAX) => {
                self.at += 1;
                Ok(number as u32)
            }
            _ => Err(self.error(format!("{what} must be a whole number"))),
        }
    }

    /// Whether the next token follows the last one without a blank.
    pub fn is_adjacent(&self) -> bool {
        self.span().start == self.last_span().end
    }

    /// An error at the next token.
    pub fn error(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(self.span(), message)
    }

    /// An error at the next token, with advice.
    pub fn error_with_help(
        &self,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Diagnostic {
        Diagnostic::error(self.span(), message).help(help)
    }
}
