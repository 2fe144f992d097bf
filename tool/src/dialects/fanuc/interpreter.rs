//! Running the syntax tree, block by block. The result is the plain list of what the program does.

use super::block_words::BlockWords;
use super::calls::ModalMacro;
use super::cycles::{Cycle, is_cycle};
use super::lathe::ToolCalls;
use super::polar::PolarPlace;
use super::routine::Routine;
use super::skipped_places::SkippedAxes;
use super::smoothness::Smoothness;
use super::syntax::{Assignment, Block, Statement, Word};
use super::tool_offsets::ToolOffsets;
use super::transforms::Transforms;
use super::values::{number, value};
use super::variables::Variables;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::plain::PlainBlock;
use crate::dialects::control::{About, Control, Done};
use crate::dialects::library::Library;
use crate::dialects::run::{Interpret, Next, Reached, reach};
use crate::dialects::settings::{DecimalPoint, Settings};
use crate::program::{Action, FrameScope};
use crate::source::Span;
use std::rc::Rc;

/// Runs a program.
pub struct Interpreter<'a> {
    pub(super) control: Control<'a>,
    pub(super) library: Library<Routine>,
    pub(super) variables: Variables,
    pub(super) transforms: Transforms,
    pub(super) offsets: ToolOffsets,
    pub(super) cycle: Option<Cycle>,
    pub(super) skipped: SkippedAxes,
    /// G16.
    pub(super) polar: Option<PolarPlace>,
    /// G187.
    pub(super) smoothness: Smoothness,
    /// G99.
    pub(super) to_return_level: bool,
    /// M29: taps follow the spindle.
    pub(super) rigid: bool,
    /// G96.
    pub(super) surface_speed: bool,
    /// G92 S: the most turns a minute under G96.
    pub(super) speed_limit: Option<f64>,
    /// S of G96.
    pub(super) metres_per_minute: Option<f64>,
    /// G20.
    pub(super) inch: bool,
    /// T.
    pub(super) tool: Option<f64>,
    pub(super) tool_calls: ToolCalls,
    /// G54 to G59.
    pub(super) work_offset: Option<f64>,
    pub(super) modal_macro: Option<ModalMacro>,
    /// The block of the caller that M99 P returns to.
    pub(super) return_to: Option<(u32, Span)>,
    /// Whether it has been said what numbers without a point are.
    pub(super) point_explained: bool,
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
            variables: Variables::new(&settings.variables),
            transforms: Transforms::default(),
            offsets: ToolOffsets::default(),
            cycle: None,
            skipped: SkippedAxes::default(),
            polar: None,
            smoothness: Smoothness::default(),
            to_return_level: false,
            rigid: false,
            surface_speed: false,
            speed_limit: None,
            metres_per_minute: None,
            inch: settings.machine_in_inch,
            tool: None,
            tool_calls: ToolCalls::default(),
            work_offset: None,
            modal_macro: None,
            return_to: None,
            point_explained: false,
        }
    }

    /// Runs a routine from one of its blocks on.
    pub(super) fn run_routine(&mut self, routine: &Rc<Routine>, first: usize) -> Next {
        let mut at = first;
        loop {
            let block = match reach(self, &routine.blocks, &mut at, routine.blocks.len()) {
                Reached::Block(block) => block,
                Reached::End => return Next::Block(at),
                Reached::Abort => return Next::Abort,
            };
            match self.run_block(routine, at, &block) {
                Next::Block(next) => at = next,
                other => return other,
            }
        }
    }

    fn run_block(&mut self, routine: &Rc<Routine>, at: usize, block: &Block) -> Next {
        let next = Next::Block(at + 1);
        if block.skip && self.control.settings.skip_blocks {
            return next;
        }
        let done = match &block.statement {
            Statement::Empty => Ok(next),
            // Where the axes are after a block that was not understood is anybody's guess.
            Statement::Invalid => {
                self.control.modal.forget_position();
                self.control.modal.has_feed = true;
                Ok(next)
            }
            Statement::Words(words) => return self.words_block(words, routine, at, block),
            Statement::Assign(assignment) => self
                .assignment(assignment, block)
                .map(|()| next)
                .map_err(|error| (error, stops_itself(assignment))),
            Statement::Noted(name) => {
                self.control.note(name, block.place.span);
                Ok(next)
            }
            Statement::If(..) | Statement::Goto(_) | Statement::Loop(..) | Statement::End(_) => {
                let flow = self.flow(routine, at, block);
                flow.map_err(|error| (error, true))
            }
        };
        let next = done.unwrap_or_else(|(diagnostic, aborts)| {
            self.control.fail(diagnostic);
            if aborts { Next::Abort } else { next }
        });
        self.control.finish_block(&block.place);
        next
    }

    /// `#1=5`.
    pub(super) fn assignment(&mut self, assignment: &Assignment, block: &Block) -> Done {
        let variable = number(&assignment.variable, self)?;
        let value = value(&assignment.value, self)?;
        let text = block.place.comment.as_deref().unwrap_or("");
        self.assign(variable, value, assignment.span, text)
    }

    fn words_block(
        &mut self,
        list: &[Word],
        routine: &Rc<Routine>,
        at: usize,
        block: &Block,
    ) -> Next {
        let next = Next::Block(at + 1);
        let (list, call) = match self.split_macro_call(list) {
            Ok(split) => split,
            Err(diagnostic) => {
                self.control.fail(diagnostic);
                return next;
            }
        };
        let words = self.collect(list);
        let outcome = match words {
            None => {
                self.control.modal.forget_position();
                self.control.modal.has_feed = true;
                self.control.finish_block(&block.place);
                return next;
            }
            Some(words) => self.run_words(words, block.place.span),
        };
        let outcome = outcome.unwrap_or_else(|diagnostic| {
            self.control.fail(diagnostic);
            self.control.modal.has_feed = true;
            Outcome::GoesOn
        });
        let moved = |action: &Action| matches!(action, Action::Move(_));
        let has_moved = self.control.actions.iter().any(moved);
        self.control.finish_block(&block.place);
        let called = match (outcome, call) {
            (Outcome::End, _) => return Next::End,
            (Outcome::Return, _) => return Next::Return,
            (Outcome::Stops, _) => return Next::Abort,
            (Outcome::Call(call), _) => self.subprogram(call, routine, at, block),
            (Outcome::GoesOn, Some((call, arguments))) => {
                self.macro_call(call, arguments, routine, at, block)
            }
            (Outcome::GoesOn, None) if has_moved => Ok(self.run_modal_macro(routine, at, block)),
            (Outcome::GoesOn, None) => Ok(next),
        };
        called.unwrap_or_else(|diagnostic| {
            self.control.fail(diagnostic);
            next
        })
    }

    fn collect(&mut self, list: &[Word]) -> Option<BlockWords> {
        let mut found = Diagnostics::default();
        let mut length = length_step(self.inch);
        let words = BlockWords::collect(list, self, length, &mut found);
        self.control.diagnostics.append(found);
        let mut words = words?;
        if let Some((inch, span)) = self.other_unit(&words) {
            // It is that of the words beside it.
            length = length_step(inch);
            if self.depends_on_unit(list, &words, inch) {
                self.control.diagnostics.push(beside_unit(span));
                return None;
            }
        }
        if words.pointless.is_empty() {
            return Some(words);
        }
        let cycle = words.g.iter().any(|g| is_cycle(g.value));
        words.forget_counts(cycle || self.cycle.is_some());
        let Some((address, span)) = words.pointless.first().copied() else {
            return Some(words);
        };
        match self.control.settings.decimal_point {
            // The factors of G51 have their own rule.
            DecimalPoint::Calculator if words.has_g(510) => {}
            DecimalPoint::Calculator => self.explain_point(address, span),
            DecimalPoint::Increments => {
                let polar = (self.polar.is_some() || words.has_g(160)) && !words.has_g(150);
                words.count_increments(length, 0.001, polar);
            }
        }
        Some(words)
    }

    /// The unit that a block changes to, whether it is the inch, and its G20 or G21.
    fn other_unit(&self, words: &BlockWords) -> Option<(bool, Span)> {
        let mut units = words.g.iter().filter(|g| matches!(g.value, 200 | 210));
        let unit = units.find(|g| (g.value == 200) != self.inch)?;
        Some((unit.value == 200, unit.span))
    }

    /// Whether the words of a block have other values in the unit that it changes to.
    fn depends_on_unit(&mut self, list: &[Word], words: &BlockWords, inch: bool) -> bool {
        let before = self.inch;
        self.use_unit(inch);
        let mut ignored = Diagnostics::default();
        let others = BlockWords::collect(list, self, length_step(inch), &mut ignored);
        self.use_unit(before);
        others.as_ref() != Some(words)
    }
}

/// The least increment of lengths, units of the program.
fn length_step(inch: bool) -> f64 {
    if inch { 0.0001 } else { 0.001 }
}

/// A block changes the unit, and its words have other values in the new one.
fn beside_unit(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "another unit in the block of a value that depends on it: of a place that is read, or of ROUND",
    )
    .help("write G20 or G21 in a block of its own before")
}

/// Whether an assignment is that of an alarm: nothing follows it.
fn stops_itself(assignment: &Assignment) -> bool {
    use crate::dialects::expression::ExpressionKind::Number;
    assignment.variable.kind == Number(3000.0)
}

/// How the words of a block leave it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome {
    /// To the next block.
    GoesOn,
    /// M98: by a subprogram.
    Call(super::calls::Call),
    /// M99.
    Return,
    /// M30 or M2.
    End,
    /// Nowhere: what follows has another meaning than here.
    Stops,
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
        let end = self.run_routine(main, 0);
        if end != Next::Abort {
            self.check_tool_calls();
        }
        matches!(end, Next::Block(_))
    }

    fn end_is_missing(&mut self, last: &Rc<Routine>) {
        if let Some(last) = self.control.last_block(&last.blocks) {
            self.control.end_is_missing(&last.place, "M99");
        }
    }

    fn takes(&self, block: &PlainBlock) -> bool {
        let whole = block.pointless
            && (!self.point_explained
                || self.control.settings.decimal_point != DecimalPoint::Calculator);
        self.cycle.is_none()
            && self.polar.is_none()
            && self.skipped == SkippedAxes::default()
            && self.modal_macro.is_none()
            && !self.transforms.is_unsettled()
            && !whole
    }
}
