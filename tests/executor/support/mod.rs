//! References with known derivatives, a player that feeds them to the executor as the planner
//! does, and a monitor that judges what the machine does.

pub mod monitor;
pub mod player;
pub mod reference;
pub mod s_curve;

use framepath::axes::{Axes, AxisLimits};

/// Limits with the same value for all axes.
pub fn uniform_limits(velocity: f64, acceleration: f64, jerk: f64) -> AxisLimits {
    AxisLimits {
        velocity: Axes::repeat(velocity),
        acceleration: Axes::repeat(acceleration),
        jerk: Axes::repeat(jerk),
    }
}
