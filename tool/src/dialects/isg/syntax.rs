//! The syntax tree of an ISG part program.

use super::structure::Structure;
use crate::diagnostics::Diagnostics;
use crate::dialects::blocks::{self, Blocks};
use crate::dialects::control::Place;
use crate::dialects::expression::Expression;
use crate::dialects::library;
use crate::source::{Sources, Span};
use std::collections::HashMap;
use std::io;

/// One block.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its text, number and comment.
    pub place: Place,
    /// Whether it begins with `/`.
    pub skip: bool,
    /// `[NAME]` at its beginning, in upper case.
    pub label: Option<String>,
    /// What it says.
    pub statement: Statement,
}

/// What a block says.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Nothing.
    Empty,
    /// Something that was not understood; that has been reported.
    Invalid,
    /// Words and values for variables, in their order.
    Items(Vec<Item>),
    /// `LL NAME`, `L file`.
    Call(Call),
    /// `$IF` and the like.
    Flow(Flow),
    /// `#MSG` and the like.
    Command(Command),
    /// Lines between `#VAR` and `#ENDVAR`.
    Declare(Declaration),
}

/// A piece of an ordinary block.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// An address and its value.
    Word(Word),
    /// A value for a variable.
    Assign(Assignment),
}

/// An address and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// The letter, in upper case.
    pub address: char,
    /// `X10`: 10.
    pub value: Expression,
    /// `G159=2`: 2.
    pub second: Option<Expression>,
    /// Where the word stands.
    pub span: Span,
}

/// `P1 = ..`, `V.P.NAME[2] = ..`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// `P`, `V.P.NAME`.
    pub name: String,
    /// The number of the parameter, or the indices.
    pub index: Vec<Expression>,
    /// The new value.
    pub value: Expression,
    /// The variable.
    pub span: Span,
}

/// A call of a subprogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// Whether it is `LL`: in the same file.
    pub local: bool,
    /// The name, or the name of the file, in upper case.
    pub name: String,
    /// Where the name stands.
    pub span: Span,
}

/// A condition, a loop or a jump.
#[derive(Clone, Debug, PartialEq)]
pub enum Flow {
    If(Expression),
    JumpIf(Expression, Jump),
    ElseIf(Expression),
    Else,
    EndIf,
    /// Variable with its first value, last value, step.
    For(Assignment, Expression, Option<Expression>),
    EndFor,
    While(Expression),
    EndWhile,
    Do,
    EndDo(Expression),
    Repeat,
    Until(Expression),
    Switch(Expression),
    Case(Expression),
    Default,
    EndSwitch,
    Break,
    Continue,
    Jump(Jump),
}

/// `$GOTO N10`, `$GOTO [NAME]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Jump {
    /// Where it leads.
    pub target: Target,
    /// Where that stands.
    pub span: Span,
}

/// The target of a jump.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A block number.
    Number(u32),
    /// A label, in upper case.
    Label(String),
}

/// A command that begins with `#`.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// `#MSG ["text %f", value]`.
    Message(String, Vec<Expression>),
    /// `#HSC ON [CONTERROR 0.1]`: whether it is switched, and its parameters.
    Smoothing(Option<bool>, Vec<Parameter>),
    /// `#CONTOUR MODE ON [DEV PATH_DEV=0.1]`: likewise; `None` for parameters of another form.
    Contouring(Option<bool>, Option<Vec<Parameter>>),
    /// `#CS DEF [1] [0,0,10,0,30,0]`.
    DefineSystem(Option<Expression>, Vec<Option<Expression>>),
    /// `#CS ON [1] [0,0,10,0,30,0]`.
    SystemOn(Option<Expression>, Option<Vec<Option<Expression>>>),
    /// `#CS OFF`, `#CS OFF ALL`.
    SystemOff {
        /// Whether all are taken off.
        all: bool,
    },
    /// `#ROTATION ON [ANGLE 30]`.
    RotationOn(Vec<Parameter>),
    /// `#ROTATION OFF`.
    RotationOff,
    /// `#TIME 2`.
    Dwell(Expression),
    /// Commands that only tune the control.
    Noted(String),
}

/// A parameter of a command: `CONTERROR=0.1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name in upper case.
    pub name: String,
    /// The value, if it has one.
    pub value: Option<Expression>,
    /// Where the name stands.
    pub span: Span,
}

/// `V.L.NAME[3] : REAL64 = 5`.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// `V.L.NAME`.
    pub name: String,
    /// Sizes, for an array.
    pub size: Vec<Expression>,
    /// The least and the greatest value, where the values are whole numbers.
    pub whole: Option<[f64; 2]>,
    /// First values, one or as many as elements.
    pub values: Vec<Expression>,
    /// The name.
    pub span: Span,
}

/// A program or subprogram.
#[derive(Debug)]
pub struct Routine {
    /// What calls look for: `3:NAME` of a subprogram in the file with index 3, or the name of the file.
    pub name: String,
    /// What messages call it.
    pub title: String,
    /// Whether it is a main program.
    pub main: bool,
    /// Index of its file.
    pub file: usize,
    /// Its blocks.
    pub blocks: Blocks<Block>,
    /// Which blocks of it belong together.
    pub structure: Structure,
    /// The blocks with each label, in upper case.
    pub labels: HashMap<String, Vec<usize>>,
    /// Whether it has a `#CS ON`: frames turn the machine then, those before it too.
    pub turns_machine: bool,
    /// The first block that says something, if there is one.
    pub first: Option<Span>,
}

impl blocks::Block for Block {
    fn place(&self) -> &Place {
        &self.place
    }

    fn is_blank(&self) -> bool {
        let nothing =
            self.place.number.is_none() && self.label.is_none() && self.place.comment.is_none();
        self.statement == Statement::Empty && nothing
    }

    fn is_invalid(&self) -> bool {
        self.statement == Statement::Invalid
    }
}

impl library::Routine for Routine {
    fn title(&self) -> &str {
        &self.title
    }

    fn check_rest(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> io::Result<()> {
        self.blocks.check_rest(sources, diagnostics)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn is_main(&self) -> bool {
        self.main
    }

    fn is_empty(&self) -> bool {
        self.first.is_none()
    }

    fn first_span(&self) -> Span {
        self.first.unwrap_or(Span::start_of(self.file))
    }
}
