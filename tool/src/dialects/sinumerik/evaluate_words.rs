//! What the words of a block do, in the order in which the control does it: modes, feed and speed,
//! tool, spindle, coolant, offsets, motion, stop.

use super::approach::shape_of;
use super::block_words::{BlockWords, ToolWord};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::beside_motion::Waiting;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension};
use crate::dialects::control::{Control, Done};
use crate::program::moves::{Corner, MoveKind};
use crate::program::{Action, Compensation, FeedMode, OrientWay};
use crate::source::Span;

/// How a block ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockEnd {
    /// The next block follows.
    Continue,
    /// The program or the subprogram ends here.
    Ends(Span),
}

/// What the G functions of a block ask for besides changing modes.
#[derive(Default)]
pub(super) struct OneShot {
    pub(super) dwell: Option<Span>,
    pub(super) exact_stop: bool,
    pub(super) machine_coordinates: Option<Span>,
    pub(super) preset: Option<Span>,
    /// G110 to G112.
    pub(super) pole: Option<At<u32>>,
    /// G52.
    pub(super) local_offset: Option<Span>,
    /// G58 or G59.
    pub(super) programmed_offset: Option<At<u32>>,
    /// G147 and its like (`true`), or G148 and its like.
    pub(super) smooth: Option<bool>,
}

impl OneShot {
    /// Whether the axes of the block are something else than the end of a motion by the mode in force.
    pub(super) fn takes_axes(&self) -> bool {
        self.machine_coordinates.is_some()
            || self.preset.is_some()
            || self.pole.is_some()
            || self.local_offset.is_some()
            || self.smooth.is_some()
    }
}

impl Interpreter<'_> {
    /// Runs the words of a block and appends what they do to the actions of the block.
    pub(super) fn run_words(
        &mut self,
        words: &BlockWords,
        block: Span,
    ) -> Result<BlockEnd, Diagnostic> {
        let mut words = words.clone();
        for noted in &words.noted {
            self.control.note(&noted.value, noted.span);
        }
        let mut once = OneShot {
            machine_coordinates: words.supa,
            ..OneShot::default()
        };
        self.exit_mode(&words);
        let side = self.control.modal.compensation;
        let compensated = side != Compensation::Off;
        self.check_open_line(&words)?;
        self.check_approach(&words)?;
        let leaves = |g: &At<u32>| shape_of(g.value).is_some_and(|(_, approaches)| !approaches);
        if words.g.iter().any(leaves) {
            self.begin_retraction(&words)?;
        }
        self.g_functions(&words, &mut once)?;
        // A retraction has left the contour by itself.
        if once.smooth.is_none() {
            self.end_contour(side, &words);
        }
        if let Some(g) = once.programmed_offset {
            self.programmed_offset(&words, g)?;
            return Ok(BlockEnd::Continue);
        }
        self.resolve_axes(&mut words)?;
        if !once.takes_axes() {
            self.resolve_turns(&mut words)?;
        }
        let words = &words;
        if let Some(span) = once.dwell {
            self.control.apply_states(compensated);
            self.dwell(words, span)?;
            return Ok(BlockEnd::Continue);
        }
        if let Some(feed) = words.feed {
            self.note_unit_of_feed(feed.span);
            self.control.feed(feed)?;
        }
        self.spindle_words(words)?;
        if let (Some(at), Some(tool)) = (words.tool, &words.tool_word) {
            match tool {
                ToolWord::Number(number) => self.control.tool(*number, at.span)?,
                ToolWord::Name(name) => self.control.named_tool(name, at.span)?,
            }
            if let Some(Action::Tool(number)) = self.control.actions.last() {
                self.selected = Some(*number);
            }
        }
        let end = self.m_functions(words)?;
        self.offset(words, compensated)?;
        if let Some(distance) = words.rounding_distance {
            self.rounding_distance(distance)?;
        }
        if let Some(tolerance) = words.contour_tolerance {
            self.contour_tolerance(tolerance)?;
        }
        self.control.apply_states(compensated);
        if words.motion.names_an_axis() {
            self.note_tool_left(block);
        }
        if self.cuts(words, &once) {
            self.refuse_tool_of_before(block)?;
        }
        let at = self.control.actions.len();
        if !self.move_with_spindle(words, &once, block)? {
            self.motion(words, &once, block)?;
        }
        self.check_exit(at)?;
        self.control.end_functions()?;
        self.control.stops(&words.m)?;
        Ok(match end {
            Some(span) => BlockEnd::Ends(span),
            None => BlockEnd::Continue,
        })
    }

    fn dwell(&mut self, words: &BlockWords, span: Span) -> Done {
        if words.motion.names_an_axis()
            || !words.m.is_empty()
            || words.tool.is_some()
            || words.offset.is_some()
        {
            return Err(Diagnostic::error(span, "G4 stands alone in its block")
                .help("put axes, T, D and M functions in another block"));
        }
        words.check_alone(40, &["F", "S"])?;
        let seconds = match (words.feed, words.speed) {
            (Some(seconds), None) => seconds.value,
            (None, Some(revolutions)) => match self.control.modal.spindle_speed {
                Some(speed) if speed > 0.0 => 60.0 * revolutions.value / speed,
                _ => {
                    return Err(Diagnostic::error(
                        revolutions.span,
                        "a dwell in revolutions of a spindle without speed",
                    )
                    .help("program S before, or dwell in seconds: G4 F2"));
                }
            },
            _ => {
                return Err(Diagnostic::error(span, "G4 needs a time")
                    .help("G4 F2.5 waits 2.5 seconds, G4 S30 waits 30 revolutions"));
            }
        };
        self.control.dwell(seconds, span)
    }

    /// M functions except the stops at the end of the block; returns the word that ends the routine.
    fn m_functions(&mut self, words: &BlockWords) -> Result<Option<Span>, Diagnostic> {
        let mut end = words.end_of_routine;
        // M5 beside axes is carried out before they move. (Siemens, SINUMERIK 802D, "Spindle speed S, directions of
        // rotation".)
        let waiting = Waiting::AllButStop;
        self.control
            .begin_functions(&words.m, waiting, words.offset.is_some());
        for At { value, span } in Control::in_order(&words.m) {
            match value {
                0 | 1 => {}
                2 | 17 | 30 => end = Some(span),
                // The control selects D1 with the new tool.
                6 => {
                    self.control.tool_change(span, true)?;
                    self.tool = self.selected;
                    self.tool_left = None;
                    self.edge = Some(1.0);
                }
                19 => self
                    .control
                    .actions
                    .push(Action::Orient(0.0, OrientWay::Shorter)),
                40..=45 => self.control.note(&format!("M{value}"), span),
                _ if self.control.switch(value) => {}
                _ => self.control.other_m(value, span)?,
            }
        }
        self.control.hold_functions();
        Ok(end)
    }

    /// D. `compensated`: whether cutter compensation was on when the block began.
    fn offset(&mut self, words: &BlockWords, compensated: bool) -> Done {
        let Some(offset) = words.offset else {
            return Ok(());
        };
        let unchanged = self.edge == Some(offset.value);
        let compensation = self.control.modal.compensation;
        if unchanged && (compensated || compensation != Compensation::Off) {
            return Ok(());
        }
        // `G41 D1`: the edge is chosen before its radius acts.
        if !compensated {
            self.control.modal.compensation = Compensation::Off;
        }
        let done = self.choose_edge(offset);
        self.control.modal.compensation = compensation;
        done?;
        self.edge = Some(offset.value);
        if offset.value != 0.0 && self.tool.is_none() {
            self.tool_left = self.selected.filter(|tool| *tool > 0);
        }
        Ok(())
    }

    /// Lathes with a turret take T for the change.
    fn note_tool_left(&mut self, span: Span) {
        if let Some(tool) = self.tool_left.take() {
            let message = format!(
                "T{tool} is selected and not changed to: LinuxCNC keeps the tool that it has, and its lengths; \
                 write M6 behind T if the tool is to be changed"
            );
            self.control.note_once("a tool without M6", &message, span);
        }
    }

    /// Whether the block moves otherwise than rapidly.
    fn cuts(&self, words: &BlockWords, once: &OneShot) -> bool {
        let with_spindle = self.spindle_motion.is_some() || words.g.iter().any(|g| g.value == 630);
        let rapid = self.control.modal.motion == Some(Motion::Rapid) && !with_spindle;
        words.is_motion() && !rapid && (!once.takes_axes() || once.machine_coordinates.is_some())
    }

    /// On a lathe, where T turns the turret on most controls: what cuts now would cut with the tool of before.
    pub(super) fn refuse_tool_of_before(&mut self, span: Span) -> Done {
        let Some(tool) = self.tool_of_turret() else {
            return Ok(());
        };
        // Said once; the blocks after it have the same fault.
        self.selected = self.tool;
        Err(Diagnostic::error(
            span,
            format!("T{tool} is selected and not changed to, on a lathe: LinuxCNC would cut with the tool of before"),
        )
        .help(format!(
            "write M6 where the tool is to be changed: T{tool} M6; a tool that is only to be ready is selected where \
             nothing is cut before its M6"
        )))
    }

    /// The tool that T has selected on a lathe and M6 has not changed to.
    pub(super) fn tool_of_turret(&self) -> Option<u32> {
        let selected = self.selected.filter(|tool| *tool > 0);
        selected.filter(|_| self.control.settings.lathe && selected != self.tool)
    }

    /// F where G70 or G71 have chosen another unit for lengths.
    fn note_unit_of_feed(&mut self, span: Span) {
        let modal = &self.control.modal;
        if modal.length_factor == modal.feed_factor || modal.feed_mode == FeedMode::InverseTime {
            return;
        }
        let (lengths, unit, both) = match self.control.settings.machine_in_inch {
            true => ("G71", "inches", "G710"),
            false => ("G70", "millimetres", "G700"),
        };
        let message = format!(
            "{lengths} is for lengths only: F stays in {unit}, the unit of this machine; {both} is for both"
        );
        self.control.note_once("the unit of F", &message, span);
    }

    fn choose_edge(&mut self, offset: At<f64>) -> Done {
        let on = match offset.value {
            0.0 => false,
            1.0 => true,
            edge if edge.fract() == 0.0 && (2.0..=9.0).contains(&edge) => {
                let row = self.edge_row(edge as u32, offset.span)?;
                return self.control.tool_offset(row, offset.span);
            }
            value => {
                return Err(Diagnostic::error(
                    offset.span,
                    format!("D{value} is not an edge of a tool"),
                )
                .help("the edges of a tool are D1 to D9, D0 is none"));
            }
        };
        self.control.tool_length(on, offset.span)?;
        if !on {
            self.control.radius_of_row(Some(0));
        }
        Ok(())
    }

    /// The row of LinuxCNC's tool table that holds a further edge of the tool.
    pub(super) fn edge_row(&self, edge: u32, span: Span) -> Result<u32, Diagnostic> {
        let tool = self.tool.unwrap_or(0);
        let rows = &self.control.settings.tool_edges;
        rows.get(&(tool, edge)).copied().ok_or_else(|| {
            Diagnostic::error(span, format!("D{edge}: a tool has one offset in LinuxCNC")).help(
                    format!(
                        "enter the edge as a row of the tool table and name it: --edge {tool}.{edge}=ROW"
                    ),
                )
        })
    }

    fn motion(&mut self, words: &BlockWords, once: &OneShot, block: Span) -> Done {
        if let Some(span) = once.preset {
            words.check_beside(920, &[])?;
            return self.preset(words, span);
        }
        if let Some(span) = once.machine_coordinates {
            words.check_beside(530, &[])?;
            return self.machine_move(words, span);
        }
        if let Some(pole) = once.pole {
            words.check_beside(10 * pole.value, &["AP", "RP"])?;
            return self.set_pole(words, pole);
        }
        if let Some(span) = once.local_offset {
            words.check_beside(520, &[])?;
            return self.local_offset(words, span);
        }
        if let Some(rounding) = words.rounding {
            self.modal_rounding(rounding)?;
        }
        match once.smooth {
            Some(true) => return self.begin_approach(words),
            Some(false) => return self.end_retraction(words, block),
            None => words.refuse_approach_words()?,
        }
        if !words.is_motion() {
            if let Some(corner) = words.corner {
                return Err(Diagnostic::error(
                    corner.span,
                    "a rounding or chamfer without a motion",
                )
                .help("write it beside the axes of the motion before the corner"));
            }
            if once.exact_stop {
                return Err(Diagnostic::error(
                    block,
                    "G9 acts in its block only, and this one has no motion",
                )
                .help("put it beside the axes, or use G60"));
            }
            return Ok(());
        }
        self.approach_before(words, |this| this.path_motion(words, once, block))?;
        if self.approach.is_some() {
            return Ok(());
        }
        match self.open_line {
            Some(_) => Ok(()),
            None => self.corner_after(words.corner),
        }
    }

    /// RNDM: every corner that follows is rounded; 0 ends it.
    fn modal_rounding(&mut self, radius: At<f64>) -> Done {
        if radius.value < 0.0 {
            return Err(Diagnostic::error(
                radius.span,
                "a rounding cannot be negative",
            ));
        }
        let length = radius.value * self.control.modal.length_factor;
        self.rounding = Some(length).filter(|length| *length > 0.0);
        Ok(())
    }

    /// Asks for the corner at the end of the motion of the block.
    pub(super) fn corner_after(&mut self, corner: Option<At<Corner>>) -> Done {
        let factor = self.control.modal.length_factor;
        // A parameter of 0, where a program leaves this corner as it is.
        if let Some(Corner::Round(0.0) | Corner::ChamferOf(0.0) | Corner::ChamferFrom(0.0)) =
            corner.map(|corner| corner.value)
        {
            return Ok(());
        }
        let asked = corner;
        let corner = match corner {
            Some(corner) => match corner.value {
                Corner::Round(length) => Corner::Round(length * factor),
                Corner::ChamferOf(length) => Corner::ChamferOf(length * factor),
                Corner::ChamferFrom(length) => Corner::ChamferFrom(length * factor),
                other => other,
            },
            None => match self.rounding {
                Some(radius) => Corner::RoundWithin(radius),
                None => return Ok(()),
            },
        };
        if let Some(Action::Move(path)) = self.control.actions.last_mut() {
            let rapid = path.kind == MoveKind::Rapid;
            match (rapid, asked) {
                (true, Some(word)) => {
                    return Err(Diagnostic::error(
                        word.span,
                        "a rounding or chamfer after a rapid motion",
                    )
                    .help("corners are made between motions with feed"));
                }
                (true, None) => {}
                (false, _) => path.corner = Some(corner),
            }
        }
        Ok(())
    }

    /// `G52 X10`: the zero of the work offset lies there until another G52; `G52 X0` ends it.
    fn local_offset(&mut self, words: &BlockWords, span: Span) -> Done {
        if !self.control.modal.frame.is_empty() {
            return Err(Diagnostic::error(span, "G52 while a frame is active")
                .help("use TRANS or ATRANS, or clear the frame with TRANS before"));
        }
        self.control.local_offset(&words.motion, span)
    }

    /// G53, G153, SUPA.
    fn machine_move(&mut self, words: &BlockWords, span: Span) -> Done {
        if !words.motion.names_an_axis() {
            // SUPA D0 alone only suppresses what a motion in this block would use.
            return Ok(());
        }
        let increment = |axis: &&At<(f64, Dimension)>| self.is_incremental(axis.value.1);
        if let Some(axis) = words.motion.axes.iter().flatten().find(increment) {
            return Err(
                Diagnostic::error(axis.span, "an increment in machine coordinates")
                    .help("write G90, or X=AC(..), in this block"),
            );
        }
        self.control
            .machine_move(&words.motion, span, true, words.feed.is_some())
    }

    fn preset(&mut self, words: &BlockWords, span: Span) -> Done {
        if !self.control.modal.frame.is_empty() {
            return Err(Diagnostic::error(span, "G92 while a frame is active")
                .help("clear the frame with TRANS before, and set it again after"));
        }
        self.control.preset(&words.motion, span)
    }
}
