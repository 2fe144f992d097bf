//! Velocity and acceleration of a straight move by the limits of the axes.

use crate::machine::limits::{Limits, is_rotary};
use crate::path::Position;

/// Shorter travel of an axis counts as none (LinuxCNC's CART_FUZZ), mm or degrees.
const SMALLEST_TRAVEL: f64 = 1.0e-8;

/// A straight move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Straight {
    /// Least time by the velocities of the axes, s.
    pub velocity_time: f64,
    /// Greatest ratio of travel to acceleration, s^2.
    pub acceleration_ratio: f64,
    /// What velocities of the move refer to: travel in X Y Z, else in U V W, else in A B C.
    pub length: f64,
    /// X Y Z U V W move.
    pub linear: bool,
    /// A B C move.
    pub angular: bool,
}

impl Straight {
    pub(super) fn between(from: &Position, to: &Position, limits: &Limits) -> Straight {
        let mut straight = Straight::default();
        let [mut xyz, mut abc, mut uvw] = [0.0; 3];
        for axis in 0..from.len() {
            let travel = (to[axis] - from[axis]).abs();
            if travel < SMALLEST_TRAVEL {
                continue;
            }
            if is_rotary(axis) {
                straight.angular = true;
                abc += travel * travel;
            } else {
                straight.linear = true;
                *(if axis < 3 { &mut xyz } else { &mut uvw }) += travel * travel;
            }
            straight.velocity_time = straight.velocity_time.max(travel / limits.velocity[axis]);
            straight.acceleration_ratio = straight
                .acceleration_ratio
                .max(travel / limits.acceleration[axis]);
        }
        let square = if !straight.linear {
            abc
        } else if xyz > 0.0 {
            xyz
        } else {
            uvw
        };
        straight.length = f64::sqrt(square);
        straight
    }

    /// What the axes allow; a move to nowhere has the feed.
    pub(super) fn velocity(&self, linear_feed: f64, angular_feed: f64) -> f64 {
        if self.velocity_time > 0.0 {
            self.length / self.velocity_time
        } else if self.angular && !self.linear {
            angular_feed
        } else {
            linear_feed
        }
    }

    /// What the axes allow; 0 for a move to nowhere.
    pub(super) fn acceleration(&self) -> f64 {
        if self.acceleration_ratio > 0.0 {
            self.length / self.acceleration_ratio
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slowest_axis_rules() {
        let mut limits = Limits::default();
        limits.apply(&"Y:V=10,A=100".parse().expect("valid"));
        let to = [30.0, 40.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let straight = Straight::between(&[0.0; 9], &to, &limits);
        assert!((straight.velocity(1.0, 1.0) - 12.5).abs() < 1e-12);
        assert!((straight.acceleration() - 125.0).abs() < 1e-12);
    }

    #[test]
    fn rotary_travel_does_not_lengthen_a_linear_move() {
        let to = [1.0, 0.0, 0.0, 50.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let straight = Straight::between(&[0.0; 9], &to, &Limits::default());
        assert!((straight.velocity(1.0, 1.0) - 2.0).abs() < 1e-12);
    }
}
