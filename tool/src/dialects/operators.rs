//! Binary operators and their levels: what the parsers of arithmetic share.

use super::cursor::{Cursor, Parsed};
use super::expression::{Binary, Expression, ExpressionKind};
use super::token::TokenKind;

/// How deep parentheses and signs may be nested.
pub const DEPTH_LIMIT: u32 = 64;

/// Reads a token as an operator of one level.
pub type OperatorOfLevel<S, P> = fn(Option<&TokenKind<S, P>>, usize) -> Option<Binary>;

/// What a dialect has between and beside its operators.
pub struct Grammar<S, P> {
    /// How many levels of operators there are; level 0 binds weakest.
    pub levels: usize,
    /// The operator that a token is, if it is one of this level.
    pub operator: OperatorOfLevel<S, P>,
    /// Refuses an operand that the operator does not take.
    pub check: fn(Binary, &Expression) -> Parsed<()>,
    /// Parses an operand with its signs, nested this deep.
    pub operand: fn(&mut Cursor<S, P>, u32) -> Parsed<Expression>,
}

impl<S: Copy + PartialEq, P> Grammar<S, P> {
    /// Parses operators of `level` and all that bind stronger, from left to right.
    pub fn parse(&self, cursor: &mut Cursor<S, P>, level: usize, depth: u32) -> Parsed<Expression> {
        if depth > DEPTH_LIMIT {
            return Err(cursor.error("parentheses are nested too deep"));
        }
        if level == self.levels {
            return (self.operand)(cursor, depth);
        }
        let mut left = self.parse(cursor, level + 1, depth)?;
        while let Some(binary) = (self.operator)(cursor.peek(), level) {
            cursor.advance();
            let right = self.parse(cursor, level + 1, depth)?;
            (self.check)(binary, &left)?;
            (self.check)(binary, &right)?;
            left = Expression {
                span: left.span.to(right.span),
                kind: ExpressionKind::Binary(binary, Box::new(left), Box::new(right)),
            };
        }
        Ok(left)
    }
}
