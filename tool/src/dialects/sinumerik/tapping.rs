//! Tapping: CYCLE84 with a rigid chuck, CYCLE840 with one that gives way. (Siemens, SINUMERIK 840D,
//! Programming Guide Cycles, "Rigid tapping" and "Tapping with compensating chuck".)

use super::drilling::Hole;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::spindle_motion::Tap;
use crate::dialects::control::words::At;
use crate::program::{Action, FeedMode, Spindle};

impl Interpreter<'_> {
    /// CYCLE84: DTB, SDAC, MPIT, PIT, POSS, SST, SST1 follow DPR. MPIT is the size of a metric thread.
    pub(super) fn rigid_tap(&mut self, hole: &Hole) -> Done {
        let call = hole.call;
        let value = |at: usize| self.value(call, at);
        let (after, size, pitch) = (value(6)?, value(7)?, value(8)?);
        let (speed, back) = (value(10)?, value(11)?);
        let pitch = self.pitch(hole, size, pitch)?.ok_or_else(|| {
            Box::new(
                Diagnostic::error(call.span, "CYCLE84 needs a pitch")
                    .help("give PIT, value 9, or MPIT, value 8, for a metric thread"),
            )
        })?;
        let Some(speed) = speed.filter(|speed| *speed > 0.0) else {
            return Err(Box::new(
                Diagnostic::error(call.span, "CYCLE84 needs a spindle speed")
                    .help("give SST, value 11"),
            ));
        };
        if value(5)?.is_some_and(|dwell| dwell != 0.0) {
            self.control.note("the dwell (DTB) of CYCLE84", call.span);
        }
        let before = self.control.modal.spindle_speed;
        let set = |value: f64| At {
            value,
            span: call.span,
        };
        self.control.speed(set(speed))?;
        let tap = Tap {
            bottom: hole.bottom,
            pitch,
            back: match back {
                Some(back) if back > 0.0 => back / speed,
                _ => 1.0,
            },
        };
        self.control.tap(&tap, call.span)?;
        if let Some(before) = before {
            self.control.speed(set(before))?;
        }
        if let Some(spindle) = turning(after) {
            self.control.set_spindle(spindle);
        }
        Ok(())
    }

    /// CYCLE840: DTB, SDR, SDAC, ENC, MPIT and PIT follow DPR. ENC 0 and 20 follow an encoder, which comes
    /// to the feed of the pitch here, as does 11; with 1 the feed of the program holds.
    pub(super) fn floating_chuck(&mut self, hole: &Hole) -> Done {
        let call = hole.call;
        let value = |at: usize| self.value(call, at);
        let dwell = value(5)?.unwrap_or(0.0);
        let (back, after, encoder) = (value(6)?, value(7)?, value(8)?.unwrap_or(0.0));
        let pitch = self.pitch(hole, value(9)?, value(10)?)?;
        let feed = match encoder {
            1.0 => None,
            0.0 | 11.0 | 20.0 => Some(self.feed_of_pitch(hole, pitch)?),
            other => {
                return Err(Box::new(
                    Diagnostic::error(call.span, format!("ENC = {other} is not supported"))
                        .help("0, 11 and 20 take the feed of the pitch, 1 that of the program"),
                ));
            }
        };
        let Some(turning_in @ (Spindle::Clockwise | Spindle::Counterclockwise)) =
            self.control.modal.spindle
        else {
            return Err(Box::new(
                Diagnostic::error(call.span, "CYCLE840, and the spindle does not turn")
                    .help("switch it on before: S500 M3"),
            ));
        };
        let turning_out = turning(back).unwrap_or(match turning_in {
            Spindle::Counterclockwise => Spindle::Clockwise,
            _ => Spindle::Counterclockwise,
        });
        let before = self.control.modal.feed;
        if let Some(value) = feed {
            let span = call.span;
            self.control.feed(At { value, span })?;
        }
        self.control.actions.push(Action::Overrides(false));
        self.plunge(hole.bottom, false, call.span)?;
        if encoder != 0.0 {
            self.wait(dwell, call.span)?;
        }
        self.control.set_spindle(turning_out);
        self.plunge(hole.safe, false, call.span)?;
        self.control.actions.push(Action::Overrides(true));
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

    /// Units of the program a minute.
    fn feed_of_pitch(&self, hole: &Hole, pitch: Option<f64>) -> Result<f64, Box<Diagnostic>> {
        let modal = &self.control.modal;
        match (pitch, modal.spindle_speed, modal.feed_mode) {
            (Some(pitch), Some(speed), FeedMode::PerMinute) if speed > 0.0 => {
                Ok(pitch.abs() * speed)
            }
            _ => Err(Box::new(
                Diagnostic::error(
                    hole.call.span,
                    "CYCLE840 needs S, G94 and a pitch: they give its feed",
                )
                .help(
                    "give PIT, value 11, or MPIT, value 10; or write ENC = 1, value 9, and F before \
                     the cycle",
                ),
            )),
        }
    }

    /// PIT, or that of the metric thread of the size MPIT; units of the program, negative for a thread
    /// that turns left.
    fn pitch(
        &self,
        hole: &Hole,
        size: Option<f64>,
        pitch: Option<f64>,
    ) -> Result<Option<f64>, Box<Diagnostic>> {
        match (pitch, size) {
            (Some(pitch), _) if pitch != 0.0 => Ok(Some(pitch)),
            (_, Some(size)) if size != 0.0 => {
                let pitch = coarse_pitch(size.abs()).ok_or_else(|| {
                    Box::new(
                        Diagnostic::error(
                            hole.call.span,
                            format!("M{size} is not a metric thread"),
                        )
                        .help("give the pitch itself as PIT, the value behind"),
                    )
                })?;
                Ok(Some(pitch.copysign(size) / self.millimetres()))
            }
            _ => Ok(None),
        }
    }
}

/// How the spindle turns by a parameter that is 3 or 4.
fn turning(direction: Option<f64>) -> Option<Spindle> {
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
