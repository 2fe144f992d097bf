//! A thread: the machine is to be at a given place along the path, moving with the spindle.

use super::rate_derivative_interval::RateDerivativeInterval;
use super::state::State;
use super::table::Table;
use crate::cube_root::cube_root;

/// Gains from the error of position to velocity, of velocity to acceleration, of acceleration to
/// jerk, 1 per second: together nearly a triple pole at -200 per second.
const GAINS: [f64; 3] = [200.0 / 3.0, 200.0, 600.0];

/// Greatest gain of the innermost loop, 1 per servo period: above, sampling would make it swing.
const GREATEST_GAIN: f64 = 0.6;

/// Part of the path's acceleration and jerk that large errors are taken back with.
const PART: f64 = 0.5;

/// A backlog is not made up for faster than by this part of the wanted velocity, and of what the
/// jerk leads to while the loop settles.
const CATCH_UP_PART: f64 = 0.5;

/// Where the reference is slower than this part of what is wanted, any rate is right.
const FREE_PART: f64 = 1e-3;

/// Slower than this, units a servo period, is standstill.
const STANDSTILL: f64 = 1e-9;

/// Where the machine is to be along the path, with derivatives by time, at the start of a servo
/// period. Units of the path's measure and seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Follow {
    /// How far the wanted place is ahead of the machine.
    pub error: f64,
    /// How fast it moves, 0 and above.
    pub velocity: f64,
    /// Its acceleration.
    pub acceleration: f64,
    /// Its jerk.
    pub jerk: f64,
    /// What the axes allow along the path, positive; may be infinite.
    pub greatest_acceleration: f64,
}

/// A [`Follow`] in units of the servo period, with the gains.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pursuit {
    error: f64,
    velocity: f64,
    acceleration: f64,
    jerk: f64,
    /// Acceleration that errors are taken back with.
    correcting: f64,
    gains: [f64; 3],
}

impl Pursuit {
    /// `period` in seconds. What is not finite counts as 0.
    pub fn new(follow: &Follow, period: f64) -> Self {
        let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
        let [position, velocity, acceleration] = GAINS;
        let correcting = PART * follow.greatest_acceleration * period * period;
        let slower = (GREATEST_GAIN / (acceleration * period)).min(1.0);
        Self {
            error: finite(follow.error),
            velocity: finite(follow.velocity * period).max(0.0),
            acceleration: finite(follow.acceleration * period * period),
            jerk: finite(follow.jerk * period * period * period),
            correcting: if correcting > 0.0 {
                correcting.min(1e15)
            } else {
                0.0
            },
            gains: [position, velocity, acceleration].map(|gain| gain * period * slower),
        }
    }

    /// The velocity that makes up for the error, given the jerk that may be used.
    fn wanted_velocity(&self, jerk: f64) -> f64 {
        let size = self.error.abs();
        // From this velocity the error ends with the velocity, by jerk alone; and by acceleration.
        let curve = cube_root(PART * jerk * size * size).min((self.correcting * size).sqrt());
        let [gain, ..] = self.gains;
        let most =
            CATCH_UP_PART * (self.velocity + (jerk / (gain * gain)).min(self.correcting / gain));
        let correction = (gain * size).min(curve);
        if self.error > 0.0 {
            self.velocity + correction.min(most)
        } else {
            self.velocity - correction
        }
    }

    /// Whether the machine is to stand still.
    pub fn is_standstill(&self) -> bool {
        self.wanted_velocity(f64::MAX) <= STANDSTILL
    }

    /// The rate jerk for the next period. `None` where the reference is so slow that any rate is right.
    pub fn approach(
        &self,
        table: &Table,
        state: State,
        jerk_interval: &RateDerivativeInterval,
    ) -> Option<f64> {
        let along = table.along(state.time);
        if along.velocity < FREE_PART * self.velocity || along.velocity < 1e-12 {
            return None;
        }
        let (rate, change) = (state.rate, state.rate_acceleration);
        let velocity = rate * along.velocity;
        let acceleration = change * along.velocity + rate * rate * along.acceleration;
        let jerk_without_rate_jerk =
            rate * rate * rate * along.jerk + 3.0 * rate * change * along.acceleration;
        let jerk_at = |rate_jerk: f64| jerk_without_rate_jerk + rate_jerk * along.velocity;
        let available = jerk_at(jerk_interval.high)
            .min(-jerk_at(jerk_interval.low))
            .clamp(1e-15, 1e15);

        let [_, velocity_gain, acceleration_gain] = self.gains;
        let missing = self.wanted_velocity(available) - velocity;
        // From this acceleration the missing velocity ends with the acceleration.
        let curve = (2.0 * PART * available * missing.abs())
            .sqrt()
            .min(self.correcting);
        let wanted = self.acceleration + (velocity_gain * missing).max(-curve).min(curve);
        let jerk = self.jerk + acceleration_gain * (wanted - acceleration);
        Some((jerk - jerk_without_rate_jerk) / along.velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still(error: f64, velocity: f64) -> bool {
        let follow = Follow {
            error,
            velocity,
            acceleration: 0.0,
            jerk: 0.0,
            greatest_acceleration: f64::INFINITY,
        };
        Pursuit::new(&follow, 1e-3).is_standstill()
    }

    #[test]
    fn stands_still_only_where_nothing_is_asked_for() {
        assert!(still(0.0, 0.0) && still(-1.0, 0.0) && still(-1.0, 10.0));
        assert!(!still(0.0, 0.1) && !still(0.1, 10.0) && !still(-1e-4, 10.0));
        assert!(still(f64::NAN, f64::NAN));
    }

    #[test]
    fn a_backlog_is_made_up_for_by_a_bounded_velocity() {
        let follow = Follow {
            error: 1e6,
            velocity: 10.0,
            acceleration: 0.0,
            jerk: 0.0,
            greatest_acceleration: f64::INFINITY,
        };
        let pursuit = Pursuit::new(&follow, 1e-3);
        assert!((pursuit.wanted_velocity(0.0) - 0.01).abs() < 1e-12);
        let most = 0.015 + 0.5 * 2e-5 / pursuit.gains[0].powi(2);
        assert!((pursuit.wanted_velocity(2e-5) - most).abs() < 1e-12);
    }
}
