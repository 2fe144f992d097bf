//! Velocity, acceleration and jerk of each axis by finite differences of the positions, and the time
//! from the first to the last motion.

use crate::host::recording::{Recording, moves, step};
use crate::machine::limits::Limits;
use serde::Serialize;

/// The worst of an axis, or of all axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Peak {
    /// Per second, squared or cubed.
    pub value: f64,
    /// Value over limit; 0 where there is no limit.
    pub ratio: f64,
    /// Index of the axis.
    pub axis: usize,
    /// When, s.
    pub time: f64,
    /// Number of the move that ran (from 1).
    pub id: i32,
}

/// What the axes did.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Motion {
    /// First to last cycle with motion, s.
    pub time: f64,
    pub velocity: Peak,
    pub acceleration: Peak,
    pub jerk: Peak,
    /// The largest jerk of an axis in units of its acceleration per second, whatever the limit.
    pub jerk_in_accelerations: f64,
    /// A position was not a number.
    pub not_finite: bool,
    /// First and last sample with motion.
    #[serde(skip)]
    pub range: Option<(usize, usize)>,
}

/// Measures a run; `jerk` are the limits of the axes, 0 = none.
pub(crate) fn motion(
    recording: &Recording,
    limits: &Limits,
    jerk: &[f64; 9],
    period: f64,
) -> Motion {
    let mut motion = Motion::default();
    let [mut velocity, mut acceleration] = [[0.0; 9]; 2];
    for (k, sample) in recording.samples.iter().enumerate() {
        let travel = step(&recording.samples, k);
        if sample
            .position
            .iter()
            .any(|coordinate| !coordinate.is_finite())
        {
            motion.not_finite = true;
        }
        if moves(&travel) {
            let first = motion.range.map_or(k, |(first, _)| first);
            motion.range = Some((first, k));
        }
        for axis in 0..9 {
            let now = travel[axis] / period;
            let change = (now - velocity[axis]) / period;
            let third = (change - acceleration[axis]) / period;
            let peak = |value: f64, limit: f64| Peak {
                value: value.abs(),
                ratio: if limit > 0.0 {
                    value.abs() / limit
                } else {
                    0.0
                },
                axis,
                time: k as f64 * period,
                id: sample.id,
            };
            keep_worse(&mut motion.velocity, peak(now, limits.velocity[axis]));
            keep_worse(
                &mut motion.acceleration,
                peak(change, limits.acceleration[axis]),
            );
            keep_worse(&mut motion.jerk, peak(third, jerk[axis]));
            motion.jerk_in_accelerations = motion
                .jerk_in_accelerations
                .max(third.abs() / limits.acceleration[axis]);
            velocity[axis] = now;
            acceleration[axis] = change;
        }
    }
    if let Some((first, last)) = motion.range {
        motion.time = (last - first + 1) as f64 * period;
    }
    motion
}

fn keep_worse(worst: &mut Peak, candidate: Peak) {
    if candidate.ratio > worst.ratio
        || (worst.ratio == 0.0 && candidate.value > worst.value)
        || candidate.value.is_nan()
    {
        *worst = candidate;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::host::recording::Sample;

    #[test]
    fn a_jump_is_seen_as_such() {
        let mut recording = Recording::default();
        for k in 0..10 {
            let mut sample = Sample::default();
            sample.position[1] = if k < 4 { 0.0 } else { 0.5 };
            recording.samples.push(sample);
        }
        let motion = motion(&recording, &Limits::default(), &[20_000.0; 9], 0.001);
        assert_eq!(motion.range, Some((4, 4)));
        assert!((motion.velocity.ratio - 5.0).abs() < 1e-9);
        assert!((motion.acceleration.ratio - 500.0).abs() < 1e-6);
        assert!((motion.jerk.ratio - 50_000.0).abs() < 1e-3);
        assert_eq!(motion.velocity.axis, 1);
    }
}
