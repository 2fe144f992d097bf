//! The fastest run along a path to rest at its end, with limited velocity, acceleration and jerk.
//!
//! The double S profile of Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines
//! and Robots (Springer 2008), sections 3.4 and 3.4.3 for the closed form; with unlimited jerk it
//! is the trapezoid of section 3.2.

use super::path_limits::PathLimits;
use super::profile_state::ProfileState;
use super::ramp::Ramp;
use crate::cube_root::cube_root;

/// A run over a given distance: up to the peak velocity, on at that velocity, and down to rest.
/// At most seven phases of constant jerk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JerkLimitedProfile {
    length: f64,
    up: Ramp,
    cruise: f64,
    down: Ramp,
}

impl JerkLimitedProfile {
    /// A profile of no duration.
    pub const NONE: Self = Self {
        length: 0.0,
        up: Ramp::NONE,
        cruise: 0.0,
        down: Ramp::NONE,
    };

    /// The fastest run over `length` > 0 from rest to rest.
    ///
    /// Acceleration and jerk may be infinite. If the velocity is too, or the length or a limit is
    /// not positive, the profile has no duration and stays at its end.
    pub fn rest_to_rest(length: f64, limits: &PathLimits) -> Self {
        let peak = rest_to_rest_peak(length, limits);
        if !(peak > 0.0 && peak.is_finite() && length.is_finite()) {
            return Self {
                length,
                ..Self::NONE
            };
        }
        Self::over_peak(length, 0.0, peak, limits)
    }

    /// The fastest run over `length` to rest from a steady `velocity` below that of the limits,
    /// acceleration 0. `None` if the length is too short to come to rest, or to gain anything.
    pub fn raised(length: f64, velocity: f64, limits: &PathLimits) -> Option<Self> {
        let fits = |peak: f64| {
            let up = Ramp::new(velocity, peak, limits);
            let down = Ramp::new(0.0, peak, limits);
            up.distance() + down.distance() <= length
        };
        let rises = velocity >= 0.0 && velocity < limits.velocity;
        if !(rises && limits.velocity.is_finite() && fits(velocity)) {
            return None;
        }
        let mut peak = limits.velocity;
        if !fits(peak) {
            // The distance grows with the peak, so halving finds the greatest one that fits.
            let (mut low, mut high) = (velocity, peak);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if fits(middle) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            peak = low;
        }
        (peak > velocity * (1.0 + 1e-6)).then(|| Self::over_peak(length, velocity, peak, limits))
    }

    fn over_peak(length: f64, velocity: f64, peak: f64, limits: &PathLimits) -> Self {
        let up = Ramp::new(velocity, peak, limits);
        let down = Ramp::new(0.0, peak, limits);
        let cruise = (length - up.distance() - down.distance()).max(0.0) / peak;
        Self {
            length,
            up,
            cruise,
            down,
        }
    }

    /// Seconds from start to end.
    pub fn duration(&self) -> f64 {
        self.up.duration() + self.cruise + self.down.duration()
    }

    /// The distance it covers.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Seconds of steady velocity that are left at time `t`, if that is within them.
    pub fn steady_time_left(&self, t: f64) -> Option<f64> {
        let since = t - self.up.duration();
        (since >= 0.0 && since < self.cruise).then_some(self.cruise - since)
    }

    /// The first instant after `t` at which jerk or acceleration jump; infinite if there is none.
    pub fn next_jump(&self, t: f64) -> f64 {
        let cruise_start = self.up.duration();
        let down_start = cruise_start + self.cruise;
        let end = down_start + self.down.duration();
        let [up_1, up_2] = self.up.jumps();
        let [down_1, down_2] = self.down.jumps();
        [
            up_1,
            up_2,
            cruise_start,
            down_start,
            end - down_2,
            end - down_1,
            end,
        ]
        .into_iter()
        .filter(|jump| *jump > t)
        .fold(f64::INFINITY, f64::min)
    }

    /// The state at time `t`, held within 0 and the duration, with the acceleration and jerk of
    /// the phase that holds at `within`: a neighbour of `t` on the side that is meant.
    ///
    /// From the peak on the state is counted from the end, which makes the end exact.
    pub fn state(&self, t: f64, within: f64) -> ProfileState {
        let down_start = self.up.duration() + self.cruise;
        let t = t.max(0.0).min(self.duration());
        if within < self.up.duration() {
            self.up.state(t, within)
        } else if within < down_start {
            ProfileState {
                distance: self.up.distance() + self.up.top() * (t - self.up.duration()),
                velocity: self.up.top(),
                acceleration: 0.0,
                jerk: 0.0,
            }
        } else {
            let end = self.duration();
            let mirrored = self.down.state(end - t, end - within);
            ProfileState {
                distance: self.length - mirrored.distance,
                velocity: mirrored.velocity,
                acceleration: -mirrored.acceleration,
                jerk: mirrored.jerk,
            }
        }
    }
}

/// The peak velocity of the fastest run from rest to rest.
fn rest_to_rest_peak(length: f64, limits: &PathLimits) -> f64 {
    let PathLimits {
        velocity,
        acceleration,
        jerk,
    } = *limits;
    // Without reaching the greatest acceleration, four phases of equal duration cover the length.
    let free = if jerk.is_finite() {
        jerk * cube_root(length / (2.0 * jerk)).powi(2)
    } else {
        f64::INFINITY
    };
    // Reaching it: v = A (T_a - A / J) with T_a from the length, where v T_a = length.
    let bounded = if acceleration.is_finite() {
        let jerk_time = acceleration / jerk;
        let half = 0.5 * jerk_time;
        // (sqrt(half^2 + L/A) - half) without cancellation.
        let ratio = length / acceleration;
        let sum = half + (half * half + ratio).sqrt();
        length / sum
    } else {
        f64::INFINITY
    };
    let peak = if free * jerk <= acceleration * acceleration || !acceleration.is_finite() {
        free
    } else {
        bounded
    };
    peak.min(velocity)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn limits(velocity: f64, acceleration: f64, jerk: f64) -> PathLimits {
        PathLimits {
            velocity,
            acceleration,
            jerk,
        }
    }

    /// All limits, each of them now and then infinite as long as one is left.
    fn any_limits() -> impl Strategy<Value = PathLimits> {
        let magnitude = |low: f64, high: f64| (low.ln()..high.ln()).prop_map(f64::exp);
        (
            magnitude(1e-2, 1e3),
            prop_oneof![4 => magnitude(1.0, 1e5), 1 => Just(f64::INFINITY)],
            prop_oneof![4 => magnitude(1e1, 1e7), 1 => Just(f64::INFINITY)],
        )
            .prop_map(|(v, a, j)| limits(v, a, j))
    }

    fn any_length() -> impl Strategy<Value = f64> {
        (1e-6f64.ln()..1e3f64.ln()).prop_map(f64::exp)
    }

    /// What the rounding of an instant makes of a velocity or acceleration that is as steep as `slope`.
    fn rounding(profile: &JerkLimitedProfile, slope: f64) -> f64 {
        if slope.is_finite() {
            1e-15 * profile.duration() * slope
        } else {
            0.0
        }
    }

    /// Checks limits at some instants of the phase between two times, and that the values belong together.
    fn check_phase(
        profile: &JerkLimitedProfile,
        limits: &PathLimits,
        [from, to]: [f64; 2],
    ) -> Result<(), TestCaseError> {
        let of_velocity = rounding(profile, limits.acceleration);
        let of_acceleration = rounding(profile, limits.jerk);
        let near = 1.0 + 1e-9;
        let middle = 0.5 * (from + to);
        let first = profile.state(from, middle);
        let (v, a, j) = (first.velocity, first.acceleration, first.jerk);
        for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let t = from + share * (to - from);
            let state = profile.state(t, middle);
            prop_assert!(state.velocity >= -1e-9 * limits.velocity - of_velocity);
            prop_assert!(state.velocity <= limits.velocity * near + of_velocity);
            prop_assert!(state.acceleration.abs() <= limits.acceleration * near + of_acceleration);
            prop_assert!(state.jerk.abs() <= limits.jerk * near);
            // Taylor's theorem within a phase ties the values together.
            let x = t - from;
            let taylor = first.distance + x * (v + x * (0.5 * a + x * j / 6.0));
            prop_assert!((state.distance - taylor).abs() <= 1e-9 * profile.length());
            prop_assert!(
                (state.velocity - (v + x * (a + x * j * 0.5))).abs()
                    <= 1e-7 * limits.velocity + of_velocity
            );
        }
        Ok(())
    }

    /// Checks continuity and limits at many instants, on both sides of each jump.
    fn check(profile: &JerkLimitedProfile, limits: &PathLimits) -> Result<(), TestCaseError> {
        let duration = profile.duration();
        prop_assert!(duration > 0.0 && duration.is_finite());
        let start = profile.state(0.0, 0.0);
        let end = profile.state(duration, duration);
        prop_assert_eq!(start.distance, 0.0);
        prop_assert_eq!(end.distance, profile.length());
        let jumps = !limits.acceleration.is_finite() && !limits.jerk.is_finite();
        prop_assert!(jumps || end.velocity == 0.0);
        let (mut from, mut phases) = (0.0, 0);
        let mut before = start;
        while from < duration {
            let to = profile.next_jump(from);
            prop_assert!(to <= duration);
            let middle = 0.5 * (from + to);
            check_phase(profile, limits, [from, to])?;
            let entry = profile.state(from, middle);
            prop_assert!((entry.distance - before.distance).abs() <= 1e-9 * profile.length());
            if !jumps {
                prop_assert!(
                    (entry.velocity - before.velocity).abs()
                        <= 1e-6 * limits.velocity + rounding(profile, limits.acceleration)
                );
            }
            if limits.jerk.is_finite() {
                let peak = limits
                    .acceleration
                    .min((limits.jerk * limits.velocity).sqrt());
                prop_assert!(
                    (entry.acceleration - before.acceleration).abs()
                        <= 1e-5 * peak + rounding(profile, limits.jerk)
                );
            }
            before = profile.state(to, middle);
            from = to;
            phases += 1;
        }
        prop_assert!(phases <= 7);
        Ok(())
    }

    #[test]
    fn has_the_durations_of_the_textbook() {
        // Full double S: v / a + a / j + L / v.
        let full = JerkLimitedProfile::rest_to_rest(100.0, &limits(100.0, 1000.0, 20_000.0));
        assert!((full.duration() - 1.15).abs() < 1e-12);
        // Without steady velocity or acceleration: four phases of cbrt(L / 2 J).
        let short = JerkLimitedProfile::rest_to_rest(0.04, &limits(100.0, 1000.0, 20_000.0));
        assert!((short.duration() - 0.04).abs() < 1e-12);
        // Trapezoid and triangle.
        let trapezoid =
            JerkLimitedProfile::rest_to_rest(20.0, &limits(100.0, 1000.0, f64::INFINITY));
        assert!((trapezoid.duration() - 0.3).abs() < 1e-12);
        let triangle = JerkLimitedProfile::rest_to_rest(2.5, &limits(100.0, 1000.0, f64::INFINITY));
        assert!((triangle.duration() - 0.1).abs() < 1e-12);
        // Nothing but a velocity.
        let jump =
            JerkLimitedProfile::rest_to_rest(5.0, &limits(100.0, f64::INFINITY, f64::INFINITY));
        assert!((jump.duration() - 0.05).abs() < 1e-15);
        assert_eq!(jump.state(0.02, 0.02).distance, 2.0);
    }

    #[test]
    fn without_limits_there_is_no_motion() {
        for (v, length) in [
            (f64::INFINITY, 1.0),
            (0.0, 1.0),
            (f64::NAN, 1.0),
            (1.0, 0.0),
        ] {
            let all = limits(v, f64::INFINITY, f64::INFINITY);
            assert_eq!(
                JerkLimitedProfile::rest_to_rest(length, &all).duration(),
                0.0
            );
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn rest_to_rest_keeps_the_limits(length in any_length(), limits in any_limits()) {
            check(&JerkLimitedProfile::rest_to_rest(length, &limits), &limits)?;
        }

        /// At least one limit is reached at each instant, so nothing faster exists.
        #[test]
        fn rest_to_rest_is_the_fastest(length in any_length(), limits in any_limits()) {
            let profile = JerkLimitedProfile::rest_to_rest(length, &limits);
            let mut from = 0.0;
            while from < profile.duration() {
                let to = profile.next_jump(from);
                // Phases that rounding has left over say nothing.
                if to - from > 1e-6 * profile.duration() {
                    let state = profile.state(0.5 * (from + to), 0.5 * (from + to));
                    let tight = 1.0 - 1e-6;
                    prop_assert!(
                        state.velocity >= limits.velocity * tight
                            || state.acceleration.abs() >= limits.acceleration * tight
                            || state.jerk.abs() >= limits.jerk * tight
                    );
                }
                from = to;
            }
        }

        #[test]
        fn a_raise_keeps_the_limits_and_gains_time(
            length in any_length(),
            limits in any_limits(),
            factor in 1.01..3.0f64,
            share in 0.0..1.0f64,
        ) {
            let before = JerkLimitedProfile::rest_to_rest(length, &limits);
            let higher = PathLimits { velocity: limits.velocity * factor, ..limits };
            let at = before.up.duration() + share * before.cruise;
            let state = before.state(at, at);
            if before.steady_time_left(at).is_some()
                && let Some(raised) = JerkLimitedProfile::raised(length - state.distance, state.velocity, &higher)
            {
                check_from(&raised, state.velocity, &higher)?;
                prop_assert!(at + raised.duration() <= before.duration() * (1.0 + 1e-9));
            }
        }
    }

    fn check_from(
        profile: &JerkLimitedProfile,
        velocity: f64,
        limits: &PathLimits,
    ) -> Result<(), TestCaseError> {
        let start = profile.state(0.0, 0.0);
        prop_assert!(
            (start.velocity - velocity).abs() <= 1e-12 * velocity
                || !limits.acceleration.is_finite()
        );
        check(profile, limits)
    }

    #[test]
    fn a_raise_with_room_reaches_the_new_velocity() {
        let before = limits(50.0, 1000.0, 20_000.0);
        let after = limits(100.0, 1000.0, 20_000.0);
        let profile = JerkLimitedProfile::raised(100.0, before.velocity, &after).expect("a raise");
        assert_eq!(profile.up.top(), 100.0);
        assert!(
            JerkLimitedProfile::raised(1.0, before.velocity, &after).is_none(),
            "no room to brake"
        );
        assert!(
            JerkLimitedProfile::raised(100.0, 100.0, &before).is_none(),
            "not a raise"
        );
    }
}
