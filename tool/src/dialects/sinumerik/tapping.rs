//! Tapping: CYCLE84 with a rigid chuck, CYCLE840 with one that gives way. (Siemens, SINUMERIK 840D,
//! Programming Guide Cycles, "Rigid tapping" and "Tapping with compensating chuck".)

use super::cycle_parameters::Cycle;
use super::drilling::Hole;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::spindle_motion::Tap;
use crate::dialects::control::words::At;
use crate::program::{FeedMode, Spindle};
use std::f64::consts::PI;

/// How many strokes a tap may take.
const STROKE_LIMIT: f64 = 1000.0;

impl Interpreter<'_> {
    /// CYCLE84. MPIT is the size of a metric thread.
    pub(super) fn rigid_tap(&mut self, hole: &Hole) -> Done {
        let cycle = hole.cycle;
        let span = cycle.span;
        let pitch = self.pitch(cycle)?.ok_or_else(|| {
            Diagnostic::error(span, "CYCLE84 needs a pitch")
                .help("give PIT, value 9, or MPIT, value 8, for a metric thread")
        })?;
        // The thousands: 1 a thread that turns right, 2 left, whatever the sign of the pitch.
        let pitch = match cycle.mode(3)? {
            0 => pitch,
            1 => pitch.abs(),
            _ => -pitch.abs(),
        };
        let Some(speed) = cycle.number("SST")?.filter(|speed| *speed > 0.0) else {
            return Err(
                Diagnostic::error(span, "CYCLE84 needs a spindle speed").help("give SST, value 11")
            );
        };
        if cycle.or_zero("POSS")?.rem_euclid(360.0) != 0.0 {
            return Err(cycle.unsupported(
                "POSS",
                "LinuxCNC begins each thread at the index of the spindle: write 0",
            ));
        }
        if cycle.nonzero("DTB")?.is_some() {
            self.control.note("the dwell (DTB) of CYCLE84", span);
        }
        let before = self.control.modal.spindle_speed;
        self.control.speed(At { value: speed, span })?;
        let back = match cycle.nonzero("SST1")? {
            Some(back) if back > 0.0 => back / speed,
            _ => 1.0,
        };
        for bottom in self.tap_depths(hole)? {
            if !self.control.count_block(span) {
                return Ok(());
            }
            self.control.tap(
                &Tap {
                    bottom,
                    pitch,
                    back,
                },
                span,
            )?;
        }
        if let Some(value) = before {
            self.control.speed(At { value, span })?;
        }
        if let Some(spindle) = turning(cycle.number("SDAC")?) {
            self.control.set_spindle(spindle);
        }
        Ok(())
    }

    /// Where the strokes of CYCLE84 turn back: with `_VARI` 1 and 2 each is deeper by `_DAM` than the one
    /// before. LinuxCNC comes back to where a tap began, and begins all in the same groove.
    fn tap_depths(&mut self, hole: &Hole) -> Result<Vec<f64>, Diagnostic> {
        let cycle = hole.cycle;
        let total = hole.reference - hole.bottom;
        let step = match (cycle.or_zero("_VARI")?, cycle.nonzero("_DAM")?) {
            (0.0, _) => total,
            (1.0 | 2.0, Some(step)) => step.abs(),
            (1.0 | 2.0, None) => return Err(cycle.missing("_DAM, the depth of a stroke")),
            _ => {
                return Err(cycle.unsupported(
                    "_VARI",
                    "0 taps in one stroke, 1 breaks chips, 2 clears them",
                ));
            }
        };
        let count = (total / step - 1e-9).ceil().max(1.0);
        if count > STROKE_LIMIT {
            return Err(cycle.unsupported("_DAM", "this tap would take too many strokes"));
        }
        if cycle.or_zero("_VARI")? == 1.0 {
            self.control.diagnostics.push(
                Diagnostic::warning(
                    cycle.span,
                    "this tap comes out of the hole after each stroke, and not by _VRT only",
                )
                .help("LinuxCNC taps back to where the tap began; the thread is the same"),
            );
        }
        let depth = |number: u32| hole.reference - (f64::from(number) * step).min(total);
        Ok((1..=count as u32).map(depth).collect())
    }

    /// CYCLE840. ENC 0 and 20 follow an encoder, which comes to the feed of the pitch here, as does 11; with
    /// 1 the feed of the program holds.
    pub(super) fn floating_chuck(&mut self, hole: &Hole) -> Done {
        let cycle = hole.cycle;
        let dwell = cycle.or_zero("DTB")?;
        let (back, after) = (cycle.number("SDR")?, cycle.number("SDAC")?);
        let encoder = cycle.or_zero("ENC")?;
        let pitch = self.pitch(cycle)?;
        let feed = match encoder {
            1.0 => None,
            0.0 | 11.0 | 20.0 => Some(self.feed_of_pitch(cycle, pitch)?),
            _ => {
                return Err(cycle.unsupported(
                    "ENC",
                    "0, 11 and 20 take the feed of the pitch, 1 that of the program",
                ));
            }
        };
        let Some(turning_in @ (Spindle::Clockwise | Spindle::Counterclockwise)) =
            self.control.modal.spindle
        else {
            return Err(
                Diagnostic::error(cycle.span, "CYCLE840, and the spindle does not turn")
                    .help("switch it on before: S500 M3"),
            );
        };
        let turning_out = turning(back).unwrap_or(match turning_in {
            Spindle::Counterclockwise => Spindle::Clockwise,
            _ => Spindle::Counterclockwise,
        });
        let before = self.control.modal.feed;
        if let Some(value) = feed {
            let span = cycle.span;
            self.control.feed(At { value, span })?;
        }
        self.control.begin_tap_without_overrides();
        self.plunge(hole.bottom, false, cycle.span)?;
        if encoder != 0.0 {
            self.wait(dwell, cycle.span)?;
        }
        self.control.set_spindle(turning_out);
        self.plunge(hole.safe, false, cycle.span)?;
        self.control.end_tap_without_overrides();
        self.restore_feed(before);
        // SDAC says nothing where the way back is left to the control (SDR = 0).
        let after = match turning(back) {
            Some(_) if after == Some(5.0) => Spindle::Stop,
            Some(_) => turning(after).unwrap_or(turning_in),
            None => turning_in,
        };
        self.control.set_spindle(after);
        Ok(())
    }

    /// F of the program: G70 and G71 change the unit of lengths, and so of the pitch, and not that of F.
    fn feed_of_pitch(&self, cycle: &Cycle, pitch: Option<f64>) -> Result<f64, Diagnostic> {
        let modal = &self.control.modal;
        match (pitch, modal.spindle_speed, modal.feed_mode) {
            (Some(pitch), Some(speed), FeedMode::PerMinute) if speed > 0.0 => {
                Ok(pitch.abs() * speed * modal.length_factor / modal.feed_factor)
            }
            _ => Err(Diagnostic::error(
                cycle.span,
                "CYCLE840 needs S, G94 and a pitch: they give its feed",
            )
            .help(
                "give PIT, value 11, or MPIT, value 10; or write ENC = 1, value 9, and F before \
                     the cycle",
            )),
        }
    }

    /// PIT in the unit of `_PITA`, or the pitch of the metric thread of the size MPIT; units of the program,
    /// negative for a thread that turns left.
    fn pitch(&self, cycle: &Cycle) -> Result<Option<f64>, Diagnostic> {
        let millimetres = |pitch: f64| Some(pitch / self.millimetres());
        match (cycle.nonzero("PIT")?, cycle.or_zero("_PITA")?) {
            (Some(pitch), 0.0) => return Ok(Some(pitch)),
            (Some(pitch), 1.0) => return Ok(millimetres(pitch)),
            (Some(threads), 2.0) => return Ok(millimetres(25.4 / threads)),
            (Some(pitch), 3.0) => return Ok(millimetres(25.4 * pitch)),
            (Some(module), 4.0) => return Ok(millimetres(PI * module)),
            (None, 0.0 | 1.0) => {}
            _ => {
                return Err(cycle.unsupported(
                    "_PITA",
                    "PIT is in millimetres (1), threads to the inch (2), inches (3) or a module (4)",
                ));
            }
        }
        let Some(size) = cycle.nonzero("MPIT")? else {
            return Ok(None);
        };
        let pitch = coarse_pitch(size.abs()).ok_or_else(|| {
            Diagnostic::error(
                cycle.span_of("MPIT"),
                format!("M{size} is not a metric thread"),
            )
            .help("give the pitch itself as PIT, the value behind")
        })?;
        Ok(millimetres(pitch.copysign(size)))
    }
}

/// How the spindle turns by a parameter that is 3 or 4.
pub(super) fn turning(direction: Option<f64>) -> Option<Spindle> {
    match direction? {
        3.0 => Some(Spindle::Clockwise),
        4.0 => Some(Spindle::Counterclockwise),
        _ => None,
    }
}

/// The pitch of a metric thread with coarse pitch, millimetres (ISO 261).
fn coarse_pitch(size: f64) -> Option<f64> {
    const PITCHES: [(f64, f64); 22] = [
        (2.0, 0.4),
        (2.5, 0.45),
        (3.0, 0.5),
        (3.5, 0.6),
        (4.0, 0.7),
        (4.5, 0.75),
        (5.0, 0.8),
        (6.0, 1.0),
        (7.0, 1.0),
        (8.0, 1.25),
        (10.0, 1.5),
        (12.0, 1.75),
        (14.0, 2.0),
        (16.0, 2.0),
        (18.0, 2.5),
        (20.0, 2.5),
        (22.0, 2.5),
        (24.0, 3.0),
        (27.0, 3.0),
        (30.0, 3.5),
        (36.0, 4.0),
        (48.0, 5.0),
    ];
    let found = PITCHES.iter().find(|(known, _)| *known == size);
    found.map(|(_, pitch)| *pitch)
}
