//! A change of velocity between two steady ones, with limited acceleration and jerk.

use super::path_limits::PathLimits;
use super::profile_state::ProfileState;

/// From a lower steady velocity up to a higher one, as fast as acceleration and jerk allow: jerk
/// up, constant acceleration, jerk down. Run backward it is the way down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    from: f64,
    to: f64,
    /// Seconds of rising acceleration, and of falling.
    jerk_time: f64,
    /// Seconds of constant acceleration.
    steady_time: f64,
    acceleration: f64,
    jerk: f64,
}

impl Ramp {
    pub(super) const NONE: Self = Self {
        from: 0.0,
        to: 0.0,
        jerk_time: 0.0,
        steady_time: 0.0,
        acceleration: 0.0,
        jerk: 0.0,
    };

    /// From `from` >= 0 up to a finite `to` >= `from`. Where neither acceleration nor jerk is
    /// limited the velocity jumps.
    pub(super) fn new(from: f64, to: f64, limits: &PathLimits) -> Self {
        let difference = (to - from).max(0.0);
        let (a, j) = (limits.acceleration, limits.jerk);
        let (jerk_time, steady_time, acceleration, jerk) = if !j.is_finite() {
            if a.is_finite() {
                (0.0, difference / a, a, 0.0)
            } else {
                (0.0, 0.0, 0.0, 0.0)
            }
        } else if difference * j >= a * a {
            (a / j, difference / a - a / j, a, j)
        } else {
            let t = (difference / j).sqrt();
            (t, 0.0, j * t, j)
        };
        Self {
            from,
            to,
            jerk_time,
            steady_time: steady_time.max(0.0),
            acceleration,
            jerk,
        }
    }

    pub(super) fn duration(&self) -> f64 {
        2.0 * self.jerk_time + self.steady_time
    }

    pub(super) fn distance(&self) -> f64 {
        0.5 * (self.from + self.to) * self.duration()
    }

    pub(super) fn top(&self) -> f64 {
        self.to
    }

    /// When the jerk changes between start and end.
    pub(super) fn jumps(&self) -> [f64; 2] {
        [self.jerk_time, self.jerk_time + self.steady_time]
    }

    /// The state at `t`, in the phase that holds at `within`.
    pub(super) fn state(&self, t: f64, within: f64) -> ProfileState {
        let [first, second] = self.jumps();
        if within < first {
            ProfileState {
                distance: t * (self.from + self.jerk * t * t / 6.0),
                velocity: self.from + 0.5 * self.jerk * t * t,
                acceleration: self.jerk * t,
                jerk: self.jerk,
            }
        } else if within < second {
            let x = t - first;
            let from = self.from + 0.5 * self.acceleration * first;
            ProfileState {
                distance: first * (self.from + self.acceleration * first / 6.0)
                    + x * (from + 0.5 * self.acceleration * x),
                velocity: from + self.acceleration * x,
                acceleration: self.acceleration,
                jerk: 0.0,
            }
        } else {
            let left = self.duration() - t;
            ProfileState {
                distance: self.distance() - left * (self.to - self.jerk * left * left / 6.0),
                velocity: self.to - 0.5 * self.jerk * left * left,
                acceleration: self.jerk * left,
                jerk: -self.jerk,
            }
        }
    }
}
