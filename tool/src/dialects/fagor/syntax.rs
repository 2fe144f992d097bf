//! The syntax tree of a Fagor part program.

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
    /// A high level statement in parentheses.
    High(HighLevel),
    /// `(SUB 10)`: a subroutine begins.
    Subroutine(u32),
}

/// A statement in parentheses.
#[derive(Clone, Debug, PartialEq)]
pub enum HighLevel {
    /// `(P1 = 5, P2 = P1 + 3)`.
    Assign(Vec<Assignment>),
    /// `(IF condition statement ELSE statement)`.
    If(Expression, Box<HighLevel>, Option<Box<HighLevel>>),
    /// `(GOTO N10)`.
    Goto(Label),
    /// `(RPT N10,N20) N3`.
    Repeat {
        /// The first block.
        first: Label,
        /// The last block.
        last: Label,
        /// How often; once if it is left out.
        times: Option<Expression>,
        /// The whole statement.
        span: Span,
    },
    /// `(CALL 10)`, `(PCALL 10, A=1)`, `(MCALL 10, A=1)`.
    Call(Call),
    /// `(MDOFF)`.
    ModalOff,
    /// `(RET)`.
    Return(Span),
    /// `(MSG "text")`.
    Message(String),
    /// `(ERROR 5, "text")`.
    Error(Option<Expression>, String, Span),
}

/// The number of a block that is jumped to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Label {
    /// The number.
    pub number: u32,
    /// Where it is named.
    pub span: Span,
}

/// The three ways to call a subroutine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CallKind {
    /// CALL: with the parameters of the caller.
    Plain,
    /// PCALL: with parameters of its own.
    Parameters,
    /// MCALL: at once and after each motion that follows, with parameters of its own. N at the end of the
    /// motion says how often.
    Modal,
}

/// A call.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// How.
    pub kind: CallKind,
    /// The number of the subroutine.
    pub number: Expression,
    /// Values of its local parameters.
    pub arguments: Vec<Assignment>,
    /// The keyword and the number.
    pub span: Span,
}

/// `P1 = ..`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// The number of the parameter.
    pub parameter: Expression,
    /// The new value.
    pub value: Expression,
    /// The parameter.
    pub span: Span,
}

/// An address and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// The address in upper case.
    pub letter: char,
    /// Its value; only axes of G11 to G14 may have none.
    pub value: Option<Expression>,
    /// The digits of a plain number as they stand there: `5.10` of `T5.10`.
    pub digits: String,
    /// The whole word.
    pub span: Span,
}

impl Word {
    /// Whether this is the G function of a pattern, G60 to G65.
    pub fn is_pattern(&self) -> bool {
        self.letter == 'G' && matches!(self.digits.parse(), Ok(60..=65))
    }
    /// Whether this is G66, whose letters name blocks.
    pub fn is_irregular_pocket(&self) -> bool {
        self.letter == 'G' && self.digits.parse() == Ok(66)
    }
}
