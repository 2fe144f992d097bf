//! The syntax tree of a Sinumerik-like part program.

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
    /// The label before the colon, in upper case.
    pub label: Option<String>,
    /// What it says.
    pub statement: Statement,
}

/// What a block says.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Nothing but number, label or comment.
    Empty,
    /// It could not be understood; that has been reported.
    Invalid,
    /// Words: G functions, axes, feed and so on.
    Words(Vec<Word>),
    /// Values for variables.
    Assign(Vec<Assignment>),
    /// A value for a settable offset.
    SettableOffset(SettableOffset),
    /// TRANS, ROT, SCALE, MIRROR and their like.
    Frame {
        /// Which command.
        command: FrameKeyword,
        /// Its name.
        keyword: Span,
        /// Its axes and angles.
        words: Vec<Word>,
    },
    /// A subprogram, or a command in the form of one.
    Call(Call),
    /// `CALL "POCKET"`, `EXTCALL "JOB/POCKET.SPF"`: a subprogram whose name is a text.
    CallByText(Expression),
    /// `MCALL POCKET(5)`; `MCALL` alone ends it.
    ModalCall(Option<Call>),
    /// `PROC POCKET(REAL DEPTH)`: the head of a subprogram.
    Procedure(Procedure),
    /// `MSG("text")`; without a text, `MSG()` clears.
    Message(Option<Expression>),
    /// `SETAL(65000, "text")`: the program stops itself. Where the word stands.
    Alarm(Vec<Expression>, Span),
    /// `STOPRE` and others that are part of the flow but need no evaluation ahead of time.
    Nothing,
    /// A command that does not change the part.
    Noted(String),
    /// Declares variables.
    Define(Vec<Definition>),
    /// A condition, a loop or a jump.
    Flow(Flow),
}

/// Commands of the programmable frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names are the commands")]
pub enum FrameKeyword {
    Trans,
    Atrans,
    Rot,
    Arot,
    Rots,
    Arots,
    Scale,
    Ascale,
    Mirror,
    Amirror,
}

/// An address and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// The address in upper case: `X`, `CR`, `I1`.
    pub address: String,
    /// Its value.
    pub value: WordValue,
    /// The whole word.
    pub span: Span,
}

/// The value of a word.
#[derive(Clone, Debug, PartialEq)]
pub enum WordValue {
    /// As G90 or G91 say.
    Plain(Expression),
    /// `AC(..)`.
    Absolute(Expression),
    /// `IC(..)`.
    Incremental(Expression),
    /// `DC(..)`, `ACP(..)`, `ACN(..)`: to an angle by a way.
    Angle(Way, Expression),
    /// A word that is its own meaning: `SUPA`.
    None,
}

/// Which way a rotary axis or the spindle turns to an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// DC: the shorter one.
    Shorter,
    /// ACP: the positive one.
    Positive,
    /// ACN: the negative one.
    Negative,
}

/// `R1 = ..`, `NAME[2] = ..`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// Name in upper case.
    pub name: String,
    /// Indices, for an array.
    pub index: Vec<Expression>,
    /// The new value.
    pub value: Assigned,
    /// The name with its indices.
    pub span: Span,
}

/// A call.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// Name in upper case: `L10`, `POCKET`, `CYCLE81`.
    pub name: String,
    /// Where the name stands.
    pub span: Span,
    /// What stands in parentheses; `None` for one that was left out. No parentheses: empty.
    pub arguments: Vec<Option<Expression>>,
    /// `P3`.
    pub passes: Option<Expression>,
}

/// The head of a subprogram.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Procedure {
    /// What stands in parentheses.
    pub parameters: Vec<Parameter>,
    /// SAVE: the modes of the program that calls are in force again behind it.
    pub saves: bool,
}

/// A parameter of a subprogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Whether its value goes back to the variable of the call (VAR).
    pub returns: bool,
    /// Name, kind, and the value where the call gives none.
    pub definition: Definition,
}

/// One name of a `DEF`.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// Name in upper case.
    pub name: String,
    /// Where it stands.
    pub span: Span,
    /// The kind of its values.
    pub kind: VariableKind,
    /// Sizes, for an array.
    pub size: Vec<Expression>,
    /// The starting value.
    pub value: Option<Assigned>,
}

/// What a variable is given, or an array from one of its elements on.
#[derive(Clone, Debug, PartialEq)]
pub enum Assigned {
    /// A value.
    One(Expression),
    /// `SET(1, 2, , 4)`: a value each; an element without one keeps what it has.
    Set(Vec<Option<Expression>>),
    /// `REP(0)`, `REP(0, 10)`: the same for all that follow, or for so many.
    Repeat(Expression, Option<Expression>),
}

/// `$P_UIFR[1]=CTRANS(X,10)`, `$P_UIFR[1,X,TR]=10`.
#[derive(Clone, Debug, PartialEq)]
pub struct SettableOffset {
    /// 1 for G54.
    pub number: Expression,
    /// Whether it is a whole frame, and what it does not name is 0.
    pub replaces: bool,
    /// Its parts with their axes (X Y Z A B C U V W) and values.
    pub parts: Vec<(OffsetPart, Vec<(usize, Expression)>)>,
    /// The whole of it.
    pub span: Span,
}

/// A part of a settable offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OffsetPart {
    /// CTRANS, TR.
    Coarse,
    /// CFINE, FI: it is added.
    Fine,
    /// CROT, RT: degrees.
    Rotation,
}

/// The kinds of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableKind {
    /// INT: a whole number.
    Whole,
    /// REAL.
    Real,
    /// BOOL: 0 or 1.
    Truth,
    /// STRING, CHAR.
    Text,
}

/// A condition, a loop or a jump.
#[derive(Clone, Debug, PartialEq)]
pub enum Flow {
    /// `IF condition`.
    If(Expression),
    /// `IF condition GOTOF ..`.
    JumpIf(Expression, Jump),
    /// `ELSE`.
    Else,
    /// `ENDIF`.
    EndIf,
    /// `WHILE condition`.
    While(Expression),
    /// `ENDWHILE`.
    EndWhile,
    /// `FOR variable = from TO to`.
    For(Assignment, Expression),
    /// `ENDFOR`.
    EndFor,
    /// `LOOP`.
    Loop,
    /// `ENDLOOP`.
    EndLoop,
    /// `REPEAT` without a label.
    Repeat,
    /// `UNTIL condition`.
    Until(Expression),
    /// `REPEAT FIRST LAST P=2`, `REPEATB BLOCK P=2`.
    RepeatPart(RepeatPart),
    /// `GOTOF`, `GOTOB`, `GOTO`, `GOTOC`.
    Jump(Jump),
    /// `CASE value OF constant GOTOF .. DEFAULT GOTOF ..`.
    Case(Expression, Vec<(Expression, Jump)>, Option<Jump>),
}

/// A part of the program that is run again.
#[derive(Clone, Debug, PartialEq)]
pub struct RepeatPart {
    /// The label of its first block.
    pub first: Target,
    /// The label of its last block. Without one: the block of ENDLABEL or that before the statement, or
    /// with `one_block` the first itself.
    pub last: Option<Target>,
    /// REPEATB.
    pub one_block: bool,
    /// How often; once if it is left out.
    pub times: Option<Expression>,
    /// Where the labels stand.
    pub span: Span,
}

/// Where to go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Jump {
    /// Where to look for the target.
    pub direction: Direction,
    /// The target.
    pub target: Target,
    /// Where the target stands.
    pub span: Span,
}

/// Where the target of a jump is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// GOTOF: towards the end.
    Forward,
    /// GOTOB: towards the beginning.
    Backward,
    /// GOTO: towards the end, then from the beginning.
    Either,
    /// GOTOC: like GOTO; without a target the jump is left out.
    Optional,
}

/// The target of a jump.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A label, in upper case.
    Label(String),
    /// A block number.
    Number(u32),
    /// A text that names a label or a block number.
    Text(Expression),
}
