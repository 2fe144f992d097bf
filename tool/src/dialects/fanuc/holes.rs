//! How each canned cycle makes its hole.

use super::block_words::g_name;
use super::cycles::{Cycle, Hole};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::spindle_motion::Tap;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::{Action, FeedMode, OrientWay, Spindle};

/// How far G73 lifts the tool, and before which depth G83 ends its rapid motion: that of LinuxCNC's own
/// cycles, millimetres. The control has parameters for both.
const CLEARANCE: f64 = 0.254;

impl Interpreter<'_> {
    /// The cycle in force, where the tool is.
    pub(super) fn drill(&mut self) -> Done {
        let Some(cycle) = self.cycle.clone() else {
            return Ok(());
        };
        let hole = self.hole(&cycle)?;
        self.to(hole.top, true, &cycle)?;
        match cycle.code {
            730 | 830 => self.in_steps(&cycle, hole)?,
            740 | 840 | 842 | 843 => self.tap_hole(&cycle, hole)?,
            760 => return self.bore_finely(&cycle, hole),
            860 => return self.bore_and_stop(&cycle, hole),
            _ => {
                self.to(hole.bottom, false, &cycle)?;
                if cycle.code != 810 {
                    self.wait(&cycle);
                }
            }
        }
        if matches!(cycle.code, 850 | 890) {
            self.to(hole.top, false, &cycle)?;
        }
        self.out(&cycle, hole)
    }

    /// Rapid to R, or with G98 to the initial level.
    fn out(&mut self, cycle: &Cycle, hole: Hole) -> Done {
        let level = match self.to_return_level {
            true => hole.top,
            false => cycle.initial()?,
        };
        self.to(level, true, cycle)
    }

    /// G73 lifts the tool a little after each step, G83 out of the hole.
    fn in_steps(&mut self, cycle: &Cycle, hole: Hole) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        let scaled = self.transforms.factor(normal);
        let step = match cycle.step {
            Some(step) if step.value > 0.0 => step.value / scaled,
            step => {
                return Err(Diagnostic::error(
                    step.map_or(cycle.span, |step| step.span),
                    format!(
                        "{} needs Q above 0, the depth of a step",
                        g_name(cycle.code)
                    ),
                )
                .help("write Q5."));
            }
        };
        let unit = if self.inch { 25.4 } else { 1.0 };
        let clearance = (CLEARANCE / unit / scaled).min(step);
        let mut depth = hole.top;
        loop {
            if !self.control.count_block(cycle.span) {
                return Ok(());
            }
            depth = (depth - step).max(hole.bottom);
            self.to(depth, false, cycle)?;
            if depth <= hole.bottom {
                break;
            }
            if cycle.code == 730 {
                self.to(depth + clearance, true, cycle)?;
            } else {
                self.to(hole.top, true, cycle)?;
                self.to(depth + clearance, true, cycle)?;
            }
        }
        self.wait(cycle);
        Ok(())
    }

    /// G84, and G74 for a thread that turns left; behind M29 in step with the spindle.
    fn tap_hole(&mut self, cycle: &Cycle, hole: Hole) -> Done {
        let left = matches!(cycle.code, 740 | 843);
        if let Some(step) = cycle.step.filter(|step| step.value != 0.0) {
            return Err(
                Diagnostic::error(step.span, "tapping in steps (Q) is not supported")
                    .help("leave Q out, or tap to several depths one after the other"),
            );
        }
        if self.rigid || matches!(cycle.code, 842 | 843) {
            return self.rigid_tap(cycle, hole, left);
        }
        self.control.note_once(
            "tap",
            "this tap is cut with F, for a chuck that gives way; write M29 S500 before it to follow the spindle",
            cycle.span,
        );
        let (inward, outward) = match left {
            true => (Spindle::Counterclockwise, Spindle::Clockwise),
            false => (Spindle::Clockwise, Spindle::Counterclockwise),
        };
        if self.control.modal.spindle != Some(inward) {
            return Err(Diagnostic::error(
                cycle.span,
                "a tap, and the spindle does not turn its way",
            )
            .help(match left {
                true => "switch it on before: S500 M4",
                false => "switch it on before: S500 M3",
            }));
        }
        self.control.begin_tap_without_overrides();
        self.to(hole.bottom, false, cycle)?;
        self.wait(cycle);
        self.control.set_spindle(outward);
        self.to(hole.top, false, cycle)?;
        self.control.set_spindle(inward);
        self.control.end_tap_without_overrides();
        Ok(())
    }

    fn rigid_tap(&mut self, cycle: &Cycle, hole: Hole, left: bool) -> Done {
        let modal = &self.control.modal;
        let turns = modal.spindle_speed.filter(|speed| *speed > 0.0);
        let pitch = match (modal.feed, modal.feed_mode, turns) {
            (Some(feed), FeedMode::PerMinute, Some(turns)) => feed / turns,
            (Some(feed), FeedMode::PerRevolution, _) => feed,
            _ => {
                return Err(Diagnostic::error(
                    cycle.span,
                    "a rigid tap needs F and S: they give its pitch",
                )
                .help("write M29 S500 and F500. for a pitch of 1"));
            }
        };
        if cycle.dwell > 0.0 {
            let span = cycle.dwell_at.unwrap_or(cycle.span);
            self.control.note("the dwell (P) of a rigid tap", span);
        }
        let pitch = pitch / self.control.modal.length_factor;
        let tap = Tap {
            bottom: hole.bottom,
            pitch: if left { -pitch } else { pitch },
            back: 1.0,
        };
        self.control.tap(&tap, cycle.span)
    }

    /// G76: the spindle stops at its angle, and the tool leaves the wall before it comes out.
    fn bore_finely(&mut self, cycle: &Cycle, hole: Hole) -> Done {
        if cycle.shift == [0.0; 2] {
            return Err(Diagnostic::error(
                cycle.step.map_or(cycle.span, |step| step.span),
                "which way G76 moves the tool off the wall is a setting of the control",
            )
            .help("write the way as I and J instead of Q: G76 X10. Y10. Z-20. R2. I0.5 J0 F100."));
        }
        if !self.transforms.is_empty() {
            return Err(Diagnostic::error(
                cycle.span,
                "G76 while G51, G51.1, G68 or G68.2 is in force",
            )
            .help("the spindle stops at the same angle whatever they are: end them before"));
        }
        let spindle = self.turning(cycle)?;
        self.to(hole.bottom, false, cycle)?;
        self.wait(cycle);
        self.control.modal.spindle = Some(Spindle::Stop);
        self.control
            .actions
            .push(Action::Orient(0.0, OrientWay::Shorter));
        self.sideways(cycle, 1.0)?;
        self.out(cycle, hole)?;
        self.sideways(cycle, -1.0)?;
        self.control.set_spindle(spindle);
        Ok(())
    }

    /// G86: out with the spindle standing.
    fn bore_and_stop(&mut self, cycle: &Cycle, hole: Hole) -> Done {
        let spindle = self.turning(cycle)?;
        self.to(hole.bottom, false, cycle)?;
        self.wait(cycle);
        self.control.set_spindle(Spindle::Stop);
        self.out(cycle, hole)?;
        self.control.set_spindle(spindle);
        Ok(())
    }

    fn turning(&self, cycle: &Cycle) -> Result<Spindle, Diagnostic> {
        match self.control.modal.spindle {
            Some(turning @ (Spindle::Clockwise | Spindle::Counterclockwise)) => Ok(turning),
            _ => Err(Diagnostic::error(
                cycle.span,
                format!("{}, and the spindle does not turn", g_name(cycle.code)),
            )
            .help("switch it on before: S500 M3")),
        }
    }

    /// By the shift of G76, times `sign`.
    fn sideways(&mut self, cycle: &Cycle, sign: f64) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        let mut motion = MotionWords::default();
        for (axis, along) in [first, second].into_iter().zip(cycle.shift) {
            if along != 0.0 {
                motion.axes[axis] = Some(At {
                    value: (sign * along, Dimension::Incremental),
                    span: cycle.span,
                });
            }
        }
        self.rapid(&motion, cycle.span)
    }

    /// Along the axis of the tool to a level, unless it is there.
    fn to(&mut self, level: f64, rapid: bool, cycle: &Cycle) -> Done {
        let [_, _, normal] = self.control.modal.plane.axes();
        if self.control.present(normal) == Some(level) {
            return Ok(());
        }
        self.control.move_axis(normal, level, rapid, cycle.span)
    }

    /// P at the bottom. G73, G83, G85 and G86 have none on the control: that of a cycle before them is not theirs.
    fn wait(&mut self, cycle: &Cycle) {
        let has_dwell = !matches!(cycle.code, 730 | 830 | 850 | 860);
        if cycle.dwell > 0.0 && (has_dwell || cycle.own_dwell) {
            self.control.actions.push(Action::Dwell(cycle.dwell));
        }
    }
}
