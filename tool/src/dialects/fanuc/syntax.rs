//! The syntax tree of a Fanuc part program.

use crate::dialects::control::Place;
use crate::dialects::expression::Expression;
use crate::source::Span;

/// One line.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its text, number and comment.
    pub place: Place,
    /// Whether it begins with `/`: it is left out where the operator says so.
    pub skip: bool,
    /// What it says.
    pub statement: Statement,
}

/// What a block says.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Nothing but number or comment.
    Empty,
    /// It could not be understood; that has been reported.
    Invalid,
    /// Words: G functions, axes, feed and so on.
    Words(Vec<Word>),
    /// `#1=5`.
    Assign(Assignment),
    /// `IF[..]GOTO 10`, `IF[..]THEN #1=5`.
    If(Expression, Then),
    /// `GOTO 10`.
    Goto(Jump),
    /// `WHILE[..]DO 1`, or `DO 1` without a condition.
    Loop(Option<Expression>, u32),
    /// `END 1`.
    End(u32),
    /// Output to a printer, or the like, that cannot change the part; its name.
    Noted(&'static str),
}

/// What follows a condition.
#[derive(Clone, Debug, PartialEq)]
pub enum Then {
    /// `GOTO 10`.
    Goto(Jump),
    /// `THEN #1=5`.
    Assign(Assignment),
}

/// The number of the block that is jumped to.
#[derive(Clone, Debug, PartialEq)]
pub struct Jump {
    /// The number.
    pub number: Expression,
    /// The whole jump.
    pub span: Span,
}

/// `#1=..`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// The number of the variable.
    pub variable: Expression,
    /// The new value.
    pub value: Expression,
    /// The variable.
    pub span: Span,
}

/// An address and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// The address in upper case.
    pub letter: char,
    /// Whether a comma stands before it: `,R5`.
    pub comma: bool,
    /// Its value.
    pub value: Expression,
    /// Digits of a plain number without a decimal point; `None` for all other values.
    pub pointless: Option<u32>,
    /// The whole word.
    pub span: Span,
}
