//! Drilling cycles, written out as moves: CYCLE81, CYCLE82 (drilling), CYCLE85 to CYCLE89 (reaming,
//! boring); CYCLE83 is in [`super::deep_hole`], CYCLE84 and CYCLE840 are in [`super::tapping`]. (Siemens,
//! SINUMERIK 840D, Programming Guide Cycles, "Drilling cycles and drilling patterns".)

use super::cycle_parameters::Cycle;
use super::interpreter::Interpreter;
use super::syntax::Call;
use super::tapping::turning;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, MotionWords};
use crate::program::{Action, Compensation, OrientWay, Spindle};
use crate::source::Span;

/// A drilling cycle; coordinates along the normal of the plane, units of the program.
pub(super) struct Hole<'a> {
    pub cycle: &'a Cycle<'a>,
    /// RTP.
    retraction: f64,
    /// RFP.
    pub reference: f64,
    /// RFP and SDIS.
    pub safe: f64,
    /// DP.
    pub bottom: f64,
}

/// Decimal places of `_AMODE` that a cycle knows; each goes from 0 to 2.
fn mode_places(cycle: &str) -> &'static [u32] {
    match cycle {
        "CYCLE83" => &[0, 1, 2, 3, 4, 5, 6, 7],
        "CYCLE84" => &[0, 3, 6],
        "CYCLE840" => &[0],
        _ => &[0, 1],
    }
}

/// Whether a cycle drills, reams, bores or taps a hole, for which the path is kept exactly.
pub(super) fn is_drilling(name: &str) -> bool {
    let kind = name.strip_prefix("CYCLE");
    kind.is_some_and(|kind| kind == "840" || matches!(kind.as_bytes(), [b'8', b'1'..=b'9']))
}

impl Interpreter<'_> {
    /// A drilling cycle at the present place.
    pub(super) fn drill(&mut self, call: &Call) -> Done {
        if self.control.modal.compensation != Compensation::Off {
            return self
                .control
                .refuse_compensation(call.span, "a drilling cycle");
        }
        let Some(cycle) = self.cycle(call)? else {
            return Ok(());
        };
        let hole = self.hole(&cycle)?;
        self.plunge(hole.safe, true, call.span)?;
        match cycle.name {
            "CYCLE83" => self.deep_hole(&hole)?,
            "CYCLE84" => self.rigid_tap(&hole)?,
            "CYCLE840" => self.floating_chuck(&hole)?,
            "CYCLE85" => self.ream(&hole)?,
            "CYCLE86" => return self.bore(&hole),
            "CYCLE87" | "CYCLE88" => self.bore_and_stop(&hole)?,
            name => {
                self.plunge(hole.bottom, false, call.span)?;
                self.wait_at_bottom(&cycle)?;
                if name == "CYCLE89" {
                    self.plunge(hole.safe, false, call.span)?;
                }
            }
        }
        self.plunge(hole.retraction, true, call.span)
    }

    /// DTB, as the tens of `_AMODE` say.
    fn wait_at_bottom(&mut self, cycle: &Cycle) -> Done {
        let unit = cycle.mode(1)?;
        self.wait_by(cycle, cycle.or_zero("DTB")?, unit)
    }

    /// A dwell of a cycle: with 0 as its sign says, with 1 in seconds, with 2 in revolutions of the
    /// spindle.
    pub(super) fn wait_by(&mut self, cycle: &Cycle, time: f64, unit: u32) -> Done {
        if time < 0.0 && unit == 1 {
            return Err(cycle.unsupported("_AMODE", "a dwell in seconds cannot be negative"));
        }
        self.wait(if unit == 2 { -time.abs() } else { time }, cycle.span)
    }

    /// CYCLE87 and CYCLE88: the spindle turns as SDIR says, stops at the bottom, and the operator goes on.
    fn bore_and_stop(&mut self, hole: &Hole) -> Done {
        let cycle = hole.cycle;
        if let Some(spindle) = turning(cycle.number("SDIR")?) {
            self.turn(spindle);
        }
        self.plunge(hole.bottom, false, cycle.span)?;
        if cycle.name == "CYCLE88" {
            self.wait_at_bottom(cycle)?;
        }
        self.control.set_spindle(Spindle::Stop);
        self.control.pause(false, cycle.span, cycle.name)
    }

    /// Switches the spindle if it does not turn that way already.
    fn turn(&mut self, spindle: Spindle) {
        if self.control.modal.spindle != Some(spindle) {
            self.control.set_spindle(spindle);
        }
    }

    /// CYCLE85: FFR and RFF are the feeds in and out.
    fn ream(&mut self, hole: &Hole) -> Done {
        let cycle = hole.cycle;
        let before = self.control.modal.feed;
        for (place, feed) in [(hole.bottom, "FFR"), (hole.safe, "RFF")] {
            if let Some(value) = cycle.nonzero(feed)? {
                let span = cycle.span_of(feed);
                self.control.feed(At { value, span })?;
            }
            self.plunge(place, false, cycle.span)?;
            if place == hole.bottom {
                self.wait_at_bottom(cycle)?;
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

    /// CYCLE86. At the bottom the spindle stops at the
    /// angle POSS, the cutting edge moves off the wall by RPA, RPO and RPAP, and the tool leaves the
    /// hole in rapid motion, then goes back over its middle.
    fn bore(&mut self, hole: &Hole) -> Done {
        let cycle = hole.cycle;
        let span = cycle.span;
        let off = [
            cycle.or_zero("RPA")?,
            cycle.or_zero("RPO")?,
            cycle.or_zero("RPAP")?,
        ];
        let Some(spindle) = turning(cycle.number("SDIR")?) else {
            return Err(
                Diagnostic::error(span, "CYCLE86 needs SDIR, how the spindle turns")
                    .help("value 7 is 3 for M3 or 4 for M4"),
            );
        };
        let [first, second, normal] = self.control.modal.plane.axes();
        let (Some(x), Some(y)) = (self.control.present(first), self.control.present(second)) else {
            return Err(Diagnostic::unknown_place(
                span,
                "where this hole is, is not known ahead of time",
            )
            .help("program its place absolute before the cycle"));
        };
        self.turn(spindle);
        self.plunge(hole.bottom, false, span)?;
        self.wait_at_bottom(cycle)?;
        self.control.modal.spindle = None;
        let angle = cycle.or_zero("POSS")?.rem_euclid(360.0);
        self.control
            .actions
            .push(Action::Orient(angle, OrientWay::Shorter));
        let lifted = [x + off[0], y + off[1], hole.bottom + off[2]];
        let axes = [first, second, normal];
        self.rapid_to(&axes, &lifted, span)?;
        self.plunge(hole.safe, true, span)?;
        self.rapid_to(&axes, &[x, y, hole.retraction], span)
    }

    /// The planes of a cycle: RTP, RFP, SDIS, DP, DPR.
    fn hole<'a>(&self, cycle: &'a Cycle) -> Result<Hole<'a>, Diagnostic> {
        cycle.check_modes(mode_places(cycle.name))?;
        self.check_tool_axis(cycle)?;
        let retraction = cycle.needed("RTP", "the retraction plane")?;
        let reference = cycle.or_zero("RFP")?;
        let clearance = cycle.or_zero("SDIS")?;
        let bottom = self.depth(cycle, reference, cycle.mode(0)?)?;
        let safe = reference + clearance;
        if clearance < 0.0 || bottom >= reference || retraction < safe {
            return Err(Diagnostic::error(
                cycle.span,
                "the planes of this cycle are not in the order RTP, RFP + SDIS, RFP, DP from above",
            )
            .help("check the retraction plane, the reference plane and the depth"));
        }
        Ok(Hole {
            cycle,
            retraction,
            reference,
            safe,
            bottom,
        })
    }

    /// DP or DPR: with 0 the one that is given, with 1 DPR, with 2 DP.
    pub(super) fn depth(
        &self,
        cycle: &Cycle,
        reference: f64,
        mode: u32,
    ) -> Result<f64, Diagnostic> {
        let below = |depth: f64| reference - depth.abs();
        let (absolute, relative) = (cycle.number("DP")?, cycle.nonzero("DPR")?);
        let bottom = match mode {
            0 => relative.map(below).or(absolute),
            1 => relative.map(below),
            _ => absolute,
        };
        bottom.ok_or_else(|| {
            Diagnostic::error(cycle.span, format!("{} needs a depth", cycle.name)).help(
                match mode {
                    0 => "give DP (absolute) or DPR (from the reference plane)",
                    1 => "the last digit of _AMODE is 1: give DPR (from the reference plane)",
                    _ => "the last digit of _AMODE is 2: give DP (absolute)",
                },
            )
        })
    }

    /// `_AXN` names the tool axis by its number from 1 on; 0 is the normal of the plane.
    fn check_tool_axis(&self, cycle: &Cycle) -> Done {
        if !cycle.has("_AXN") {
            return Ok(());
        }
        let [_, _, normal] = self.control.modal.plane.axes();
        match cycle.nonzero("_AXN")? {
            None => Ok(()),
            Some(axis) if axis == (normal + 1) as f64 => Ok(()),
            Some(_) => Err(cycle.unsupported(
                "_AXN",
                "holes are drilled along the normal of the plane: write 0, and G17, G18 or G19 before",
            )),
        }
    }

    /// How many millimetres a unit of the program has.
    pub(super) fn millimetres(&self) -> f64 {
        match self.control.settings.machine_in_inch {
            true => 25.4 * self.control.modal.length_factor,
            false => self.control.modal.length_factor,
        }
    }

    pub(super) fn rapid_to(&mut self, axes: &[usize], place: &[f64], span: Span) -> Done {
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
                return Err(Diagnostic::error(
                    span,
                    "a dwell in revolutions of a spindle without speed",
                ));
            }
        };
        if seconds > 0.0 {
            self.control.actions.push(Action::Dwell(seconds));
        }
        Ok(())
    }
}
