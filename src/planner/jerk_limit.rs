//! What a limit of jerk means that comes from outside.

/// A jerk-limited axis takes at most so many seconds from rest to its greatest acceleration. With
/// more a stop would take so long that the number is taken for a slip.
const LONGEST_RAMP: f64 = 5.0;

/// The acceleration goes at most from one sign of its limit to the other within a servo period.
const BOTH_SIGNS: f64 = 2.0;

/// What a limit of jerk means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JerkLimit {
    /// Machine units per second cubed.
    Limited(f64),
    /// The jerk of the axis is not limited.
    Unlimited {
        /// Whether a limit was given, greater than what can be used.
        asked: bool,
    },
    /// It makes no sense.
    Refused {
        /// The smallest limit that does, machine units per second cubed.
        smallest: f64,
    },
}

impl JerkLimit {
    /// From a limit in machine units per second cubed, 0 = not limited, the axis' greatest
    /// acceleration, and the servo period in seconds. Where the last two are not known (0, or not
    /// numbers), every positive limit makes sense.
    pub fn new(jerk: f64, acceleration: f64, period: f64) -> Self {
        let known = acceleration > 0.0 && acceleration.is_finite();
        let smallest = if known {
            acceleration / LONGEST_RAMP
        } else {
            0.0
        };
        if jerk == 0.0 {
            Self::Unlimited { asked: false }
        } else if !(jerk > 0.0 && jerk >= smallest) {
            Self::Refused { smallest }
        } else if jerk == f64::INFINITY || known && jerk * period >= BOTH_SIGNS * acceleration {
            Self::Unlimited { asked: true }
        } else {
            Self::Limited(jerk)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ordinary_limit_is_what_it_is() {
        assert_eq!(
            JerkLimit::new(20_000.0, 1000.0, 1e-3),
            JerkLimit::Limited(20_000.0)
        );
        assert_eq!(
            JerkLimit::new(200.0, 1000.0, 1e-3),
            JerkLimit::Limited(200.0)
        );
    }

    #[test]
    fn none_and_more_than_a_period_can_use_are_the_same() {
        let asked = |asked| JerkLimit::Unlimited { asked };
        assert_eq!(JerkLimit::new(0.0, 1000.0, 1e-3), asked(false));
        assert_eq!(JerkLimit::new(2e6, 1000.0, 1e-3), asked(true));
        assert_eq!(JerkLimit::new(f64::INFINITY, 1000.0, 1e-3), asked(true));
        assert_eq!(
            JerkLimit::new(1.9e6, 1000.0, 1e-3),
            JerkLimit::Limited(1.9e6)
        );
    }

    #[test]
    fn what_makes_a_stop_last_for_ever_is_refused() {
        let refused = JerkLimit::Refused { smallest: 200.0 };
        for jerk in [199.0, 1e-300, -1.0, f64::NAN, f64::NEG_INFINITY] {
            assert_eq!(JerkLimit::new(jerk, 1000.0, 1e-3), refused, "{jerk}");
        }
    }

    #[test]
    fn an_axis_without_acceleration_or_period_has_any_positive_limit() {
        for acceleration in [0.0, f64::NAN, f64::INFINITY, -1.0] {
            assert_eq!(
                JerkLimit::new(1.0, acceleration, 1e-3),
                JerkLimit::Limited(1.0)
            );
        }
        assert_eq!(JerkLimit::new(1e9, 1000.0, 0.0), JerkLimit::Limited(1e9));
        assert_eq!(
            JerkLimit::new(-1.0, 0.0, 0.0),
            JerkLimit::Refused { smallest: 0.0 }
        );
    }
}
