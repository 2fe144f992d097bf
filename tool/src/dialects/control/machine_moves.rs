//! Motions in coordinates of the machine, G52 and G92.

use super::modal::Motion;
use super::motion::{length_factor, targets};
use super::words::{AXES, At, Dimension, MotionWords};
use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::frame::Frame;
use crate::program::moves::{Coordinate, Move, MoveKind};
use crate::program::position::displaced_in;
use crate::program::{Action, Compensation};
use crate::source::Span;

impl Control<'_> {
    /// To coordinates of the machine, without frame and work offset. `tool_length`: the tip goes to
    /// the coordinates if tool length compensation is on; else the spindle nose does. `own_feed`:
    /// whether the block has an F.
    pub fn machine_move(
        &mut self,
        words: &MotionWords,
        span: Span,
        tool_length: bool,
        own_feed: bool,
    ) -> Done {
        self.refuse_compensation(span, "a motion in machine coordinates")?;
        let increment = |axis: &At<(f64, Dimension)>| self.modal.is_incremental(axis.value.1);
        if words.axes.iter().flatten().any(increment) {
            return Err(
                Diagnostic::error(span, "an increment in machine coordinates")
                    .help("write G90 in this block"),
            );
        }
        let rapid = match self.modal.motion {
            Some(Motion::Rapid) => true,
            Some(Motion::Line) => {
                self.check_feed(own_feed, span)?;
                false
            }
            _ => {
                return Err(Diagnostic::error(
                    span,
                    "only G0 and G1 can move in machine coordinates",
                )
                .help("write G0 or G1 in this block"));
            }
        };
        let target = targets(words, &self.modal, self.settings, self.diagnostics)?;
        let start = self.modal.position.coordinates();
        let moved = target.map(|target| target != Coordinate::Keep);
        let displaced = displaced_in(&self.modal.frame, moved);
        for (axis, target) in target.iter().enumerate() {
            let moves = *target != Coordinate::Keep;
            self.modal.length_undecided &= !(moves && axis == 2);
            if displaced[axis] {
                self.modal.position.set(axis, None);
            }
            // What has changed for an axis that stays is still to be travelled, from a place that the motion
            // of the others may have changed in a frame.
            let carried = &mut self.modal.carried[axis];
            *carried = match axis < 3 && !self.modal.frame.is_empty() {
                _ if moves => None,
                true => carried.map(|_| None),
                false => *carried,
            };
        }
        let kind = MoveKind::Machine { rapid, tool_length };
        self.actions.push(Action::Move(Move {
            kind,
            target,
            start,
            exact_stop: false,
            corner: None,
        }));
        Ok(())
    }

    /// The end of G92.
    pub fn preset_off(&mut self, span: Span) -> Done {
        self.refuse_compensation(span, "the end of G92")?;
        self.modal.forget_position();
        self.modal.preset = [None; 9];
        self.modal.preset_at = None;
        self.states.push(Action::PresetOff);
        Ok(())
    }

    /// G52: the zero of the work offset lies at these coordinates, for the axes that are named.
    ///
    /// LinuxCNC keeps G52 and G92 in one place, where the later one counts; on the control both count. Where
    /// G92 is in force G52 is therefore written as another G92, which needs to know where the axis is.
    pub fn local_offset(&mut self, words: &MotionWords, span: Span) -> Done {
        self.refuse_compensation(span, "G52")?;
        if !words.names_an_axis() {
            return Err(Diagnostic::error(span, "G52 needs axes").help("G52 X0 Y0 Z0 ends it"));
        }
        let (mut offsets, mut presets) = ([None; 9], [None; 9]);
        for (axis, word) in words.axes.iter().enumerate() {
            let Some(word) = word else { continue };
            let value = word.value.0 * length_factor(axis, &self.modal);
            let Some(before) = self.modal.preset[axis] else {
                offsets[axis] = Some(value);
                self.modal.shifted[axis] = value != 0.0;
                self.modal.position.set(axis, None);
                continue;
            };
            if before != value {
                let place = self.modal.position.get(axis);
                let place = place.ok_or_else(|| unknown_preset(axis, word.span))?;
                presets[axis] = Some(place + before - value);
                self.modal.position.set(axis, presets[axis]);
                self.modal.preset[axis] = Some(value);
            }
        }
        self.modal.tangent = None;
        if offsets != [None; 9] {
            self.actions.push(Action::LocalOffset(offsets));
        }
        if presets != [None; 9] {
            self.actions.push(Action::Preset(presets));
        }
        Ok(())
    }

    /// G92: the present place gets these coordinates of the work offset. Frames act inside of the
    /// work offset and are not seen by it: the values are neither mirrored, turned nor scaled.
    pub fn preset(&mut self, words: &MotionWords, span: Span) -> Done {
        self.refuse_compensation(span, "G92")?;
        if !words.names_an_axis() {
            return Err(
                Diagnostic::error(span, "G92 needs axes").help("G92 X0 makes this place X0")
            );
        }
        let factors = std::mem::replace(&mut self.modal.axis_factors, [1.0; 9]);
        let targets = targets(words, &self.modal, self.settings, self.diagnostics);
        self.modal.axis_factors = factors;
        let frame = self.modal.frame.clone();
        let mut position = self.modal.position.clone();
        position.change_frame(&frame, &Frame::default());
        let mut values = [None; 9];
        for (axis, target) in targets?.into_iter().enumerate() {
            match target {
                Coordinate::Keep => continue,
                Coordinate::At(value) if !self.modal.incremental => values[axis] = Some(value),
                _ => {
                    return Err(
                        Diagnostic::error(span, "G92 with increments").help("write G90 before")
                    );
                }
            }
            position.set(axis, values[axis]);
            // It ends G52 of its axes.
            self.modal.preset[axis] = Some(0.0);
            self.modal.shifted[axis] = false;
        }
        position.change_frame(&Frame::default(), &frame);
        self.modal.position = position;
        self.modal.preset_at = Some(span);
        self.actions.push(Action::Preset(values));
        Ok(())
    }

    /// The end of the program takes G52 back, which LinuxCNC would keep in force for the next program. What it
    /// keeps of G92 is said: how long that is in force on the control is a setting there.
    pub(super) fn end_shifts(&mut self) {
        let shifted = std::mem::take(&mut self.modal.shifted);
        if shifted != [false; 9] {
            if self.modal.compensation != Compensation::Off {
                // LinuxCNC ends it with the program, and shifts nothing before.
                self.actions.push(Action::Compensation(Compensation::Off));
            }
            let zero = shifted.map(|shifted| shifted.then_some(0.0));
            self.actions.push(Action::LocalOffset(zero));
        }
        if let Some(span) = self.modal.preset_at {
            self.note_once(
                "the end of G92",
                "G92 stays in force in LinuxCNC behind the end of the program; G92.1, or DISABLE_G92_PERSISTENCE = 1 \
                 in the section RS274NGC of the INI file, ends it",
                span,
            );
        }
    }
}

/// G52 behind G92, while the tool is nobody knows where.
fn unknown_preset(axis: usize, span: Span) -> Diagnostic {
    let letter = AXES[axis];
    Diagnostic::unknown_place(
        span,
        format!("G52 behind G92, and where {letter} is, is not known ahead of time"),
    )
    .help(format!(
        "LinuxCNC keeps both in one place: program {letter} absolute before G52"
    ))
}
