//! Running the syntax tree, block by block. The result is the plain list of what the program does.

use super::block_words::BlockWords;
use super::calls::ModalCall;
use super::cycles::Cycle;
use super::parameters::Parameters;
use super::polar::PolarOrigin;
use super::routine::Routine;
use super::syntax::{Assignment, Block, HighLevel, Label, Statement, Word};
use super::tool_words::ToolState;
use super::transforms::Transforms;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::plain::PlainBlock;
use crate::dialects::control::words::At;
use crate::dialects::control::{About, Control};
use crate::dialects::library::Library;
use crate::dialects::run::{Interpret, Next, Reached, jump_out_of_repetition, reach};
use crate::dialects::settings::Settings;
use crate::program::contour_entry::Standing;
use crate::program::{Action, FrameScope};
use crate::source::Span;
use std::rc::Rc;

/// How often a block can be repeated.
const REPEAT_LIMIT: u32 = 9999;

/// Runs a program.
pub struct Interpreter<'a> {
    pub(super) control: Control<'a>,
    pub(super) library: Library<Routine>,
    pub(super) parameters: Parameters,
    pub(super) transforms: Transforms,
    pub(super) polar: PolarOrigin,
    pub(super) tool: ToolState,
    /// Whether G92 is in force.
    pub(super) preset: bool,
    pub(super) cycle: Option<Cycle>,
    /// G98: canned cycles end in their starting plane; with G99 in the reference plane.
    pub(super) to_start: bool,
    /// The pitch of G33, machine units, until one of G0 to G3.
    pub(super) thread: Option<f64>,
    pub(super) modal_call: Option<ModalCall>,
    /// The RPT statements that are running.
    pub(super) repeats: Vec<Span>,
}

impl<'a> Interpreter<'a> {
    /// Ready to run the main program of the library.
    pub fn new(
        settings: &'a Settings,
        library: Library<Routine>,
        about: About<'a>,
    ) -> Interpreter<'a> {
        let mut control = Control::new(settings, about, FrameScope::Block);
        control.set_standing_entry(Standing::Steps);
        Interpreter {
            control,
            library,
            parameters: Parameters::new(&settings.variables),
            transforms: Transforms::default(),
            polar: PolarOrigin::default(),
            tool: ToolState::default(),
            preset: false,
            cycle: None,
            to_start: true,
            thread: None,
            modal_call: None,
            repeats: Vec::new(),
        }
    }

    /// Runs the blocks from `first` up to the one before `end`.
    pub(super) fn run_blocks(&mut self, routine: &Rc<Routine>, first: usize, end: usize) -> Next {
        let mut at = first;
        loop {
            let block = match reach(self, &routine.blocks, &mut at, end) {
                Reached::Block(block) => block,
                Reached::End => return Next::Block(at),
                Reached::Abort => return Next::Abort,
            };
            match self.run_block(routine, at, &block) {
                Next::Block(next) if next < first || next > end => {
                    self.control.fail(jump_out_of_repetition(block.place.span));
                    return Next::Abort;
                }
                Next::Block(next) => at = next,
                other => return other,
            }
        }
    }

    fn run_block(&mut self, routine: &Rc<Routine>, at: usize, block: &Block) -> Next {
        if block.skip && self.control.settings.skip_blocks {
            return Next::Block(at + 1);
        }
        let next = Next::Block(at + 1);
        let finished = self.control.blocks_finished();
        let done = match &block.statement {
            Statement::Empty => Ok(next),
            // Where the axes are after a block that was not understood is anybody's guess.
            Statement::Invalid | Statement::Subroutine(_) => {
                self.control.modal.forget_position();
                self.control.modal.has_feed = true;
                Ok(next)
            }
            Statement::Words(words) => {
                return match words.iter().any(Word::is_irregular_pocket) {
                    true => self.irregular_pocket(words, routine, block, at),
                    false => self.words_block(words, block, at),
                };
            }
            Statement::High(statement) => self.high_level(statement, routine, at, block),
        };
        let next = done.unwrap_or_else(|diagnostic| {
            let is_jump = matches!(
                block.statement,
                Statement::High(HighLevel::Goto(_) | HighLevel::If(..) | HighLevel::Error(..))
            );
            self.control.fail(diagnostic);
            if is_jump { Next::Abort } else { next }
        });
        // A call finishes its block before the subroutine begins.
        match self.control.blocks_finished() == finished {
            true => self.control.finish_block(&block.place),
            false => self.control.finish_marker(&block.place),
        }
        next
    }

    fn words_block(&mut self, words: &[Word], block: &Block, at: usize) -> Next {
        let words = BlockWords::collect(words, &self.parameters, self.control.diagnostics);
        let Some(mut words) = words else {
            self.control.modal.forget_position();
            self.control.finish_block(&block.place);
            return Next::Block(at + 1);
        };
        let pattern = words.g.iter().find(|g| (60..=65).contains(&g.value));
        if let (Some(g), true, None) = (pattern, self.modal_call.is_some(), &self.cycle) {
            return self
                .modal_pattern(&words, *g, block, at)
                .unwrap_or_else(|diagnostic| {
                    self.control.fail(diagnostic);
                    self.control.finish_block(&block.place);
                    Next::Block(at + 1)
                });
        }
        match self.modal_passes(&mut words) {
            Ok(passes) => self.run_block_words(&words, passes, block, at),
            Err(diagnostic) => {
                self.control.fail(diagnostic);
                self.control.finish_block(&block.place);
                Next::Block(at + 1)
            }
        }
    }

    /// A block, and the modal subroutine as often as `passes` says if it moves; once without.
    pub(super) fn run_block_words(
        &mut self,
        words: &BlockWords,
        passes: Option<At<u32>>,
        block: &Block,
        at: usize,
    ) -> Next {
        let errors = self.control.diagnostics.errors();
        let ends = self
            .run_words(words, block.place.span)
            .unwrap_or_else(|diagnostic| {
                self.control.fail(diagnostic);
                self.control.modal.has_feed = true;
                false
            });
        let moved = |action: &Action| matches!(action, Action::Move(_));
        let has_moved = self.control.actions.iter().any(moved);
        self.control.finish_block(&block.place);
        if ends {
            return Next::End;
        }
        if has_moved && self.modal_call.is_some() {
            return self.run_modal_call(passes.map_or(1, |passes| passes.value), block, at);
        }
        if let Some(passes) = passes.filter(|_| self.control.diagnostics.errors() == errors) {
            self.control.diagnostics.push(
                Diagnostic::error(passes.span, "N without a motion in its block")
                    .help("it says how often the modal subroutine runs behind the motion"),
            );
        }
        Next::Block(at + 1)
    }

    fn high_level(
        &mut self,
        statement: &HighLevel,
        routine: &Rc<Routine>,
        at: usize,
        block: &Block,
    ) -> Result<Next, Diagnostic> {
        let next = Next::Block(at + 1);
        match statement {
            HighLevel::Assign(list) => {
                self.assign(list);
                Ok(next)
            }
            HighLevel::If(condition, then, otherwise) => {
                let holds = condition.number(&self.parameters)? != 0.0;
                match (holds, otherwise) {
                    (true, _) => self.high_level(then, routine, at, block),
                    (false, Some(otherwise)) => self.high_level(otherwise, routine, at, block),
                    (false, None) => Ok(next),
                }
            }
            HighLevel::Goto(label) => self.find_label(routine, *label, at).map(Next::Block),
            HighLevel::Repeat {
                first,
                last,
                times,
                span,
            } => {
                self.control.finish_block(&block.place);
                let times = match times {
                    Some(times) => times.whole(&self.parameters, 0)?,
                    None => 1,
                };
                self.repeat(routine, [*first, *last], times, *span, at)
            }
            HighLevel::Call(call) => self.call(call, block, at),
            HighLevel::ModalOff => {
                self.modal_call = None;
                Ok(next)
            }
            HighLevel::Return(span) => match self.control.is_in_main() {
                true => Err(Diagnostic::error(*span, "(RET) outside of a subroutine")
                    .help("a subroutine begins with (SUB n)")),
                false => Ok(Next::Return),
            },
            HighLevel::Message(text) => {
                if !text.trim().is_empty() {
                    self.control.actions.push(Action::Message(text.clone()));
                }
                Ok(next)
            }
            HighLevel::Error(number, text, span) => {
                let number = match number {
                    Some(number) => format!(" {}", number.number(&self.parameters)?),
                    None => String::new(),
                };
                Err(Diagnostic::error(
                    *span,
                    format!("the program stops itself here with error{number}: {text}"),
                )
                .help("the values that lead here are in the program or were given with --set"))
            }
        }
    }

    /// The block that a jump names.
    pub(super) fn find_label(
        &mut self,
        routine: &Routine,
        label: Label,
        at: usize,
    ) -> Result<usize, Diagnostic> {
        let (sources, diagnostics) = (&*self.control.sources, &mut *self.control.diagnostics);
        let found = routine.label(label.number, at, sources, diagnostics);
        found.ok_or_else(|| {
            Diagnostic::error(
                label.span,
                format!("there is no block N{} here", label.number),
            )
            .help("jumps and repetitions stay in their program or subroutine")
        })
    }

    /// One that fails does not keep the others from their values.
    fn assign(&mut self, list: &[Assignment]) {
        for Assignment {
            parameter,
            value,
            span,
        } in list
        {
            let numbers = parameter.number(&self.parameters);
            let numbers = numbers.and_then(|number| Ok((number, value.number(&self.parameters)?)));
            let done =
                numbers.and_then(|(number, value)| self.parameters.assign(number, value, *span));
            if let Err(diagnostic) = done {
                self.control.diagnostics.push(diagnostic);
            }
        }
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
        let end = self.run_blocks(main, 0, main.blocks.len());
        if end == Next::End {
            self.check_tool_length();
        }
        matches!(end, Next::Block(_) | Next::Return)
    }

    fn end_is_missing(&mut self, last: &Rc<Routine>) {
        if let Some(last) = self.control.last_block(&last.blocks) {
            self.control.end_is_missing(&last.place, "(RET)");
        }
        self.check_tool_length();
    }

    fn takes(&self, block: &PlainBlock) -> bool {
        self.cycle.is_none()
            && self.thread.is_none()
            && self.modal_call.is_none()
            && block.axes[3..].iter().all(Option::is_none)
    }
}

/// How often a block is repeated by N at its end.
pub(super) fn times(word: At<f64>) -> Result<u32, Diagnostic> {
    let whole = word.value.fract() == 0.0;
    match whole && (0.0..=f64::from(REPEAT_LIMIT)).contains(&word.value) {
        true => Ok(word.value as u32),
        false => Err(Diagnostic::error(
            word.span,
            "N here is how often the block is repeated: a whole number up to 9999",
        )),
    }
}
