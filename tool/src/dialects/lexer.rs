//! From lines to tokens: what dialects of words and high-level blocks do alike.

use super::scanner::Scanner;
use super::token::{Token, TokenKind};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::Text;

/// A text that is being cut into tokens. `S`, `P`: see [`Token`].
pub struct Lexer<'a, S, P> {
    /// Where the next token begins.
    pub scanner: Scanner<'a>,
    tokens: Vec<Token<S, P>>,
}

impl<'a, S, P> Lexer<'a, S, P> {
    /// All tokens of a text; `line` cuts one line, without its end. What is no token is reported and left
    /// out; the rest of its line is left out too, so that one wrong character gives one error.
    pub fn cut(
        text: Text<'a>,
        diagnostics: &mut Diagnostics,
        line: fn(&mut Self) -> Result<(), Diagnostic>,
    ) -> Vec<Token<S, P>> {
        let mut lexer = Lexer {
            scanner: Scanner::new(text),
            tokens: Vec::new(),
        };
        while lexer.scanner.peek().is_some() {
            if let Err(diagnostic) = line(&mut lexer) {
                diagnostics.push(diagnostic);
                let start = lexer.scanner.position();
                lexer.scanner.take_while(|c| c != '\n');
                lexer.push(start, TokenKind::Invalid);
            }
            let start = lexer.scanner.position();
            lexer.scanner.take("\n");
            lexer.push(start, TokenKind::EndOfLine);
        }
        lexer.tokens
    }

    /// Adds a token that began at `start` and ends here.
    pub fn push(&mut self, start: usize, kind: TokenKind<S, P>) {
        let span = self.scanner.span_from(start);
        self.tokens.push(Token { kind, span });
    }
}
