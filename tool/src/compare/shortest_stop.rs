//! No stop is shorter than that of each axis by itself.

use crate::host::recording::{Sample, step};
use crate::machine::limits::Limits;

/// A moment of motion, and what no stop from there undercuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    /// Along the path, above 0.
    pub speed: f64,
    /// Greatest acceleration along the path.
    most: f64,
    /// Time to rest of the axis that takes longest by itself, s.
    pub least_time: f64,
}

impl State {
    /// The state after cycle `k`, from its travel and that of the two cycles before. `None` if the
    /// machine stands. `jerk`: limits of the axes, 0 = none.
    pub(crate) fn after(
        samples: &[Sample],
        k: usize,
        limits: &Limits,
        jerk: &[f64; 9],
        period: f64,
    ) -> Option<State> {
        let travel = step(samples, k);
        let earlier = |cycles: usize| k.checked_sub(cycles).map_or([0.0; 9], |k| step(samples, k));
        let (before, first) = (earlier(1), earlier(2));
        let length = norm(&travel);
        if length <= 0.0 {
            return None;
        }
        let (mut most, mut least_time) = (f64::INFINITY, 0.0_f64);
        for (axis, &now) in travel.iter().enumerate() {
            let limit = limits.acceleration[axis];
            if limit <= 0.0 {
                continue;
            }
            let jerk = if jerk[axis] > 0.0 {
                jerk[axis]
            } else {
                f64::INFINITY
            };
            if now != 0.0 {
                most = most.min(limit * length / now.abs());
            }
            // The mean velocities of the cycles, carried on to the end of the last.
            let change = (now - before[axis]) / period.powi(2);
            let third = (now - 2.0 * before[axis] + first[axis]) / period.powi(3);
            let bend = third.clamp(-jerk, jerk);
            let acceleration = (change + bend * period).clamp(-limit, limit);
            let velocity = now / period + 0.5 * period * (change + 0.5 * period * bend);
            least_time = least_time.max(axis_stop(velocity, acceleration, limit, jerk));
        }
        Some(State {
            speed: length / period,
            most,
            least_time,
        })
    }

    /// A distance that no stop undercuts.
    pub(crate) fn least_distance(&self) -> f64 {
        // Constant full braking at once.
        self.speed * self.speed / (2.0 * self.most)
    }
}

/// Least time, s, in which an axis by itself comes from a velocity and an acceleration to rest, with
/// at most the acceleration `most` and the jerk `jerk`, which may be infinite. Where it comes to rest
/// is free, and on the way it may turn back.
///
/// Full jerk to the braking acceleration, that one held if it is the greatest, full jerk back to none:
/// the time-optimal control of a double integrator whose second state is bounded.
fn axis_stop(velocity: f64, acceleration: f64, most: f64, jerk: f64) -> f64 {
    if !jerk.is_finite() {
        return velocity.abs() / most;
    }
    // The velocity that is left once the acceleration has been let go tells which way to brake.
    let left = velocity + acceleration * acceleration.abs() / (2.0 * jerk);
    let (velocity, acceleration) = if left >= 0.0 {
        (velocity, acceleration)
    } else {
        (-velocity, -acceleration)
    };
    let square = (jerk * velocity + 0.5 * acceleration * acceleration).max(0.0);
    let braking = square.sqrt().min(most);
    let held = if square.sqrt() > most {
        (square - most * most) / (jerk * most)
    } else {
        0.0
    };
    (acceleration + braking).max(0.0) / jerk + held + braking / jerk
}

fn norm(vector: &[f64; 9]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stop(velocity: f64, acceleration: f64) -> f64 {
        let time = axis_stop(velocity, acceleration, 1000.0, 20_000.0);
        let mirrored = axis_stop(-velocity, -acceleration, 1000.0, 20_000.0);
        assert!((time - mirrored).abs() < 1e-12);
        time
    }

    #[test]
    fn three_regimes_and_a_start_with_acceleration() {
        assert!((stop(100.0, 0.0) - 0.15).abs() < 1e-12);
        assert!((stop(5.0, 0.0) - 2.0 * (5.0f64 / 20_000.0).sqrt()).abs() < 1e-12);
        // At full acceleration: 50 ms to 0, during which 25 mm/s are gained.
        assert!((stop(50.0, 1000.0) - (0.05 + stop(75.0, 0.0))).abs() < 1e-12);
        // At full braking: 50 ms and 25 mm/s less than from the start of it.
        assert!((stop(75.0, -1000.0) - (stop(100.0, 0.0) - 0.05)).abs() < 1e-12);
        // The last part of a stop.
        assert!((stop(10.0, -(2.0 * 20_000.0 * 10.0f64).sqrt()) - 0.001f64.sqrt()).abs() < 1e-9);
        assert_eq!(axis_stop(-50.0, 300.0, 1000.0, f64::INFINITY), 0.05);
        assert_eq!(stop(0.0, 0.0), 0.0);
    }

    #[test]
    fn braking_too_hard_for_the_velocity_that_is_left_it_turns_back() {
        // Letting go of 1000 mm/s2 takes 50 ms and makes -25 mm/s of 0.
        assert!((stop(0.0, -1000.0) - (0.05 + stop(25.0, 0.0))).abs() < 1e-12);
        assert!((stop(5.0, -1000.0) - (0.05 + stop(20.0, 0.0))).abs() < 1e-12);
    }

    #[test]
    fn state_from_positions() {
        // x = 40 t + 500 t^2 / 2 + 20000 t^3 / 6
        let samples: Vec<Sample> = (1..=20)
            .map(|k| {
                let t = f64::from(k) * 1e-3;
                let mut sample = Sample::default();
                sample.position[2] = 40.0 * t + 250.0 * t * t + 20_000.0 / 6.0 * t * t * t;
                sample
            })
            .collect();
        let limits = Limits::default();
        let state = State::after(&samples, 19, &limits, &[20_000.0; 9], 1e-3).expect("it moves");
        assert!((state.speed - 51.0).abs() < 5.0, "{state:?}");
        // At 20 ms 54 mm/s and 900 mm/s2.
        assert!(
            (state.least_time - stop(54.0, 900.0)).abs() < 1e-3,
            "{state:?}"
        );
        assert!((state.least_distance() - state.speed.powi(2) / 2000.0).abs() < 1e-9);
        assert_eq!(State::after(&[], 3, &limits, &[0.0; 9], 1e-3), None);
    }
}
