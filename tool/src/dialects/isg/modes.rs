//! What a block of words does, in the order in which the control does it: modes, feed and speed,
//! tool, spindle, coolant, offsets, motion, stop.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::beside_motion::Waiting;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension};
use crate::dialects::control::{Done, Place};
use crate::dialects::run::Next;
use crate::dialects::settings::MirroredCircle;
use crate::program::{Action, Compensation, FeedMode};
use crate::source::Span;

/// Modes of this dialect that the shared control does not have. Lengths are kept in machine units: what G70 or
/// G71 changes later is the unit of what is written then.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Modes {
    /// G161: centres of arcs are absolute.
    pub absolute_centre: bool,
    /// The radius of arcs that name none, machine units.
    pub radius: Option<f64>,
    /// F of G93: the time of a block in seconds.
    pub block_time: Option<f64>,
    /// F of G94, machine units.
    pub feed_per_minute: Option<f64>,
    /// F of G95, machine units.
    pub feed_per_revolution: Option<f64>,
    /// G360: exact stop until G359.
    pub exact_stop: bool,
    /// `#HSC [CONTERROR ..]`, machine units.
    pub contour_error: Option<f64>,
    /// `#CONTOUR MODE [PATH_DEV ..]`, machine units.
    pub contour_deviation: Option<f64>,
}

/// What the G functions of a block ask for besides changing modes.
#[derive(Default)]
pub(super) struct OneShot {
    /// G04.
    pub(super) dwell: Option<Span>,
    /// G60.
    pub(super) exact_stop: Option<Span>,
    /// G61.
    pub(super) contouring: Option<Span>,
    /// G92.
    pub(super) reference_offset: Option<Span>,
    /// G351.
    pub(super) mirror_axes: Option<Span>,
}

impl Interpreter<'_> {
    pub(super) fn carry_out(
        &mut self,
        mut words: BlockWords,
        place: &Place,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        let next = Next::Block(at + 1);
        let was_compensated = self.control.modal.compensation != Compensation::Off;
        // The offset is selected before the compensation that uses it, and after the one that ends.
        let releases = words.function(40).is_some();
        if let Some(offset) = words.offset.filter(|_| !releases) {
            self.tool_offset(offset)?;
        }
        let once = self.g_functions(&words)?;
        self.check_tap(&words)?;
        if let Some(offset) = words.offset.filter(|_| releases) {
            self.tool_offset(offset)?;
        }
        if let Some(span) = once.dwell {
            self.control.apply_states(was_compensated);
            self.dwell(&words, span)?;
            return Ok(next);
        }
        if let Some(feed) = words.feed {
            self.feed(feed)?;
        }
        if let Some(speed) = words.speed {
            self.spindle_speed(speed)?;
        }
        if let Some(tool) = words.tool {
            self.control.tool(tool.value, tool.span)?;
        }
        let has_offset = words.offset.is_some();
        self.control
            .begin_functions(&words.m, Waiting::SwitchesOff, has_offset);
        let end = self.control.m_functions(&words.m, &[2, 17, 29, 30])?;
        self.control.hold_functions();
        if words.m.iter().any(|m| m.value == 6) {
            self.offset_free.forget();
        }
        self.control.apply_states(was_compensated);
        if let Some(span) = once.mirror_axes {
            self.mirror_axes(&words, span)?;
        } else if let Some(span) = once.reference_offset {
            self.reference_offset(&words, span)?;
        } else {
            self.shift_further_axes(&mut words);
            self.block_motion(&mut words, &once, place)?;
        }
        self.control.end_functions()?;
        self.control.stops(&words.m)?;
        Ok(match end {
            None => next,
            Some(17 | 29) => Next::Return,
            Some(end) => {
                if !self.control.is_in_main() {
                    self.control.diagnostics.push(Diagnostic::warning(
                        place.span,
                        format!("M{end} in a subprogram ends the whole program"),
                    ));
                }
                self.control.end_of_program(end == 30);
                Next::End
            }
        })
    }

    pub(super) fn tool_offset(&mut self, offset: At<f64>) -> Done {
        if self
            .control
            .select_offset_row(&mut self.offset_row, offset)?
        {
            self.offset_free.forget();
        }
        Ok(())
    }

    /// F belongs to the feed mode in which it is programmed.
    pub(super) fn feed(&mut self, feed: At<f64>) -> Done {
        if self.control.modal.feed_mode == FeedMode::InverseTime {
            if feed.value <= 0.0 {
                return Err(Diagnostic::error(
                    feed.span,
                    "the time of a block (G93) must be above 0",
                ));
            }
            self.modes.block_time = Some(feed.value);
            return Ok(());
        }
        self.control.feed(feed)?;
        match self.control.modal.feed_mode {
            FeedMode::PerRevolution => self.modes.feed_per_revolution = self.control.modal.feed,
            _ => self.modes.feed_per_minute = self.control.modal.feed,
        }
        Ok(())
    }

    /// G93 to G95. Each has the F that was programmed last with it.
    pub(super) fn feed_mode(&mut self, mode: FeedMode, own_feed: bool) {
        self.control.feed_mode(mode);
        let before = match mode {
            FeedMode::InverseTime => None,
            FeedMode::PerMinute => self.modes.feed_per_minute,
            FeedMode::PerRevolution => self.modes.feed_per_revolution,
        };
        if let Some(feed) = before.filter(|_| !own_feed) {
            self.control.feed_again(feed);
        }
    }

    fn block_motion(&mut self, words: &mut BlockWords, once: &OneShot, place: &Place) -> Done {
        let block = place.span;
        if self.spindle_motion(words, block)? {
            return Ok(());
        }
        let arc = matches!(
            self.control.modal.motion,
            Some(Motion::Clockwise | Motion::Counterclockwise)
        );
        if !words.motion.names_an_axis() {
            // A radius alone is for the arcs that follow; a centre alone is a full circle.
            if let Some(radius) = words.motion.radius.take() {
                self.modes.radius = Some(radius.value * self.control.modal.length_factor);
            }
            if !words.motion.is_motion() {
                return match once.exact_stop.or(once.contouring) {
                    None => Ok(()),
                    Some(span) => Err(Diagnostic::error(
                        span,
                        "this acts in its block only, and the block has no motion",
                    )
                    .help("put it beside the axes; G360 and G261 act until G359 and G260")),
                };
            }
        }
        if arc {
            self.prepare_arc(words, block)?;
        }
        let rapid = self.control.modal.motion == Some(Motion::Rapid);
        let mut own_feed = words.feed.is_some();
        if self.control.modal.feed_mode == FeedMode::InverseTime
            && !rapid
            && let Some(seconds) = self.modes.block_time
        {
            // LinuxCNC wants the reciprocal of the time in minutes, in every block.
            self.control.actions.push(Action::Feed(60.0 / seconds));
            self.control.modal.has_feed = true;
            own_feed = true;
        }
        let before = self.control.modal.path_control;
        if once.contouring.is_some() {
            self.round_contour(block)?;
            self.control.apply_states(false);
        }
        let exact_stop = once.exact_stop.is_some() || self.modes.exact_stop;
        if self.offset_free.active {
            self.control.offset_free_motion(
                &words.motion,
                &mut self.offset_free,
                block,
                own_feed,
                exact_stop,
            )?;
        } else {
            self.control
                .motion(&words.motion, block, own_feed, exact_stop)?;
        }
        if once.contouring.is_some() {
            self.control.path_control(before, block)?;
            self.control.apply_states(false);
        }
        for (axis, unsettled) in self.unsettled.iter_mut().enumerate() {
            *unsettled &= words.motion.axes[axis].is_none();
        }
        Ok(())
    }

    /// Corners are rounded by as much as `#CONTOUR MODE` has said.
    pub(super) fn round_contour(&mut self, span: Span) -> Done {
        self.control
            .continuous_path(self.modes.contour_deviation, span)
    }

    /// Centres by G161 or G162, radii that hold on.
    fn prepare_arc(&mut self, words: &mut BlockWords, block: Span) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        let factor = self.control.modal.length_factor;
        let motion = &mut words.motion;
        if let Some(radius) = motion.radius {
            self.modes.radius = Some(radius.value * factor);
        }
        let centred = motion.centre.iter().any(Option::is_some);
        if !centred && motion.radius.is_none() {
            motion.radius = self.modes.radius.map(|radius| At {
                value: radius / factor,
                span: block,
            });
        }
        if !centred || !self.modes.absolute_centre {
            return Ok(());
        }
        for centre in motion.centre.iter_mut().flatten() {
            centre.value.1 = Dimension::Absolute;
        }
        let given = motion
            .centre
            .iter()
            .flatten()
            .next()
            .map(|centre| centre.span);
        let span = given.unwrap_or(block);
        if motion.centre[first].is_none() || motion.centre[second].is_none() {
            return Err(Diagnostic::error(
                span,
                "an absolute centre (G161) needs both coordinates",
            )
            .help("write I and J in G17, K and I in G18, J and K in G19"));
        }
        let stays = motion.axes[first].is_none() && motion.axes[second].is_none();
        if stays && (self.unsettled[first] || self.unsettled[second]) {
            let message = "only the centre of this circle is mirrored, not its start: \
                           it would get another radius";
            let help = "move to the mirrored start of the circle before it";
            match self.control.settings.mirrored_circle {
                MirroredCircle::Refuse => {
                    return Err(Diagnostic::error(span, message).help(format!(
                        "{help}, or give --mirrored-circle warn if the control did that"
                    )));
                }
                MirroredCircle::Warn => {
                    let warning = Diagnostic::warning(span, message).help(help);
                    self.control.diagnostics.push(warning);
                }
            }
        }
        Ok(())
    }

    /// `G04 X2.5`, `G04 2.5`: seconds; `G04 S10`: revolutions.
    fn dwell(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        let [first, ..] = self.control.modal.plane.axes();
        let axis = rest.motion.axes[first].take();
        let axis = axis.map(|axis| At {
            value: axis.value.0,
            span: axis.span,
        });
        let (direct, turns) = (rest.g_value.take(), rest.speed.take());
        let other = rest.beside_axes(&[4]);
        if let (Some((word, at)), None, None, None) = (&other, axis, direct, turns) {
            return Err(
                Diagnostic::error(*at, format!("{word} is no time of G04 here"))
                    .help("G04 X2.5 and G04 2.5 wait 2.5 seconds, G04 S10 waits 10 revolutions"),
            );
        }
        let other = other.map(|(_, span)| span);
        if let Some(other) = other.or(rest.motion.first_axis()) {
            return Err(Diagnostic::error(other, "G04 stands alone in its block")
                .help("put everything but the time in another block"));
        }
        if let (Some(axis), Some(_)) = (axis, direct) {
            return Err(Diagnostic::error(axis.span, "G04 has its time twice")
                .help("leave one of them out"));
        }
        match (axis.or(direct), turns) {
            (Some(seconds), None) => self.control.dwell(seconds.value, seconds.span),
            (None, Some(turns)) => match self.control.modal.spindle_speed {
                Some(speed) if speed > 0.0 => {
                    self.control.dwell(60.0 * turns.value / speed, turns.span)
                }
                _ => Err(Diagnostic::error(
                    turns.span,
                    "a dwell in revolutions of a spindle without speed",
                )
                .help("program S before, or dwell in seconds: G04 X2")),
            },
            _ => {
                Err(Diagnostic::error(span, "G04 needs a time").help("G04 X2.5 waits 2.5 seconds"))
            }
        }
    }
}
