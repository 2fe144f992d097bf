//! Which block comes next: jumps, conditions and loops.

use super::calls::block_number;
use super::interpreter::Interpreter;
use super::routine::Routine;
use super::syntax::{Block, Jump, Statement, Then};
use super::values::number;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::words::At;
use crate::dialects::run::Next;
use crate::source::Span;

impl Interpreter<'_> {
    /// A block with IF, GOTO, WHILE, DO or END.
    pub(super) fn flow(
        &mut self,
        routine: &Routine,
        at: usize,
        block: &Block,
    ) -> Result<Next, Diagnostic> {
        let next = Next::Block(at + 1);
        // Where its partner is missing, that has been reported.
        let partner = routine.loop_at(at);
        Ok(match &block.statement {
            Statement::Goto(jump) => self.jump(jump, routine, at)?,
            Statement::If(condition, then) => match (number(condition, self)? != 0.0, then) {
                (false, _) => next,
                (true, Then::Goto(jump)) => self.jump(jump, routine, at)?,
                (true, Then::Assign(assignment)) => {
                    self.assignment(assignment, block)?;
                    next
                }
            },
            Statement::Loop(condition, _) => {
                let holds = match condition {
                    Some(condition) => number(condition, self)? != 0.0,
                    None => true,
                };
                match (holds, partner) {
                    (true, _) => next,
                    (false, Some(partner)) => Next::Block(partner.last + 1),
                    (false, None) => Next::Abort,
                }
            }
            Statement::End(_) => partner.map_or(Next::Abort, |partner| Next::Block(partner.first)),
            _ => next,
        })
    }

    fn jump(&mut self, jump: &Jump, routine: &Routine, at: usize) -> Result<Next, Diagnostic> {
        let label = block_number(At {
            value: number(&jump.number, self)?,
            span: jump.span,
        })?;
        self.label(label, jump.span, routine, at).map(Next::Block)
    }

    /// The block with this number, to which a jump or a call of this program leads.
    pub(super) fn label(
        &mut self,
        label: u32,
        span: Span,
        routine: &Routine,
        at: usize,
    ) -> Result<usize, Diagnostic> {
        let (sources, diagnostics) = (&*self.control.sources, &mut *self.control.diagnostics);
        let Some(target) = routine.label(label, at, sources, diagnostics) else {
            return Err(Diagnostic::error(
                span,
                format!("there is no block N{label} in {}", routine.name),
            )
            .help("jumps stay in their program"));
        };
        if routine.jumps_into_loop(at, target) {
            return Err(Diagnostic::error(
                span,
                format!("N{label} is inside of a loop, and this jump is not"),
            )
            .help("jump to the block with WHILE or DO"));
        }
        Ok(target)
    }
}
