//! Which block comes next: conditions, loops and jumps.

use super::interpreter::Interpreter;
use super::routine::Routine;
use super::syntax::{Assignment, Direction, Flow, Jump, RepeatPart, Statement, Target};
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Expression, ExpressionKind, Value, Variables};
use crate::dialects::run::Next;
use std::rc::Rc;

/// How often a part can be repeated by one statement.
const MOST_REPEATS: u32 = 9999;

impl Interpreter<'_> {
    pub(super) fn flow(
        &mut self,
        flow: &Flow,
        routine: &Rc<Routine>,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        // A missing partner has been reported when the file was read.
        let Some(after_partner) = self.after_partner(flow, routine, at) else {
            return Ok(Next::Abort);
        };
        let next = Next::Block(at + 1);
        Ok(match flow {
            Flow::If(condition) | Flow::While(condition) => match self.holds(condition)? {
                true => next,
                false => Next::Block(after_partner),
            },
            Flow::Else => Next::Block(after_partner),
            Flow::EndIf | Flow::Loop | Flow::Repeat => next,
            Flow::EndWhile | Flow::EndLoop => Next::Block(after_partner - 1),
            Flow::Until(condition) => match self.holds(condition)? {
                true => next,
                false => Next::Block(after_partner),
            },
            Flow::For(start, last) => {
                self.assign(std::slice::from_ref(start))?;
                self.for_pass(start, last, at + 1, after_partner)?
            }
            Flow::EndFor => self.end_for(routine, at, after_partner)?,
            Flow::JumpIf(condition, jump) => match self.holds(condition)? {
                true => self.jump(jump, routine, at)?,
                false => next,
            },
            Flow::Jump(jump) => self.jump(jump, routine, at)?,
            Flow::RepeatPart(part) => self.repeat(part, routine, at)?,
            Flow::Case(value, cases, default) => {
                let value = value.evaluate(&self.variables)?;
                for (constant, jump) in cases {
                    if constant.evaluate(&self.variables)? == value {
                        return self.jump(jump, routine, at);
                    }
                }
                match default {
                    Some(jump) => self.jump(jump, routine, at)?,
                    None => next,
                }
            }
        })
    }

    /// Index of the block after the partner; for flow without partner, any.
    fn after_partner(&self, flow: &Flow, routine: &Routine, at: usize) -> Option<usize> {
        match flow {
            Flow::JumpIf(..) | Flow::Jump(_) | Flow::Case(..) | Flow::RepeatPart(_) => Some(0),
            _ => routine.structure.partner(at).map(|partner| partner + 1),
        }
    }

    /// Runs a part of the program again.
    fn repeat(
        &mut self,
        part: &RepeatPart,
        routine: &Rc<Routine>,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        if self.repeats.contains(&part.span) {
            return Err(Diagnostic::error(
                part.span,
                "this repetition is among the blocks that it repeats",
            )
            .help("let the part end before it"));
        }
        let missing = |what: &str| {
            Diagnostic::error(part.span, format!("there is no {what} for this repetition"))
                .help("labels are written NAME: at the beginning of a block")
        };
        // The label nearest before the statement, else the first one behind it.
        let nearest = |targets: Vec<usize>| {
            let before = targets.partition_point(|place| *place < at);
            let before = before.checked_sub(1).and_then(|last| targets.get(last));
            before.or(targets.first()).copied()
        };
        let first = nearest(self.targets(&part.first, routine)).ok_or_else(|| missing("label"))?;
        let end_label = Target::Label("ENDLABEL".to_string());
        let end = match &part.last {
            _ if part.one_block => first + 1,
            Some(last) => {
                let mut places = self.targets(last, routine).into_iter();
                let last = places.find(|last| *last >= first);
                last.ok_or_else(|| missing("last label"))? + 1
            }
            None => {
                let mut ends = self.targets(&end_label, routine).into_iter();
                let end = ends.find(|end| *end > first && (*end < at || first > at));
                match end {
                    // What stands behind ENDLABEL in its block is repeated too.
                    Some(end) => end + 1,
                    None if first < at => at,
                    None => return Err(missing("ENDLABEL")),
                }
            }
        };
        let times = match &part.times {
            Some(times) => times.whole(&self.variables, 0)?,
            None => 1,
        };
        if times > MOST_REPEATS {
            let message = format!("{times} repetitions are more than the control allows");
            return Err(Diagnostic::error(part.span, message));
        }
        self.repeats.push(part.span);
        let mut next = Next::Block(end);
        for _ in 0..times {
            next = self.run_range(routine, first..end);
            if !matches!(next, Next::Block(_)) {
                break;
            }
        }
        self.repeats.pop();
        Ok(match next {
            Next::Block(_) => Next::Block(at + 1),
            other => other,
        })
    }

    fn holds(&self, condition: &Expression) -> Result<bool, Diagnostic> {
        Ok(condition.number(&self.variables)? != 0.0)
    }

    fn for_pass(
        &self,
        start: &Assignment,
        last: &Expression,
        body: usize,
        after: usize,
    ) -> Result<Next, Diagnostic> {
        let value = self.loop_variable(start)?;
        let last = last.number(&self.variables)?;
        Ok(Next::Block(if value <= last { body } else { after }))
    }

    fn loop_variable(&self, start: &Assignment) -> Result<f64, Diagnostic> {
        let variable = Expression {
            kind: ExpressionKind::Variable(start.name.clone(), start.index.clone()),
            span: start.span,
        };
        variable.number(&self.variables)
    }

    /// Counts up and tests again. The end is evaluated in each pass, as the control does.
    fn end_for(&mut self, routine: &Routine, at: usize, body: usize) -> Result<Next, Diagnostic> {
        let beginning = self.control.block(&routine.blocks, body - 1);
        let Some(Statement::Flow(Flow::For(start, last))) =
            beginning.as_ref().map(|block| &block.statement)
        else {
            return Ok(Next::Abort);
        };
        let value = Value::Number(self.loop_variable(start)? + 1.0);
        let index: Result<Vec<f64>, _> = start
            .index
            .iter()
            .map(|index| index.number(&self.variables))
            .collect();
        self.variables
            .assign(&start.name, &index?, value, start.span)?;
        self.for_pass(start, last, body, at + 1)
    }

    pub(super) fn targets(&mut self, target: &Target, routine: &Routine) -> Vec<usize> {
        let control = &mut self.control;
        routine.targets(target, control.sources, control.diagnostics)
    }

    fn jump(&mut self, jump: &Jump, routine: &Routine, at: usize) -> Result<Next, Diagnostic> {
        let named = self.named_by_text(jump, routine)?;
        let targets = self.targets(named.as_ref().unwrap_or(&jump.target), routine);
        // Those up to this block, and those after it.
        let (before, after) = targets.split_at(targets.partition_point(|target| *target <= at));
        let forward = after.first().copied();
        let backward = before.last().copied();
        let found = match jump.direction {
            Direction::Forward => forward,
            Direction::Backward => backward,
            Direction::Either | Direction::Optional => forward.or(before.first().copied()),
        };
        match (found, jump.direction) {
            (Some(target), _) => Ok(Next::Block(target)),
            (None, Direction::Optional) => Ok(Next::Block(at + 1)),
            (None, _) => {
                let error =
                    Diagnostic::error(jump.span, "there is no such label in this direction");
                Err(match forward.or(backward) {
                    Some(_) => {
                        error.help("GOTOF looks towards the end, GOTOB towards the beginning")
                    }
                    None if named.is_some() => error.help(format!(
                        "the text is here {}: labels are written NAME: at the beginning of a block, block numbers N100",
                        shown(named.as_ref())
                    )),
                    None => error.help("labels are written NAME: at the beginning of a block"),
                })
            }
        }
    }

    /// The target that a text names: `GOTOF "N" << R10`, or GOTOF with a variable that is a text. `None` where the
    /// jump names it itself.
    fn named_by_text(&self, jump: &Jump, routine: &Routine) -> Result<Option<Target>, Diagnostic> {
        let value = match &jump.target {
            Target::Number(_) => return Ok(None),
            Target::Text(text) => text.evaluate(&self.variables)?,
            Target::Label(name) => match self.variables.value(name, &[], jump.span) {
                Ok(Value::Text(_)) if routine.has_label(name) => {
                    let message = format!(
                        "{name} is a label and a text: which of them is meant is not known"
                    );
                    return Err(
                        Diagnostic::error(jump.span, message).help("give one of them another name")
                    );
                }
                Ok(value) if !routine.has_label(name) => value,
                _ => return Ok(None),
            },
        };
        match value {
            Value::Text(text) => Ok(Some(target_of(&text))),
            Value::Number(_) => Err(Diagnostic::error(
                jump.span,
                "the target of a jump is a label, a block number or a text, and this is a number",
            )
            .help(
                "for the block whose number it is, write \"N\" and << before it: GOTOF \"N\"<<R10",
            )),
        }
    }
}

/// What a text names.
pub(super) fn target_of(text: &str) -> Target {
    let name = text.trim().to_ascii_uppercase();
    let digits = name.strip_prefix(['N', ':']);
    let digits = digits.filter(|digits| digits.bytes().all(|digit| digit.is_ascii_digit()));
    match digits.and_then(|digits| digits.parse().ok()) {
        Some(number) => Target::Number(number),
        None => Target::Label(name),
    }
}

fn shown(target: Option<&Target>) -> String {
    match target {
        Some(Target::Number(number)) => format!("N{number}"),
        Some(Target::Label(name)) => format!("\"{name}\""),
        _ => String::new(),
    }
}
