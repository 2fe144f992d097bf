//! Where the executor is in the reference, and its exact step over one servo period.

/// Reference time and its first two derivatives by time. Time is counted in servo periods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Reference time tau since the start of the first cell that the table keeps.
    pub time: f64,
    /// The rate, dtau/dt, 0 to 1; l in formulas.
    pub rate: f64,
    /// Its derivative by time, per servo period; m in formulas.
    pub rate_acceleration: f64,
}

impl State {
    /// At the start of the table, running as fast as the reference.
    pub const START: Self = Self {
        time: 0.0,
        rate: 1.0,
        rate_acceleration: 0.0,
    };

    /// How far the reference time advances in one servo period with this rate jerk (per period
    /// squared). Exact: within the period the reference time is a cubic.
    #[inline(always)]
    pub fn advance(self, rate_jerk: f64) -> f64 {
        self.rate + 0.5 * self.rate_acceleration + rate_jerk * (1.0 / 6.0)
    }

    /// The state after that period.
    #[inline(always)]
    pub fn step(self, rate_jerk: f64) -> Self {
        Self {
            time: self.time + self.advance(rate_jerk),
            rate: self.rate + self.rate_acceleration + 0.5 * rate_jerk,
            rate_acceleration: self.rate_acceleration + rate_jerk,
        }
    }

    /// The state in the middle of the same period; its time is not needed and is left as it is.
    #[inline(always)]
    pub fn half_step(self, rate_jerk: f64) -> Self {
        Self {
            time: self.time,
            rate: self.rate + 0.5 * self.rate_acceleration + 0.125 * rate_jerk,
            rate_acceleration: self.rate_acceleration + 0.5 * rate_jerk,
        }
    }

    /// The same with a rate acceleration of exactly 0 where it is 0 but for rounding.
    #[inline(always)]
    pub fn settled(self) -> Self {
        if self.is_steady() {
            Self {
                rate_acceleration: 0.0,
                ..self
            }
        } else {
            self
        }
    }

    /// Whether the rate stays as it is (its acceleration is 0 but for rounding): feasible for ever.
    #[inline(always)]
    pub fn is_steady(self) -> bool {
        self.rate_acceleration.abs() < STEADY
    }

    /// Whether this state may come one period after `previous`: with a rate from 0 to 1 but for
    /// rounding, and a time that in between ran neither backwards nor further than the reference does in a
    /// period, as it may where the rate rises above 1 and falls again within it.
    #[inline(always)]
    pub fn follows(self, previous: Self) -> bool {
        let possible = -ROUNDING..=1.0 + ROUNDING;
        possible.contains(&self.rate) && possible.contains(&(self.time - previous.time))
    }

    /// The state with its rate held from 0 to 1, exactly at the end of this range where it is
    /// there but for rounding.
    pub fn within_range(self) -> Self {
        let nearest = if self.rate < 0.5 { 0.0 } else { 1.0 };
        let steady = self.rate_acceleration == 0.0;
        if (-ROUNDING..=1.0 + ROUNDING).contains(&self.rate) {
            let rounds = steady && (self.rate - nearest).abs() < STEADY;
            Self {
                rate: if rounds {
                    nearest
                } else {
                    self.rate.clamp(0.0, 1.0)
                },
                ..self
            }
        } else {
            Self {
                rate: nearest,
                rate_acceleration: 0.0,
                ..self
            }
        }
    }
}

/// Rates and times this far off are rounding.
const ROUNDING: f64 = 1e-9;

/// Below this a rate acceleration is rounding: after a million periods it would amount to 1e-6.
const STEADY: f64 = 1e-12;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_step_is_the_integral(
            rate in 0.0..1.0,
            rate_acceleration in -0.25..0.25,
            rate_jerk in -0.25..0.25,
        ) {
            let state = State { time: 3.0, rate, rate_acceleration };
            let count = 2000;
            let h = 1.0 / f64::from(count);
            let mut sum = [state.time, state.rate];
            for i in 0..count {
                // The middle of each part: exact for the rate, of second order for the time.
                let t = (f64::from(i) + 0.5) * h;
                sum[0] += h * (rate + t * (rate_acceleration + 0.5 * t * rate_jerk));
                sum[1] += h * (rate_acceleration + t * rate_jerk);
            }
            let end = state.step(rate_jerk);
            prop_assert!((end.time - sum[0]).abs() < 1e-7);
            prop_assert!((end.rate - sum[1]).abs() < 1e-9);
            prop_assert!((end.rate_acceleration - rate_acceleration - rate_jerk).abs() < 1e-15);
            prop_assert!((end.time - state.time - state.advance(rate_jerk)).abs() < 1e-14);
            let middle = state.half_step(rate_jerk);
            prop_assert!((middle.rate - (rate + 0.5 * rate_acceleration + 0.125 * rate_jerk)).abs() < 1e-15);
            prop_assert!((middle.rate_acceleration - (rate_acceleration + 0.5 * rate_jerk)).abs() < 1e-15);
        }
    }

    #[test]
    fn the_range_is_kept() {
        let state = |rate, rate_acceleration| State {
            time: 0.0,
            rate,
            rate_acceleration,
        };
        assert_eq!(state(1.0 - 1e-13, 0.0).within_range(), state(1.0, 0.0));
        assert_eq!(state(1e-13, 0.0).within_range(), state(0.0, 0.0));
        assert_eq!(state(-1e-10, 0.01).within_range(), state(0.0, 0.01));
        assert_eq!(state(1.3, 0.01).within_range(), state(1.0, 0.0));
        assert_eq!(state(-0.3, -0.1).within_range(), state(0.0, 0.0));
        assert_eq!(state(0.7, 0.1).within_range(), state(0.7, 0.1));
        assert!(state(0.5, 0.0).follows(state(0.6, -0.1)));
        assert!(!state(1.1, 0.0).follows(state(1.0, 0.1)));
        assert!(!state(f64::NAN, 0.0).follows(state(1.0, 0.1)));
        let earlier = State {
            time: -0.1,
            ..state(0.5, 0.0)
        };
        assert!(!earlier.follows(state(0.5, 0.0)));
        // The rate is above 1 in the middle of the period, and in the mean.
        let before = state(0.9999, 0.0022);
        let behind = before.step(-0.0044);
        assert!(behind.rate < 1.0 && !behind.follows(before));
        assert!(before.step(-0.0072).follows(before));
    }
}
