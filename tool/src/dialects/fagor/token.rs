//! The smallest pieces of a Fagor part program.

use crate::dialects::cursor;

/// A token and where it stands.
pub type Token = cursor::Token<TokenKind>;

/// The kinds of tokens.
#[derive(Clone, Debug, PartialEq)]
pub enum TokenKind {
    /// A letter that stands alone, in upper case: the address of a word, or the `P` of a parameter.
    Letter(char),
    /// Two letters or more inside of parentheses, in upper case: `CALL`, `SIN`, `GT`.
    Name(String),
    /// A number without sign.
    Number(f64),
    /// A text between double quotes.
    Text(String),
    /// An operator or a punctuation mark.
    Symbol(char),
    /// From `;` to the end of the line.
    Comment(String),
    /// A line `%NAME,MX--,`: the program begins.
    Header(String),
    /// The rest of a line that is no token; that has been reported.
    Invalid,
    /// The end of a line, and of the last one.
    EndOfLine,
}

impl cursor::Kind for TokenKind {
    type Symbol = char;

    fn symbol(&self) -> Option<char> {
        match self {
            TokenKind::Symbol(symbol) => Some(*symbol),
            _ => None,
        }
    }

    fn letter(&self) -> Option<char> {
        match self {
            TokenKind::Letter(letter) => Some(*letter),
            _ => None,
        }
    }

    fn name(&self) -> Option<&str> {
        match self {
            TokenKind::Name(name) => Some(name),
            _ => None,
        }
    }

    fn number(&self) -> Option<f64> {
        match self {
            TokenKind::Number(number) => Some(*number),
            _ => None,
        }
    }
}
