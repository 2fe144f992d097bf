//! The limits of the axes as rows that are linear in b = v^2, a and u.
//!
//! With q(s) the path, each axis keeps
//!
//! ```text
//! |q'| sqrt(b) <= V     |q' a + q'' b| <= A     |q' u + 3 q'' a + q''' b| sqrt(b) <= J
//! ```

use nalgebra::ArrayStorage;

use super::interval::Parabola;
use super::interval_samples::IntervalSamples;
use super::quads::{LANES, QUADS, Quad, Quads, ZEROS, quads};
use super::route::{Route, SpeedCap};
use crate::axes::{AXIS_COUNT, Axes, AxisLimits, MachineMap};
use crate::cube_root::cube_root;
use crate::path::PathPoint;

const ZERO: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));
const UNLIMITED: Axes = Axes::from_array_storage(ArrayStorage([[f64::INFINITY; AXIS_COUNT]]));

/// The share of a cap of v^2 that is used: between the places that are looked at a little more may
/// be taken.
const CAP_SHARE: f64 = 0.999;
/// Between these places the acceleration may exceed what is allowed there by this share of its
/// limit ..
const ACCELERATION_BETWEEN: f32 = 1e-3;
/// .. and the jerk by this one: what is seen of it once a servo period is a mean.
const JERK_BETWEEN: f32 = 0.03;

/// Where the jerk bends by more than this share of its limit between three places, it is looked at there.
const JERK_BEND: f32 = 0.3;

/// By how much a chord of 1 / x^2 exceeds it in the middle, over the square of the change of x:
/// an eighth of its second derivative.
const CHORD: f64 = 0.75;

/// A product is quicker than a quotient.
pub(super) const THIRD: f32 = 1.0 / 3.0;

/// The greatest v^2 that is ever planned. Nothing real comes near it; it keeps sums finite where
/// neither the program nor an axis limits the speed.
const GREATEST_SPEED_SQUARED: f64 = 1e16;

/// Of the acceleration, what the jerk takes away in one servo period where the jerk is unlimited:
/// the planner limits it all the same, since a trajectory is sampled once a period.
const JERK_SHARE: f64 = 0.3;

/// What the axes of the machine are able to do, prepared for [`Sample`].
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisRows {
    map: MachineMap,
    velocity: Axes,
    /// 1 / J; 0 where nothing limits the axis.
    inverse_jerk: Axes,
    /// J / A; 0 where the acceleration is unlimited.
    jerk_time: Axes,
    /// The same in single precision.
    pub jerk_time_quads: Quads,
}

impl AxisRows {
    /// Rows that limit nothing, before the first plan.
    pub const NONE: Self = Self {
        map: MachineMap::IDENTITY,
        velocity: UNLIMITED,
        inverse_jerk: ZERO,
        jerk_time: ZERO,
        jerk_time_quads: ZEROS,
    };

    /// `period` of the servo thread, seconds, stands in for what is infinite: an unlimited
    /// acceleration reaches the greatest velocity, and no jerk takes more than `JERK_SHARE` of the
    /// acceleration in one period. With more of it the arcs at rest would shrink to nothing, and
    /// positions once a period would not show it.
    pub fn new(limits: &AxisLimits, map: &MachineMap, period: f64) -> Self {
        let mut inverse_jerk = Axes::zeros();
        let mut jerk_time = Axes::zeros();
        for axis in 0..AXIS_COUNT {
            let acceleration = if limits.acceleration[axis].is_finite() {
                limits.acceleration[axis]
            } else {
                limits.velocity[axis] / period
            };
            let jerk = limits.jerk[axis].min(JERK_SHARE * acceleration / period);
            if jerk.is_finite() {
                inverse_jerk[axis] = 1.0 / jerk;
                if acceleration.is_finite() {
                    jerk_time[axis] = jerk / acceleration;
                }
            }
        }
        Self {
            map: *map,
            velocity: limits.velocity,
            inverse_jerk,
            jerk_time,
            jerk_time_quads: quads(&jerk_time),
        }
    }

    /// The rows at `s`, in an interval of the given `length`: together with those a quarter of it
    /// away its caps hold in between too. 0 where a place stands for itself.
    pub fn sample<R: Route>(&self, route: &R, s: f64, length: f64) -> Sample {
        self.sample_of(route, s, &route.point(s), length)
    }

    /// The same where the path is known to have this `point`.
    pub fn sample_of<R: Route>(&self, route: &R, s: f64, point: &PathPoint, length: f64) -> Sample {
        let cap = self.cap(route, s, point, 0.25 * length);
        let first = self.map.apply(&point.first);
        let second = self.map.apply(&point.second);
        let mut axes = MovingAxes::NONE;
        for axis in 0..AXIS_COUNT {
            if first[axis] != 0.0 || second[axis] != 0.0 {
                axes.add(axis);
            }
        }
        let third = self.map.apply(&point.third);
        let first = first.component_mul(&self.inverse_jerk);
        let second = second.component_mul(&self.inverse_jerk) * 3.0;
        let third = third.component_mul(&self.inverse_jerk);
        Sample {
            first,
            second,
            third,
            quads: [&first, &second, &third].map(quads),
            cap,
            axes,
        }
    }

    /// The cap at `s`, where the path has this `point`: a v^2 that changes evenly to the cap that is
    /// `beside` away exceeds no velocity in between.
    pub fn cap<R: Route>(&self, route: &R, s: f64, point: &PathPoint, beside: f64) -> Cap {
        let along = point.first * raised_norm(point, beside);
        let SpeedCap {
            programmed,
            greatest,
        } = route.speed_cap(s, &along);
        let [first, second, third] =
            [&point.first, &point.second, &point.third].map(|of| self.map.apply(of));
        let mut most = (greatest * greatest).min(GREATEST_SPEED_SQUARED);
        for axis in 0..AXIS_COUNT {
            // By what q' may exceed both places in between, and 1 / q'^2 the chord between them.
            let slope = first[axis].abs() + third[axis].abs() * (0.125 * beside * beside);
            let change = second[axis] * beside;
            let square = slope * slope + CHORD * change * change;
            if square > 0.0 {
                most = most.min(self.velocity[axis] * self.velocity[axis] / square);
            }
        }
        Cap {
            programmed: programmed * programmed * CAP_SHARE,
            greatest: most * CAP_SHARE,
        }
    }

    /// How the path curves at `s`.
    pub fn curving<R: Route>(&self, route: &R, s: f64) -> Curving {
        let point = route.point(s);
        let row = |derivative: &Axes| self.map.apply(derivative).component_mul(&self.inverse_jerk);
        Curving {
            second: row(&point.second) * 3.0,
            third: row(&point.third),
        }
    }

    /// J / A by axis, shape (9).
    pub fn jerk_time(&self) -> &Axes {
        &self.jerk_time
    }

    /// The greatest acceleration along the path from rest, infinite if nothing limits it.
    pub fn acceleration_from_rest(&self, sample: &Sample) -> f64 {
        1.0 / self.acceleration_row(sample, 0.0, 1.0)
    }

    /// The greatest share of A that an axis takes.
    #[inline]
    pub fn acceleration_row(&self, sample: &Sample, b: f64, a: f64) -> f64 {
        let mut most = 0.0;
        for axis in 0..AXIS_COUNT {
            let row = sample.first[axis] * a + sample.second[axis] * (b / 3.0);
            most = f64::max(most, (row * self.jerk_time[axis]).abs());
        }
        most
    }

    /// Whether an interval keeps the share `margin` of all limits at its start, middle and end,
    /// hardly exceeds them in between, and may be described by these places.
    #[inline]
    pub fn keeps(
        &self,
        parabola: &Parabola,
        interval: &IntervalSamples,
        raise_squared: f64,
        margin: f64,
    ) -> bool {
        if parabola.is_degenerate() {
            return false;
        }
        let half = 0.5 * parabola.length;
        let [(b0, a0), (b1, a1), (b2, a2)] = [0.0, half, parabola.length].map(|x| parabola.at(x));
        let samples = interval.places();
        let [cap0, cap1, cap2] = samples.map(|sample| sample.cap.raised(raise_squared));
        let quarters = interval.quarters.map(|cap| cap.raised(raise_squared));
        let capped = b0 > 0.0 && b1 > 0.0 && b2 > 0.0 && b0 <= cap0 && b1 <= cap1 && b2 <= cap2;
        if !(capped
            && keeps_caps_between(
                [b0, b1, b2],
                parabola.u * half * half,
                [cap0, cap1, cap2],
                quarters,
            ))
        {
            return false;
        }
        let places = [(b0, a0), (b1, a1), (b2, a2)].map(|(b, a)| (b as f32, a as f32));
        let speeds = places.map(|(b, _)| b.sqrt());
        let (u, half, margin) = (parabola.u as f32, half as f32, margin as f32);
        let fastest = b0.max(b1).max(b2) as f32;
        let for_acceleration = margin - interval.departure.second * fastest;
        let for_jerk = margin - interval.departure.third * fastest * fastest.sqrt();
        let moving = MovingAxes::at_any(samples);
        // Without a branch, so that all lanes are looked at together: 1 where they keep their limits.
        let mut kept = [1u32; LANES];
        for quad in (0..QUADS).filter(|quad| moving.in_quad(*quad)) {
            let times = &self.jerk_time_quads[quad];
            let first = samples.map(|sample| &sample.quads[0][quad]);
            let second = samples.map(|sample| &sample.quads[1][quad]);
            let third = samples.map(|sample| &sample.quads[2][quad]);
            let mut bent = [0u32; LANES];
            for lane in 0..LANES {
                let time = times[lane];
                let [mut accelerations, mut changes, mut jerks] = [[0.0; 3]; 3];
                for place in 0..3 {
                    let by_u = first[place][lane];
                    let by_a = second[place][lane];
                    let by_b = third[place][lane];
                    let (b, a) = places[place];
                    accelerations[place] = (by_u * a + by_a * (THIRD * b)) * time;
                    // The jerk over the velocity: by how much the acceleration changes with s.
                    changes[place] = by_u * u + by_a * a + by_b * b;
                    jerks[place] = changes[place] * speeds[place];
                }
                let between = halves(accelerations, changes.map(|change| change * time * half));
                let within = is_within(accelerations, for_acceleration, ACCELERATION_BETWEEN)
                    & is_within(jerks, for_jerk, JERK_BETWEEN)
                    & (between <= for_acceleration + ACCELERATION_BETWEEN);
                kept[lane] &= u32::from(within);
                bent[lane] |= u32::from(is_bent(jerks));
            }
            let rows = [first, second, third];
            if bent != [0; LANES] && !keeps_jerk_between(parabola, rows, for_jerk + JERK_BETWEEN) {
                return false;
            }
        }
        kept == [1; LANES]
    }
}

/// Whether v^2 keeps its caps between start, middle and end: in the middle of both halves, where they are known, and
/// half of the way to there, where they are no less than the mean of those beside. `bend`: u times the square
/// of half the length.
fn keeps_caps_between(
    [start, middle, end]: [f64; 3],
    bend: f64,
    [cap_start, cap_middle, cap_end]: [f64; 3],
    quarters: [f64; 2],
) -> bool {
    // Half of the way between two places v^2 exceeds their mean by this.
    let bulge = -0.25 * bend;
    let [first, last] = [start + middle, middle + end].map(|sum| 0.5 * sum + bulge);
    let kept = first <= quarters[0] && last <= quarters[1];
    let twice_bulge = 0.5 * bulge;
    let between =
        |at: f64, next: f64, cap: f64, next_cap: f64| at + next + twice_bulge <= cap + next_cap;
    kept && between(start, first, cap_start, quarters[0])
        && between(first, middle, quarters[0], cap_middle)
        && between(middle, last, cap_middle, quarters[1])
        && between(last, end, quarters[1], cap_end)
}

/// Whether a parabola through these values at start, middle and end bends back between them so much that
/// it does not describe the jerk, which is no parabola.
#[inline(always)]
fn is_bent([start, middle, end]: [f32; 3]) -> bool {
    let slope = 0.5 * (end - start);
    let bend = start + end - 2.0 * middle;
    (bend.abs() > JERK_BEND) & (slope.abs() < bend.abs())
}

/// Whether four axes keep this share of the jerk in the middle of both halves: their rows by u, a and b, at start,
/// middle and end, are parabolas.
#[inline(never)]
fn keeps_jerk_between(parabola: &Parabola, rows: [[&Quad; 3]; 3], most: f32) -> bool {
    let mut kept = true;
    for (share, weights) in [(0.25, [0.375, 0.75, -0.125]), (0.75, [-0.125, 0.75, 0.375])] {
        let (b, a) = parabola.at(share * parabola.length);
        let factors = [parabola.u, a, b].map(|factor| (factor * b.sqrt()) as f32);
        for lane in 0..LANES {
            let mut jerk = 0.0;
            for (row, factor) in rows.iter().zip(factors) {
                for (place, weight) in row.iter().zip(weights) {
                    jerk += place[lane] * (weight * factor);
                }
            }
            kept &= jerk.abs() <= most;
        }
    }
    kept
}

/// The greatest amount at three places in each half of what has these values at start, middle and end:
/// of the cubic with its slopes there (Hermite), given as changes over a half.
#[inline(always)]
fn halves([start, middle, end]: [f32; 3], [slope0, slope1, slope2]: [f32; 3]) -> f32 {
    let first = half([start, middle], [slope0, slope1]);
    let second = half([middle, end], [slope1, slope2]);
    first.max(second)
}

/// The same of one half.
#[inline(always)]
fn half([start, end]: [f32; 2], [slope0, slope1]: [f32; 2]) -> f32 {
    let quarter = 0.84375 * start + 0.15625 * end + (0.140625 * slope0 - 0.046875 * slope1);
    let middle = 0.5 * (start + end) + 0.125 * (slope0 - slope1);
    let last = 0.15625 * start + 0.84375 * end + (0.046875 * slope0 - 0.140625 * slope1);
    quarter.abs().max(middle.abs()).max(last.abs())
}

/// Whether the amounts of three values at start, middle and end are at most `most`, and those of the
/// parabola through them exceed it by `between` at most. Not if one is no number.
#[inline(always)]
fn is_within([start, middle, end]: [f32; 3], most: f32, between: f32) -> bool {
    let at_places = (start.abs() <= most) & (middle.abs() <= most) & (end.abs() <= most);
    let slope = 0.5 * (end - start);
    let bend = start + end - 2.0 * middle;
    let extremum = (middle - 0.5 * slope * slope / bend).abs();
    let outside = slope.abs() >= bend.abs();
    at_places & (outside | (extremum <= most + between))
}

/// The axes that move at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MovingAxes(u16);

impl MovingAxes {
    pub const NONE: Self = Self(0);

    pub fn add(&mut self, axis: usize) {
        self.0 |= 1 << (axis & 15);
    }

    /// Those that move at any of these places.
    #[inline]
    pub fn at_any(samples: [&Sample; 3]) -> Self {
        let [start, middle, end] = samples;
        Self(start.axes.0 | middle.axes.0 | end.axes.0)
    }

    #[inline]
    pub fn contains(self, axis: usize) -> bool {
        self.0 >> (axis & 15) & 1 == 1
    }

    /// Whether one of the four axes of a quad is among them.
    #[inline]
    pub fn in_quad(self, quad: usize) -> bool {
        self.0 >> (LANES * quad) & 15 != 0
    }

    /// How many there are.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}

/// The caps of v^2 at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    /// What the program asks for at 100 %.
    programmed: f64,
    /// What neither override nor axes exceed.
    greatest: f64,
}

impl Cap {
    pub const NONE: Self = Self {
        programmed: 0.0,
        greatest: 0.0,
    };

    /// What two caps both allow.
    pub fn least(&self, other: &Self) -> Self {
        Self {
            programmed: self.programmed.min(other.programmed),
            greatest: self.greatest.min(other.greatest),
        }
    }

    /// The cap while those of the program are raised by sqrt(`raise_squared`).
    #[inline]
    pub fn raised(&self, raise_squared: f64) -> f64 {
        (self.programmed * raise_squared).min(self.greatest)
    }
}

/// What |q'| is to be multiplied by for the cap of the speed along the path, see [`AxisRows::cap`].
fn raised_norm(point: &PathPoint, beside: f64) -> f64 {
    let square = point.first.norm_squared();
    if square <= 0.0 {
        return 1.0;
    }
    let slope = point.first.dot(&point.second) / square;
    let bend =
        (point.second.norm_squared() + point.first.dot(&point.third)) / square - slope * slope;
    let change = slope * beside;
    (1.0 + CHORD * change * change).sqrt() + (-bend).max(0.0) * (0.125 * beside * beside)
}

/// The rows of all axes at a place of the path, in units of J.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// q' / J, shape (9).
    pub first: Axes,
    /// 3 q'' / J, shape (9).
    pub second: Axes,
    /// q''' / J, shape (9).
    pub third: Axes,
    /// The three in single precision.
    pub quads: [Quads; 3],
    pub cap: Cap,
    /// Rows of all other axes are 0.
    pub axes: MovingAxes,
}

impl Sample {
    pub const NONE: Self = Self {
        first: ZERO,
        second: ZERO,
        third: ZERO,
        quads: [ZEROS; 3],
        cap: Cap::NONE,
        axes: MovingAxes::NONE,
    };

    /// Whether the path gave numbers and a speed to run at.
    pub fn is_sound(&self) -> bool {
        let sum = self.first.sum() + self.second.sum() + self.third.sum();
        sum.is_finite() && self.cap.programmed > 0.0 && self.cap.greatest > 0.0
    }

    /// The speed at which curvature alone takes an axis to its acceleration or jerk.
    pub fn curve_speed(&self, rows: &AxisRows) -> f64 {
        let by_acceleration = (1.0 / rows.acceleration_row(self, 1.0, 0.0)).sqrt();
        let by_jerk = cube_root(1.0 / self.third.amax());
        by_acceleration.min(by_jerk)
    }

    /// The radius of the curve as the rows see it: |q'| / |q''| in s, infinite on a line.
    pub fn radius(&self) -> f64 {
        3.0 * self.first.norm_squared().sqrt() / self.second.norm_squared().sqrt()
    }
}

/// What a [`Sample`] says of curvature alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curving {
    /// 3 q'' / J, shape (9).
    pub second: Axes,
    /// q''' / J, shape (9).
    pub third: Axes,
}
