//! How the machine comes to rest when it is held: by a pause or by a feed override of 0.

use super::kinematics::{moves, step};
use super::limits::Limits;
use super::recording::{HELD, Recording, WAITING};
use serde::Serialize;

/// The holds of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Holds {
    /// How often a moving machine was held until it stood.
    pub count: usize,
    /// How often it did not stand at the end of the hold.
    pub not_at_rest: usize,
    /// Longest time to rest, s.
    pub longest: f64,
    /// Mean of the time to rest over that of the shortest stop on a straight path.
    pub mean_ratio: f64,
    /// How much longer than that it took at worst, s.
    pub latest: f64,
    /// Largest travel of an axis while it was held and had been at rest, mm or degrees.
    pub drift: f64,
}

/// Measures all holds; `jerk` are the limits of the axes, 0 = none.
pub(crate) fn holds(recording: &Recording, limits: &Limits, jerk: &[f64; 9], period: f64) -> Holds {
    let samples = &recording.samples;
    let held = |k: usize| {
        samples
            .get(k)
            .is_some_and(|sample| sample.flags & (HELD | WAITING) == HELD)
    };
    let mut holds = Holds::default();
    let mut sum = 0.0;
    let mut k = 1;
    while k < samples.len() {
        if !held(k) {
            k += 1;
            continue;
        }
        let start = k;
        let before = step(samples, start - 1);
        let mut rest = None;
        while held(k) {
            let travel = step(samples, k);
            if !moves(&travel) {
                rest.get_or_insert(k);
            } else if rest.is_some() {
                let far = travel
                    .iter()
                    .fold(0.0, |far, part| f64::max(far, part.abs()));
                holds.drift = holds.drift.max(far);
            }
            k += 1;
        }
        if !moves(&before) {
            continue;
        }
        let Some(rest) = rest else {
            holds.not_at_rest += 1;
            continue;
        };
        let time = (rest - start) as f64 * period;
        let ideal = shortest_stop(&before, limits, jerk, period);
        holds.count += 1;
        holds.longest = holds.longest.max(time);
        holds.latest = holds.latest.max(time - ideal);
        sum += time / ideal;
    }
    if holds.count > 0 {
        holds.mean_ratio = sum / holds.count as f64;
    }
    holds
}

/// Least time to rest from this travel in a cycle without acceleration, straight on. At least a
/// cycle.
fn shortest_stop(travel: &[f64; 9], limits: &Limits, jerk: &[f64; 9], period: f64) -> f64 {
    let mut longest = period;
    // Along a straight line all axes slow down in proportion: the one that needs most time rules.
    for axis in 0..9 {
        let velocity = travel[axis].abs() / period;
        let (most, change) = (limits.acceleration[axis], jerk[axis]);
        let time = if change <= 0.0 {
            velocity / most
        } else if velocity >= most * most / change {
            velocity / most + most / change
        } else {
            2.0 * (velocity / change).sqrt()
        };
        longest = longest.max(time);
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::recording::Sample;

    /// 100 mm/s in X; from 0.1 s on held, slowing down with `deceleration`.
    fn held_run(deceleration: f64) -> Recording {
        let mut recording = Recording::default();
        let (mut x, mut velocity) = (0.0, 100.0);
        for k in 0..400 {
            let flags = if k >= 100 { HELD } else { 0 };
            if k >= 100 {
                velocity = f64::max(0.0, velocity - deceleration * 1e-3);
            }
            x += velocity * 1e-3;
            let mut sample = Sample {
                flags,
                ..Sample::default()
            };
            sample.position[0] = x;
            recording.samples.push(sample);
        }
        recording
    }

    #[test]
    fn full_deceleration_is_ideal_and_half_takes_twice_as_long() {
        let measure = |deceleration| {
            holds(
                &held_run(deceleration),
                &Limits::default(),
                &[0.0; 9],
                0.001,
            )
        };
        let ideal = measure(1000.0);
        assert_eq!((ideal.count, ideal.not_at_rest), (1, 0));
        assert!((ideal.mean_ratio - 1.0).abs() < 0.02, "{ideal:?}");
        let half = measure(500.0);
        assert!((half.mean_ratio - 2.0).abs() < 0.02, "{half:?}");
        assert!((half.latest - 0.1).abs() < 0.002, "{half:?}");
        let never = measure(100.0);
        assert_eq!((never.count, never.not_at_rest), (0, 1));
    }

    #[test]
    fn shortest_stop_with_a_jerk_limit() {
        let mut travel = [0.0; 9];
        travel[0] = 0.1;
        let stop = |jerk| shortest_stop(&travel, &Limits::default(), &[jerk; 9], 0.001);
        assert!((stop(20_000.0) - 0.15).abs() < 1e-12);
        assert!((stop(1000.0) - 2.0 * 0.1f64.sqrt()).abs() < 1e-12);
    }
}
