//! Binary operators and their levels: what the parsers of arithmetic share.

use super::cursor::{Cursor, Parsed};
use super::expression::{Binary, Expression, ExpressionKind};
use super::token::TokenKind;
use crate::diagnostics::Diagnostic;

/// How deep parentheses and signs may be nested.
pub const DEPTH_LIMIT: u32 = 64;

/// How many operators a block may have: a tree of them is as deep as its chain of operators is long, and whoever walks
/// through it or drops it takes stack for each.
const OPERATOR_LIMIT: u32 = 1000;

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

/// What precedence climbing reads from.
pub trait Arithmetic {
    /// How many levels of operators there are; level 0 binds weakest.
    fn levels(&self) -> usize;

    /// Takes an operator of this level if it comes next.
    fn take_operator(&mut self, level: usize) -> Option<Binary>;

    /// How many operators of the block were taken so far.
    fn taken_operators(&mut self) -> &mut u32;

    /// An error where the next operand begins.
    fn error_with_help(&self, message: String, help: &str) -> Diagnostic;

    /// Refuses operands that the operator does not take.
    fn check(&self, operator: Binary, left: &Expression, right: &Expression) -> Parsed<()>;

    /// Parses an operand with its signs.
    fn operand(&mut self) -> Parsed<Expression>;
}

/// Parses operators of `level` and all that bind stronger, from left to right.
pub fn climb(source: &mut impl Arithmetic, level: usize) -> Parsed<Expression> {
    if level == source.levels() {
        return source.operand();
    }
    let mut left = climb(source, level + 1)?;
    while let Some(binary) = source.take_operator(level) {
        count_operator(source)?;
        let right = climb(source, level + 1)?;
        source.check(binary, &left, &right)?;
        left = Expression {
            span: left.span.to(right.span),
            kind: ExpressionKind::Binary(binary, Box::new(left), Box::new(right)),
        };
    }
    Ok(left)
}

fn count_operator(source: &mut impl Arithmetic) -> Parsed<()> {
    *source.taken_operators() += 1;
    match *source.taken_operators() > OPERATOR_LIMIT {
        false => Ok(()),
        true => Err(source.error_with_help(
            format!("a block with more than {OPERATOR_LIMIT} operators"),
            "set variables to parts of it in blocks before",
        )),
    }
}

impl<S: Copy + PartialEq, P> Grammar<S, P> {
    /// Parses operators of `level` and all that bind stronger, from left to right.
    pub fn parse(&self, cursor: &mut Cursor<S, P>, level: usize, depth: u32) -> Parsed<Expression> {
        if depth > DEPTH_LIMIT {
            return Err(cursor.error("parentheses are nested too deep"));
        }
        let grammar = self;
        let mut tokens = Tokens {
            grammar,
            cursor,
            depth,
        };
        climb(&mut tokens, level)
    }
}

/// The tokens of a block under the grammar of its dialect, so deep in parentheses.
struct Tokens<'g, 'c, 't, S, P> {
    grammar: &'g Grammar<S, P>,
    cursor: &'c mut Cursor<'t, S, P>,
    depth: u32,
}

impl<S: Copy + PartialEq, P> Arithmetic for Tokens<'_, '_, '_, S, P> {
    fn levels(&self) -> usize {
        self.grammar.levels
    }

    fn take_operator(&mut self, level: usize) -> Option<Binary> {
        let operator = (self.grammar.operator)(self.cursor.peek(), level)?;
        self.cursor.advance();
        Some(operator)
    }

    fn taken_operators(&mut self) -> &mut u32 {
        &mut self.cursor.operators
    }

    fn error_with_help(&self, message: String, help: &str) -> Diagnostic {
        self.cursor.error_with_help(message, help)
    }

    fn check(&self, operator: Binary, left: &Expression, right: &Expression) -> Parsed<()> {
        (self.grammar.check)(operator, left)?;
        (self.grammar.check)(operator, right)
    }

    fn operand(&mut self) -> Parsed<Expression> {
        (self.grammar.operand)(self.cursor, self.depth)
    }
}
