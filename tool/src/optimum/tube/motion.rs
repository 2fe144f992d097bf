//! A motion with constant jerk in each of equal steps of time: a cubic spline.

use crate::path::pieces::Point;

/// Coefficients at each end that are the end itself: at rest, without acceleration.
pub(super) const AT_REST: usize = 3;

/// Fewer steps have no free coefficient.
pub(super) const LEAST_STEPS: usize = 12;

/// From rest to rest.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Motion {
    /// Of the uniform cubic B-spline, mm: three more than steps. Those from number k on, four of them, make step k.
    pub coefficients: Vec<Point>,
    /// Duration of a step, s.
    pub step: f64,
}

/// Weights of four coefficients in the position at a share of a step.
pub(super) fn position_weights(share: f64) -> [f64; 4] {
    let (u, rest) = (share, 1.0 - share);
    [
        rest * rest * rest / 6.0,
        (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
        (3.0 * rest * rest * rest - 6.0 * rest * rest + 4.0) / 6.0,
        u * u * u / 6.0,
    ]
}

/// The same in the velocity, times the duration of a step.
pub(super) fn velocity_weights(share: f64) -> [f64; 4] {
    let (u, rest) = (share, 1.0 - share);
    [
        -0.5 * rest * rest,
        1.5 * u * u - 2.0 * u,
        2.0 * rest - 1.5 * rest * rest,
        0.5 * u * u,
    ]
}

/// What the velocity of a step and its neighbours lies between, times the duration: where these keep a limit of speed it
/// does, between the knots, too.
pub(super) const VELOCITY_HULL: [f64; 4] = [0.0, -1.0, 1.0, 0.0];

/// The same in the acceleration at the start of a step, times the square of the duration.
pub(super) const ACCELERATION_WEIGHTS: [f64; 4] = [1.0, -2.0, 1.0, 0.0];

/// The same in the jerk, times the cube of the duration.
pub(super) const JERK_WEIGHTS: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];

impl Motion {
    /// Near positions that are equally far apart in time, altogether `duration` seconds. The motion stays within what
    /// the positions turn by in a step.
    pub(super) fn near(positions: &[Point], duration: f64, steps: usize) -> Motion {
        let last = positions.len() - 1;
        let at = |knot: usize| {
            let index = knot.min(steps) as f64 / steps as f64 * last as f64;
            let from = (index as usize).min(last.saturating_sub(1));
            let share = index - from as f64;
            let (one, other) = (positions[from], positions[(from + 1).min(last)]);
            std::array::from_fn(|axis| one[axis] + share * (other[axis] - one[axis]))
        };
        let mut coefficients: Vec<Point> = (0..steps + AT_REST)
            .map(|index| at(index.saturating_sub(1)))
            .collect();
        coefficients[..AT_REST].fill(positions[0]);
        coefficients[steps..].fill(positions[last]);
        Motion {
            coefficients,
            step: duration / steps as f64,
        }
    }

    /// The same in another number of steps.
    pub(super) fn resampled(&self, steps: usize) -> Motion {
        let positions: Vec<Point> = (0..=steps)
            .map(|knot| {
                let index = knot as f64 / steps as f64 * self.steps() as f64;
                let step = (index as usize).min(self.steps() - 1);
                self.position(step, index - step as f64)
            })
            .collect();
        Motion::near(&positions, self.duration(), steps)
    }

    pub(super) fn steps(&self) -> usize {
        self.coefficients.len() - AT_REST
    }

    /// s.
    pub(super) fn duration(&self) -> f64 {
        self.step * self.steps() as f64
    }

    /// At a share of step `step`.
    pub(super) fn position(&self, step: usize, share: f64) -> Point {
        self.weighted(step, &position_weights(share))
    }

    /// Between the steps: 0 to their number.
    pub(super) fn knots(&self) -> Vec<Point> {
        let mut knots: Vec<Point> = (0..self.steps()).map(|k| self.position(k, 0.0)).collect();
        knots.push(self.position(self.steps() - 1, 1.0));
        knots
    }

    /// A sum of the coefficients of a step.
    pub(super) fn weighted(&self, step: usize, weights: &[f64; 4]) -> Point {
        let coefficients = &self.coefficients[step..step + 4];
        std::array::from_fn(|axis| {
            let terms = coefficients.iter().zip(weights);
            terms.map(|(point, weight)| weight * point[axis]).sum()
        })
    }
}
