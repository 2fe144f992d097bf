//! Braking for a feed cap ahead, hard and within the limits.

use super::backup_refusal::BackupRefusal;
use super::rate_derivative_interval::RateDerivativeInterval;
use super::simulated_period::{Place, step};
use super::simulation::Simulation;
use super::state::State;

/// Of what the jerk allows in a period, what braking for a cap ahead leaves at first.
const RESERVED: f64 = 0.15;

/// Of the greatest rate jerk in a period, what braking counts on for bringing the rate acceleration to 0 in time.
const KEPT_TO_RELEASE: f64 = 0.7;

/// One period of hard braking, with a rate acceleration from `least_rate_acceleration` on, towards a rate not below
/// `lowest`.
#[inline(always)]
pub fn braking_step(
    simulation: &mut Simulation,
    start: &Place,
    (least_rate_acceleration, lowest): (f64, f64),
) -> Result<Place, BackupRefusal> {
    let state = start.state;
    let limits = simulation.limits;
    let gentle = least_rate_acceleration - state.rate_acceleration;
    step(simulation, limits, start, |span, jerk, predicted| {
        let low = span.acceleration_interval(state, predicted).low;
        let landing = least_to_land(state, lowest, KEPT_TO_RELEASE * jerk.high.max(0.0));
        hard_braking(jerk, low.max(landing).max(gentle))
    })
}

/// The least rate jerk behind which the rate acceleration can be brought to 0 before the rate is below `lowest`, or 0
/// where it is below that already, with rate jerks up to `most`.
fn least_to_land(state: State, lowest: f64, most: f64) -> f64 {
    let lowest = if state.rate > lowest { lowest } else { 0.0 };
    let rate = state.rate - lowest + 0.5 * state.rate_acceleration;
    if rate <= most {
        // The period behind it ends there.
        return -(rate + state.rate_acceleration);
    }
    // Behind it the rate acceleration is x, and the rate falls by x^2 / (2 most) until x is 0; since periods are
    // counted whole, by most / 8 more at worst.
    let half = 0.5 * most;
    let fall = rate - 0.125 * most;
    half - (half * half + 2.0 * most * fall).sqrt() - state.rate_acceleration
}

/// The rate jerk of a period of hard braking, where the jerk allows `jerk` and the acceleration `low`.
pub fn hard_braking(jerk: &RateDerivativeInterval, low: f64) -> f64 {
    jerk.nearest(low.max(jerk.low + RESERVED * (jerk.high - jerk.low)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn behind_the_least_rate_jerk_the_rate_does_not_fall_below_the_lowest(
            lowest in 0.0..0.9,
            above in 0.0..0.1,
            part in 0.0..1.0_f64,
            most in 1e-5..0.01_f64,
        ) {
            // A rate acceleration that can be brought to 0 in time.
            let fall = f64::max(above - 0.125 * most, 0.0);
            let start = State {
                time: 0.0,
                rate: lowest + above,
                rate_acceleration: -part * f64::sqrt(2.0 * most * fall),
            };
            let mut state = start.step(least_to_land(start, lowest, most));
            for _ in 0..10_000 {
                if state.is_steady() {
                    break;
                }
                state = state.step((-state.rate_acceleration).max(-most).min(most));
            }
            prop_assert!(state.is_steady());
            prop_assert!(state.rate >= lowest - 1e-9, "{}", state.rate - lowest);
            // Nor does it leave more than it has to.
            prop_assert!(state.rate <= lowest + most, "{}", state.rate - lowest);
        }
    }

    #[test]
    fn hard_braking_keeps_to_what_the_acceleration_allows() {
        let jerk = RateDerivativeInterval {
            low: -1.0,
            high: 1.0,
        };
        assert_eq!(hard_braking(&jerk, -5.0), -1.0 + 2.0 * RESERVED);
        assert_eq!(hard_braking(&jerk, -0.2), -0.2);
        assert_eq!(hard_braking(&jerk, 3.0), 1.0);
    }
}
