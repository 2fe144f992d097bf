//! What the words of an arc would be in a plane, before it is known which plane is meant.

use super::Control;
use super::words::{At, Dimension, MotionWords};
use crate::program::Plane;
use crate::program::arc::checked_centre;

impl Control<'_> {
    /// Whether centre and end, taken in this plane, lie on one circle with the start; `None` where that
    /// cannot be known ahead of time.
    pub fn arc_fits(&self, words: &MotionWords, plane: Plane) -> Option<bool> {
        let [first, second, _] = plane.axes();
        let factor = self.modal.length_factor;
        let chord = [
            self.step_along(words, first)? * factor,
            self.step_along(words, second)? * factor,
        ];
        let centre = [
            self.centre_step(words, first)? * factor,
            self.centre_step(words, second)? * factor,
        ];
        Some(checked_centre(chord, centre, &self.settings.arc_tolerance).is_ok())
    }

    /// How far an axis of X Y Z goes, in units of the program, if that is known ahead of time.
    pub fn step_along(&self, words: &MotionWords, axis: usize) -> Option<f64> {
        let Some(At {
            value: (value, dimension),
            ..
        }) = words.axes[axis]
        else {
            return Some(0.0);
        };
        match (dimension, self.modal.incremental) {
            (Dimension::Incremental, _) | (Dimension::Modal, true) => Some(value),
            _ => Some(value - self.present(axis)?),
        }
    }

    /// From the start to the centre along an axis of X Y Z, in units of the program.
    pub fn centre_step(&self, words: &MotionWords, axis: usize) -> Option<f64> {
        match words.centre[axis].map(|word| word.value) {
            None => Some(0.0),
            Some((value, Dimension::Absolute)) => Some(value - self.present(axis)?),
            Some((value, _)) => Some(value),
        }
    }
}
