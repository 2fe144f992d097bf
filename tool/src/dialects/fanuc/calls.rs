//! Subprograms (M97, M98, M99) and macros (G65, G66, G67).

use super::arguments::locals;
use super::block_words::BlockWords;
use super::interpreter::{Interpreter, Outcome};
use super::routine::{Routine, program_name};
use super::syntax::{Block, Word};
use super::values::number;
use super::variables::Locals;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::calls::CallRules;
use crate::dialects::control::words::At;
use crate::dialects::run::{Interpret, Next};
use crate::dialects::settings::DecimalPoint;
use crate::source::Span;
use std::rc::Rc;

const RULES: CallRules = CallRules {
    nesting: 15,
    passes: 9999,
    instead_of_recursion: "repeat with L, or with WHILE[..]DO1 .. END1",
};

/// Programs with a number of more digits are called with L only.
const DIGITS: u32 = 4;

/// What is called, and how often.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Call {
    /// That of a program, or with `local` of a block of this one.
    number: u32,
    /// M97 of Haas controls.
    local: bool,
    passes: u32,
    span: Span,
}

/// G65, or G66 with `modal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MacroCall {
    modal: bool,
    span: Span,
}

/// A macro that runs after each motion (G66).
#[derive(Clone, Debug, PartialEq)]
pub struct ModalMacro {
    call: Call,
    /// Its variables keep their values from one run to the next.
    locals: Locals,
    running: bool,
}

/// The words before the call of a macro, and the call with those behind it.
pub type Split<'w> = (&'w [Word], Option<(MacroCall, &'w [Word])>);

impl Interpreter<'_> {
    /// Parts the words of a block before G65 or G66 from the arguments behind.
    pub(super) fn split_macro_call<'w>(&self, list: &'w [Word]) -> Result<Split<'w>, Diagnostic> {
        for (at, word) in list
            .iter()
            .enumerate()
            .filter(|(_, word)| word.letter == 'G')
        {
            let code = number(&word.value, self)?;
            if code == 66.1 {
                return Err(Diagnostic::error(word.span, "G66.1 is not supported")
                    .help("G66 calls the macro after each motion; or write G65 in each block"));
            }
            if code == 65.0 || code == 66.0 {
                let call = MacroCall {
                    modal: code == 66.0,
                    span: word.span,
                };
                let arguments = list.get(at + 1..).unwrap_or(&[]);
                return Ok((list.get(..at).unwrap_or(&[]), Some((call, arguments))));
            }
        }
        Ok((list, None))
    }

    /// G65 and G66.
    pub(super) fn macro_call(
        &mut self,
        call: MacroCall,
        words: &[Word],
        routine: &Rc<Routine>,
        at: usize,
        block: &Block,
    ) -> Result<Next, Diagnostic> {
        let is_call = |word: &&Word| matches!(word.letter, 'P' | 'L') && !word.comma;
        let (how, arguments): (Vec<&Word>, Vec<&Word>) = words.iter().partition(is_call);
        let mut values = [None; 2];
        for word in how {
            let place = &mut values[usize::from(word.letter == 'L')];
            let value = number(&word.value, self)?;
            if place
                .replace(At {
                    value,
                    span: word.span,
                })
                .is_some()
            {
                return Err(Diagnostic::error(
                    word.span,
                    format!("{} is in this block twice", word.letter),
                ));
            }
        }
        let [program, passes] = values;
        let Some(program) = program else {
            return Err(
                Diagnostic::error(call.span, "the number of the macro is missing")
                    .help("write G65 P9010 A1. B2."),
            );
        };
        let target = Call {
            number: program_number(program)?,
            local: false,
            passes: passes.map_or(Ok(1), whole_passes)?,
            span: call.span,
        };
        let increments = self.control.settings.decimal_point == DecimalPoint::Increments;
        let arguments: Vec<Word> = arguments.into_iter().cloned().collect();
        let locals = locals(&arguments, self, increments)?;
        if !call.modal {
            return self
                .run_program(target, Some(locals), routine, at, block)
                .map(|(next, _)| next);
        }
        if self.modal_macro.is_some() {
            return Err(
                Diagnostic::error(call.span, "G66 while another macro is called by G66")
                    .help("end it with G67 before"),
            );
        }
        self.routine(target.number, target.span)?;
        self.modal_macro = Some(ModalMacro {
            call: target,
            locals,
            running: false,
        });
        Ok(Next::Block(at + 1))
    }

    /// The macro of G66 after a motion. What it moves itself does not call it again.
    pub(super) fn run_modal_macro(
        &mut self,
        routine: &Rc<Routine>,
        at: usize,
        block: &Block,
    ) -> Next {
        let next = Next::Block(at + 1);
        let Some(modal) = self.modal_macro.as_mut().filter(|modal| !modal.running) else {
            return next;
        };
        modal.running = true;
        let (call, locals) = (modal.call, modal.locals.clone());
        let done = self.run_program(call, Some(locals), routine, at, block);
        let done = done.map(|(next, locals)| {
            if let Some(modal) = &mut self.modal_macro {
                modal.locals = locals;
            }
            next
        });
        if let Some(modal) = &mut self.modal_macro {
            modal.running = false;
        }
        done.unwrap_or_else(|diagnostic| {
            self.control.fail(diagnostic);
            next
        })
    }

    /// M97 and M98.
    pub(super) fn subprogram(
        &mut self,
        call: Call,
        routine: &Rc<Routine>,
        at: usize,
        block: &Block,
    ) -> Result<Next, Diagnostic> {
        self.run_program(call, None, routine, at, block)
            .map(|(next, _)| next)
    }

    /// With `locals`, the program is a macro with local variables of its own; they are given back.
    fn run_program(
        &mut self,
        call: Call,
        locals: Option<Locals>,
        caller: &Rc<Routine>,
        at: usize,
        block: &Block,
    ) -> Result<(Next, Locals), Diagnostic> {
        let (routine, first, name) = self.callee(call, caller, at)?;
        self.control
            .check_call(&name, call.passes, call.span, &RULES)?;
        let place = &block.place;
        let mut end = Next::Block(at + 1);
        let mut left = Locals::new();
        for pass in 1..=call.passes {
            let passes = [pass, call.passes];
            self.control.enter(&name, routine.file, passes, place);
            if let Some(locals) = &locals {
                self.variables.enter(locals.clone());
            }
            end = self.run_routine(&routine, first);
            if let Next::Block(_) = end {
                self.end_is_missing(&routine);
            }
            if locals.is_some() {
                left = self.variables.leave();
            }
            self.control.leave(&name, place);
            if !matches!(end, Next::Block(_) | Next::Return) {
                return Ok((end, left));
            }
            if self.return_to.is_some() {
                break;
            }
        }
        let next = match (end, self.return_to.take()) {
            (_, Some((label, span))) => Next::Block(self.label(label, span, caller, at)?),
            _ => Next::Block(at + 1),
        };
        Ok((next, left))
    }

    /// The program that a call leads to, the first of its blocks that runs, and the name of both.
    fn callee(
        &mut self,
        call: Call,
        caller: &Rc<Routine>,
        at: usize,
    ) -> Result<(Rc<Routine>, usize, String), Diagnostic> {
        if !call.local {
            let routine = self.routine(call.number, call.span)?;
            let name = routine.name.clone();
            return Ok((routine, 0, name));
        }
        let name = format!("N{} of {}", call.number, caller.name);
        let first = self.label(call.number, call.span, caller, at)?;
        Ok((caller.clone(), first, name))
    }

    /// A program by its number: in this file, or in one that has the number for its name.
    fn routine(&mut self, number: u32, span: Span) -> Result<Rc<Routine>, Diagnostic> {
        let name = program_name(number);
        let stems = [
            name.clone(),
            format!("O{number:04}"),
            format!("{number}"),
            format!("{number:04}"),
        ];
        for stem in &stems {
            for wanted in [stem, &name] {
                let (sources, diagnostics) =
                    (&mut *self.control.sources, &mut *self.control.diagnostics);
                if let Some(found) = self.library.find(wanted, sources, diagnostics) {
                    return Ok(found);
                }
            }
        }
        let mut stems = stems.iter();
        if let Some((path, first)) = stems.find_map(|stem| self.library.first_of_file(stem)) {
            let path = path.display();
            return Err(Diagnostic::error(
                span,
                format!(
                    "the program {name} was not found: {path} is there, but it begins with {first}"
                ),
            )
            .help(format!("write {name} into its first line, or call {first}")));
        }
        Err(Diagnostic::error(span, format!("the program {name} was not found")).help(format!(
                "it is looked for in this file, and as O{number:04}.nc, {number:04}.nc and the like \
                 beside it and in the folders of --subprograms"
            )))
    }

    /// `M98 P1000 L3`, or `M98 P31000`: the last four digits are the program, those before how often.
    pub(super) fn m98(
        &mut self,
        words: &mut BlockWords,
        span: Span,
    ) -> Result<Outcome, Diagnostic> {
        let Some(At {
            value: (value, digits),
            span: at,
        }) = words.p.take()
        else {
            return Err(
                Diagnostic::error(span, "the number of the subprogram is missing")
                    .help("write M98 P1000"),
            );
        };
        let number = At { value, span: at };
        let repeats = words.l.take();
        let (number, passes) = match (repeats, digits) {
            (Some(repeats), _) => (program_number(number)?, whole_passes(repeats)?),
            (None, Some(digits)) if digits > DIGITS => {
                let whole = value as u32;
                let program = At {
                    value: f64::from(whole % 10_000),
                    span: at,
                };
                (program_number(program)?, (whole / 10_000).max(1))
            }
            (None, _) => (program_number(number)?, 1),
        };
        Ok(Outcome::Call(Call {
            number,
            local: false,
            passes,
            span,
        }))
    }

    /// `M97 P100 L3`: the blocks of this program from N100 to M99. (Haas Automation, Mill Operator's Manual, "M97 Local
    /// Sub-Program Call".)
    pub(super) fn m97(
        &mut self,
        words: &mut BlockWords,
        span: Span,
    ) -> Result<Outcome, Diagnostic> {
        let Some(At {
            value: (value, _),
            span: at,
        }) = words.p.take()
        else {
            return Err(
                Diagnostic::error(span, "the number of the block is missing")
                    .help("write M97 P100 for the blocks from N100 to M99"),
            );
        };
        Ok(Outcome::Call(Call {
            number: block_number(At { value, span: at })?,
            local: true,
            passes: words.l.take().map_or(Ok(1), whole_passes)?,
            span: at,
        }))
    }

    /// `M99`, or `M99 P100`: the caller goes on at N100.
    pub(super) fn m99(
        &mut self,
        words: &mut BlockWords,
        span: Span,
    ) -> Result<Outcome, Diagnostic> {
        if self.control.is_in_main() {
            return Err(Diagnostic::error(
                span,
                "M99 in the main program begins it again, for ever",
            )
            .help("write M30 at its end; WHILE[..]DO1 .. END1 or GOTO repeat a part of it"));
        }
        self.return_to = match words.p.take() {
            None => None,
            Some(At {
                value: (value, _),
                span,
            }) => Some((block_number(At { value, span })?, span)),
        };
        Ok(Outcome::Return)
    }
}

/// The number of a block, to which a jump or a call leads.
pub(super) fn block_number(word: At<f64>) -> Result<u32, Diagnostic> {
    if word.value.fract() == 0.0 && (0.0..=99_999_999.0).contains(&word.value) {
        return Ok(word.value as u32);
    }
    Err(Diagnostic::error(
        word.span,
        format!("{} is not the number of a block", word.value),
    ))
}

fn program_number(word: At<f64>) -> Result<u32, Diagnostic> {
    if word.value.fract() == 0.0 && (1.0..=99_999_999.0).contains(&word.value) {
        return Ok(word.value as u32);
    }
    Err(Diagnostic::error(
        word.span,
        format!("{} is not the number of a program", word.value),
    ))
}

fn whole_passes(word: At<f64>) -> Result<u32, Diagnostic> {
    if word.value.fract() == 0.0 && (1.0..=f64::from(RULES.passes)).contains(&word.value) {
        return Ok(word.value as u32);
    }
    Err(Diagnostic::error(
        word.span,
        "L is how often the program runs: a whole number from 1 to 9999",
    ))
}
