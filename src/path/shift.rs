//! By how much a line is moved off the program.

use super::linear_axes::{self, LinearAxes, ORIGIN};
use crate::axes::Axes;
use crate::moves::shape::PathPoint;

/// What a [fairing](super::fairing) moves a leg by: the more or less the farther along it, XYZ and UVW.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shift {
    start: LinearAxes,
    end: LinearAxes,
    slope: LinearAxes,
    length: f64,
}

impl Shift {
    pub const NONE: Self = Self {
        start: ORIGIN,
        end: ORIGIN,
        slope: ORIGIN,
        length: 0.0,
    };

    /// Of a leg of this length, path distance, from what its start is moved by to what its end is.
    pub fn between(start: &LinearAxes, end: &LinearAxes, length: f64) -> Self {
        Self {
            start: *start,
            end: *end,
            slope: (end - start) / length,
            length,
        }
    }

    /// What it is at a distance from the start of the leg, at its end exactly what that is moved by.
    #[inline]
    pub fn at(&self, distance: f64) -> LinearAxes {
        if distance < self.length {
            self.start + self.slope * distance
        } else {
            self.end
        }
    }

    /// Moves the point of a leg at a distance from its start.
    #[inline]
    pub fn move_point(&self, point: &mut PathPoint, distance: f64) {
        linear_axes::add(&mut point.position, &self.at(distance));
        self.turn(&mut point.first);
    }

    /// Turns the first derivative of a leg by path distance.
    #[inline]
    pub fn turn(&self, direction: &mut Axes) {
        linear_axes::add(direction, &self.slope);
    }
}
