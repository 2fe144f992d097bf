//! The path that a machine executed, from its positions in every servo cycle.

use super::derivatives::{STENCIL, weights};
use super::limits::{AXES, COORDINATES, Coordinates, SpeedCap, angle, coordinates, norm, over};
use std::array::from_fn;

/// A position of the machine, and what the program says about the speed there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PathSample {
    pub position: Coordinates,
    pub cap: SpeedCap,
}

/// Positions that are closer to each other tell nothing more about the path than rounding: their
/// distance as the time that it takes at full velocity, s.
const LEAST_DISTANCE: f64 = 1e-5;

/// The same in turns, which nobody takes at full velocity.
const LEAST_IN_TURNS: f64 = 1e-8;

/// A change of direction that makes a turn, radians.
const TURN: f64 = 0.05;

/// Less distance in a cycle is a standstill, as time at full velocity, s.
const STANDSTILL: f64 = 1e-7;

/// [`LEAST_DISTANCE`] as a share of the length of the whole path.
const LEAST_SHARE: f64 = 1.0 / 400.0;

/// A turn between two cycles that makes a place the tip of a near reversal, radians.
const TIP: f64 = 0.2;

/// Around a tip the parameter goes on as fast as the acceleration there would make the machine in
/// this time, s.
const TIP_TIME: f64 = 5e-3;

/// How far that extends in time to both sides, s.
const TIP_REACH: f64 = 30e-3;

/// A change of direction within a standstill that makes a corner, radians.
const CORNER: f64 = 0.5;

/// A path q(s), third derivative bounded.
///
/// The parameter s is the arc length with each axis and joint divided by its greatest velocity: the time in
/// seconds that the path would take at full velocity. Near the tip of a near reversal, where an arc
/// length would make the derivatives infinite, it goes on a little faster than the length does.
#[derive(Clone, Debug)]
pub(crate) struct ExecutedPath {
    parameter: Vec<f64>,
    samples: Vec<PathSample>,
    /// When the machine was there, s from the start.
    time: Vec<f64>,
    /// Greatest velocity of each coordinate.
    velocity: Coordinates,
}

/// dq/ds and the next two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slope {
    pub first: Coordinates,
    pub second: Coordinates,
    pub third: Coordinates,
}

impl PathSample {
    /// `joints` where they have limits of their own.
    pub(crate) fn new(axes: &[f64; AXES], joints: Option<&[f64; AXES]>, cap: SpeedCap) -> Self {
        PathSample {
            position: coordinates(axes, joints.unwrap_or(&[0.0; AXES])),
            cap,
        }
    }

    /// Where the axes are.
    pub(crate) fn axes(&self) -> [f64; AXES] {
        from_fn(|axis| self.position[axis])
    }
}

impl ExecutedPath {
    /// From the positions of successive servo cycles, `period` seconds apart. `None` if the machine
    /// does not move enough for a path.
    pub(crate) fn new(
        samples: &[PathSample],
        period: f64,
        velocity: &Coordinates,
    ) -> Option<ExecutedPath> {
        let floors = tip_floors(samples, period, velocity);
        let length: f64 = samples
            .windows(2)
            .map(|pair| norm(&chord(&pair[0], &pair[1], velocity)))
            .sum();
        let least = LEAST_DISTANCE.min(length * LEAST_SHARE);
        let kept = kept(samples, velocity, &floors, period, least);
        if kept.len() < STENCIL {
            return None;
        }
        let chords: Vec<Coordinates> = kept
            .windows(2)
            .map(|pair| chord(&samples[pair[0]], &samples[pair[1]], velocity))
            .collect();
        let mut parameter = vec![0.0];
        let mut at = 0.0;
        for (k, pair) in kept.windows(2).enumerate() {
            let turn = |other: Option<&Coordinates>| {
                other.map_or(0.0, |other| angle(&chords[k], other).min(0.3))
            };
            let before = turn(k.checked_sub(1).and_then(|k| chords.get(k)));
            let turned = 0.5 * (before + turn(chords.get(k + 1)));
            let arc = norm(&chords[k]) * (1.0 + turned * turned / 24.0);
            let floor: f64 = floors[pair[0]..pair[1]].iter().sum::<f64>() * period;
            at += arc.hypot(floor);
            parameter.push(at);
        }
        Some(ExecutedPath {
            parameter,
            samples: kept.iter().map(|&k| samples[k]).collect(),
            time: kept.iter().map(|&k| k as f64 * period).collect(),
            velocity: *velocity,
        })
    }

    /// Greatest parameter.
    pub(crate) fn end(&self) -> f64 {
        self.parameter.last().copied().unwrap_or(0.0)
    }

    /// Parameters of the positions.
    pub(crate) fn parameters(&self) -> &[f64] {
        &self.parameter
    }

    /// Index of the last position at or before `s`.
    fn index(&self, s: f64) -> usize {
        self.parameter
            .partition_point(|&parameter| parameter <= s)
            .saturating_sub(1)
    }

    /// The derivatives at `s`.
    pub(crate) fn slope(&self, s: f64) -> Slope {
        let k = self.index(s);
        let nearer_next = self
            .parameter
            .get(k + 1)
            .is_some_and(|&next| next - s < s - self.parameter[k]);
        let middle = k + usize::from(nearer_next);
        let from = middle
            .saturating_sub(STENCIL / 2)
            .min(self.parameter.len() - STENCIL);
        let points: [f64; STENCIL] = from_fn(|i| self.parameter[from + i]);
        let weights = weights(s, &points);
        // Differences from the middle: the rounding of large coordinates counts less.
        let origin = self.samples[middle].position;
        let derivative = |order: usize| -> Coordinates {
            from_fn(|axis| {
                let values = self.samples[from..].iter();
                let sum = values.zip(&weights[order]);
                sum.map(|(sample, weight)| weight * (sample.position[axis] - origin[axis]))
                    .sum()
            })
        };
        Slope {
            first: derivative(1),
            second: derivative(2),
            third: derivative(3),
        }
    }

    /// Greatest ds/dt that the program allows at `s`; on a change the lower one.
    pub(crate) fn cap(&self, s: f64, slope: &Slope) -> f64 {
        let k = self.index(s);
        let last = self.samples.len() - 1;
        let of = |k: usize| {
            self.samples[k.min(last)]
                .cap
                .along(&slope.first, &self.velocity)
        };
        of(k).min(of(k + 1))
    }

    /// Where the machine was `time` seconds from the start, with the square of ds/dt and d2s/dt2 there,
    /// from the positions up to then alone.
    pub(crate) fn state(&self, time: f64) -> Option<(f64, f64, f64)> {
        let k = self
            .time
            .partition_point(|&at| at <= time + 1e-9)
            .checked_sub(4)?;
        let (at, s) = (&self.time[k..k + 4], &self.parameter[k..k + 4]);
        let speed = |i: usize| (s[i + 1] - s[i]) / (at[i + 1] - at[i]);
        let middle = |i: usize| 0.5 * (at[i] + at[i + 1]);
        let change = |i: usize| (speed(i + 1) - speed(i)) / (middle(i + 1) - middle(i));
        // The parabola through the mean speeds.
        let bend = (change(1) - change(0)) / (middle(2) - middle(0));
        let left = at[3] - middle(2);
        let acceleration = change(1) + bend * (2.0 * at[3] - middle(2) - middle(1));
        let speed = speed(2) + left * (change(1) + bend * (at[3] - middle(1)));
        (speed > 0.0).then_some((s[3], speed * speed, acceleration))
    }

    /// Where the machine was `time` seconds from the start: on a standstill its place.
    pub(crate) fn parameter_at(&self, time: f64) -> f64 {
        let k = self.time.partition_point(|&at| at <= time + 1e-9);
        self.parameter[k.clamp(1, self.parameter.len()) - 1]
    }

    /// ds/dt of the machine as it was, between the positions around `s`.
    pub(crate) fn speed(&self, s: f64) -> f64 {
        let k = self.index(s).min(self.parameter.len() - 2);
        (self.parameter[k + 1] - self.parameter[k]) / (self.time[k + 1] - self.time[k])
    }
}

/// Indices of the samples that tell something about the path: apart from the one before by `least`,
/// by less in turns and at tips; first and last always.
fn kept(
    samples: &[PathSample],
    velocity: &Coordinates,
    floors: &[f64],
    period: f64,
    least: f64,
) -> Vec<usize> {
    let mut kept: Vec<usize> = vec![0];
    let mut last_chord = [0.0; COORDINATES];
    let end = samples.len().saturating_sub(1);
    for k in 1..samples.len() {
        let last = kept[kept.len() - 1];
        let chord = chord(&samples[last], &samples[k], velocity);
        let far = norm(&chord);
        let turns = far >= LEAST_IN_TURNS && angle(&last_chord, &chord) > TURN;
        let tip = far > 0.0 && floors[k] * period >= least;
        if far >= least || turns || tip {
            kept.push(k);
            last_chord = chord;
        } else if k == end && far > 0.0 {
            // The end in place of the one that is too close to it.
            if kept.len() > 1 {
                kept.pop();
            }
            kept.push(k);
        }
    }
    kept
}

/// Where a path has to be cut since nobody can pass without a standstill: a corner, as far as the
/// positions tell, at which the machine stood. Indices of the samples.
pub(crate) fn corners(samples: &[PathSample], velocity: &Coordinates) -> Vec<usize> {
    let step = |k: usize| norm(&chord(&samples[k], &samples[k + 1], velocity));
    let mut corners = Vec::new();
    let mut k = 1;
    while k + 1 < samples.len() {
        if step(k) >= STANDSTILL || step(k) > step(k - 1) {
            k += 1;
            continue;
        }
        let far = |other: usize| norm(&chord(&samples[k], &samples[other], velocity)) >= STANDSTILL;
        let before = (0..k).rev().find(|&other| far(other));
        let after = (k + 1..samples.len()).find(|&other| far(other));
        let (Some(before), Some(after)) = (before, after) else {
            k += 1;
            continue;
        };
        let into = chord(&samples[before], &samples[k], velocity);
        let out = chord(&samples[k], &samples[after], velocity);
        if angle(&into, &out) > CORNER {
            corners.push(k);
        }
        k = after;
    }
    corners
}

/// How fast the parameter goes on at least, by the time between sample k and the next; 0 away from
/// the tips of near reversals.
fn tip_floors(samples: &[PathSample], period: f64, velocity: &Coordinates) -> Vec<f64> {
    let mut squares = vec![0.0; samples.len()];
    let reach = (TIP_REACH / period).round().max(1.0) as usize;
    for (tip, acceleration) in tips(samples, period, velocity) {
        let floor = acceleration * TIP_TIME;
        let from = tip.saturating_sub(reach);
        for (k, square) in squares.iter_mut().enumerate().take(tip + reach).skip(from) {
            let x = (k as f64 + 0.5 - tip as f64) / reach as f64;
            let bump = (1.0 - x * x).max(0.0).powi(4);
            *square += (floor * bump).powi(2);
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// The tips of near reversals: the index of the slowest sample of each, and the acceleration there.
fn tips(samples: &[PathSample], period: f64, velocity: &Coordinates) -> Vec<(usize, f64)> {
    let mut tips: Vec<(usize, f64)> = Vec::new();
    let mut last_turn = None;
    let mut slowest = f64::INFINITY;
    for k in 1..samples.len().saturating_sub(1) {
        let before = chord(&samples[k - 1], &samples[k], velocity);
        let after = chord(&samples[k], &samples[k + 1], velocity);
        let change: Coordinates = from_fn(|axis| after[axis] - before[axis]);
        let acceleration = norm(&change) / (period * period);
        // A standstill with next to no acceleration is no tip, whatever rounding says of its
        // direction.
        let turns = angle(&before, &after) > TIP;
        if !turns || acceleration * TIP_TIME * period < LEAST_DISTANCE {
            continue;
        }
        let speed = norm(&before) + norm(&after);
        let same = last_turn.is_some_and(|last| k - last <= 2);
        last_turn = Some(k);
        if !same {
            slowest = speed;
            tips.push((k, acceleration));
        } else if let Some(tip) = tips.last_mut().filter(|_| speed < slowest) {
            slowest = speed;
            *tip = (k, acceleration);
        }
    }
    tips
}

fn chord(from: &PathSample, to: &PathSample, velocity: &Coordinates) -> Coordinates {
    let travel = from_fn(|axis| to.position[axis] - from.position[axis]);
    over(&travel, velocity)
}
