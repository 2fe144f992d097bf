//! From the text of a Fanuc part program to tokens. Blanks say nothing, and words need none between
//! them: `IF[#1EQ0]GOTO10` is eight tokens.

use super::token::{Head, Token, TokenKind};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::lexer;
use crate::dialects::scanner::is_blank;
use crate::source::Text;

/// The names of macro statements; one that begins with another stands before it.
const NAMES: [&str; 37] = [
    "DPRNT", "BPRNT", "POPEN", "PCLOS", "SETVN", "ROUND", "WHILE", "ENDIF", "GOTO", "THEN", "ELSE",
    "ASIN", "ACOS", "ATAN", "SQRT", "SIN", "COS", "TAN", "SQR", "RND", "ABS", "FIX", "FUP", "MOD",
    "AND", "XOR", "BIN", "BCD", "EXP", "POW", "ADP", "END", "IF", "DO", "OR", "LN", "EQ",
];

/// Those that may be shortened to their first two letters; what follows is `[`, which no address has behind two
/// letters.
const SHORTENED: [&str; 13] = [
    "ROUND", "WHILE", "ASIN", "ACOS", "ATAN", "SQRT", "SIN", "COS", "TAN", "ABS", "FIX", "FUP",
    "EXP",
];

/// The names of comparisons besides `EQ`.
const COMPARISONS: [&str; 5] = ["NE", "GT", "GE", "LT", "LE"];

type Lexer<'a> = lexer::Lexer<'a, char, Head>;

/// All tokens of a file; see [`lexer::Lexer::cut`].
pub fn tokens(text: Text, diagnostics: &mut Diagnostics) -> Vec<Token> {
    Lexer::cut(text, diagnostics, Lexer::line)
}

impl Lexer<'_> {
    fn line(&mut self) -> Result<(), Diagnostic> {
        self.blanks();
        if let Some(mark @ ('%' | 'O' | 'o' | ':')) = self.scanner.peek() {
            self.head(mark)?;
        }
        loop {
            self.blanks();
            match self.scanner.peek() {
                None | Some('\n') => return Ok(()),
                Some(next) => self.token(next)?,
            }
        }
    }

    fn blanks(&mut self) {
        self.scanner.take_while(|c| is_blank(c) || c == '\r');
    }

    /// `%`, `O1234` or `:1234`.
    fn head(&mut self, mark: char) -> Result<(), Diagnostic> {
        let start = self.scanner.position();
        self.scanner.advance();
        if mark == '%' {
            self.push(start, TokenKind::Program(None));
            return Ok(());
        }
        self.blanks();
        let digits = self.scanner.take_while(|c| c.is_ascii_digit());
        match digits.parse() {
            Ok(number @ ..=99_999_999) => {
                self.push(start, TokenKind::Program(Some(number)));
                Ok(())
            }
            _ => Err(self
                .scanner
                .error(start, "a program begins with O and its number")
                .help("numbers go from O0 to O99999999; names in < > are not supported")),
        }
    }

    fn token(&mut self, next: char) -> Result<(), Diagnostic> {
        let start = self.scanner.position();
        let kind = match next {
            '(' => TokenKind::Comment(self.comment()?),
            c if c.is_ascii_alphabetic() => self.letters(),
            c if c.is_ascii_digit() || c == '.' => self.number()?,
            '+' | '-' | '*' | '/' | '#' | '[' | ']' | '=' | ',' => {
                self.scanner.advance();
                TokenKind::Symbol(next)
            }
            ';' => return self.end_of_block(start),
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

    fn comment(&mut self) -> Result<String, Diagnostic> {
        let start = self.scanner.position();
        self.scanner.advance();
        let text = self.scanner.take_while(|c| c != ')' && c != '\n');
        if self.scanner.take(")") {
            return Ok(text.trim().to_string());
        }
        Err(self
            .scanner
            .error(start, "this comment does not end")
            .help("put ) at its end, on the same line"))
    }

    /// Listings show the end of a block as `;`.
    fn end_of_block(&mut self, start: usize) -> Result<(), Diagnostic> {
        self.scanner
            .take_while(|c| is_blank(c) || c == ';' || c == '\r');
        match self.scanner.peek() {
            None | Some('\n' | '(') => Ok(()),
            _ => Err(self
                .scanner
                .error(
                    start,
                    "a block ends here, and another follows on the same line",
                )
                .help("put it on a line of its own; comments stand in parentheses")),
        }
    }

    /// The name of a macro statement, or else one letter: the address of a word.
    fn letters(&mut self) -> TokenKind {
        let rest = self.scanner.rest().as_bytes();
        let is_next = |name: &&&str| {
            let letters = rest.get(..name.len());
            letters.is_some_and(|letters| letters.eq_ignore_ascii_case(name.as_bytes()))
        };
        let name = NAMES.iter().chain(&COMPARISONS).find(is_next);
        let name = name.map(|name| (*name, name.len()));
        if let Some((name, mut left)) = name.or_else(|| shortened(rest)) {
            while left > 0 && self.scanner.advance().is_some() {
                left -= 1;
            }
            return match name {
                "DPRNT" | "BPRNT" => {
                    let rest = self.scanner.take_while(|c| c != '\n').to_string();
                    TokenKind::Text(rest)
                }
                name => TokenKind::Name(name.to_string()),
            };
        }
        let letter = self.scanner.advance().unwrap_or(' ');
        TokenKind::Letter(letter.to_ascii_uppercase())
    }

    fn number(&mut self) -> Result<TokenKind, Diagnostic> {
        let start = self.scanner.position();
        let digits = self.scanner.digits()?;
        Ok(TokenKind::Number(self.scanner.number(start, digits)?))
    }
}

/// `WH[`, `SQ[`: the name, and how many of its letters are there.
fn shortened(rest: &[u8]) -> Option<(&'static str, usize)> {
    const LETTERS: usize = 2;
    let (letters, behind) = rest.split_at_checked(LETTERS)?;
    let next = behind.iter().find(|byte| !matches!(byte, b' ' | b'\t'));
    if next != Some(&b'[') {
        return None;
    }
    let begins = |name: &&&str| {
        let first = name.as_bytes().get(..LETTERS);
        first.is_some_and(|first| first.eq_ignore_ascii_case(letters))
    };
    SHORTENED.iter().find(begins).map(|name| (*name, LETTERS))
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
    fn words_need_no_blanks() {
        use crate::dialects::token::TokenKind::*;
        assert_eq!(
            kinds("if[#1EQ.5]GOTO10(a)"),
            [
                Name("IF".into()),
                Symbol('['),
                Symbol('#'),
                Number(1.0),
                Name("EQ".into()),
                Number(0.5),
                Symbol(']'),
                Name("GOTO".into()),
                Number(10.0),
                Comment("a".into()),
                EndOfLine,
            ]
        );
        assert_eq!(kinds("G1X-1.;")[..4], kinds("G1 X -1. ")[..4]);
        assert_eq!(kinds("O0012(A)")[0], Program(Some(12)));
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
