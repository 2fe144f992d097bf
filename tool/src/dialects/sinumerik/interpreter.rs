//! Running the syntax tree, block by block. The result is the plain list of what the program does.

use super::block_words::BlockWords;
use super::evaluate_words::BlockEnd;
use super::frame_commands::frame_command;
use super::library::{Library, Routine};
use super::modal::Modal;
use super::syntax::{Assignment, Block, Definition, Statement, Word};
use super::variables::VariableStore;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::expression::{Expression, text};
use crate::dialects::settings::Settings;
use crate::program::frame::FrameCommand;
use crate::program::{self, Action, Origin, Program};
use crate::source::{Sources, Span};
use std::collections::BTreeSet;
use std::rc::Rc;

/// How many blocks a program may run: a loop that never ends must not fill the memory.
const BLOCK_LIMIT: u32 = 2_000_000;

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
    pub(super) settings: &'a Settings,
    pub(super) diagnostics: &'a mut Diagnostics,
    pub(super) modal: Modal,
    pub(super) actions: Vec<Action>,
    pub(super) library: Library,
    pub(super) sources: &'a mut Sources,
    pub(super) variables: VariableStore,
    program: Program,
    pub(super) running: Vec<String>,
    blocks_run: u32,
    noted: BTreeSet<String>,
}

impl<'a> Interpreter<'a> {
    /// Ready to run the main program of the library.
    pub fn new(
        settings: &'a Settings,
        library: Library,
        sources: &'a mut Sources,
        diagnostics: &'a mut Diagnostics,
    ) -> Interpreter<'a> {
        Interpreter {
            settings,
            diagnostics,
            modal: Modal::new(settings),
            actions: Vec::new(),
            library,
            sources,
            variables: VariableStore::new(&settings.variables),
            program: Program::default(),
            running: Vec::new(),
            blocks_run: 0,
            noted: BTreeSet::new(),
        }
    }

    /// Runs the main program.
    pub fn run(mut self) -> Program {
        if let Some(main) = self.library.main() {
            self.running.push(main.name.clone());
            self.run_routine(&main);
        }
        self.program
    }

    /// Runs a program or subprogram; `false` when nothing can follow it.
    pub(super) fn run_routine(&mut self, routine: &Rc<Routine>) -> bool {
        let blocks = &routine.section.blocks;
        let mut at = 0;
        while let Some(block) = blocks.get(at) {
            self.blocks_run += 1;
            if self.blocks_run > BLOCK_LIMIT {
                self.diagnostics.push(
                    Diagnostic::error(
                        block.span,
                        format!("the program does not end: {BLOCK_LIMIT} blocks have run"),
                    )
                    .help("check the conditions of its loops and jumps"),
                );
                return false;
            }
            if self.diagnostics.is_full() {
                return false;
            }
            match self.run_block(routine, at, block) {
                Next::Block(next) => at = next,
                Next::Return => return true,
                Next::Abort => return false,
            }
        }
        self.end_is_missing(routine);
        true
    }

    fn end_is_missing(&mut self, routine: &Rc<Routine>) {
        let main = self.running.len() <= 1;
        let Some(last) = routine.section.blocks.last() else {
            return;
        };
        let (kind, word) = match main {
            true => ("program", "M30"),
            false => ("subprogram", "M17"),
        };
        self.diagnostics.push(
            Diagnostic::warning(last.span, format!("the {kind} ends without {word}"))
                .help(format!("put {word} into its last block")),
        );
        if main {
            self.end_of_program(false);
            self.finish_block(last, routine.file);
        }
    }

    fn end_of_program(&mut self, rewind: bool) {
        if !self.modal.frame.is_empty() {
            self.actions.push(Action::Frame(FrameCommand::Cancel));
        }
        self.actions.push(Action::End { rewind });
    }

    fn run_block(&mut self, routine: &Rc<Routine>, at: usize, block: &Block) -> Next {
        if block.skip && self.settings.skip_blocks {
            return Next::Block(at + 1);
        }
        let next = match &block.statement {
            Statement::Empty | Statement::Nothing => Ok(Next::Block(at + 1)),
            // Where the axes are after a block that was not understood is anybody's guess.
            Statement::Invalid => {
                self.modal.forget_position();
                self.modal.has_feed = true;
                Ok(Next::Block(at + 1))
            }
            Statement::Noted(name) => {
                self.note(name, block.span);
                Ok(Next::Block(at + 1))
            }
            Statement::Words(words) => self.words_block(words, block, at),
            Statement::Assign(list) => self.assign(list).map(|()| Next::Block(at + 1)),
            Statement::Define(list) => self.define(list).map(|()| Next::Block(at + 1)),
            Statement::Message(message) => {
                self.message(message.as_ref()).map(|()| Next::Block(at + 1))
            }
            Statement::Frame {
                command,
                keyword,
                words,
            } => {
                let command = frame_command(
                    *command,
                    *keyword,
                    words,
                    &self.modal,
                    &self.variables,
                    self.diagnostics,
                );
                command.and_then(|command| {
                    if let Some(command) = command {
                        self.run_frame(command, *keyword)?;
                    }
                    Ok(Next::Block(at + 1))
                })
            }
            Statement::Call(call) => {
                self.finish_block(block, routine.file);
                return self.call(call, block, routine.file, at);
            }
            Statement::Flow(flow) => {
                self.finish_block(block, routine.file);
                return self.flow(flow, routine, at).unwrap_or_else(|diagnostic| {
                    self.diagnostics.push(*diagnostic);
                    Next::Abort
                });
            }
        };
        let next = next.unwrap_or_else(|diagnostic| {
            self.diagnostics.push(*diagnostic);
            self.modal.forget_position();
            Next::Block(at + 1)
        });
        self.finish_block(block, routine.file);
        next
    }

    fn words_block(
        &mut self,
        words: &[Word],
        block: &Block,
        at: usize,
    ) -> Result<Next, Box<Diagnostic>> {
        let Some(words) = BlockWords::collect(words, &self.variables, self.diagnostics) else {
            self.modal.forget_position();
            return Ok(Next::Block(at + 1));
        };
        match self.run_words(&words, block.span)? {
            BlockEnd::Continue => Ok(Next::Block(at + 1)),
            BlockEnd::Ends(_) => {
                // M30 in a subprogram returns, M17 in a main program ends it: as on the control.
                if self.running.len() <= 1 {
                    let rewind = words.m.iter().any(|m| m.value == 30);
                    self.end_of_program(rewind);
                }
                Ok(Next::Return)
            }
        }
    }

    /// Puts the collected actions into the program, with the place of the block.
    pub(super) fn finish_block(&mut self, block: &Block, file: usize) {
        let actions = std::mem::take(&mut self.actions);
        // Loops and jumps do nothing by themselves: there would be very many of them.
        if actions.is_empty() && block.comment.is_none() {
            return;
        }
        self.program.blocks.push(program::Block {
            origin: Origin {
                file,
                line: self.sources.line(block.span),
                number: block.number,
                span: block.span,
            },
            actions,
            comment: block.comment.clone(),
        });
    }

    /// Says once of each kind of command that it is left out.
    pub(super) fn note(&mut self, name: &str, span: Span) {
        if self.noted.insert(name.to_string()) {
            self.diagnostics.push(Diagnostic::warning(
                span,
                format!("{name} tunes the other control and is left out"),
            ));
        }
    }

    fn message(&mut self, message: Option<&Expression>) -> Result<(), Box<Diagnostic>> {
        let Some(message) = message else {
            return Ok(());
        };
        let message = text(&message.evaluate(&self.variables)?);
        if !message.trim().is_empty() {
            self.actions.push(Action::Message(message));
        }
        Ok(())
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
