//! Judges sampled positions by their differences.

use framepath::axes::{Axes, AxisLimits};

/// The greatest ratios seen of velocity, acceleration and jerk to their limits.
pub struct Monitor {
    limits: AxisLimits,
    period: f64,
    last: [Axes; 4],
    pub velocity: f64,
    pub acceleration: f64,
    pub jerk: f64,
    /// Samples seen, and those with a jerk above its limit.
    pub samples: usize,
    pub above_jerk: usize,
}

impl Monitor {
    /// The machine stands at `position`.
    pub fn new(limits: &AxisLimits, period: f64, position: Axes) -> Self {
        Self {
            limits: *limits,
            period,
            last: [position; 4],
            velocity: 0.0,
            acceleration: 0.0,
            jerk: 0.0,
            samples: 0,
            above_jerk: 0,
        }
    }

    pub fn push(&mut self, position: Axes) {
        self.last = [position, self.last[0], self.last[1], self.last[2]];
        let [a, b, c, d] = &self.last;
        let h = self.period;
        // Differences of doubles are exact to some 1e-14 of the positions only.
        let noise = 1e-14 * (1.0 + position.amax());
        let ratio = |difference: Axes, limit: &Axes, power: i32| {
            difference
                .iter()
                .zip(limit.iter())
                .map(|(x, limit)| (x.abs() - 8.0 * noise).max(0.0) / h.powi(power) / limit)
                .fold(0.0, f64::max)
        };
        let velocity = ratio(a - b, &self.limits.velocity, 1);
        let acceleration = ratio(a - b * 2.0 + c, &self.limits.acceleration, 2);
        let jerk = ratio(a - b * 3.0 + c * 3.0 - d, &self.limits.jerk, 3);
        self.velocity = self.velocity.max(velocity);
        self.acceleration = self.acceleration.max(acceleration);
        self.jerk = self.jerk.max(jerk);
        self.samples += 1;
        self.above_jerk += usize::from(jerk > 1.0005);
    }
}
