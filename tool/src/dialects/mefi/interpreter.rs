//! Running a program, block by block. The result is the plain list of what it does.

use super::block_words::BlockWords;
use super::recalculation::Recalculation;
use super::syntax::{Block, Routine};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::beside_motion::Waiting;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::offset_free::OffsetFree;
use crate::dialects::control::offset_row::OffsetRow;
use crate::dialects::control::plain::PlainBlock;
use crate::dialects::control::{About, Control, Done, Place};
use crate::dialects::library::Library;
use crate::dialects::run::{Interpret, Next, Reached, reach};
use crate::dialects::settings::Settings;
use crate::program::{Compensation, FrameScope};
use crate::source::Span;
use std::rc::Rc;

/// Runs a program.
pub struct Interpreter<'a> {
    pub(super) control: Control<'a>,
    pub(super) library: Library<Routine>,
    pub(super) recalculation: Recalculation,
    pub(super) offset_free: OffsetFree,
    /// The row of the tool table that D selected.
    pub(super) offset_row: OffsetRow,
    /// Whether the program has named one of G0 to G3.
    pub(super) motion_named: bool,
}

impl<'a> Interpreter<'a> {
    /// Ready to run the main program of the library.
    pub fn new(
        settings: &'a Settings,
        library: Library<Routine>,
        about: About<'a>,
    ) -> Interpreter<'a> {
        let mut control = Control::new(settings, about, FrameScope::Block);
        // A program that names no motion before its first axis moves with feed.
        control.modal.motion = Some(Motion::Line);
        Interpreter {
            control,
            library,
            recalculation: Recalculation::default(),
            offset_free: OffsetFree::default(),
            offset_row: OffsetRow::default(),
            motion_named: false,
        }
    }

    /// Runs a subprogram.
    pub(super) fn run_routine(&mut self, routine: &Rc<Routine>) -> Next {
        match self.run_blocks(routine) {
            Next::Block(_) => {
                self.end_is_missing(routine);
                Next::Return
            }
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
            if block.skip && self.control.settings.skip_blocks {
                at += 1;
                continue;
            }
            match self.run_block(&block, at) {
                Next::Block(next) => at = next,
                Next::Return if self.control.is_in_main() => {
                    self.control.diagnostics.push(
                        Diagnostic::error(
                            block.place.span,
                            "G70 returns from a subprogram, and this is the program",
                        )
                        .help("end the program with M30"),
                    );
                    return Next::Abort;
                }
                other => return other,
            }
        }
    }

    fn end_is_missing(&mut self, routine: &Rc<Routine>) {
        if let Some(last) = self.control.last_block(&routine.blocks) {
            self.control.end_is_missing(&last.place, "G70");
        }
    }

    fn run_block(&mut self, block: &Block, at: usize) -> Next {
        let following = Next::Block(at + 1);
        if block.invalid {
            self.control.modal.forget_position();
            self.control.modal.has_feed = true;
            return following;
        }
        let place = &block.place;
        let Some(words) = BlockWords::collect(block, self.control.diagnostics) else {
            self.control.modal.forget_position();
            return following;
        };
        let call = words.function(71);
        let next = match call {
            Some(call) => self.call(call.span, &words, place, following),
            None => self.run_words(words, place, following),
        };
        let next = next.unwrap_or_else(|diagnostic| {
            self.control.fail(diagnostic);
            // What a subprogram would have done is unknown.
            self.control.modal.has_feed |= call.is_some();
            following
        });
        // A call has finished its block before the subprogram began.
        if call.is_none() {
            self.control.finish_block(place);
        }
        next
    }

    fn run_words(
        &mut self,
        mut words: BlockWords,
        place: &Place,
        following: Next,
    ) -> Result<Next, Diagnostic> {
        if let Some(end) = words.function(70) {
            return match words.beside_axes(70) {
                None if !words.motion.names_an_axis() => Ok(Next::Return),
                _ => Err(Diagnostic::error(end.span, "G70 stands alone in its block")
                    .help("put the rest in the block before")),
            };
        }
        let stray = words.label.or(words.passes);
        if let Some(word) = stray {
            return Err(Diagnostic::error(
                word.span,
                "L, P and Q belong to the call of a subprogram",
            )
            .help("write G71 L100 P3 for three passes of L100"));
        }
        let recalculation = words.g.iter().find(|g| (34..=37).contains(&g.value));
        if let Some(function) = recalculation.copied() {
            self.recalculate(function, &words)?;
            return Ok(following);
        }
        self.carry_out(&mut words, place, following)
    }

    /// The words of an ordinary block, in the order in which controls carry them out: modes, feed and
    /// speed, tool, spindle, coolant, offsets, motion, stop.
    fn carry_out(
        &mut self,
        words: &mut BlockWords,
        place: &Place,
        following: Next,
    ) -> Result<Next, Diagnostic> {
        let was_compensated = self.control.modal.compensation != Compensation::Off;
        // The offset is selected before the compensation that uses it, and after the one that ends.
        let releases = words.function(40).is_some();
        if let Some(offset) = words.offset.filter(|_| !releases) {
            self.tool_offset(offset)?;
        }
        let once = self.g_functions(words)?;
        if let Some(offset) = words.offset.filter(|_| releases) {
            self.tool_offset(offset)?;
        }
        if let Some(span) = once.dwell {
            self.control.apply_states(was_compensated);
            self.dwell(words, span)?;
            return Ok(following);
        }
        if let Some(feed) = words.feed {
            self.control.feed(feed)?;
        }
        if let Some(speed) = words.speed {
            self.control.speed(speed)?;
        }
        if let Some(tool) = words.tool {
            self.control.tool(tool.value, tool.span)?;
        }
        let has_offset = words.offset.is_some();
        self.control
            .begin_functions(&words.m, Waiting::SwitchesOff, has_offset);
        let ends = self.control.m_functions(&words.m, &[2, 30])?;
        self.control.hold_functions();
        if words.m.iter().any(|m| m.value == 6) {
            self.offset_free.forget();
        }
        self.control.apply_states(was_compensated);
        match once.preset {
            Some(span) => self.preset(words, span)?,
            None => self.block_motion(words, place.span)?,
        }
        self.control.end_functions()?;
        self.control.stops(&words.m)?;
        let Some(end) = ends else {
            return Ok(following);
        };
        self.control.end_of_program(end == 30);
        Ok(Next::End)
    }

    fn block_motion(&mut self, words: &mut BlockWords, block: Span) -> Done {
        self.shift_further_axes(words);
        let own_feed = words.feed.is_some();
        let motion = &words.motion;
        if !motion.is_motion() {
            return Ok(());
        }
        if !self.motion_named {
            self.motion_named = true;
            self.control.diagnostics.push(
                Diagnostic::warning(
                    motion.first_axis().unwrap_or(block),
                    "no G0, G1, G2 or G3 before the first motion: it is taken as G1",
                )
                .help("say how the axes are to move: G0 rapid, G1 with feed"),
            );
        }
        if self.offset_free.active {
            let state = &mut self.offset_free;
            return self
                .control
                .offset_free_motion(motion, state, block, own_feed, false);
        }
        self.control.motion(motion, block, own_feed, false)
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
        self.motion_named && !self.offset_free.active && block.axes[3..].iter().all(Option::is_none)
    }
}
