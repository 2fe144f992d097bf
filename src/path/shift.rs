//! By how much a line is moved off the program.

use nalgebra::Vector3;

use crate::axes::Axes;
use crate::moves::shape::PathPoint;

/// What a [fairing](super::fairing) moves a leg by: the more or less the farther along it, XYZ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shift {
    start: Vector3<f64>,
    end: Vector3<f64>,
    slope: Vector3<f64>,
    length: f64,
}

impl Shift {
    pub const NONE: Self = Self {
        start: Vector3::new(0.0, 0.0, 0.0),
        end: Vector3::new(0.0, 0.0, 0.0),
        slope: Vector3::new(0.0, 0.0, 0.0),
        length: 0.0,
    };

    /// Of a leg of this length, path distance, from what its start is moved by to what its end is.
    pub fn between(start: &Vector3<f64>, end: &Vector3<f64>, length: f64) -> Self {
        Self {
            start: *start,
            end: *end,
            slope: (end - start) / length,
            length,
        }
    }

    /// What it is at a distance from the start of the leg, at its end exactly what that is moved by.
    #[inline]
    pub fn at(&self, distance: f64) -> Vector3<f64> {
        if distance < self.length {
            self.start + self.slope * distance
        } else {
            self.end
        }
    }

    /// Moves the point of a leg at a distance from its start.
    #[inline]
    pub fn move_point(&self, point: &mut PathPoint, distance: f64) {
        add(&mut point.position, &self.at(distance));
        self.turn(&mut point.first);
    }

    /// Turns the first derivative of a leg by path distance.
    #[inline]
    pub fn turn(&self, direction: &mut Axes) {
        add(direction, &self.slope);
    }
}

/// Adds XYZ to what has nine axes.
#[inline]
pub(super) fn add(axes: &mut Axes, linear: &Vector3<f64>) {
    for (axis, linear) in axes.iter_mut().zip(linear) {
        *axis += linear;
    }
}
