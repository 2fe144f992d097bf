//! Acceleration, jerk and direction along the path, which LinuxCNC 2.10 has in its status.

use nalgebra::Vector3;

use crate::axes::{AXIS_COUNT, Axes};

/// Displacements in a servo period from here on have a direction, machine units.
const LEAST_STEP: f64 = 1e-12;

/// The motion along the path in the last servo period, as differences of what was reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathMotion {
    position: Axes,
    velocity: f64,
    /// Units per second squared.
    pub(super) acceleration: f64,
    /// Units per second cubed.
    pub(super) jerk: f64,
    /// Where X Y Z go, of length 1; 0 without a move, or before it has moved them.
    pub(super) direction: Vector3<f64>,
}

impl PathMotion {
    pub(super) const NONE: Self = Self {
        position: Axes::from_array_storage(nalgebra::ArrayStorage([[0.0; AXIS_COUNT]])),
        velocity: 0.0,
        acceleration: 0.0,
        jerk: 0.0,
        direction: Vector3::new(0.0, 0.0, 0.0),
    };

    /// A servo period of so many seconds has passed, at the end of which a move runs at this velocity and place; `None`:
    /// there is none.
    pub(super) fn pass(&mut self, velocity: Option<f64>, position: &Axes, period: f64) {
        let Some(velocity) = velocity else {
            *self = Self {
                position: *position,
                ..Self::NONE
            };
            return;
        };
        let step = position - self.position;
        let step = Vector3::new(step[0], step[1], step[2]);
        let length = step.norm_squared().sqrt();
        if length > LEAST_STEP {
            self.direction = step / length;
        }
        let acceleration = (velocity - self.velocity) / period;
        self.jerk = (acceleration - self.acceleration) / period;
        self.acceleration = acceleration;
        self.velocity = velocity;
        self.position = *position;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagonal(place: f64) -> Axes {
        Axes::from([place, place, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    #[test]
    fn is_what_changes_in_a_period() {
        let mut motion = PathMotion::NONE;
        motion.pass(Some(0.0), &diagonal(0.0), 1e-3);
        assert_eq!(motion.direction, Vector3::zeros());
        motion.pass(Some(1e-2), &diagonal(1e-5), 1e-3);
        motion.pass(Some(3e-2), &diagonal(3e-5), 1e-3);
        assert!((motion.acceleration - 20.0).abs() < 1e-9);
        assert!((motion.jerk - 1e4).abs() < 1e-6);
        let there = Vector3::new(0.5f64.sqrt(), 0.5f64.sqrt(), 0.0);
        assert!((motion.direction - there).amax() < 1e-9);
    }

    #[test]
    fn a_hold_keeps_the_direction_and_the_end_of_the_move_leaves_nothing() {
        let mut motion = PathMotion::NONE;
        motion.pass(Some(1.0), &diagonal(1.0), 1e-3);
        let there = motion.direction;
        motion.pass(Some(0.0), &diagonal(1.0), 1e-3);
        assert_eq!(motion.direction, there);
        assert!(motion.acceleration < 0.0);
        motion.pass(None, &diagonal(1.0), 1e-3);
        assert_eq!(motion.direction, Vector3::zeros());
        assert_eq!(
            (motion.acceleration, motion.jerk, motion.velocity),
            (0.0, 0.0, 0.0)
        );
    }
}
