//! Which block comes next: conditions, loops and jumps.

use super::interpreter::Interpreter;
use super::structure::Links;
use super::syntax::{Assignment, Flow, Jump, Routine, Statement, Target};
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Expression, Variables};
use crate::dialects::run::Next;

/// Values that differ by less are the same to `$SWITCH`.
const SAME_CASE: f64 = 0.001;

/// Conditions hold from this absolute value on.
const TRUE: f64 = 0.5;

impl Interpreter<'_> {
    pub(super) fn flow(
        &mut self,
        flow: &Flow,
        routine: &Routine,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        let links = routine.structure.links(at);
        let body = Next::Block(at + 1);
        Ok(match flow {
            Flow::Jump(jump) => self.jump(jump, routine)?,
            Flow::JumpIf(condition, jump) => match self.holds(condition)? {
                true => self.jump(jump, routine)?,
                false => body,
            },
            Flow::If(condition) => match self.holds(condition)? {
                true => body,
                false => self.branch(routine, links.next)?,
            },
            // Reached from above: the branch before it has run.
            Flow::ElseIf(_) | Flow::Else => after(links.last),
            Flow::EndIf | Flow::EndSwitch | Flow::Do | Flow::Repeat => body,
            Flow::For(first, last, step) => {
                let index = self.numbers(&first.index)?;
                let value = first.value.number(&self.variables)?;
                self.variables
                    .assign(&first.name, &index, value, first.span)?;
                self.counting(value, last, step.as_ref(), body, links)?
            }
            Flow::EndFor => self.end_for(routine, links)?,
            Flow::While(condition) => match self.holds(condition)? {
                true => body,
                false => after(links.last),
            },
            Flow::EndWhile => links.first.map_or(Next::Abort, Next::Block),
            Flow::EndDo(condition) => match self.holds(condition)? {
                true => after(links.first),
                false => body,
            },
            Flow::Until(condition) => match self.holds(condition)? {
                true => body,
                false => after(links.first),
            },
            Flow::Switch(value) => self.switch(value, routine, links)?,
            Flow::Case(_) | Flow::Default => {
                let block = self.control.block(&routine.blocks, at);
                let span = block.map(|block| block.place.span);
                let span = span.unwrap_or(routine_span(routine));
                return Err(
                    Diagnostic::error(span, "the $CASE before this one does not end")
                        .help("end it with $BREAK"),
                );
            }
            Flow::Break => after(links.last),
            Flow::Continue => links.last.map_or(Next::Abort, Next::Block),
        })
    }

    fn holds(&self, condition: &Expression) -> Result<bool, Diagnostic> {
        Ok(condition.number(&self.variables)?.abs() >= TRUE)
    }

    /// From an `$IF` that does not hold to the first of its other branches that does.
    fn branch(&mut self, routine: &Routine, next: Option<usize>) -> Result<Next, Diagnostic> {
        let mut next = next;
        while let Some(at) = next {
            let block = self.control.block(&routine.blocks, at);
            match block.as_ref().map(|block| &block.statement) {
                Some(Statement::Flow(Flow::ElseIf(condition))) => {
                    if self.holds(condition)? {
                        return Ok(Next::Block(at + 1));
                    }
                    next = routine.structure.links(at).next;
                }
                _ => return Ok(Next::Block(at + 1)),
            }
        }
        // The missing partner has been reported when the file was read.
        Ok(Next::Abort)
    }

    fn switch(
        &mut self,
        value: &Expression,
        routine: &Routine,
        links: Links,
    ) -> Result<Next, Diagnostic> {
        let value = value.number(&self.variables)?;
        let mut default = None;
        let mut next = links.next;
        while let Some(at) = next {
            let block = self.control.block(&routine.blocks, at);
            match block.as_ref().map(|block| &block.statement) {
                Some(Statement::Flow(Flow::Case(case))) => {
                    if (case.number(&self.variables)? - value).abs() < SAME_CASE {
                        return Ok(Next::Block(at + 1));
                    }
                }
                Some(Statement::Flow(Flow::Default)) => default = Some(at),
                _ => break,
            }
            next = routine.structure.links(at).next;
        }
        Ok(match default {
            Some(at) => Next::Block(at + 1),
            None => after(links.last),
        })
    }

    /// Whether a counting loop runs (again) with this value of its variable.
    fn counting(
        &self,
        value: f64,
        last: &Expression,
        step: Option<&Expression>,
        body: Next,
        links: Links,
    ) -> Result<Next, Diagnostic> {
        let step = self.step(step)?;
        let last = last.number(&self.variables)?;
        // Steps such as 0.1 add up with rounding.
        let within = (last - value) * step.signum() >= -1e-9 * step.abs();
        Ok(if within { body } else { after(links.last) })
    }

    fn step(&self, step: Option<&Expression>) -> Result<f64, Diagnostic> {
        let Some(step) = step else {
            return Ok(1.0);
        };
        let value = step.number(&self.variables)?;
        if value == 0.0 {
            return Err(Diagnostic::error(
                step.span,
                "with a step of 0 this loop never ends",
            ));
        }
        Ok(value)
    }

    fn end_for(&mut self, routine: &Routine, links: Links) -> Result<Next, Diagnostic> {
        let Some(first) = links.first else {
            return Ok(Next::Abort);
        };
        let block = self.control.block(&routine.blocks, first);
        let Some(Statement::Flow(Flow::For(variable, last, step))) =
            block.as_ref().map(|block| &block.statement)
        else {
            return Ok(Next::Abort);
        };
        let Assignment {
            name, index, span, ..
        } = variable;
        let index = self.numbers(index)?;
        let old = self.variables.value(name, &index, *span)?;
        let crate::dialects::expression::Value::Number(old) = old else {
            return Ok(Next::Abort);
        };
        let value = old + self.step(step.as_ref())?;
        self.variables.assign(name, &index, value, *span)?;
        self.counting(
            value,
            last,
            step.as_ref(),
            Next::Block(first + 1),
            routine.structure.links(first),
        )
    }

    fn jump(&mut self, jump: &Jump, routine: &Routine) -> Result<Next, Diagnostic> {
        let control = &mut self.control;
        let numbered;
        let found = match &jump.target {
            Target::Label(label) => routine.labels.get(label).map_or(&[][..], Vec::as_slice),
            Target::Number(number) => {
                let blocks = &routine.blocks;
                numbered = blocks.numbered(*number, control.sources, control.diagnostics);
                &numbered
            }
        };
        match found {
            [target] => Ok(Next::Block(*target)),
            [_, _, ..] => Err(Diagnostic::error(
                jump.span,
                "several blocks have this number or label",
            )
            .help("give the target of the jump a number of its own")),
            [] => Err(
                Diagnostic::error(jump.span, "there is no such block in this program")
                    .help("the target begins with N10 or with [NAME]"),
            ),
        }
    }
}

/// The block after this one.
fn after(index: Option<usize>) -> Next {
    index.map_or(Next::Abort, |index| Next::Block(index + 1))
}

fn routine_span(routine: &Routine) -> crate::source::Span {
    crate::dialects::library::Routine::first_span(routine)
}
