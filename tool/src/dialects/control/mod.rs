//! The control that is imitated: what the commands of every dialect do.
//!
//! The interpreters of the dialects understand the words; what a feed, an offset, an arc or a frame
//! then changes, and what LinuxCNC cannot do in which state, is the same for all and stands here.

mod arc_fit;
mod arc_forms;
pub mod beside_motion;
pub mod calls;
mod end_of_compensation;
pub mod frame;
pub mod groups;
mod machine_moves;
pub mod modal;
mod modes;
mod motion;
pub mod offset_free;
pub mod offset_row;
pub mod own_m;
mod path_modes;
pub mod plain;
pub mod spindle_motion;
mod tool_book;
pub mod words;

use super::blocks::{Block, Blocks};
use super::settings::Settings;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::program::contour_end::ContourEnds;
use crate::program::contour_entry::{ContourEntries, Standing};
use crate::program::contour_start::ContourStarts;
use crate::program::corners::Corners;
use crate::program::frame::FrameCommand;
use crate::program::{self, Action, Compensation, FrameScope, Origin, PathControl, Sink};
use crate::source::{SourceFile, Sources, Span};
use beside_motion::Functions;
use end_of_compensation::EndOfCompensation;
use modal::Modal;
use std::collections::BTreeSet;
use std::rc::Rc;
use std::time::Instant;
use tool_book::ToolState;

/// How many blocks of a long program are handed on at once.
const BATCH: usize = 256;

/// How many blocks of a short one may wait.
const MOST_WAITING: usize = 20_000;

/// After how many blocks the clock is looked at.
const CLOCK: usize = 1024;

/// The outcome of carrying out a part of a block.
pub type Done = Result<(), Diagnostic>;

/// What a program is read from, and who hears of it.
pub struct About<'a> {
    /// The files of the program; 0 is the program itself.
    pub sources: &'a mut Sources,
    /// What was found wrong.
    pub diagnostics: &'a mut Diagnostics,
    /// Takes what the program does.
    pub sink: &'a mut dyn Sink,
}

/// A block of the source, to which actions belong.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The text of the block.
    pub span: Span,
    /// Its number.
    pub number: Option<u32>,
    /// Its comment.
    pub comment: Option<String>,
}

/// The control and the program that it has run so far.
pub struct Control<'a> {
    /// How the control was set up.
    pub settings: &'a Settings,
    /// The files of the program.
    pub sources: &'a mut Sources,
    /// What was found wrong.
    pub diagnostics: &'a mut Diagnostics,
    /// What stays in force from block to block.
    pub modal: Modal,
    /// What the block that is running does.
    pub actions: Vec<Action>,
    /// Modes that the block sets, until [`Control::apply_states`] puts them in order.
    pub states: Vec<Action>,
    sink: &'a mut dyn Sink,
    scope: FrameScope,
    /// How many cycles are running inside of each other, a modal one among them.
    cycles: usize,
    has_modal_cycle: bool,
    /// How corners are passed in the output while cutter compensation is on.
    path_of_compensation: PathControl,
    corners: Corners,
    contour_starts: ContourStarts,
    contour_ends: ContourEnds,
    contour_entries: ContourEntries,
    end_of_compensation: EndOfCompensation,
    /// Whether a motion in the plane has stood behind G41 or G42, in a block that is finished.
    on_contour: bool,
    finished: usize,
    running: Vec<String>,
    blocks_run: usize,
    block_limit: usize,
    begun: Instant,
    frames_handed_on: bool,
    noted: BTreeSet<String>,
    /// What blocks do instead of becoming a part of the program.
    recording: Option<Vec<Action>>,
    tools: ToolState,
    functions: Functions,
}

impl<'a> Control<'a> {
    /// As it is after power on. `scope` is what the frames of the dialect turn; `about` has the files of
    /// the program, and takes what is said about it and what it does.
    pub fn new(settings: &'a Settings, about: About<'a>, scope: FrameScope) -> Control<'a> {
        Control {
            settings,
            sources: about.sources,
            diagnostics: about.diagnostics,
            modal: Modal::new(settings),
            actions: Vec::new(),
            states: Vec::new(),
            sink: about.sink,
            scope,
            cycles: 0,
            has_modal_cycle: false,
            path_of_compensation: settings.path_mode,
            corners: Corners::default(),
            contour_starts: ContourStarts::default(),
            contour_ends: ContourEnds::default(),
            contour_entries: ContourEntries::default(),
            end_of_compensation: EndOfCompensation::default(),
            on_contour: false,
            finished: 0,
            running: Vec::new(),
            blocks_run: 0,
            block_limit: settings.most_blocks,
            begun: Instant::now(),
            frames_handed_on: false,
            noted: BTreeSet::new(),
            recording: None,
            tools: ToolState::default(),
            functions: Functions::default(),
        }
    }

    /// Changes what the frames of the program turn; `false` where some have been handed on already.
    pub fn set_frame_scope(&mut self, scope: FrameScope) -> bool {
        let late = self.scope != scope && self.frames_handed_on;
        self.scope = scope;
        !late
    }

    /// How the control begins cutter compensation without a motion in the plane.
    pub fn set_standing_entry(&mut self, standing: Standing) {
        self.contour_entries.set_standing(standing);
    }

    /// Counts a block, or a step of a cycle, that is about to run; `false` when the program must not go on, because it does
    /// not end or has too many errors.
    pub fn count_block(&mut self, block: Span) -> bool {
        self.blocks_run += 1;
        if self.blocks_run > self.block_limit {
            let written: usize = self.sources.iter().map(SourceFile::lines).sum();
            self.block_limit = self.settings.most_blocks + 2 * written;
        }
        if self.blocks_run.is_multiple_of(CLOCK) && self.has_taken_too_long(block) {
            return false;
        }
        if self.blocks_run > self.block_limit {
            self.diagnostics.push(
                Diagnostic::error(
                    block,
                    format!(
                        "the program does not end: {} blocks have run",
                        self.block_limit
                    ),
                )
                .help(
                    "check the conditions of its loops and jumps; --most-blocks raises the limit",
                ),
            );
            return false;
        }
        !self.diagnostics.is_full()
    }

    fn has_taken_too_long(&mut self, block: Span) -> bool {
        let most = self.settings.reading.most_time;
        let late = self.begun.elapsed() > most;
        if late {
            let seconds = most.as_secs();
            self.diagnostics.push(
                Diagnostic::error(
                    block,
                    format!("the program has not ended after {seconds} s"),
                )
                .help(
                    "check the conditions of its loops and jumps; --most-seconds raises the limit",
                ),
            );
        }
        late
    }

    /// The block with an index; `None` where its line holds none, or cannot be read, which is said.
    pub fn block<B: Block>(&mut self, blocks: &Blocks<B>, at: usize) -> Option<Rc<B>> {
        blocks.get(at, self.sources, self.diagnostics)
    }

    /// The last block that holds something.
    pub fn last_block<B: Block>(&mut self, blocks: &Blocks<B>) -> Option<Rc<B>> {
        blocks.last(self.sources, self.diagnostics)
    }

    /// Puts the collected actions into the program, with the place of the block.
    pub fn finish_block(&mut self, place: &Place) {
        self.on_contour = self.is_on_contour();
        let mut actions = std::mem::take(&mut self.actions);
        self.states.clear();
        self.take_functions();
        // Loops and jumps do nothing by themselves: there would be very many of them.
        if actions.is_empty() && place.comment.is_none() {
            return;
        }
        // There may be very many blocks, and most have one action.
        actions.shrink_to_fit();
        let is_frame = |action: &Action| matches!(action, Action::Frame(_));
        let frame = !actions.is_empty() && actions.iter().all(is_frame);
        let frame_text = frame.then(|| self.sources.slice(place.span));
        self.add_block(program::Block {
            origin: Origin {
                file: place.span.file,
                line: self.sources.line(place.span),
                number: place.number,
                span: place.span,
            },
            actions,
            comment: place.comment.clone(),
            frame_text,
        });
    }

    /// Whether LinuxCNC leads the tool beside a contour: where nothing has moved in the plane since G41 or G42,
    /// [`ContourEntries`] still holds them back.
    fn is_on_contour(&self) -> bool {
        let leads = |action: &Action| match action {
            Action::Move(motion) => motion.leads_in_plane(self.modal.plane),
            _ => false,
        };
        self.modal.compensation != Compensation::Off
            && (self.on_contour || self.actions.iter().any(leads))
    }

    /// What the blocks that follow do is kept, and not a part of the program.
    pub fn begin_recording(&mut self) {
        self.recording = Some(Vec::new());
    }

    /// What has been kept; blocks become parts of the program again.
    pub fn end_recording(&mut self) -> Vec<Action> {
        self.recording.take().unwrap_or_default()
    }

    fn add_block(&mut self, block: program::Block) {
        if let Some(recording) = &mut self.recording {
            recording.extend(block.actions);
            return;
        }
        self.finished += 1;
        if let Some(no_way_off) = self.end_of_compensation.meets(&block.actions) {
            self.diagnostics.push(no_way_off.error(block.origin.span));
        }
        if self.diagnostics.errors() > 0 {
            // What follows an error may not be where it belongs, and is not written anyway.
            self.corners = Corners::default();
            return;
        }
        self.corners.push(block);
        // What the frames of a program turn may come to light late.
        let waiting = self.corners.waiting();
        let is_long = || self.sources.iter().any(SourceFile::is_windowed);
        if waiting >= MOST_WAITING || waiting >= BATCH && is_long() {
            let blocks = self.corners.take_finished(self.diagnostics);
            let blocks = self.begin_and_end_contours(blocks);
            self.hand_on(blocks);
        }
    }

    /// Lets cutter compensation begin and end where the other controls do.
    fn begin_and_end_contours(&mut self, mut blocks: Vec<program::Block>) -> Vec<program::Block> {
        let mut starts = std::mem::take(&mut self.contour_starts);
        let mut found = Diagnostics::default();
        for block in &mut blocks {
            self.contour_entries.change(block, &mut found);
            self.contour_ends.change(block, &mut found);
        }
        let mut diameter = |row, span| {
            let found = self.tool_diameter("the way onto this contour", Some(row), span)?;
            Ok(found.map(|(_, diameter)| diameter))
        };
        let blocks = starts.take(blocks, &mut diameter, &mut found);
        self.contour_starts = starts;
        self.diagnostics.append(found);
        blocks
    }

    fn hand_on(&mut self, blocks: Vec<program::Block>) {
        if self.diagnostics.errors() == 0 {
            let is_frame = |action: &Action| matches!(action, Action::Frame(_));
            let mut actions = blocks.iter().flat_map(|block| &block.actions);
            self.frames_handed_on = self.frames_handed_on || actions.any(is_frame);
            self.sink.take(blocks, self.scope, self.sources);
        }
    }

    /// How many blocks are finished.
    pub fn blocks_finished(&self) -> usize {
        self.finished
    }

    /// Reports an error. Where the axes are after a block that could not be carried out is anybody's
    /// guess.
    pub fn fail(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
        self.modal.forget_position();
    }

    /// Says once of each kind of command that it is left out.
    pub fn note(&mut self, name: &str, span: Span) {
        if self.noted.insert(name.to_string()) {
            self.diagnostics.push(Diagnostic::warning(
                span,
                format!("{name} tunes the other control and is left out"),
            ));
        }
    }

    /// Says something once that the user should know; `kind` is what is not said again.
    pub fn note_once(&mut self, kind: &str, message: &str, span: Span) {
        if self.noted.insert(kind.to_string()) {
            self.diagnostics.push(Diagnostic::warning(span, message));
        }
    }

    /// Puts the modes of the block behind its other actions, in the order in which LinuxCNC can set
    /// them. `was_compensated`: whether cutter compensation was on when the block began.
    pub fn apply_states(&mut self, was_compensated: bool) {
        let mut states = std::mem::take(&mut self.states);
        states.sort_by_key(|state| order_of_state(state, was_compensated));
        self.actions.append(&mut states);
    }

    /// The end of the program; frames and shifts end with it.
    pub fn end_of_program(&mut self, rewind: bool) {
        if !self.modal.frame.is_empty() {
            self.actions.push(Action::Frame(FrameCommand::Cancel));
        }
        self.end_shifts();
        self.actions.push(Action::End { rewind });
    }

    /// The program or subprogram that runs has come to its last block without its end, which in a
    /// subprogram is `end_of_subprogram`.
    pub fn end_is_missing(&mut self, last: &Place, end_of_subprogram: &str) {
        let main = self.is_in_main();
        let (kind, word) = match main {
            true => ("program", "M30"),
            false => ("subprogram", end_of_subprogram),
        };
        self.diagnostics.push(
            Diagnostic::warning(last.span, format!("the {kind} ends without {word}"))
                .help(format!("put {word} into its last block")),
        );
        if main {
            self.end_of_program(false);
            self.finish_block(last);
        }
    }

    /// Hands on what is left of the program, with its roundings and chamfers.
    pub fn finish(&mut self) {
        if self.diagnostics.errors() == 0 {
            let blocks = self.corners.take_rest(self.diagnostics);
            let mut blocks = self.begin_and_end_contours(blocks);
            blocks.append(&mut self.contour_starts.take_rest());
            self.hand_on(blocks);
        }
    }
}

/// In which order the states of one block are set. G40 comes before all that is not allowed under
/// compensation, or, when there is none to end, where LinuxCNC has it.
fn order_of_state(state: &Action, compensated: bool) -> u8 {
    match state {
        Action::Compensation(Compensation::Off) if compensated => 0,
        Action::Plane(_) => 1,
        Action::Compensation(Compensation::Off) => 2,
        Action::ToolLength(_)
        | Action::ToolOffset(_)
        | Action::RadiusRow(_)
        | Action::CutterDiameter(_) => 3,
        Action::PresetOff | Action::WorkOffset(_) => 4,
        Action::PathControl(_) => 5,
        _ => 6,
    }
}
