//! The limits of the axes as rows that are linear in b = v^2, a and u.
//!
//! With q(s) the path, each axis keeps
//!
//! ```text
//! |q'| sqrt(b) <= V     |q' a + q'' b| <= A     |q' u + 3 q'' a + q''' b| sqrt(b) <= J
//! ```

use nalgebra::ArrayStorage;

use super::interval::Parabola;
use super::quads::{LANES, QUADS, Quads, ZEROS, quads};
use super::route::{Route, SpeedCap};
use crate::axes::{AXIS_COUNT, Axes, AxisLimits, MachineMap};
use crate::cube_root::cube_root;

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

/// Of the second difference of three places, how far what is smooth may exceed them in between.
const SMOOTH_SHARE: f64 = 0.125;

/// Of the jerk, by how much that may be exceeded without setting anything aside.
const JERK_EXCESS: f64 = 0.015;

/// The most that is set aside for what happens between the places that are looked at.
const MOST_EXCESS: f64 = 0.3;

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

    /// The rows at `s`, in the middle of a stretch of the given `length` or at its end: the caps of
    /// three such places hold in between. 0 where a place stands for itself.
    pub fn sample<R: Route>(&self, route: &R, s: f64, length: f64) -> Sample {
        let point = route.point(s);
        let third = self.map.apply(&point.third);
        // Between two places q' may be greater than at both, by what it bends in half of the way.
        let beside = length * length / 16.0;
        let first = self.map.apply(&point.first);
        let SpeedCap {
            programmed,
            greatest,
        } = route.speed_cap(s, &point.first);
        let second = self.map.apply(&point.second);
        let mut most = (greatest * greatest).min(GREATEST_SPEED_SQUARED);
        let mut axes = MovingAxes::NONE;
        for axis in 0..AXIS_COUNT {
            let slope = first[axis].abs() + third[axis].abs() * beside;
            if slope > 0.0 || second[axis] != 0.0 {
                axes.add(axis);
            }
            if slope > 0.0 {
                let speed = self.velocity[axis] / slope;
                most = most.min(speed * speed);
            }
        }
        let first = first.component_mul(&self.inverse_jerk);
        let second = second.component_mul(&self.inverse_jerk) * 3.0;
        let third = third.component_mul(&self.inverse_jerk);
        Sample {
            first,
            second,
            third,
            quads: [&first, &second, &third].map(quads),
            programmed: programmed * programmed * CAP_SHARE,
            greatest: most * CAP_SHARE,
            axes,
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
        samples: [&Sample; 3],
        raise_squared: f64,
        margin: f64,
    ) -> bool {
        if parabola.is_degenerate() {
            return false;
        }
        let half = 0.5 * parabola.length;
        let [(b0, a0), (b1, a1), (b2, a2)] = [0.0, half, parabola.length].map(|x| parabola.at(x));
        let [cap0, cap1, cap2] = samples.map(|sample| sample.cap(raise_squared));
        let capped = b0 > 0.0 && b1 > 0.0 && b2 > 0.0 && b0 <= cap0 && b1 <= cap1 && b2 <= cap2;
        // Half of the way between two places b exceeds their mean by this.
        let bulge = -0.25 * parabola.u * half * half;
        let kept = 0.5 * (b0 + b1) + bulge <= 0.5 * (cap0 + cap1)
            && 0.5 * (b1 + b2) + bulge <= 0.5 * (cap1 + cap2);
        if !(capped && kept) {
            return false;
        }
        let places = [(b0, a0), (b1, a1), (b2, a2)].map(|(b, a)| (b as f32, a as f32));
        let speeds = places.map(|(b, _)| b.sqrt());
        let (u, half, margin) = (parabola.u as f32, half as f32, margin as f32);
        let moving = MovingAxes::at_any(samples);
        // Without a branch, so that all lanes are looked at together: 1 where they keep their limits.
        let mut kept = [1u32; LANES];
        for quad in (0..QUADS).filter(|quad| moving.in_quad(*quad)) {
            let times = &self.jerk_time_quads[quad];
            let first = samples.map(|sample| &sample.quads[0][quad]);
            let second = samples.map(|sample| &sample.quads[1][quad]);
            let third = samples.map(|sample| &sample.quads[2][quad]);
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
                let within = is_within(accelerations, margin, ACCELERATION_BETWEEN)
                    & is_within(jerks, margin, JERK_BETWEEN)
                    & (between <= margin + ACCELERATION_BETWEEN);
                kept[lane] &= u32::from(within);
            }
        }
        kept == [1; LANES]
    }
}

/// The greatest amount in the middle of both halves of what has these values at start, middle and end:
/// of the cubic with its slopes there (Hermite), given as changes over a half.
#[inline(always)]
fn halves([start, middle, end]: [f32; 3], slopes: [f32; 3]) -> f32 {
    let [slope0, slope1, slope2] = slopes.map(|slope| 0.125 * slope);
    let first = 0.5 * (start + middle) + (slope0 - slope1);
    let second = 0.5 * (middle + end) + (slope1 - slope2);
    first.abs().max(second.abs())
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
    /// v^2 that the program asks for at 100 %.
    programmed: f64,
    /// v^2 that neither override nor axes exceed.
    greatest: f64,
    /// Rows of all other axes are 0.
    pub axes: MovingAxes,
}

impl Sample {
    pub const NONE: Self = Self {
        first: ZERO,
        second: ZERO,
        third: ZERO,
        quads: [ZEROS; 3],
        programmed: 0.0,
        greatest: 0.0,
        axes: MovingAxes::NONE,
    };

    /// The cap of v^2 while the program's caps are raised by sqrt(`raise_squared`).
    #[inline]
    pub fn cap(&self, raise_squared: f64) -> f64 {
        (self.programmed * raise_squared).min(self.greatest)
    }

    /// Whether the path gave numbers and a speed to run at.
    pub fn is_sound(&self) -> bool {
        let sum = self.first.sum() + self.second.sum() + self.third.sum();
        sum.is_finite() && self.programmed > 0.0 && self.greatest > 0.0
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
    second: Axes,
    /// q''' / J, shape (9).
    third: Axes,
}

/// The samples of an interval, at start and end as they are inside of it: where two legs meet the
/// third derivative of the path may jump.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalSamples {
    pub start: Sample,
    pub middle: Sample,
    pub end: Sample,
}

impl IntervalSamples {
    pub const NONE: Self = Self {
        start: Sample::NONE,
        middle: Sample::NONE,
        end: Sample::NONE,
    };

    /// By how much a derivative of the path may exceed what the three places show of it, shape (9).
    ///
    /// Between three values a parabola exceeds them by an eighth of their second difference at
    /// most. What has a kink there, where a change of shape begins or ends, leaves the parabola:
    /// the path is looked at in the middle of both halves, `between`.
    fn hidden(&self, between: &Option<[Curving; 2]>) -> Curving {
        let [start, middle, end] = [&self.start, &self.middle, &self.end].map(|sample| Curving {
            second: sample.second,
            third: sample.third,
        });
        let exceeds = |of: fn(&Curving) -> Axes| {
            let [start, middle, end] = [&start, &middle, &end].map(of);
            match between {
                None => (start + end - middle * 2.0).abs() * SMOOTH_SHARE,
                Some([first, last]) => {
                    let parabola =
                        |near: Axes, far: Axes| near * 0.375 + middle * 0.75 - far * 0.125;
                    let first = (of(first) - parabola(start, end)).abs();
                    let last = (of(last) - parabola(end, start)).abs();
                    first.sup(&last)
                }
            }
        };
        Curving {
            second: exceeds(|place| place.second),
            third: exceeds(|place| place.third),
        }
    }

    /// Makes room for what happens between the three places, see [`hidden`](Self::hidden). How
    /// much that is of the limits depends on the speed, which is at most what cap and curvature
    /// allow.
    pub fn cover(&mut self, rows: &AxisRows, raise_squared: f64, between: Option<[Curving; 2]>) {
        let [start, middle, end] = [&self.start, &self.middle, &self.end];
        let mut speed = f64::INFINITY;
        for sample in [start, middle, end] {
            speed = speed
                .min(sample.cap(raise_squared).sqrt())
                .min(sample.curve_speed(rows));
        }
        if !speed.is_finite() {
            return;
        }
        let Curving { second, third } = self.hidden(&between);
        let mut excess = 0.0;
        for axis in 0..AXIS_COUNT {
            let acceleration = second[axis] * rows.jerk_time[axis] / 3.0 * speed * speed;
            let jerk = third[axis] * speed * speed * speed;
            excess = f64::max(excess, acceleration.max(jerk - JERK_EXCESS));
        }
        let factor = 1.0 + f64::min(excess, MOST_EXCESS);
        for sample in [&mut self.start, &mut self.middle, &mut self.end] {
            sample.first *= factor;
            sample.second *= factor;
            sample.third *= factor;
            sample.quads = [&sample.first, &sample.second, &sample.third].map(quads);
        }
    }
}
