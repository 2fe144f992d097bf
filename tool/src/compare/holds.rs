//! How the machine comes to rest when it is held: by a pause or by a feed override of 0.

use super::against_optimum::Holds;
use super::shortest_stop::State;
use crate::host::job::Job;
use crate::host::recording::{HELD, Recording, Sample, WAITING, moves, step};
use crate::machine::limits::{Limits, infinite_for_none};
use crate::optimum::{ExecutedPath, PathLimits, PathSample, SpeedCap, shortest_stop};

/// Measures all holds of a run: along the joints, where these have limits of their own.
pub(crate) fn holds_of(recording: &Recording, job: &Job) -> Holds {
    let takes_jerk = recording.takes_jerk;
    let (period, in_thread) = (job.period, job.in_thread());
    let (Some(joints), Some(bounds)) = (&job.joints, job.joint_bounds(takes_jerk)) else {
        let jerk = job.jerk_limits(takes_jerk);
        return holds(recording, &job.limits, &jerk, period, &in_thread);
    };
    let [velocity, acceleration, jerk] = bounds;
    let limits = Limits {
        velocity,
        acceleration,
    };
    let jerk = jerk.map(|jerk| if jerk.is_finite() { jerk } else { 0.0 });
    holds(
        &recording.of_joints(joints),
        &limits,
        &jerk,
        period,
        &in_thread,
    )
}

/// Measures all holds; `jerk` are the limits of the axes, 0 = none. `in_thread`: whether each move, by its
/// number, follows the angle of a spindle.
fn holds(
    recording: &Recording,
    limits: &Limits,
    jerk: &[f64; 9],
    period: f64,
    in_thread: &[bool],
) -> Holds {
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
        // Begun while the program waited, with nothing queued: a planner forgets such a hold, and the
        // task controller of LinuxCNC hands over nothing before the operator goes on.
        let waited = samples[start - 1].flags & HELD != 0;
        let state = State::after(samples, start - 1, limits, jerk, period);
        let mut rest = None;
        while held(k) {
            let travel = step(samples, k);
            if !moves(&travel) {
                rest.get_or_insert(k);
            } else if rest.is_some() && !waited {
                let far = travel
                    .iter()
                    .fold(0.0, |far, part| f64::max(far, part.abs()));
                holds.drift = holds.drift.max(far);
            }
            k += 1;
        }
        let Some(state) = state.filter(|_| moves(&step(samples, start - 1))) else {
            continue;
        };
        let number = usize::try_from(samples[start].id).ok();
        let index = number.and_then(|number| number.checked_sub(1));
        if index.is_some_and(|index| in_thread.get(index) == Some(&true)) {
            holds.in_threads += 1;
            continue;
        }
        let Some(rest) = rest else {
            holds.not_at_rest += 1;
            continue;
        };
        let time = (rest - start) as f64 * period;
        let stop = Stop {
            samples,
            limits,
            jerk,
            period,
            start,
            rest,
        };
        let ideal = stop.ideal(&state);
        holds.count += 1;
        holds.longest = holds.longest.max(time);
        holds.latest = holds.latest.max(time - ideal);
        holds.worst_ratio = holds.worst_ratio.max(time / ideal);
        sum += time / ideal;
    }
    if holds.count > 0 {
        holds.mean_ratio = sum / holds.count as f64;
    }
    holds
}

/// A hold: from the position before cycle `start` to the first cycle without motion.
struct Stop<'a> {
    samples: &'a [Sample],
    limits: &'a Limits,
    jerk: &'a [f64; 9],
    period: f64,
    start: usize,
    rest: usize,
}

/// So many cycles before the hold belong to the path of the stop, and as many after the machine went
/// on.
const AROUND: usize = 40;

/// A stop of less is none, s at full velocity.
const STANDSTILL: f64 = 1e-7;

/// Where a path bends, the axes may brake more than in the direction it starts in: less than twice as
/// much.
const BENDS: f64 = 0.5;

impl Stop<'_> {
    /// Least time to rest, s, in whole cycles: positions are seen at the end of each.
    ///
    /// What each axis needs by itself first: on a straight line that is all. Only if the machine takes
    /// longer than that, what the path itself allows is worth its effort.
    fn ideal(&self, state: &State) -> f64 {
        let cycles = |time: f64| (time / self.period - 1e-6).ceil().max(1.0) * self.period;
        let axes = cycles(state.least_time);
        let time = (self.rest - self.start) as f64 * self.period;
        if time < axes + 1.5 * self.period {
            return axes;
        }
        let along_path = self.along_path(state).map_or(axes, cycles);
        // What the machine has done is possible.
        along_path.clamp(axes, time.max(axes))
    }

    /// Least time to rest on the path as it was run on after the hold.
    fn along_path(&self, state: &State) -> Option<f64> {
        let from = self.start.saturating_sub(AROUND);
        let goes_on = (self.rest..self.samples.len()).find(|&k| moves(&step(self.samples, k)))?;
        let to = (goes_on + AROUND).min(self.samples.len());
        let path: Vec<PathSample> = self.samples[from..to]
            .iter()
            .map(|sample| PathSample::new(&sample.position, None, SpeedCap::None))
            .collect();
        let Limits {
            velocity,
            acceleration,
        } = *self.limits;
        let jerk = self.jerk.map(infinite_for_none);
        let limits = PathLimits::new([velocity, acceleration, jerk], None);
        let path = ExecutedPath::new(&path, self.period, &limits.velocity)?;
        // Sample k is the position after cycle k.
        let at = |k: usize| (k - from) as f64 * self.period;
        let (start, squared, acceleration) = path.state(at(self.start.checked_sub(1)?))?;
        let stopped = path.parameter_at(at(self.rest)) - start;
        if stopped <= STANDSTILL {
            return None;
        }
        let least = BENDS * state.least_distance() * squared.sqrt() / state.speed;
        shortest_stop(
            &path,
            &limits,
            (start, squared, acceleration),
            least,
            stopped,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::host::recording::Sample;

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
                &[],
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
    fn a_thread_is_followed_to_its_end() {
        let mut run = held_run(500.0);
        for sample in &mut run.samples {
            sample.id = 2;
        }
        let count = |in_thread: &[bool]| {
            let holds = holds(&run, &Limits::default(), &[0.0; 9], 0.001, in_thread);
            (holds.count, holds.in_threads)
        };
        assert_eq!(count(&[false, true]), (0, 1));
        assert_eq!(count(&[true, false]), (1, 0));
    }

    #[test]
    fn a_hold_that_is_left_drifts_but_not_one_of_a_waiting_program() {
        let drift = |before: u8| {
            let mut recording = Recording::default();
            for k in 0..100 {
                let mut sample = Sample {
                    flags: if k < 50 { before } else { HELD },
                    ..Sample::default()
                };
                // It moves from cycle 60 on.
                sample.position[0] = 0.01 * f64::from((k - 59).max(0));
                recording.samples.push(sample);
            }
            holds(&recording, &Limits::default(), &[0.0; 9], 0.001, &[]).drift
        };
        assert!((drift(0) - 0.01).abs() < 1e-9);
        assert_eq!(drift(HELD | WAITING), 0.0);
    }
}
