//! What is allowed of the rate jerk, or of the rate acceleration, over a servo period.

use super::state::State;

/// Greatest rate acceleration, per period, where jerk is limited: from 0 to 1 takes four periods even where the limits
/// leave more, which keeps a period's change of rate small against what the rows linearise.
pub const RATE_ACCELERATION_LIMIT: f64 = 0.25;

/// Greatest rate jerk, per period squared, for the same reason.
pub const RATE_JERK_LIMIT: f64 = 0.25;

/// An interval of the rate jerk, per period squared, or of the rate acceleration, per period. Empty if `low > high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateDerivativeInterval {
    pub low: f64,
    pub high: f64,
}

impl RateDerivativeInterval {
    pub fn is_empty(&self) -> bool {
        self.low > self.high
    }

    pub fn contains(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        }
    }

    /// `value` moved into the interval; the middle of an empty one.
    pub fn nearest(&self, value: f64) -> f64 {
        if self.is_empty() {
            0.5 * (self.low + self.high)
        } else {
            value.max(self.low).min(self.high)
        }
    }

    /// The rate jerks that keep the rate from 0 to 1, at the end of the period and in the mean over it, and the rate
    /// acceleration within [`RATE_ACCELERATION_LIMIT`] at its end. Never empty.
    pub fn of_rate(state: State) -> Self {
        let (rate, change) = (state.rate, state.rate_acceleration);
        let (end, mean) = (rate + change, rate + 0.5 * change);
        let low = (-RATE_ACCELERATION_LIMIT - change)
            .max(-2.0 * end)
            .max(-6.0 * mean);
        let high = (RATE_ACCELERATION_LIMIT - change)
            .min(2.0 * (1.0 - end))
            .min(6.0 * (1.0 - mean));
        Self {
            low: low.min(high),
            high: high.max(low),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals() {
        let interval = RateDerivativeInterval {
            low: -1.0,
            high: 2.0,
        };
        assert_eq!(interval.nearest(5.0), 2.0);
        assert_eq!(interval.nearest(-5.0), -1.0);
        assert_eq!(interval.nearest(0.5), 0.5);
        assert!(interval.contains(-1.0) && interval.contains(2.0));
        assert!(!interval.contains(-1.1) && !interval.contains(2.1));
        let empty = interval.intersection(&RateDerivativeInterval {
            low: 3.0,
            high: 4.0,
        });
        assert!(empty.is_empty() && !empty.contains(2.5));
        assert_eq!(empty.nearest(9.0), 2.5);
        let standing = State {
            time: 0.0,
            rate: 0.0,
            rate_acceleration: 0.0,
        };
        let of_rate = RateDerivativeInterval::of_rate(standing);
        assert_eq!((of_rate.low, of_rate.high), (0.0, RATE_ACCELERATION_LIMIT));
        let nearly_full = State {
            rate: 0.999,
            rate_acceleration: 0.002,
            ..standing
        };
        let RateDerivativeInterval { high, .. } = RateDerivativeInterval::of_rate(nearly_full);
        assert!(nearly_full.step(high).rate <= 1.0 && nearly_full.advance(high) <= 1.0);
    }
}
