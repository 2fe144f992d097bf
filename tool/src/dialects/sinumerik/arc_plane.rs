//! The plane of an arc: that of its words, where they do not fit the active one. (Siemens, SINUMERIK
//! 840D sl, Programming Manual Fundamentals, "Circular interpolation": the axes of the end point
//! determine the plane of an arc outside of the working plane.)

use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::arc::sweep;
use crate::program::{Action, Plane};
use crate::source::Span;
use std::f64::consts::TAU;

/// Words of a helix that differ by less, in units of the program, say the same.
const SAME_RISE: f64 = 1e-3;

impl Interpreter<'_> {
    /// A motion by G0 to G3; an arc in the plane that its words name.
    pub(super) fn motion_in_its_plane(
        &mut self,
        motion: &MotionWords,
        block: Span,
        own_feed: bool,
        exact_stop: bool,
    ) -> Done {
        let mut motion = *motion;
        let active = self.control.modal.plane;
        let plane = self.plane_of(&motion, block);
        if self.is_arc() {
            self.drop_rise(&mut motion, plane)?;
        }
        if plane == active {
            return self.control.motion(&motion, block, own_feed, exact_stop);
        }
        let span = motion.first_axis().unwrap_or(block);
        self.control
            .refuse_compensation(span, "an arc in another plane than the active one")?;
        self.control.modal.plane = plane;
        self.control.actions.push(Action::Plane(plane));
        let done = self.control.motion(&motion, block, own_feed, exact_stop);
        self.control.modal.plane = active;
        self.control.actions.push(Action::Plane(active));
        done
    }

    fn is_arc(&self) -> bool {
        matches!(
            self.control.modal.motion,
            Some(Motion::Clockwise | Motion::Counterclockwise)
        )
    }

    fn plane_of(&mut self, motion: &MotionWords, block: Span) -> Plane {
        let active = self.control.modal.plane;
        let named = [0, 1, 2].map(|axis| motion.axes[axis].is_some());
        let centre = [0, 1, 2].map(|axis| motion.centre[axis].is_some());
        let [_, _, normal] = active.axes();
        if !self.is_arc() || motion.turns.is_some() {
            return active;
        }
        let fits = |plane: Plane| self.control.arc_fits(motion, plane);
        let either = [0, 1, 2].map(|axis| named[axis] || centre[axis]);
        if centre[normal] {
            if let Some(plane) = plane_with(either) {
                return plane;
            }
            // `I0.6 J0 K0` beside X and Z, and X Y Z beside `I0.6 K0`.
            let other = plane_with(named).or(plane_with(centre));
            return match other {
                Some(other) if fits(active) == Some(false) && fits(other) == Some(true) => other,
                _ => active,
            };
        }
        match plane_with(either).filter(|other| *other != active) {
            Some(other) if motion.radius.is_some() => {
                self.warn_of_plane(other, motion.first_axis().unwrap_or(block));
                other
            }
            Some(other) if fits(active) == Some(false) && fits(other) == Some(true) => other,
            _ => active,
        }
    }

    fn warn_of_plane(&mut self, plane: Plane, span: Span) {
        let [_, _, normal] = plane.axes();
        let missing = ["X", "Y", "Z"][normal];
        let message = "the axes of this arc with a radius lie in another plane than the active one";
        self.control
            .diagnostics
            .push(Diagnostic::warning(span, message).help(format!(
            "it is cut in the plane of its axes, as on the control; name {missing} too for a helix"
        )));
    }

    /// Takes out the centre word along the normal of a helix, where it says what the others say: nothing,
    /// the height of the end, or the rise of a whole turn.
    fn drop_rise(&self, motion: &mut MotionWords, plane: Plane) -> Done {
        let [first, second, normal] = plane.axes();
        let Some(At {
            value: (value, dimension),
            span,
        }) = motion.centre[normal]
        else {
            return Ok(());
        };
        if motion.centre[first].is_none() && motion.centre[second].is_none() {
            return Ok(());
        }
        let steps = [first, second, normal].map(|axis| self.control.step_along(motion, axis));
        let rise = match (dimension, self.control.present(normal)) {
            (Dimension::Absolute, Some(start)) => Some(value - start),
            (Dimension::Absolute, None) => None,
            _ => Some(value),
        };
        let offset = [first, second].map(|axis| self.control.centre_step(motion, axis));
        let agrees = match (rise, steps, offset) {
            (Some(0.0), _, _) => true,
            (Some(rise), [Some(a), Some(b), Some(height)], [Some(i), Some(j)]) => {
                let clockwise = self.control.modal.motion == Some(Motion::Clockwise);
                let turns = sweep([-i, -j], [a - i, b - j], clockwise, extra(motion)) / TAU;
                let of_a_turn = (height / turns).abs();
                (rise - height).abs() < SAME_RISE || (rise.abs() - of_a_turn).abs() < SAME_RISE
            }
            _ => false,
        };
        if !agrees {
            let letter = ["I", "J", "K"][normal];
            return Err(Diagnostic::error(
                span,
                format!(
                    "{letter} is not in the plane of this arc, and is not the rise of its helix"
                ),
            )
            .help(
                "G17 has I and J, G18 I and K, G19 J and K; further turns of a helix are TURN=",
            ));
        }
        motion.centre[normal] = None;
        Ok(())
    }
}

fn extra(motion: &MotionWords) -> u32 {
    motion.turns.map_or(0, |turns| turns.value.max(0.0) as u32)
}

/// The plane of two of X Y Z; `None` for fewer or more.
fn plane_with(axes: [bool; 3]) -> Option<Plane> {
    match axes {
        [true, true, false] => Some(Plane::Xy),
        [true, false, true] => Some(Plane::Zx),
        [false, true, true] => Some(Plane::Yz),
        _ => None,
    }
}
