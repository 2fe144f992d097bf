//! The smallest pieces of a Sinumerik-like part program.

use crate::dialects::token;

/// A token and where it stands.
pub type Token = token::Token<Symbol, SectionName>;

/// The kinds of tokens. Names may hold `_` and `$`: `TRANS`, `CR`, `$P_TOOLR`.
pub type TokenKind = token::TokenKind<Symbol, SectionName>;

/// What a line `%_N_NAME_MPF` or `%_N_NAME_SPF` of an archive says.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionName {
    /// The name in upper case.
    pub name: String,
    /// Whether it is a main program.
    pub main: bool,
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
