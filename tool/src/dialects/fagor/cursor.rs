//! Walking over the tokens of one block.

use crate::dialects::cursor;

pub use cursor::Parsed;

/// The tokens of one block, without its comment and its end.
pub type Cursor<'a> = cursor::Cursor<'a, char, String>;
