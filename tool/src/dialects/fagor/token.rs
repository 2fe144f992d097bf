//! The smallest pieces of a Fagor part program. Names stand inside of parentheses only: `CALL`, `SIN`,
//! `GT`; a program begins with `%NAME,MX--,`.

use crate::dialects::token;

/// A token and where it stands; symbols are their characters.
pub type Token = token::Token<char, String>;

/// The kinds of tokens.
pub type TokenKind = token::TokenKind<char, String>;
