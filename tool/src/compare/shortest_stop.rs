//! The shortest stop from a state of motion on a straight path.

use super::kinematics::step;
use super::limits::Limits;
use super::recording::Sample;

/// Speed and acceleration along the path at a moment, and what the axes allow there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    /// Above 0.
    pub speed: f64,
    /// Negative if it slows down.
    pub acceleration: f64,
    /// Greatest acceleration along the path.
    pub most: f64,
    /// Greatest jerk along the path; infinite if there is no limit.
    pub jerk: f64,
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
        let size = |k: Option<usize>| k.map_or(0.0, |k| norm(&step(samples, k)));
        let length = norm(&travel);
        if length <= 0.0 {
            return None;
        }
        let along = |limits: &[f64; 9]| {
            let axes = limits.iter().zip(&travel);
            axes.filter(|(limit, travel)| **limit > 0.0 && **travel != 0.0)
                .map(|(limit, travel)| limit * length / travel.abs())
                .fold(f64::INFINITY, f64::min)
        };
        let (most, jerk) = (along(&limits.acceleration), along(jerk));
        let before = size(k.checked_sub(1));
        let earlier = size(k.checked_sub(2));
        // The mean speeds of the cycles, carried on to the end of the last.
        let change = (length - before) / period.powi(2);
        let bend = ((length - 2.0 * before + earlier) / period.powi(3)).clamp(-jerk, jerk);
        let acceleration = (change + bend * period).clamp(-most, most);
        let speed = length / period + 0.5 * period * (change + 0.5 * period * bend);
        Some(State {
            speed: speed.max(length / period * 1e-3),
            acceleration,
            most,
            jerk,
        })
    }

    /// Time to rest, s. A path that bends leaves less for braking: no stop is shorter.
    ///
    /// Full jerk down to the braking acceleration, that one held if it is the greatest, full jerk up
    /// to rest.
    pub(crate) fn shortest_stop(&self) -> f64 {
        let State {
            speed,
            acceleration,
            most,
            jerk,
        } = *self;
        if !jerk.is_finite() {
            return speed / most;
        }
        // Braking so hard already that only letting go is left.
        if acceleration < 0.0 && speed <= acceleration * acceleration / (2.0 * jerk) {
            return -2.0 * speed / acceleration;
        }
        let square = jerk * speed + 0.5 * acceleration * acceleration;
        let braking = square.sqrt().min(most);
        let held = (square - braking * braking).max(0.0) / (jerk * braking);
        (acceleration + braking) / jerk + held + braking / jerk
    }

    /// A distance that no stop undercuts.
    pub(crate) fn least_distance(&self) -> f64 {
        // Constant full braking at once.
        self.speed * self.speed / (2.0 * self.most)
    }
}

fn norm(vector: &[f64; 9]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stop(speed: f64, acceleration: f64) -> f64 {
        let state = State {
            speed,
            acceleration,
            most: 1000.0,
            jerk: 20_000.0,
        };
        state.shortest_stop()
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
        assert!(
            (state.speed - (40.0 + 500.0 * 0.02 + 10_000.0 * 0.0004)).abs() < 2e-2,
            "{state:?}"
        );
        assert!((state.acceleration - 900.0).abs() < 1e-6, "{state:?}");
        assert_eq!((state.most, state.jerk), (1000.0, 20_000.0));
        assert_eq!(State::after(&[], 3, &limits, &[0.0; 9], 1e-3), None);
    }
}
