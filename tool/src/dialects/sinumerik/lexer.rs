//! From the text of a Sinumerik-like part program to tokens.

use super::token::{SectionName, Symbol, Token, TokenKind};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::lexer;
use crate::dialects::scanner::is_blank;
use crate::source::Text;

/// The symbols, longer ones before their beginnings.
const SYMBOLS: [(&str, Symbol); 18] = [
    ("==", Symbol::Equal),
    ("<>", Symbol::NotEqual),
    ("<=", Symbol::LessOrEqual),
    (">=", Symbol::GreaterOrEqual),
    ("<<", Symbol::Concatenate),
    ("=", Symbol::Assign),
    ("<", Symbol::Less),
    (">", Symbol::Greater),
    ("+", Symbol::Plus),
    ("-", Symbol::Minus),
    ("*", Symbol::Star),
    ("/", Symbol::Slash),
    ("(", Symbol::Open),
    (")", Symbol::Close),
    ("[", Symbol::OpenBracket),
    ("]", Symbol::CloseBracket),
    (",", Symbol::Comma),
    (":", Symbol::Colon),
];

type Lexer<'a> = lexer::Lexer<'a, Symbol, SectionName>;

/// All tokens of a file; see [`lexer::Lexer::cut`].
pub fn tokens(text: Text, diagnostics: &mut Diagnostics) -> Vec<Token> {
    Lexer::cut(text, diagnostics, Lexer::line)
}

impl Lexer<'_> {
    fn line(&mut self) -> Result<(), Diagnostic> {
        self.scanner.take_while(is_blank);
        if self.scanner.peek() == Some('%') {
            return self.section();
        }
        while let Some(next) = self.scanner.peek() {
            if next == '\n' {
                break;
            }
            if is_blank(next) {
                self.scanner.advance();
                continue;
            }
            self.token(next)?;
        }
        Ok(())
    }

    fn token(&mut self, next: char) -> Result<(), Diagnostic> {
        let start = self.scanner.position();
        let kind = if next == ';' {
            self.scanner.advance();
            TokenKind::Comment(self.scanner.take_while(|c| c != '\n').trim().to_string())
        } else if next == '"' {
            TokenKind::Text(self.scanner.quoted()?.to_string())
        } else if next.is_ascii_alphabetic() || next == '_' || next == '$' {
            self.name()
        } else if next.is_ascii_digit() || next == '.' {
            self.number()?
        } else {
            let found = SYMBOLS
                .into_iter()
                .find(|(text, _)| self.scanner.take(text));
            match found {
                Some((_, symbol)) => TokenKind::Symbol(symbol),
                None => return Err(self.unknown_character(next)),
            }
        };
        self.push(start, kind);
        Ok(())
    }

    /// A letter followed by anything but a letter or `_` is an address: `G0X10` has four tokens.
    fn name(&mut self) -> TokenKind {
        let mut rest = self.scanner.rest().chars();
        let first = rest.next().unwrap_or('_');
        let joined = rest
            .next()
            .is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
        if first.is_ascii_alphabetic() && !joined {
            self.scanner.advance();
            return TokenKind::Letter(first.to_ascii_uppercase());
        }
        let name = self
            .scanner
            .take_while(|c| c.is_ascii_alphanumeric() || c == '_' || c == '$');
        TokenKind::Name(name.to_ascii_uppercase())
    }

    fn number(&mut self) -> Result<TokenKind, Diagnostic> {
        let start = self.scanner.position();
        let digits = self.scanner.digits()?;
        let mut text = digits.to_string();
        let rest = self.scanner.rest();
        let upper = rest.get(..2).unwrap_or("").to_ascii_uppercase();
        if upper == "EX" {
            self.scanner.advance();
            self.scanner.advance();
            text.push('e');
            for sign in ["-", "+"] {
                if self.scanner.take(sign) {
                    text.push_str(sign);
                    break;
                }
            }
            text.push_str(self.scanner.take_while(|c| c.is_ascii_digit()));
        }
        Ok(TokenKind::Number(self.scanner.number(start, &text)?))
    }

    /// `%_N_L10_SPF`, the older `%MPF100` and `%SPF10`, or a bare `%`, which says nothing.
    fn section(&mut self) -> Result<(), Diagnostic> {
        let start = self.scanner.position();
        let line = self.scanner.take_while(|c| c != '\n' && c != ';').trim();
        let upper = line.to_ascii_uppercase();
        let section = if let Some(archive) = upper.strip_prefix("%_N_") {
            archive
                .strip_suffix("_SPF")
                .map(|name| (name, false))
                .or(archive.strip_suffix("_MPF").map(|name| (name, true)))
        } else {
            upper
                .strip_prefix("%SPF")
                .map(|name| (name, false))
                .or(upper.strip_prefix("%MPF").map(|name| (name, true)))
        };
        match section {
            Some((name, main)) if is_program_name(name) => {
                // %SPF10 is called as L10.
                let name = if upper.starts_with("%SPF") {
                    format!("L{name}")
                } else {
                    name.to_string()
                };
                self.push(start, TokenKind::Program(SectionName { name, main }));
            }
            _ if upper == "%" => {}
            _ => {
                return Err(Diagnostic::error(
                    self.scanner.span_from(start),
                    "this line begins a kind of data that is not run here",
                )
                .help(
                    "programs begin with %_N_NAME_MPF, subprograms with %_N_NAME_SPF; \
                         take tool, offset and other data out of the file",
                ));
            }
        }
        Ok(())
    }

    fn unknown_character(&mut self, character: char) -> Diagnostic {
        let start = self.scanner.position();
        self.scanner.advance();
        let shown = character.escape_default();
        let span = self.scanner.span_from(start);
        match character {
            '{' | '}' | '\'' => Diagnostic::error(span, format!("`{shown}` is not supported"))
                .help("write numbers in decimal form"),
            _ => Diagnostic::error(
                span,
                format!("the character `{shown}` has no meaning in a part program"),
            ),
        }
    }
}

fn is_program_name(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
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
    fn words_need_no_blanks_between_them() {
        use crate::dialects::token::TokenKind::*;
        assert_eq!(
            kinds("N80G0x-.5RPL=45"),
            [
                Letter('N'),
                Number(80.0),
                Letter('G'),
                Number(0.0),
                Letter('X'),
                Symbol(super::Symbol::Minus),
                Number(0.5),
                Name("RPL".into()),
                Symbol(super::Symbol::Assign),
                Number(45.0),
                EndOfLine,
            ]
        );
    }

    #[test]
    fn archives_name_their_sections() {
        for (line, name, main) in [
            ("%_N_L10_SPF", "L10", false),
            ("%_n_part_mpf ; x", "PART", true),
            ("%SPF7", "L7", false),
            ("%MPF100", "100", true),
        ] {
            let name = name.to_string();
            assert_eq!(
                kinds(line)[0],
                TokenKind::Program(SectionName { name, main })
            );
        }
        assert_eq!(kinds("%\n"), [TokenKind::EndOfLine]);
    }

    #[test]
    fn one_wrong_character_is_one_error() {
        let mut diagnostics = Diagnostics::default();
        let tokens = tokens(
            Text::from("G0 X1.2.3 ? ?\nG1 X\"abc\n#\n"),
            &mut diagnostics,
        );
        assert_eq!(diagnostics.errors(), 3);
        let ends = tokens
            .iter()
            .filter(|token| token.kind == TokenKind::EndOfLine);
        assert_eq!(ends.count(), 3);
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
