//! Velocity, acceleration and jerk of each axis and joint by finite differences of the positions, and the time
//! from the first to the last motion.

use crate::host::job::Job;
use crate::host::recording::{Recording, Sample, moves, step};
use crate::path::Position;
use crate::path::differences::Differences;
use serde::Serialize;

/// What moves, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Mover {
    /// In the order X Y Z A B C U V W.
    Axis(usize),
    Joint(usize),
}

impl Default for Mover {
    fn default() -> Self {
        Mover::Axis(0)
    }
}

/// The worst of all axes, or of all joints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Peak {
    /// Per second, squared or cubed.
    pub value: f64,
    /// Value over limit; 0 where there is no limit.
    pub ratio: f64,
    /// Whose it is.
    #[serde(flatten)]
    pub mover: Mover,
    /// When, s.
    pub time: f64,
    /// Number of the move that ran (from 1).
    pub id: i32,
}

/// The worst of each quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Peaks {
    pub velocity: Peak,
    pub acceleration: Peak,
    pub jerk: Peak,
    /// The largest jerk in units of its mover's acceleration per second, whatever the limit.
    pub jerk_in_accelerations: f64,
}

/// What axes and joints did.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Motion {
    /// First to last cycle with motion, s.
    pub time: f64,
    #[serde(flatten)]
    pub axes: Peaks,
    /// Where joints have limits of their own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints: Option<Peaks>,
    /// A position was not a number.
    pub not_finite: bool,
    /// First and last sample with motion.
    #[serde(skip)]
    pub range: Option<(usize, usize)>,
}

impl Motion {
    /// Measures a run of a job.
    pub(crate) fn of(recording: &Recording, job: &Job) -> Motion {
        let samples = recording.samples.as_slice();
        let takes_jerk = recording.takes_jerk;
        let axes = Bounds {
            limits: job.bounds(takes_jerk),
            accelerations: job.limits.acceleration,
            mover: Mover::Axis,
        };
        let mut motion = Motion {
            axes: peaks(samples, &axes, job.period),
            ..Motion::default()
        };
        if let (Some(joints), Some(limits)) = (&job.joints, job.joint_bounds(takes_jerk)) {
            let bounds = Bounds {
                limits,
                accelerations: limits[1],
                mover: Mover::Joint,
            };
            let samples = recording.of_joints(joints).samples;
            motion.joints = Some(peaks(&samples, &bounds, job.period));
        }
        motion.note_range(samples, job.period);
        motion
    }

    fn note_range(&mut self, samples: &[Sample], period: f64) {
        for (k, sample) in samples.iter().enumerate() {
            let mut coordinates = sample.position.iter();
            self.not_finite |= coordinates.any(|coordinate| !coordinate.is_finite());
            if moves(&step(samples, k)) {
                let first = self.range.map_or(k, |(first, _)| first);
                self.range = Some((first, k));
            }
        }
        if let Some((first, last)) = self.range {
            self.time = (last - first + 1) as f64 * period;
        }
    }
}

/// What peaks are compared with.
struct Bounds {
    /// Velocity, acceleration and jerk, shape (3, 9), infinite where there is no limit.
    limits: [Position; 3],
    /// What jerk is told in.
    accelerations: Position,
    mover: fn(usize) -> Mover,
}

/// The peaks of a run that began at zero.
fn peaks(samples: &[Sample], bounds: &Bounds, period: f64) -> Peaks {
    let mut peaks = Peaks::default();
    let mut differences = Differences::new([0.0; 9], period);
    for (k, sample) in samples.iter().enumerate() {
        let rates = differences.step(&sample.position).orders;
        for (number, jerk) in rates[2].iter().enumerate() {
            let peak = |order: usize| Peak {
                value: rates[order][number].abs(),
                ratio: rates[order][number].abs() / bounds.limits[order][number],
                mover: (bounds.mover)(number),
                time: k as f64 * period,
                id: sample.id,
            };
            keep_worse(&mut peaks.velocity, peak(0));
            keep_worse(&mut peaks.acceleration, peak(1));
            keep_worse(&mut peaks.jerk, peak(2));
            let in_accelerations = jerk.abs() / bounds.accelerations[number];
            peaks.jerk_in_accelerations = peaks.jerk_in_accelerations.max(in_accelerations);
        }
    }
    peaks
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
        let bounds = Bounds {
            limits: [[100.0; 9], [1000.0; 9], [20_000.0; 9]],
            accelerations: [1000.0; 9],
            mover: Mover::Joint,
        };
        let peaks = peaks(&recording.samples, &bounds, 0.001);
        assert!((peaks.velocity.ratio - 5.0).abs() < 1e-9);
        assert!((peaks.acceleration.ratio - 500.0).abs() < 1e-6);
        assert!((peaks.jerk.ratio - 50_000.0).abs() < 1e-3);
        assert_eq!(peaks.velocity.mover, Mover::Joint(1));
        let mut motion = Motion::default();
        motion.note_range(&recording.samples, 0.001);
        assert_eq!(motion.range, Some((4, 4)));
    }
}
