//! Motions while the work offset is switched off for good: controls whose G53 is modal.
//!
//! LinuxCNC's G53 holds for its own line only. Every motion therefore gets one, and its coordinates
//! are those of the machine after the frame of the program.

use super::modal::Motion;
use super::motion::length_factor;
use super::words::{AXES, At, Dimension, MotionWords};
use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::{Action, PathControl};
use crate::source::Span;

/// Whether the work offset is off, and where the axes are since, as they were programmed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OffsetFree {
    /// Whether it is.
    pub active: bool,
    /// The G function that switched it off.
    name: &'static str,
    programmed: [Option<f64>; 9],
}

impl OffsetFree {
    /// The work offset is switched off by this G function.
    pub fn begin(&mut self, name: &'static str) {
        if !self.active {
            *self = OffsetFree {
                active: true,
                name,
                ..OffsetFree::default()
            };
        }
    }

    /// A work offset acts again.
    pub fn end(&mut self) {
        *self = OffsetFree::default();
    }

    /// The frame or the tool changed: where the axes are in its coordinates is not known.
    pub fn forget(&mut self) {
        self.programmed = [None; 9];
    }
}

impl Control<'_> {
    /// The motion of a block while the work offset is off; see [`Control::motion`]. G53 alone cannot
    /// turn arcs into something else: they are refused, and so are increments from a place that is
    /// not known, and frames that turn.
    pub fn offset_free_motion(
        &mut self,
        words: &MotionWords,
        state: &mut OffsetFree,
        block: Span,
        own_feed: bool,
        exact_stop: bool,
    ) -> Done {
        let span = words.first_axis().unwrap_or(block);
        let arc = matches!(
            self.modal.motion,
            Some(Motion::Clockwise | Motion::Counterclockwise)
        );
        if arc || words.names_a_centre() {
            let name = state.name;
            let reason = format!("an arc while the work offset is off ({name})");
            return Err(Diagnostic::error(span, reason).help(format!(
                "LinuxCNC moves in straight lines only there: set a work offset of the machine to 0 and \
                 select it instead of {name}"
            )));
        }
        let mut machine = *words;
        let mut programmed = state.programmed;
        for (axis, word) in machine.axes.iter_mut().enumerate() {
            if let Some(word) = word {
                let value = self.offset_free_coordinate(axis, word, state)?;
                programmed[axis] = Some(value);
                word.value = (
                    self.framed(axis, value, state.name, word.span)?,
                    Dimension::Absolute,
                );
            }
        }
        let restored = self.modal.path_control;
        let stops = exact_stop && restored != PathControl::ExactStop;
        if stops {
            self.actions
                .push(Action::PathControl(PathControl::ExactStop));
        }
        self.machine_move(&machine, span, true, own_feed)?;
        if stops {
            self.actions.push(Action::PathControl(restored));
        }
        state.programmed = programmed;
        Ok(())
    }

    fn offset_free_coordinate(
        &self,
        axis: usize,
        word: &At<(f64, Dimension)>,
        state: &OffsetFree,
    ) -> Result<f64, Diagnostic> {
        let (value, dimension) = word.value;
        if !self.modal.is_incremental(dimension) {
            return Ok(value);
        }
        let letter = AXES[axis];
        let name = state.name;
        state.programmed[axis].map(|base| base + value).ok_or_else(|| {
            Diagnostic::unknown_place(
                word.span,
                format!(
                    "an increment while the work offset is off ({name}), and where {letter} is there \
                         is not known ahead of time"
                ),
            )
            .help(format!("program {letter} with G90 once after {name}"))
        })
    }

    /// A coordinate after the frame, in units of the program. A frame that turns would need all axes.
    fn framed(&self, axis: usize, value: f64, name: &str, span: Span) -> Result<f64, Diagnostic> {
        if axis >= 3 {
            return Ok(value);
        }
        let map = self.modal.frame.map();
        let turns = (0..3).any(|other| other != axis && map.linear()[(axis, other)] != 0.0);
        if turns {
            return Err(Diagnostic::error(
                span,
                format!("a rotation is active while the work offset is off ({name})"),
            )
            .help(format!(
                "end the rotation before {name}, or select a work offset"
            )));
        }
        let factor = length_factor(axis, &self.modal);
        let shift = map.translation()[axis] / factor;
        Ok(map.linear()[(axis, axis)] * value + shift)
    }
}
