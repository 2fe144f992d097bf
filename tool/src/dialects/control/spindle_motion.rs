//! Threads and taps: motions in step with the spindle, and those that only seem to be.

use super::motion::targets;
use super::words::{AXES, MotionWords};
use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::moves::{Coordinate, Move, MoveKind};
use crate::program::{Action, FeedMode, Spindle, SurfaceSpeed};
use crate::source::Span;

/// A rigid tap along the normal of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Its deepest place, units of the program.
    pub bottom: f64,
    /// Units of the program for a revolution; negative for a thread that turns left.
    pub pitch: f64,
    /// The spindle speed on the way back over that on the way in.
    pub back: f64,
}

impl Control<'_> {
    /// A straight thread to the axes of `words`. `pitch`: units of the program for a revolution, along
    /// `axis` of X Y Z.
    pub fn thread(&mut self, words: &MotionWords, pitch: f64, axis: usize, span: Span) -> Done {
        self.refuse_compensation(span, "a thread")?;
        self.check_spindle(span)?;
        self.check_kept_speed()?;
        check_pitch(pitch, span)?;
        let mut path = Move {
            kind: MoveKind::Line,
            target: targets(words, &self.modal, self.settings, self.diagnostics)?,
            start: self.modal.position.coordinates(),
            exact_stop: false,
            corner: None,
        };
        let steps: [Option<f64>; 3] = std::array::from_fn(|axis| match path.target[axis] {
            Coordinate::Keep => Some(0.0),
            Coordinate::By(step) => Some(step),
            Coordinate::At(end) => path.start[axis].map(|start| end - start),
        });
        let others = path.target.iter().enumerate();
        let alone = others
            .filter(|(_, target)| **target != Coordinate::Keep)
            .all(|(named, _)| named == axis);
        // LinuxCNC wants the pitch along the path.
        let slope = match steps {
            _ if alone => 1.0,
            [Some(x), Some(y), Some(z)] if [x, y, z][axis] != 0.0 => {
                x.hypot(y).hypot(z) / [x, y, z][axis].abs()
            }
            _ => {
                return Err(Diagnostic::unknown_place(
                    span,
                    "the slope of this thread is not known ahead of time",
                )
                .help("program X, Y and Z absolute before it"));
            }
        };
        path.kind = MoveKind::Thread {
            pitch: pitch.abs() * self.modal.length_factor * slope,
        };
        self.add_move(path, span)
    }

    /// Where the axis of a tap is, units of the program; it must be the normal of the plane and the only one
    /// that is named.
    ///
    /// # Errors
    ///
    /// It is not, or where it is is not known ahead of time.
    pub fn tap_place(
        &self,
        words: &MotionWords,
        axis: usize,
        span: Span,
    ) -> Result<f64, Diagnostic> {
        let [_, _, normal] = self.modal.plane.axes();
        let others = words.axes.iter().enumerate();
        let others = others
            .filter(|(_, word)| word.is_some())
            .any(|(named, _)| named != axis);
        match (axis == normal && !others, self.present(axis)) {
            (true, Some(place)) => Ok(place),
            (true, None) => Err(Diagnostic::unknown_place(
                span,
                "where the tap begins is not known ahead of time",
            )
            .help(format!("program {} absolute before", AXES[axis]))),
            (false, _) => Err(Diagnostic::error(
                span,
                "a tap goes along the normal of the plane, and no other axis with it",
            )),
        }
    }

    /// A rigid tap from where the tool is. The spindle turns as the pitch says, and stands when it is
    /// over.
    pub fn tap(&mut self, tap: &Tap, span: Span) -> Done {
        self.refuse_compensation(span, "a tap")?;
        check_pitch(tap.pitch, span)?;
        if self.modal.spindle_speed.is_none_or(|speed| speed <= 0.0) {
            return Err(no_speed(span));
        }
        let [_, _, normal] = self.modal.plane.axes();
        let factor = self.modal.length_factor;
        let mut target = [Coordinate::Keep; 9];
        target[normal] = Coordinate::At(tap.bottom * factor);
        let direction = match tap.pitch < 0.0 {
            false => Spindle::Clockwise,
            true => Spindle::Counterclockwise,
        };
        self.set_spindle(direction);
        self.add_move(
            Move {
                kind: MoveKind::Tap {
                    pitch: tap.pitch.abs() * factor,
                    back: tap.back,
                },
                target,
                start: self.modal.position.coordinates(),
                exact_stop: false,
                corner: None,
            },
            span,
        )?;
        self.set_spindle(Spindle::Stop);
        Ok(())
    }

    /// Switches the spindle.
    pub fn set_spindle(&mut self, spindle: Spindle) {
        self.modal.spindle = Some(spindle);
        self.modal.spindle_before_change = None;
        self.actions.push(Action::Spindle(spindle));
    }

    /// The spindle turns: as it did before the tool was changed, or else clockwise, unless it turns already.
    /// Returns how.
    pub fn turn_spindle(&mut self) -> Spindle {
        if let Some(turning @ (Spindle::Clockwise | Spindle::Counterclockwise)) = self.modal.spindle
        {
            return turning;
        }
        let before = self.modal.spindle_before_change;
        let turning = before.unwrap_or(Spindle::Clockwise);
        self.set_spindle(turning);
        turning
    }

    /// G96: metres or feet per minute at the surface, with the axis X at the radius.
    pub fn surface_speed(&mut self, speed: f64, limit: Option<f64>, span: Span) -> Done {
        if speed <= 0.0 || limit.is_some_and(|limit| limit <= 0.0) {
            return Err(Diagnostic::error(span, "the speed must be above 0"));
        }
        if !self.modal.frame.is_empty() {
            return Err(Diagnostic::error(
                span,
                "constant cutting speed in a frame: X is not the radius",
            )
            .help("clear the frame before"));
        }
        let per_minute = match self.settings.machine_in_inch {
            // The control counts metres, LinuxCNC feet.
            true => 1.0 / 0.3048,
            false => 1.0,
        };
        // What a dwell in revolutions takes is not known any more.
        self.modal.spindle_speed = None;
        self.modal.surface_speed = true;
        self.modal.kept_speed = None;
        self.actions.push(Action::SurfaceSpeed(Some(SurfaceSpeed {
            speed: speed * per_minute,
            limit,
        })));
        Ok(())
    }

    /// G97, with the speed that follows.
    pub fn turning_speed(&mut self, speed: Option<f64>, span: Span) -> Done {
        if speed.is_none() {
            return Err(Diagnostic::error(
                span,
                "G97 keeps a speed that is not known ahead of time",
            )
            .help("program the speed beside it: G97 S1000"));
        }
        self.end_surface_speed();
        Ok(())
    }

    /// S counts turns from here on.
    pub fn end_surface_speed(&mut self) {
        self.modal.surface_speed = false;
        self.modal.kept_speed = None;
        self.actions.push(Action::SurfaceSpeed(None));
    }

    /// Refuses a motion with feed at a speed that only the control knows.
    pub fn check_kept_speed(&mut self) -> Done {
        let turns = matches!(
            self.modal.spindle,
            Some(Spindle::Clockwise | Spindle::Counterclockwise)
        );
        // Said once; the blocks after it have the same fault.
        match self.modal.kept_speed.take_if(|_| turns) {
            None => Ok(()),
            Some((end, feed_mode)) => {
                let name = match feed_mode {
                    FeedMode::InverseTime => "G93",
                    FeedMode::PerMinute => "G94",
                    FeedMode::PerRevolution => "G95",
                };
                Err(Diagnostic::error(
                    end,
                    "the end of G96 keeps a speed that is not known ahead of time",
                )
                .help(format!("program the speed beside it: {name} S1000")))
            }
        }
    }

    fn check_spindle(&self, span: Span) -> Done {
        match self.modal.spindle {
            Some(Spindle::Clockwise | Spindle::Counterclockwise) => Ok(()),
            _ => Err(
                Diagnostic::error(span, "a thread, and the spindle does not turn")
                    .help("switch it on before: S500 M3"),
            ),
        }
    }
}

fn check_pitch(pitch: f64, span: Span) -> Done {
    match pitch.is_finite() && pitch != 0.0 {
        true => Ok(()),
        false => {
            Err(Diagnostic::error(span, "a thread with no pitch").help("the pitch cannot be 0"))
        }
    }
}

/// A tap while the spindle has no speed.
pub fn no_speed(span: Span) -> Diagnostic {
    Diagnostic::error(span, "a tap, and no spindle speed is programmed")
        .help("program S before or beside it")
}
