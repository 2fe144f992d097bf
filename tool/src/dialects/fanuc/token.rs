//! The smallest pieces of a Fanuc part program. Names are those of macro statements: `IF`, `SIN`, `GT`.

use crate::dialects::{cursor, token};

pub use cursor::Parsed;

/// A line with which a program begins or ends: `O1234` with its number, or `%`.
pub type Head = Option<u32>;

/// A token and where it stands; symbols are their characters.
pub type Token = token::Token<char, Head>;

/// The kinds of tokens.
pub type TokenKind = token::TokenKind<char, Head>;

/// The tokens of one block, without its comments and its end.
pub type Cursor<'a> = cursor::Cursor<'a, char, Head>;
