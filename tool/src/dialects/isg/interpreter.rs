//! Running the syntax tree, block by block. The result is the plain list of what the program does.

use super::block_words::BlockWords;
use super::frames::Frames;
use super::modes::Modes;
use super::spindle::SpindleModes;
use super::syntax::{Block, Declaration, Item, Routine, Statement};
use super::variables::VariableStore;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::offset_free::OffsetFree;
use crate::dialects::control::offset_row::OffsetRow;
use crate::dialects::control::plain::PlainBlock;
use crate::dialects::control::{About, Control, Done, Place};
use crate::dialects::expression::Expression;
use crate::dialects::library::Library;
use crate::dialects::run::{Interpret, Next, Reached, reach};
use crate::dialects::settings::Settings;
use crate::program::FrameScope;
use std::rc::Rc;

/// Runs a program.
pub struct Interpreter<'a> {
    pub(super) control: Control<'a>,
    pub(super) library: Library<Routine>,
    pub(super) variables: VariableStore,
    pub(super) frames: Frames,
    /// Axes that have not moved since the mirror or the rotation changed.
    pub(super) unsettled: [bool; 3],
    pub(super) offset_free: OffsetFree,
    pub(super) offset_row: OffsetRow,
    pub(super) modes: Modes,
    pub(super) spindle: SpindleModes,
}

impl<'a> Interpreter<'a> {
    /// Ready to run the main program of the library.
    pub fn new(
        settings: &'a Settings,
        library: Library<Routine>,
        about: About<'a>,
    ) -> Interpreter<'a> {
        Interpreter {
            control: Control::new(settings, about, FrameScope::Block),
            library,
            variables: VariableStore::new(&settings.variables),
            frames: Frames::default(),
            unsettled: [false; 3],
            offset_free: OffsetFree::default(),
            offset_row: OffsetRow::default(),
            modes: Modes::default(),
            spindle: SpindleModes::default(),
        }
    }

    /// Runs a subprogram. M17 and M29 may be left out at its end.
    pub(super) fn run_routine(&mut self, routine: &Rc<Routine>) -> Next {
        match self.run_blocks(routine) {
            Next::Block(_) => Next::Return,
            other => other,
        }
    }

    /// Runs blocks up to the last one, or to one that leads elsewhere.
    fn run_blocks(&mut self, routine: &Rc<Routine>) -> Next {
        let mut at = 0;
        loop {
            let block = match reach(self, &routine.blocks, &mut at, routine.blocks.len()) {
                Reached::Block(block) => block,
                Reached::End => return Next::Block(at),
                Reached::Abort => return Next::Abort,
            };
            match self.run_block(routine, at, &block) {
                Next::Block(next) => at = next,
                Next::Return if self.control.is_in_main() => {
                    self.control.end_of_program(false);
                    self.control.finish_block(&block.place);
                    return Next::End;
                }
                other => return other,
            }
        }
    }

    fn run_block(&mut self, routine: &Rc<Routine>, at: usize, block: &Block) -> Next {
        if block.skip && self.control.settings.skip_blocks {
            return Next::Block(at + 1);
        }
        let here = &block.place;
        let next = match &block.statement {
            Statement::Empty => Ok(Next::Block(at + 1)),
            // Where the axes are after a block that was not understood is anybody's guess.
            Statement::Invalid => {
                self.control.modal.forget_position();
                self.control.modal.has_feed = true;
                Ok(Next::Block(at + 1))
            }
            Statement::Items(items) => self.run_items(items, here, at),
            Statement::Declare(declaration) => {
                self.declare(declaration).map(|()| Next::Block(at + 1))
            }
            Statement::Command(command) => self
                .run_command(command, block.place.span)
                .map(|()| Next::Block(at + 1)),
            Statement::Call(call) => {
                self.control.finish_block(here);
                return self.call(call, here, at).unwrap_or_else(|diagnostic| {
                    self.control.fail(diagnostic);
                    self.control.modal.has_feed = true;
                    Next::Block(at + 1)
                });
            }
            Statement::Flow(flow) => {
                self.control.finish_block(here);
                return self.flow(flow, routine, at).unwrap_or_else(|diagnostic| {
                    self.control.diagnostics.push(diagnostic);
                    Next::Abort
                });
            }
        };
        let next = next.unwrap_or_else(|diagnostic| {
            self.control.fail(diagnostic);
            Next::Block(at + 1)
        });
        self.control.finish_block(here);
        next
    }

    /// Words are evaluated in their order, and variables get their values on the way.
    fn run_items(&mut self, items: &[Item], place: &Place, at: usize) -> Result<Next, Diagnostic> {
        let mut words = BlockWords::default();
        let mut failed = false;
        let mut has_words = false;
        for item in items {
            let done = match item {
                Item::Word(word) => {
                    has_words = true;
                    words.add(word, &self.variables)
                }
                Item::Assign(assignment) => {
                    let value = assignment.value.number(&self.variables);
                    let index = self.numbers(&assignment.index);
                    match (index, value) {
                        (Ok(index), Ok(value)) => {
                            let name = assignment.name.as_str();
                            self.variables.assign(name, &index, value, assignment.span)
                        }
                        (Err(error), _) | (_, Err(error)) => Err(error),
                    }
                }
            };
            if let Err(diagnostic) = done {
                self.control.fail(diagnostic);
                failed = true;
            }
        }
        if failed || !has_words {
            return Ok(Next::Block(at + 1));
        }
        self.carry_out(words, place, at)
    }

    pub(super) fn numbers(&self, list: &[Expression]) -> Result<Vec<f64>, Diagnostic> {
        list.iter()
            .map(|item| item.number(&self.variables))
            .collect()
    }

    fn declare(&mut self, declaration: &Declaration) -> Done {
        let size: Result<Vec<usize>, _> = declaration
            .size
            .iter()
            .map(|size| size.whole(&self.variables, 1).map(|size| size as usize))
            .collect();
        let values = self.numbers(&declaration.values)?;
        self.variables.declare(declaration, size?, values)
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

    fn parts(&mut self) -> (&Library<Routine>, &mut Control<'a>) {
        (&self.library, &mut self.control)
    }

    fn run_main(&mut self, main: &Rc<Routine>) -> bool {
        if main.turns_machine {
            self.control.set_frame_scope(FrameScope::Machine);
        }
        matches!(self.run_blocks(main), Next::Block(_))
    }

    fn end_is_missing(&mut self, last: &Rc<Routine>) {
        self.check_tap_at_end();
        if let Some(last) = self.control.last_block(&last.blocks) {
            self.control.end_is_missing(&last.place, "M29");
        }
    }

    fn takes(&self, block: &PlainBlock) -> bool {
        self.unsettled == [false; 3]
            && !self.modes.exact_stop
            && self.spindle.active.is_none()
            && !self.offset_free.active
            // F has a meaning of its own in each feed mode.
            && block.feed.is_none()
            && block.axes[3..].iter().all(Option::is_none)
    }
}
