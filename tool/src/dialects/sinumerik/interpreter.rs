//! Running the syntax tree, block by block. The result is the plain list of what the program does.

use super::arc_words::ArcForm;
use super::block_words::BlockWords;
use super::evaluate_words::BlockEnd;
use super::frame_commands::frame_command;
use super::polar::Pole;
use super::procedures::ModalCall;
use super::routine::Routine;
use super::spindle::{Diameter, Tapping};
use super::syntax::{Assignment, Block, Definition, Statement, Word};
use super::variables::VariableStore;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::offset_free::OffsetFree;
use crate::dialects::control::plain::PlainBlock;
use crate::dialects::control::{About, Control, Place};
use crate::dialects::expression::{Expression, text};
use crate::dialects::library::Library;
use crate::dialects::run::{Interpret, jump_out_of_repetition};
use crate::dialects::settings::Settings;
use crate::program::frame::FrameOperation;
use crate::program::{Action, FrameScope};
use crate::source::Span;
use std::ops::Range;
use std::rc::Rc;

/// Where the flow goes after a block.
pub(super) enum Next {
    /// To the block with this index.
    Block(usize),
    /// Out of the routine.
    Return,
    /// Nowhere: what follows cannot be known after an error.
    Abort,
}

/// Runs a program.
pub struct Interpreter<'a> {
    pub(super) control: Control<'a>,
    pub(super) library: Library<Routine>,
    pub(super) variables: VariableStore,
    /// CIP or CT, while one of them is the modal motion.
    pub(super) arc_form: Option<ArcForm>,
    pub(super) pole: Pole,
    /// RNDM, machine units.
    pub(super) rounding: Option<f64>,
    /// The tool that T selected, and the one in the spindle.
    pub(super) selected: Option<u32>,
    pub(super) tool: Option<u32>,
    /// G500.
    pub(super) offset_free: OffsetFree,
    /// The frame of CYCLE800, in which that of TRANS and its like acts.
    pub(super) swivelled: Vec<FrameOperation>,
    pub(super) modal_call: Option<ModalCall>,
    /// The REPEAT statements that are running.
    pub(super) repeats: Vec<Span>,
    /// G331, until its G332.
    pub(super) tapping: Option<Tapping>,
    /// DIAMON and DIAM90.
    pub(super) diameter: Diameter,
    /// LIMS: the most that G96 turns the spindle.
    pub(super) most_speed: Option<f64>,
    /// G96.
    pub(super) surface_speed: bool,
}

impl<'a> Interpreter<'a> {
    /// Ready to run the main program of the library.
    pub fn new(
        settings: &'a Settings,
        library: Library<Routine>,
        about: About<'a>,
    ) -> Interpreter<'a> {
        let mut control = Control::new(settings, about, FrameScope::Machine);
        control.modal.follows_setting = true;
        Interpreter {
            control,
            library,
            variables: VariableStore::new(&settings.variables),
            arc_form: None,
            pole: Pole::default(),
            rounding: None,
            selected: None,
            tool: None,
            offset_free: OffsetFree::default(),
            swivelled: Vec::new(),
            modal_call: None,
            repeats: Vec::new(),
            tapping: None,
            diameter: Diameter::default(),
            most_speed: None,
            surface_speed: false,
        }
    }

    /// Runs a subprogram; `false` when nothing can follow it.
    pub(super) fn run_routine(&mut self, routine: &Rc<Routine>) -> bool {
        let next = self.run_blocks(routine);
        if let Next::Block(_) = next {
            self.end_is_missing(routine);
        }
        !matches!(next, Next::Abort)
    }

    /// Runs blocks up to the last one, or to one that leads elsewhere.
    fn run_blocks(&mut self, routine: &Rc<Routine>) -> Next {
        self.run_range(routine, 0..routine.section.blocks.len())
    }

    /// The same of a part of the blocks, which no jump may leave.
    pub(super) fn run_range(&mut self, routine: &Rc<Routine>, range: Range<usize>) -> Next {
        let blocks = &routine.section.blocks[..range.end];
        let mut at = range.start;
        while let Some(block) = blocks.get(at) {
            if !self.control.count_block(block.span) {
                return Next::Abort;
            }
            match self.run_block(routine, at, block) {
                Next::Block(next) if next < range.start || next > range.end => {
                    self.control.fail(jump_out_of_repetition(block.span));
                    return Next::Abort;
                }
                Next::Block(next) => at = next,
                other => return other,
            }
        }
        Next::Block(at)
    }

    fn end_is_missing(&mut self, routine: &Rc<Routine>) {
        if let Some(last) = routine.section.blocks.last() {
            self.control.end_is_missing(&place(last), "M17");
        }
    }

    fn run_block(&mut self, routine: &Rc<Routine>, at: usize, block: &Block) -> Next {
        if block.skip && self.control.settings.skip_blocks {
            return Next::Block(at + 1);
        }
        let finished = self.control.blocks_finished();
        let next = match &block.statement {
            Statement::Empty | Statement::Nothing => Ok(Next::Block(at + 1)),
            // Where the axes are after a block that was not understood is anybody's guess.
            Statement::Invalid => {
                self.control.modal.forget_position();
                self.control.modal.has_feed = true;
                Ok(Next::Block(at + 1))
            }
            Statement::Noted(name) => {
                self.control.note(name, block.span);
                Ok(Next::Block(at + 1))
            }
            Statement::Words(words) => self.words_block(words, block, at),
            Statement::Assign(list) => self.assign(list).map(|()| Next::Block(at + 1)),
            Statement::Define(list) => self.define(list).map(|()| Next::Block(at + 1)),
            Statement::Message(message) => {
                self.message(message.as_ref()).map(|()| Next::Block(at + 1))
            }
            Statement::Alarm(values, span) => {
                self.control.diagnostics.push(self.alarm(values, *span));
                return Next::Abort;
            }
            // It was read when the subprogram was called.
            Statement::Procedure(_) => Ok(Next::Block(at + 1)),
            Statement::ModalCall(call) => self
                .set_modal_call(call.as_ref())
                .map(|()| Next::Block(at + 1)),
            Statement::Frame {
                command,
                keyword,
                words,
            } => {
                let command = frame_command(
                    *command,
                    *keyword,
                    words,
                    &self.control.modal,
                    &self.variables,
                    self.control.diagnostics,
                );
                command.and_then(|command| {
                    if let Some(command) = command {
                        self.programmable_frame(command, *keyword)?;
                    }
                    Ok(Next::Block(at + 1))
                })
            }
            Statement::Call(call) => {
                self.finish_block(block);
                return self.call(call, block, at);
            }
            Statement::Flow(flow) => {
                self.finish_block(block);
                return self.flow(flow, routine, at).unwrap_or_else(|diagnostic| {
                    self.control.diagnostics.push(*diagnostic);
                    Next::Abort
                });
            }
        };
        let next = next.unwrap_or_else(|diagnostic| {
            self.control.diagnostics.push(*diagnostic);
            self.control.modal.forget_position();
            Next::Block(at + 1)
        });
        // A modal subprogram has finished its block.
        if !self.control.actions.is_empty() || self.control.blocks_finished() == finished {
            self.finish_block(block);
        }
        next
    }

    fn words_block(
        &mut self,
        words: &[Word],
        block: &Block,
        at: usize,
    ) -> Result<Next, Box<Diagnostic>> {
        let Some(words) = BlockWords::collect(words, &self.variables, self.control.diagnostics)
        else {
            self.control.modal.forget_position();
            return Ok(Next::Block(at + 1));
        };
        match self.run_words(&words, block.span)? {
            BlockEnd::Continue => {
                let moves = |action: &Action| matches!(action, Action::Move(_));
                if self.modal_call.is_some() && self.control.actions.iter().any(moves) {
                    self.finish_block(block);
                    return self.run_modal_call(block, at);
                }
                Ok(Next::Block(at + 1))
            }
            BlockEnd::Ends(_) => {
                // M30 in a subprogram returns, M17 in a main program ends it: as on the control.
                if self.control.is_in_main() {
                    let rewind = words.m.iter().any(|m| m.value == 30);
                    self.control.end_of_program(rewind);
                }
                Ok(Next::Return)
            }
        }
    }

    pub(super) fn finish_block(&mut self, block: &Block) {
        self.control.finish_block(&place(block));
    }

    fn message(&mut self, message: Option<&Expression>) -> Result<(), Box<Diagnostic>> {
        let Some(message) = message else {
            return Ok(());
        };
        let message = text(&message.evaluate(&self.variables)?);
        if !message.trim().is_empty() {
            self.control.actions.push(Action::Message(message));
        }
        Ok(())
    }

    /// What SETAL says.
    fn alarm(&self, values: &[Expression], span: Span) -> Diagnostic {
        let shown: Vec<String> = values
            .iter()
            .filter_map(|value| value.evaluate(&self.variables).ok())
            .map(|value| text(&value))
            .collect();
        let message = format!(
            "the program stops itself here with alarm {}",
            shown.join(": ")
        );
        Diagnostic::error(span, message)
            .help("the values that lead here are in the program or were given with --set")
    }

    pub(super) fn assign(&mut self, list: &[Assignment]) -> Result<(), Box<Diagnostic>> {
        for assignment in list {
            let index: Result<Vec<f64>, _> = assignment
                .index
                .iter()
                .map(|index| index.number(&self.variables))
                .collect();
            let value = assignment.value.evaluate(&self.variables)?;
            self.variables
                .assign(&assignment.name, &index?, value, assignment.span)?;
        }
        Ok(())
    }

    fn define(&mut self, list: &[Definition]) -> Result<(), Box<Diagnostic>> {
        for definition in list {
            let size: Result<Vec<usize>, _> = definition
                .size
                .iter()
                .map(|size| size.whole(&self.variables, 1).map(|size| size as usize))
                .collect();
            let value = match &definition.value {
                Some(value) => Some(value.evaluate(&self.variables)?),
                None => None,
            };
            self.variables.define(
                &definition.name,
                definition.kind,
                size?,
                value,
                definition.span,
            )?;
        }
        Ok(())
    }
}

impl<'a> Interpret<'a> for Interpreter<'a> {
    type Routine = Routine;

    fn control(&mut self) -> &mut Control<'a> {
        &mut self.control
    }

    fn library(&self) -> &Library<Routine> {
        &self.library
    }

    fn run_main(&mut self, main: &Rc<Routine>) -> bool {
        matches!(self.run_blocks(main), Next::Block(_))
    }

    fn end_is_missing(&mut self, last: &Rc<Routine>) {
        Interpreter::end_is_missing(self, last);
    }

    fn takes(&self, _: &PlainBlock) -> bool {
        self.arc_form.is_none()
            && self.rounding.is_none()
            && self.modal_call.is_none()
            && self.tapping.is_none()
            && self.diameter == Diameter::default()
            && !self.offset_free.active
    }
}

/// Where the actions of a block belong.
pub(super) fn place(block: &Block) -> Place {
    Place {
        span: block.span,
        number: block.number,
        comment: block.comment.clone(),
    }
}
