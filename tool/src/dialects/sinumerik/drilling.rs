//! Drilling cycles and patterns of holes, written out as moves: CYCLE81, CYCLE82 (drilling), CYCLE83 (deep
//! holes), CYCLE85 to CYCLE89 (reaming, boring), HOLES1 (a row), HOLES2 (a circle); CYCLE84 and CYCLE840
//! are in [`super::tapping`]. (Siemens, SINUMERIK 840D, Programming Guide Cycles, "Drilling cycles and
//! drilling patterns".)

use super::interpreter::Interpreter;
use super::syntax::{Block, Call};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, MotionWords};
use crate::program::{Action, Compensation, Spindle};
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// How many strokes a deep hole may take.
const STROKE_LIMIT: usize = 1000;

/// How many holes a pattern may have.
const HOLE_LIMIT: u32 = 10_000;

/// How far chip breaking (VARI = 0) comes back, millimetres.
const CHIP_BREAKING: f64 = 1.0;

/// A drilling cycle; coordinates along the normal of the plane, units of the program.
pub(super) struct Hole<'a> {
    pub call: &'a Call,
    /// RTP.
    retraction: f64,
    /// RFP.
    reference: f64,
    /// RFP and SDIS.
    pub safe: f64,
    /// DP.
    pub bottom: f64,
}

impl Interpreter<'_> {
    /// A drilling cycle at the present place.
    pub(super) fn drill(&mut self, call: &Call) -> Done {
        if self.control.modal.compensation != Compensation::Off {
            return self
                .control
                .refuse_compensation(call.span, "a drilling cycle");
        }
        let hole = self.hole(call)?;
        self.plunge(hole.safe, true, call.span)?;
        match call.name.as_str() {
            "CYCLE83" => self.deep_hole(&hole)?,
            "CYCLE84" => self.rigid_tap(&hole)?,
            "CYCLE840" => self.floating_chuck(&hole)?,
            "CYCLE85" => self.ream(&hole)?,
            "CYCLE86" => return self.bore(&hole),
            name => {
                self.plunge(hole.bottom, false, call.span)?;
                let dwell = match name {
                    "CYCLE81" | "CYCLE87" => 0.0,
                    _ => self.value(call, 5)?.unwrap_or(0.0),
                };
                self.wait(dwell, call.span)?;
            }
        }
        match call.name.as_str() {
            "CYCLE89" => self.plunge(hole.safe, false, call.span)?,
            "CYCLE87" | "CYCLE88" => {
                // The operator goes on when the spindle stands.
                self.control.set_spindle(Spindle::Stop);
                self.control.actions.push(Action::Pause { optional: false });
            }
            _ => {}
        }
        self.plunge(hole.retraction, true, call.span)
    }

    /// CYCLE85: DTB, FFR and RFF follow DPR, the feeds in and out.
    fn ream(&mut self, hole: &Hole) -> Done {
        let call = hole.call;
        let feeds = [6, 7].map(|at| self.value(call, at));
        let before = self.control.modal.feed;
        for (place, feed) in [hole.bottom, hole.safe].into_iter().zip(feeds) {
            if let Some(value) = feed?.filter(|feed| *feed != 0.0) {
                self.control.feed(At {
                    value,
                    span: call.span,
                })?;
            }
            self.plunge(place, false, call.span)?;
            if place == hole.bottom {
                let dwell = self.value(call, 5)?.unwrap_or(0.0);
                self.wait(dwell, call.span)?;
            }
        }
        self.restore_feed(before);
        Ok(())
    }

    /// The feed of the program holds again.
    pub(super) fn restore_feed(&mut self, before: Option<f64>) {
        if let Some(before) = before.filter(|before| Some(*before) != self.control.modal.feed) {
            self.control.modal.feed = Some(before);
            self.control.actions.push(Action::Feed(before));
        }
    }

    /// CYCLE86: DTB, SDIR, RPA, RPO, RPAP and POSS follow DPR. At the bottom the spindle stops at the
    /// angle POSS, the cutting edge moves off the wall by RPA, RPO and RPAP, and the tool leaves the
    /// hole in rapid motion, then goes back over its middle.
    fn bore(&mut self, hole: &Hole) -> Done {
        let call = hole.call;
        let mut values = [0.0; 6];
        for (at, value) in values.iter_mut().enumerate() {
            *value = self.value(call, 5 + at)?.unwrap_or(0.0);
        }
        let [dwell, direction, off @ .., angle] = values;
        let spindle = match direction {
            3.0 => Spindle::Clockwise,
            4.0 => Spindle::Counterclockwise,
            _ => {
                return Err(Box::new(
                    Diagnostic::error(call.span, "CYCLE86 needs SDIR, how the spindle turns")
                        .help("value 7 is 3 for M3 or 4 for M4"),
                ));
            }
        };
        let [first, second, normal] = self.control.modal.plane.axes();
        let (Some(x), Some(y)) = (self.control.present(first), self.control.present(second)) else {
            return Err(Box::new(
                Diagnostic::error(call.span, "where this hole is, is not known ahead of time")
                    .help("program its place absolute before the cycle"),
            ));
        };
        if self.control.modal.spindle != Some(spindle) {
            self.control.set_spindle(spindle);
        }
        self.plunge(hole.bottom, false, call.span)?;
        self.wait(dwell, call.span)?;
        self.control.modal.spindle = None;
        let angle = angle.rem_euclid(360.0);
        self.control.actions.push(Action::Orient(angle));
        let lifted = [x + off[0], y + off[1], hole.bottom + off[2]];
        let axes = [first, second, normal];
        self.rapid_to(&axes, &lifted, call.span)?;
        self.plunge(hole.safe, true, call.span)?;
        self.rapid_to(&axes, &[x, y, hole.retraction], call.span)
    }

    /// The planes of a cycle: RTP, RFP, SDIS, DP, DPR.
    fn hole<'a>(&self, call: &'a Call) -> Result<Hole<'a>, Box<Diagnostic>> {
        let known = match call.name.as_str() {
            "CYCLE81" | "CYCLE87" => 5,
            "CYCLE83" | "CYCLE84" => 12,
            "CYCLE840" | "CYCLE86" => 11,
            "CYCLE85" => 8,
            _ => 6,
        };
        for at in known..call.arguments.len() {
            // Which way the spindle turns at the bottom of CYCLE87 and CYCLE88 before it stops.
            if matches!((call.name.as_str(), at), ("CYCLE87", 5) | ("CYCLE88", 6)) {
                continue;
            }
            if self.value(call, at)?.is_some_and(|value| value != 0.0) {
                return Err(Box::new(
                    Diagnostic::error(
                        call.span,
                        format!("value {} of {} is not supported", at + 1, call.name),
                    )
                    .help(
                        "it belongs to the modes of newer controls: post the program with the moves \
                         of the cycle",
                    ),
                ));
            }
        }
        let need = |at: usize, name: &str| {
            self.value(call, at)?.ok_or_else(|| {
                Box::new(Diagnostic::error(
                    call.span,
                    format!("{} needs {name}", call.name),
                ))
            })
        };
        let retraction = need(0, "RTP, the retraction plane")?;
        let reference = self.value(call, 1)?.unwrap_or(0.0);
        let clearance = self.value(call, 2)?.unwrap_or(0.0);
        let bottom = match (self.value(call, 4)?, self.value(call, 3)?) {
            (Some(depth), _) if depth != 0.0 => reference - depth.abs(),
            (_, Some(bottom)) => bottom,
            _ => {
                return Err(Box::new(
                    Diagnostic::error(call.span, format!("{} needs a depth", call.name))
                        .help("give DP (absolute) or DPR (from the reference plane)"),
                ));
            }
        };
        let safe = reference + clearance;
        if clearance < 0.0 || bottom >= reference || retraction < safe {
            return Err(Box::new(
                Diagnostic::error(
                    call.span,
                    "the planes of this cycle are not in the order RTP, RFP + SDIS, RFP, DP from above",
                )
                .help("check the retraction plane, the reference plane and the depth"),
            ));
        }
        Ok(Hole {
            call,
            retraction,
            reference,
            safe,
            bottom,
        })
    }

    /// CYCLE83: FDEP, FDPR, DAM, DTB, DTS, FRF, VARI follow DPR.
    fn deep_hole(&mut self, hole: &Hole) -> Done {
        let call = hole.call;
        let value = |at: usize| self.value(call, at);
        let first = match (value(6)?, value(5)?) {
            (Some(depth), _) if depth != 0.0 => depth.abs(),
            (_, Some(depth)) => hole.reference - depth,
            _ => hole.reference - hole.bottom,
        };
        let (less, at_bottom, at_top) = (value(7)?, value(8)?, value(9)?);
        let (share, clears) = (value(10)?, value(11)?);
        if share.is_some_and(|share| share != 1.0 && share != 0.0) {
            return Err(Box::new(
                Diagnostic::error(
                    call.span,
                    "FRF, another feed for the first stroke, is not supported",
                )
                .help("write 1"),
            ));
        }
        let clears = match clears.unwrap_or(0.0) {
            0.0 => false,
            1.0 => true,
            other => {
                return Err(Box::new(
                    Diagnostic::error(call.span, format!("VARI = {other} is not supported"))
                        .help("0 breaks chips, 1 clears them"),
                ));
            }
        };
        let depths =
            strokes(hole.reference - hole.bottom, first, less.unwrap_or(0.0)).ok_or_else(|| {
                Box::new(
                    Diagnostic::error(
                        call.span,
                        "the strokes of this cycle do not lead to the bottom",
                    )
                    .help("check the first depth (FDEP, FDPR) and DAM"),
                )
            })?;
        let factor = self.control.modal.length_factor;
        let last = depths.len() - 1;
        for (at, depth) in depths.into_iter().enumerate() {
            if !self.control.count_block(call.span) {
                return Ok(());
            }
            let bottom = hole.reference - depth;
            self.plunge(bottom, false, call.span)?;
            self.wait(at_bottom.unwrap_or(0.0), call.span)?;
            if at == last {
                break;
            }
            if clears {
                self.plunge(hole.safe, true, call.span)?;
                self.wait(at_top.unwrap_or(0.0), call.span)?;
                // How far before the last bottom the rapid motion ends: 0.6 mm up to a depth of 30 mm,
                // then a fiftieth of it, at most 7 mm.
                let ahead = (depth * factor / 50.0).clamp(0.6, 7.0) / factor;
                self.plunge((bottom + ahead).min(hole.safe), true, call.span)?;
            } else {
                let back = CHIP_BREAKING / self.millimetres();
                self.plunge((bottom + back).min(hole.safe), false, call.span)?;
            }
        }
        Ok(())
    }

    /// How many millimetres a unit of the program has.
    pub(super) fn millimetres(&self) -> f64 {
        match self.control.settings.machine_in_inch {
            true => 25.4 * self.control.modal.length_factor,
            false => self.control.modal.length_factor,
        }
    }

    /// `HOLES1(SPCA, SPCO, STA1, FDIS, DBH, NUM)`, `HOLES2(CPA, CPO, RAD, STA1, INDA, NUM)`: the modal
    /// subprogram or cycle at each place.
    pub(super) fn holes(&mut self, call: &Call, block: &Block) -> Done {
        let mut values = [0.0; 6];
        for (at, value) in values.iter_mut().enumerate() {
            *value = self.value(call, at)?.unwrap_or(0.0);
        }
        let [a, b, third, fourth, fifth, count] = values;
        if count.fract() != 0.0 || !(1.0..=f64::from(HOLE_LIMIT)).contains(&count) {
            return Err(Box::new(Diagnostic::error(
                call.span,
                format!("NUM = {count} is not a number of holes"),
            )));
        }
        if self.modal_call.is_none() {
            return Err(Box::new(
                Diagnostic::error(call.span, format!("{} without a modal cycle", call.name))
                    .help("say before what is done at the holes: MCALL CYCLE81(10,0,2,-5)"),
            ));
        }
        for number in 0..count as u32 {
            if !self.control.count_block(call.span) {
                return Ok(());
            }
            let number = f64::from(number);
            let (distance, direction) = match call.name.as_str() {
                "HOLES1" => (fourth + number * fifth, third),
                _ => {
                    let step = if fifth == 0.0 { 360.0 / count } else { fifth };
                    (third, fourth + number * step)
                }
            };
            let (sin, cos) = sin_cos_degrees(direction);
            self.go_to([a + distance * cos, b + distance * sin], call.span)?;
            self.control
                .finish_marker(&super::interpreter::place(block));
            if !matches!(
                self.run_modal_call(block, 0)?,
                super::interpreter::Next::Block(_)
            ) {
                return Ok(());
            }
        }
        Ok(())
    }

    fn go_to(&mut self, place: [f64; 2], span: Span) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        self.rapid_to(&[first, second], &place, span)
    }

    fn rapid_to(&mut self, axes: &[usize], place: &[f64], span: Span) -> Done {
        let mut words = MotionWords::default();
        for (axis, value) in axes.iter().zip(place) {
            if self.control.present(*axis) != Some(*value) {
                words.axes[*axis] = Some(super::arc_words::absolute(*value, span));
            }
        }
        if !words.names_an_axis() {
            return Ok(());
        }
        let before = self.control.modal.motion.replace(Motion::Rapid);
        let done = self.control.motion(&words, span, false, false);
        self.control.modal.motion = before;
        done
    }

    pub(super) fn plunge(&mut self, place: f64, rapid: bool, span: Span) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        if self.control.present(normal) == Some(place) {
            return Ok(());
        }
        self.control.move_axis(normal, place, rapid, span)
    }

    /// Seconds, or if negative revolutions of the spindle.
    pub(super) fn wait(&mut self, time: f64, span: Span) -> Done {
        let seconds = match (time < 0.0, self.control.modal.spindle_speed) {
            (false, _) => time,
            (true, Some(speed)) if speed > 0.0 => -60.0 * time / speed,
            _ => {
                return Err(Box::new(Diagnostic::error(
                    span,
                    "a dwell in revolutions of a spindle without speed",
                )));
            }
        };
        if seconds > 0.0 {
            self.control.actions.push(Action::Dwell(seconds));
        }
        Ok(())
    }

    pub(super) fn value(&self, call: &Call, at: usize) -> Result<Option<f64>, Box<Diagnostic>> {
        match call.arguments.get(at) {
            Some(Some(argument)) => argument.number(&self.variables).map(Some),
            _ => Ok(None),
        }
    }
}

/// The depths of the strokes, from the reference plane: each stroke is shorter by `less` than the one
/// before until it would be shorter than `less`; the last two share what is left. `None` where they never
/// reach the bottom.
fn strokes(total: f64, first: f64, less: f64) -> Option<Vec<f64>> {
    if !(first > 0.0 && less >= 0.0) {
        return None;
    }
    let mut depths = vec![first.min(total)];
    let mut stroke = first;
    while let Some(depth) = depths.last().copied().filter(|depth| *depth < total) {
        stroke = if stroke - less >= less {
            stroke - less
        } else {
            less
        };
        let left = total - depth;
        let next = match left {
            left if left <= stroke => left,
            left if less > 0.0 && left < 2.0 * stroke && stroke == less => left / 2.0,
            _ => stroke,
        };
        // Rounding must not leave a last stroke of nothing.
        depths.push(if total - depth - next < 1e-9 * total {
            total
        } else {
            depth + next
        });
        if depths.len() > STROKE_LIMIT {
            return None;
        }
    }
    Some(depths)
}

#[cfg(test)]
mod tests {
    use super::strokes;

    #[test]
    fn strokes_become_shorter_and_end_at_the_bottom() {
        assert_eq!(strokes(10.0, 4.0, 0.0), Some(vec![4.0, 8.0, 10.0]));
        assert_eq!(strokes(10.0, 20.0, 1.0), Some(vec![10.0]));
        assert_eq!(
            strokes(20.0, 8.0, 3.0),
            Some(vec![8.0, 13.0, 16.0, 18.0, 20.0])
        );
        assert_eq!(strokes(10.0, 0.0, 1.0), None);
        assert_eq!(strokes(10.0, 1e-9, 0.0), None);
    }
}
