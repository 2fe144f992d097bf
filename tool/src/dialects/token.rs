//! The smallest pieces of a part program.

use crate::source::Span;

/// A token and where it stands. `S`: the operators and punctuation marks of the dialect; `P`: what the
/// line says with which a program begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Token<S, P> {
    /// What it is.
    pub kind: TokenKind<S, P>,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of tokens.
#[derive(Clone, Debug, PartialEq)]
pub enum TokenKind<S, P> {
    /// A letter that stands alone, in upper case: the address of a word (`X` in `X10`).
    Letter(char),
    /// A name of several characters, in upper case.
    Name(String),
    /// A number without sign.
    Number(f64),
    /// A text between double quotes.
    Text(String),
    /// An operator or a punctuation mark.
    Symbol(S),
    /// From `;` to the end of the line.
    Comment(String),
    /// A line that begins with `%`: a program or subprogram begins.
    Program(P),
    /// The rest of a line that is no token; that has been reported.
    Invalid,
    /// The end of a line, and of the last one.
    EndOfLine,
}

impl<S: Copy, P> TokenKind<S, P> {
    /// The symbol, if it is one.
    pub fn symbol(&self) -> Option<S> {
        match self {
            TokenKind::Symbol(symbol) => Some(*symbol),
            _ => None,
        }
    }

    /// The letter, if it stands alone.
    pub fn letter(&self) -> Option<char> {
        match self {
            TokenKind::Letter(letter) => Some(*letter),
            _ => None,
        }
    }

    /// The name of several letters, if it is one.
    pub fn name(&self) -> Option<&str> {
        match self {
            TokenKind::Name(name) => Some(name),
            _ => None,
        }
    }

    /// The value, if it is a number.
    pub fn number(&self) -> Option<f64> {
        match self {
            TokenKind::Number(number) => Some(*number),
            _ => None,
        }
    }
}
