//! The smallest pieces of a Sinumerik-like part program.

use crate::dialects::cursor;

/// A token and where it stands.
pub type Token = cursor::Token<TokenKind>;

/// The kinds of tokens.
#[derive(Clone, Debug, PartialEq)]
pub enum TokenKind {
    /// A letter that stands alone, in upper case: the address of a word (`X` in `X10`).
    Letter(char),
    /// A name of two characters or more, in upper case: `TRANS`, `CR`, `$P_TOOLR`.
    Name(String),
    /// A number without sign.
    Number(f64),
    /// A text between double quotes.
    Text(String),
    /// An operator or a punctuation mark.
    Symbol(Symbol),
    /// From `;` to the end of the line.
    Comment(String),
    /// A line `%_N_NAME_MPF` or `%_N_NAME_SPF`: a program or subprogram of an archive begins.
    Section {
        /// The name in upper case.
        name: String,
        /// Whether it is a main program.
        main: bool,
    },
    /// The rest of a line that is no token; that has been reported.
    Invalid,
    /// The end of a line, and of the last one.
    EndOfLine,
}

/// Operators and punctuation marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names are the characters")]
pub enum Symbol {
    Plus,
    Minus,
    Star,
    Slash,
    Open,
    Close,
    OpenBracket,
    CloseBracket,
    Comma,
    Colon,
    Assign,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Concatenate,
}

impl cursor::Kind for TokenKind {
    type Symbol = Symbol;

    fn symbol(&self) -> Option<Symbol> {
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
