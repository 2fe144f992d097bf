//! The tolerance of corners under a frame that scales.
//!
//! LinuxCNC rounds corners in the coordinates of the program, and the kinematics makes what it has cut
//! off larger or smaller with the path: P is the tolerance over the greatest stretch of the frame.

use crate::program::PathControl;
use crate::program::frame::Frame;
use crate::program::moves::{Coordinate, Move};
use framepath::frame::singular_values::singular_values;

/// What P has to be divided by.
pub struct PathScale {
    /// The greatest stretch of the frame.
    frame: f64,
    /// Whether the program has moved axes that no frame stretches, which share P with the others.
    has_further_axes: bool,
    /// What P was divided by when it was written last.
    written: f64,
}

impl PathScale {
    /// No frame.
    pub fn new() -> PathScale {
        PathScale {
            frame: 1.0,
            has_further_axes: false,
            written: 1.0,
        }
    }

    /// The frame is another one.
    pub fn set_frame(&mut self, frame: &Frame) {
        // Rotations stretch by rounding only.
        self.frame = match frame.has_scale() || frame.has_stretch() {
            true => singular_values(frame.map().linear()).max(),
            false => 1.0,
        };
    }

    /// Remembers the axes that a move has beside X Y Z.
    pub fn follow(&mut self, motion: &Move) {
        let moves = |target: &Coordinate| *target != Coordinate::Keep;
        self.has_further_axes |= motion.target[3..].iter().any(moves);
    }

    /// The mode with the tolerance that is to be written; `frame_is_off`: the frame does not act.
    pub fn in_frame(&mut self, control: PathControl, frame_is_off: bool) -> PathControl {
        self.written = self.wanted(frame_is_off);
        match control {
            PathControl::Continuous { tolerance } => PathControl::Continuous {
                tolerance: tolerance / self.written,
            },
            exact => exact,
        }
    }

    /// Whether what was written last belongs to another scale.
    pub fn has_changed(&self, frame_is_off: bool) -> bool {
        let wanted = self.wanted(frame_is_off);
        (wanted - self.written).abs() > super::SAME_SIZE * wanted
    }

    fn wanted(&self, frame_is_off: bool) -> f64 {
        match frame_is_off {
            true => 1.0,
            false if self.has_further_axes => self.frame.max(1.0),
            false => self.frame,
        }
    }
}
