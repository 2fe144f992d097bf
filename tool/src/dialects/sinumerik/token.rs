//! The smallest pieces of a Sinumerik-like part program.

use crate::source::Span;

/// A token and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Where it stands.
    pub span: Span,
}

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
