//! Subroutines and repetitions.

use super::block_words::BlockWords;
use super::interpreter::{Interpreter, times};
use super::parameters::checked;
use super::routine::{Routine, defines, subroutine_name};
use super::syntax::{Block, Call, CallKind, Label};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::calls::CallRules;
use crate::dialects::control::words::At;
use crate::dialects::run::Next;
use crate::source::Span;
use std::rc::Rc;

const RULES: CallRules = CallRules {
    nesting: 15,
    passes: 9999,
    instead_of_recursion: "repeat with (RPT N10,N20) N3 or with IF and GOTO",
};

/// How many RPT may be inside each other.
const REPEAT_NESTING: usize = 15;

/// A subroutine that runs at once and then after each motion.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalCall {
    number: u32,
    arguments: Vec<(u32, f64)>,
    span: Span,
    running: bool,
}

impl Interpreter<'_> {
    /// CALL, PCALL, MCALL.
    pub(super) fn call(
        &mut self,
        call: &Call,
        block: &Block,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        self.control.finish_block(&block.place);
        let number = call.number.whole(&self.parameters, 0)?;
        let mut arguments = Vec::new();
        for argument in &call.arguments {
            let parameter = argument.parameter.number(&self.parameters)?;
            let value = argument.value.number(&self.parameters)?;
            arguments.push((checked(parameter, argument.span)?, value));
        }
        if call.kind == CallKind::Modal {
            self.subroutine(number, call.span)?;
            self.modal_call = Some(ModalCall {
                number,
                arguments,
                span: call.span,
                running: false,
            });
            // It runs here as well, as PCALL would.
            return Ok(self.run_modal_call(1, block, at));
        }
        let arguments = (call.kind == CallKind::Parameters).then_some(arguments.as_slice());
        self.run_subroutine([number, 1], arguments, call.span, block, at)
    }

    /// How often the modal subroutine runs behind a block: N at its end, which is taken out of it.
    pub(super) fn modal_passes(
        &mut self,
        words: &mut BlockWords,
    ) -> Result<Option<At<u32>>, Diagnostic> {
        let calls = self.modal_call.as_ref().is_some_and(|call| !call.running);
        let Some(word) = words.times.filter(|_| calls) else {
            return Ok(None);
        };
        let is_cycle = |g: &At<u32>| matches!(g.value, 69 | 79 | 81..=89);
        if self.cycle.is_some() || words.g.iter().any(is_cycle) {
            return Err(Diagnostic::error(
                word.span,
                "N repeats a canned cycle or a modal subroutine, and both are in force",
            )
            .help("end one of them before, with G80 or (MDOFF)"));
        }
        words.times = None;
        let (value, span) = (times(word)?, word.span);
        Ok(Some(At { value, span }))
    }

    /// The modal subroutine after a motion, `passes` times. What it moves itself does not call it again.
    pub(super) fn run_modal_call(&mut self, passes: u32, block: &Block, at: usize) -> Next {
        let next = Next::Block(at + 1);
        let Some(modal) = self.modal_call.clone().filter(|modal| !modal.running) else {
            return next;
        };
        if let Some(modal) = &mut self.modal_call {
            modal.running = true;
        }
        let called = [modal.number, passes];
        let done = self.run_subroutine(called, Some(&modal.arguments), modal.span, block, at);
        if let Some(modal) = &mut self.modal_call {
            modal.running = false;
        }
        done.unwrap_or_else(|diagnostic| {
            self.control.fail(diagnostic);
            next
        })
    }

    fn subroutine(&mut self, number: u32, span: Span) -> Result<Rc<Routine>, Diagnostic> {
        let name = subroutine_name(number);
        let found = self.library.find_defined(
            &name,
            defines,
            span,
            self.control.sources,
            self.control.diagnostics,
        );
        found.ok_or_else(|| {
            Diagnostic::error(span, format!("the subroutine {number} was not found")).help(format!(
                "it is looked for as (SUB {number}) .. (RET) in this file, in the program \
                         files beside it and in the folders of --subprograms"
            ))
        })
    }

    /// Runs the subroutine of a number so many times. With `arguments`, it gets local parameters of its own,
    /// which a pass leaves to the next as they are then.
    fn run_subroutine(
        &mut self,
        [number, passes]: [u32; 2],
        arguments: Option<&[(u32, f64)]>,
        span: Span,
        block: &Block,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        let routine = self.subroutine(number, span)?;
        self.control
            .check_call(&routine.name, passes, span, &RULES)?;
        let place = &block.place;
        if let Some(arguments) = arguments {
            self.parameters.enter(arguments);
        }
        let mut end = Next::Return;
        for pass in 1..=passes {
            if pass > 1 && !self.control.count_block(place.span) {
                end = Next::Abort;
                break;
            }
            self.control
                .enter(&routine.name, routine.file, [pass, passes], place);
            end = self.run_blocks(&routine, 0, routine.blocks.len());
            self.control.leave(&routine.name, place);
            if !matches!(end, Next::Block(_) | Next::Return) {
                break;
            }
        }
        if arguments.is_some() {
            self.parameters.leave();
        }
        Ok(match end {
            Next::Block(_) | Next::Return => Next::Block(at + 1),
            other => other,
        })
    }

    /// `(RPT N10,N20) N3`.
    pub(super) fn repeat(
        &mut self,
        routine: &Rc<Routine>,
        labels: [Label; 2],
        times: u32,
        span: Span,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        let [first, last] = labels.map(|label| self.find_label(routine, label, at));
        let (first, last) = (first?, last?);
        if last < first {
            return Err(Diagnostic::error(
                labels[1].span,
                "the last block stands before the first one",
            )
            .help("write (RPT N10,N20) with the block first that comes first"));
        }
        if (first..=last).contains(&at) || self.repeats.contains(&span) {
            return Err(
                Diagnostic::error(span, "these blocks contain the repetition itself")
                    .help("let the repeated blocks end before it"),
            );
        }
        if self.repeats.len() >= REPEAT_NESTING {
            return Err(Diagnostic::error(
                span,
                format!("more than {REPEAT_NESTING} repetitions inside each other"),
            ));
        }
        if times > RULES.passes {
            return Err(Diagnostic::error(
                span,
                format!("{times} passes are more than the control allows (9999)"),
            ));
        }
        self.repeats.push(span);
        let mut end = Next::Block(at + 1);
        for _ in 0..times {
            end = self.run_blocks(routine, first, last + 1);
            if !matches!(end, Next::Block(_)) {
                break;
            }
        }
        self.repeats.pop();
        Ok(match end {
            Next::Block(_) => Next::Block(at + 1),
            other => other,
        })
    }
}
