//! From the text of a Fagor part program to tokens.
//!
//! Outside of parentheses a program consists of letters and numbers: `G01XP1` is four tokens. Inside,
//! in high level blocks, letters make names.

use super::token::{Token, TokenKind};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::lexer;
use crate::dialects::scanner::is_blank;
use crate::source::Text;

type Lexer<'a> = lexer::Lexer<'a, char, String>;

/// All tokens of a file; see [`lexer::Lexer::cut`].
pub fn tokens(text: Text, diagnostics: &mut Diagnostics) -> Vec<Token> {
    Lexer::cut(text, diagnostics, Lexer::line)
}

impl Lexer<'_> {
    fn line(&mut self) -> Result<(), Diagnostic> {
        self.scanner.take_while(is_blank);
        if self.scanner.peek() == Some('%') {
            let start = self.scanner.position();
            let line = self.scanner.take_while(|c| c != '\n');
            // A bare % is the end of a transmission and says nothing.
            let name = line.trim_start_matches('%').split(',').next();
            let name = name.unwrap_or("").trim().to_ascii_uppercase();
            if !name.is_empty() {
                self.push(start, TokenKind::Program(name));
            }
            return Ok(());
        }
        // How many parentheses are open.
        let mut depth = 0;
        while let Some(next) = self.scanner.peek() {
            if next == '\n' {
                break;
            }
            if is_blank(next) {
                self.scanner.advance();
                continue;
            }
            self.token(next, &mut depth)?;
        }
        Ok(())
    }

    fn token(&mut self, next: char, depth: &mut u32) -> Result<(), Diagnostic> {
        let start = self.scanner.position();
        let kind = match next {
            ';' => {
                self.scanner.advance();
                TokenKind::Comment(self.scanner.take_while(|c| c != '\n').trim().to_string())
            }
            '"' => TokenKind::Text(self.scanner.quoted()?.to_string()),
            c if c.is_ascii_alphabetic() => self.letters(*depth > 0),
            c if c.is_ascii_digit() || c == '.' => self.number()?,
            '+' | '-' | '*' | '/' | '(' | ')' | '=' | ',' => {
                self.scanner.advance();
                match next {
                    '(' => *depth += 1,
                    ')' => *depth = depth.saturating_sub(1),
                    _ => {}
                }
                TokenKind::Symbol(next)
            }
            _ => {
                self.scanner.advance();
                let shown = next.escape_default();
                return Err(self.scanner.error(
                    start,
                    format!("the character `{shown}` has no meaning in a part program"),
                ));
            }
        };
        self.push(start, kind);
        Ok(())
    }

    fn letters(&mut self, names: bool) -> TokenKind {
        let mut rest = self.scanner.rest().chars();
        let first = rest.next().unwrap_or(' ').to_ascii_uppercase();
        let joined = rest.next().is_some_and(|c| c.is_ascii_alphabetic());
        if !names || !joined {
            self.scanner.advance();
            return TokenKind::Letter(first);
        }
        let name = self.scanner.take_while(|c| c.is_ascii_alphabetic());
        TokenKind::Name(name.to_ascii_uppercase())
    }

    fn number(&mut self) -> Result<TokenKind, Diagnostic> {
        let start = self.scanner.position();
        let digits = self.scanner.digits()?;
        Ok(TokenKind::Number(self.scanner.number(start, digits)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn kinds(text: &str) -> Vec<TokenKind> {
        let mut diagnostics = Diagnostics::default();
        let tokens = tokens(Text::from(text), &mut diagnostics);
        assert_eq!(diagnostics.errors(), 0, "{text}");
        tokens.into_iter().map(|token| token.kind).collect()
    }

    #[test]
    fn letters_are_addresses_outside_of_parentheses_and_names_inside() {
        use crate::dialects::token::TokenKind::*;
        assert_eq!(
            kinds("G1XP2(IF P1 GT.5)"),
            [
                Letter('G'),
                Number(1.0),
                Letter('X'),
                Letter('P'),
                Number(2.0),
                Symbol('('),
                Name("IF".into()),
                Letter('P'),
                Number(1.0),
                Name("GT".into()),
                Number(0.5),
                Symbol(')'),
                EndOfLine,
            ]
        );
    }

    #[test]
    fn the_header_names_the_program() {
        assert_eq!(
            kinds("%part 1,MX--,")[0],
            TokenKind::Program("PART 1".into())
        );
        assert_eq!(kinds("%\n"), [TokenKind::EndOfLine]);
    }

    proptest! {
        #[test]
        fn spans_lie_in_the_text_in_order(text in "\\PC*") {
            let mut diagnostics = Diagnostics::default();
            let mut last = 0;
            for token in tokens(Text::from(text.as_str()), &mut diagnostics) {
                prop_assert!(last <= token.span.start && token.span.start <= token.span.end);
                prop_assert!(text.get(token.span.start..token.span.end).is_some());
                last = token.span.end;
            }
        }
    }
}
