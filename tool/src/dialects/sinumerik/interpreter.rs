//! Running the syntax tree, block by block. The result is the plain list of what the program does.

use super::approach::Smooth;
use super::arc_words::ArcForm;
use super::block_words::BlockWords;
use super::contour_angle::OpenLine;
use super::contour_exit::ContourEnd;
use super::evaluate_words::BlockEnd;
use super::frame_commands::frame_command;
use super::polar::Pole;
use super::procedures::ModalCall;
use super::programmed_offset::ProgrammedOffset;
use super::routine::Routine;
use super::smoothing::Smoothing;
use super::spindle::{Diameter, SpindleMotion, Tapping};
use super::spindle_speed::SpindleSpeed;
use super::syntax::{Assigned, Assignment, Block, Definition, Statement, Word};
use super::variables::{Filling, VariableStore};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::offset_free::OffsetFree;
use crate::dialects::control::plain::PlainBlock;
use crate::dialects::control::{About, Control};
use crate::dialects::expression::{Expression, text};
use crate::dialects::library::Library;
use crate::dialects::run::{Interpret, Next, Reached, jump_out_of_repetition, reach};
use crate::dialects::settings::Settings;
use crate::program::frame::FrameOperation;
use crate::program::{Action, FrameScope, SystemValues};
use crate::source::Span;
use std::ops::Range;
use std::rc::Rc;

/// Runs a program.
pub struct Interpreter<'a> {
    pub(super) control: Control<'a>,
    pub(super) library: Library<Routine>,
    pub(super) variables: VariableStore,
    /// CIP or CT, while one of them is the modal motion.
    pub(super) arc_form: Option<ArcForm>,
    /// G33, G331 or G332, likewise.
    pub(super) spindle_motion: Option<SpindleMotion>,
    pub(super) pole: Pole,
    /// RNDM, machine units.
    pub(super) rounding: Option<f64>,
    pub(super) smoothing: Smoothing,
    /// The tool that T selected, and the one in the spindle.
    pub(super) selected: Option<u32>,
    pub(super) tool: Option<u32>,
    /// D, while that is known.
    pub(super) edge: Option<f64>,
    /// The tool that D means, where no M6 has changed to it, until it moves.
    pub(super) tool_left: Option<u32>,
    /// G500.
    pub(super) offset_free: OffsetFree,
    /// The frame of CYCLE800, in which that of TRANS and its like acts.
    pub(super) swivelled: Vec<FrameOperation>,
    /// G58, G59, TRANS and ATRANS.
    pub(super) offset: ProgrammedOffset,
    pub(super) modal_call: Option<ModalCall>,
    /// The REPEAT statements that are running.
    pub(super) repeats: Vec<Span>,
    /// KONT, not NORM.
    pub(super) goes_round: bool,
    /// The end of a contour under KONT, until the tool has left it.
    pub(super) contour_end: Option<ContourEnd>,
    /// G331, until its G332.
    pub(super) tapping: Option<Tapping>,
    /// DIAMON and DIAM90.
    pub(super) diameter: Diameter,
    /// G147, G247 or G347, until the contour comes.
    pub(super) approach: Option<Smooth>,
    /// G141 (left) and G142; `None` with G140.
    pub(super) approach_side: Option<bool>,
    /// G341.
    pub(super) approach_flat: bool,
    /// The axes that DC, ACP or ACN have shown to count their angles within one turn.
    pub(super) modulo: [bool; 9],
    /// The first of two lines with ANG.
    pub(super) open_line: Option<OpenLine>,
    /// The work offset in force, 1 for G54 and 0 for G500, once the program has named one.
    pub(super) system: Option<u8>,
    /// Values for work offsets, until one is chosen.
    pub(super) waiting_offsets: Vec<SystemValues>,
    /// The routine whose blocks run.
    pub(super) routine: Option<Rc<Routine>>,
    /// What S means, and LIMS.
    pub(super) speed: SpindleSpeed,
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
            spindle_motion: None,
            pole: Pole::default(),
            rounding: None,
            smoothing: Smoothing::default(),
            selected: None,
            tool: None,
            edge: None,
            tool_left: None,
            offset_free: OffsetFree::default(),
            swivelled: Vec::new(),
            offset: ProgrammedOffset::default(),
            modal_call: None,
            repeats: Vec::new(),
            goes_round: false,
            contour_end: None,
            tapping: None,
            diameter: Diameter::default(),
            approach: None,
            approach_side: None,
            approach_flat: false,
            modulo: [false; 9],
            open_line: None,
            system: None,
            routine: None,
            waiting_offsets: Vec::new(),
            speed: SpindleSpeed::default(),
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
        self.run_range(routine, 0..routine.blocks.len())
    }

    /// The same of a part of the blocks, which no jump may leave.
    pub(super) fn run_range(&mut self, routine: &Rc<Routine>, range: Range<usize>) -> Next {
        let caller = self.routine.replace(routine.clone());
        let next = self.run_blocks_in(routine, range);
        self.routine = caller;
        next
    }

    fn run_blocks_in(&mut self, routine: &Rc<Routine>, range: Range<usize>) -> Next {
        let mut at = range.start;
        loop {
            let block = match reach(self, &routine.blocks, &mut at, range.end) {
                Reached::Block(block) => block,
                Reached::End => return Next::Block(at),
                Reached::Abort => return Next::Abort,
            };
            match self.run_block(routine, at, &block) {
                Next::Block(next) if next < range.start || next > range.end => {
                    self.control.fail(jump_out_of_repetition(block.place.span));
                    return Next::Abort;
                }
                Next::Block(next) => at = next,
                other => return other,
            }
        }
    }

    fn end_is_missing(&mut self, routine: &Rc<Routine>) {
        if let Some(last) = self.control.last_block(&routine.blocks) {
            if self.control.is_in_main() {
                self.set_offsets();
            }
            self.control.end_is_missing(&last.place, "M17");
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
                self.control.note(name, block.place.span);
                Ok(Next::Block(at + 1))
            }
            Statement::Words(words) => self.words_block(words, block, at),
            Statement::Assign(list) => self.assign(list).map(|()| Next::Block(at + 1)),
            Statement::SettableOffset(offset) => {
                self.settable_offset(offset).map(|()| Next::Block(at + 1))
            }
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
            Statement::CallByText(text) => {
                self.finish_block(block);
                return self.call_by_text(text, block, at);
            }
            Statement::Flow(flow) => {
                self.finish_block(block);
                return self.flow(flow, routine, at).unwrap_or_else(|diagnostic| {
                    self.control.diagnostics.push(diagnostic);
                    Next::Abort
                });
            }
        };
        let next = next.unwrap_or_else(|diagnostic| {
            self.control.diagnostics.push(diagnostic);
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
    ) -> Result<Next, Diagnostic> {
        let Some(words) = BlockWords::collect(words, &self.variables, self.control.diagnostics)
        else {
            self.control.modal.forget_position();
            return Ok(Next::Block(at + 1));
        };
        match self.run_words(&words, block.place.span)? {
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
                    self.set_offsets();
                    let rewind = words.m.iter().any(|m| m.value == 30);
                    self.control.end_of_program(rewind);
                }
                Ok(Next::Return)
            }
        }
    }

    pub(super) fn finish_block(&mut self, block: &Block) {
        self.control.finish_block(&block.place);
    }

    fn message(&mut self, message: Option<&Expression>) -> Result<(), Diagnostic> {
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

    pub(super) fn assign(&mut self, list: &[Assignment]) -> Result<(), Diagnostic> {
        for assignment in list {
            let index: Result<Vec<f64>, _> = assignment
                .index
                .iter()
                .map(|index| index.number(&self.variables))
                .collect();
            let filling = self.filling(&assignment.value)?;
            self.variables
                .fill(&assignment.name, &index?, filling, assignment.span)?;
        }
        Ok(())
    }

    fn filling(&self, value: &Assigned) -> Result<Filling, Diagnostic> {
        Ok(match value {
            Assigned::One(value) => Filling::One(value.evaluate(&self.variables)?),
            Assigned::Set(list) => {
                let mut values = Vec::new();
                for value in list {
                    values.push(match value {
                        Some(value) => Some(value.evaluate(&self.variables)?),
                        None => None,
                    });
                }
                Filling::Each(values)
            }
            Assigned::Repeat(value, count) => Filling::Same(
                value.evaluate(&self.variables)?,
                match count {
                    Some(count) => Some(count.whole(&self.variables, 0)? as usize),
                    None => None,
                },
            ),
        })
    }

    fn define(&mut self, list: &[Definition]) -> Result<(), Diagnostic> {
        for definition in list {
            let size: Result<Vec<usize>, _> = definition
                .size
                .iter()
                .map(|size| size.whole(&self.variables, 1).map(|size| size as usize))
                .collect();
            let size = size?;
            let first = vec![0.0; size.len()];
            let (name, span) = (&definition.name, definition.span);
            let filling = match &definition.value {
                Some(value) => Some(self.filling(value)?),
                None => None,
            };
            match filling {
                // One value is that of all elements.
                Some(Filling::One(value)) => {
                    self.variables
                        .define(name, definition.kind, size, Some(value), span)?;
                }
                filling => {
                    self.variables
                        .define(name, definition.kind, size, None, span)?;
                    if let Some(filling) = filling {
                        self.variables.fill(name, &first, filling, span)?;
                    }
                }
            }
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

    fn parts(&mut self) -> (&Library<Routine>, &mut Control<'a>) {
        (&self.library, &mut self.control)
    }

    fn run_main(&mut self, main: &Rc<Routine>) -> bool {
        matches!(self.run_blocks(main), Next::Block(_))
    }

    fn end_is_missing(&mut self, last: &Rc<Routine>) {
        Interpreter::end_is_missing(self, last);
    }

    fn takes(&self, block: &PlainBlock) -> bool {
        let modal = &self.control.modal;
        // What G70 and G71 do to F is said.
        let feed_as_lengths = block.feed.is_none() || modal.length_factor == modal.feed_factor;
        feed_as_lengths
            && self.arc_form.is_none()
            && self.spindle_motion.is_none()
            && self.rounding.is_none()
            && self.modal_call.is_none()
            && self.tapping.is_none()
            && self.contour_end.is_none()
            && self.open_line.is_none()
            && self.approach.is_none()
            && self.diameter == Diameter::default()
            && !self.offset_free.active
            && modal.kept_speed.is_none()
            && self.tool_left.is_none()
            && self.tool_of_turret().is_none()
            && self.modulo == [false; 9]
    }
}
