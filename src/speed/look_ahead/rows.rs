//! The limits of the axes as rows that are linear in b = v^2, a and u.
//!
//! With q(s) the path, each axis keeps
//!
//! ```text
//! |q'| sqrt(b) <= V     |q' a + q'' b| <= A     |q' u + 3 q'' a + q''' b| sqrt(b) <= J
//! ```

use nalgebra::ArrayStorage;

use super::interval::Parabola;
use super::route::{Route, SpeedCap};
use crate::axes::{AXIS_COUNT, Axes, AxisLimits, MachineMap};

const ZERO: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));
const UNLIMITED: Axes = Axes::from_array_storage(ArrayStorage([[f64::INFINITY; AXIS_COUNT]]));

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
}

impl AxisRows {
    /// Rows that limit nothing, before the first plan.
    pub const NONE: Self = Self {
        map: MachineMap::IDENTITY,
        velocity: UNLIMITED,
        inverse_jerk: ZERO,
        jerk_time: ZERO,
    };

    /// `period` of the servo thread, seconds, stands in for what is infinite: an unlimited
    /// acceleration reaches the greatest velocity, an unlimited jerk `JERK_SHARE` of the
    /// acceleration in one period.
    pub fn new(limits: &AxisLimits, map: &MachineMap, period: f64) -> Self {
        let mut inverse_jerk = Axes::zeros();
        let mut jerk_time = Axes::zeros();
        for axis in 0..AXIS_COUNT {
            let acceleration = if limits.acceleration[axis].is_finite() {
                limits.acceleration[axis]
            } else {
                limits.velocity[axis] / period
            };
            let jerk = if limits.jerk[axis].is_finite() {
                limits.jerk[axis]
            } else {
                JERK_SHARE * acceleration / period
            };
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
        }
    }

    /// The rows at `s`.
    pub fn sample<R: Route>(&self, route: &R, s: f64) -> Sample {
        let point = route.point(s);
        let first = self.map.apply(&point.first);
        let SpeedCap {
            programmed,
            greatest,
        } = route.speed_cap(s);
        let mut most = (greatest * greatest).min(GREATEST_SPEED_SQUARED);
        for axis in 0..AXIS_COUNT {
            let slope = first[axis].abs();
            if slope > 0.0 {
                let speed = self.velocity[axis] / slope;
                most = most.min(speed * speed);
            }
        }
        Sample {
            first: first.component_mul(&self.inverse_jerk),
            second: self
                .map
                .apply(&point.second)
                .component_mul(&self.inverse_jerk)
                * 3.0,
            third: self
                .map
                .apply(&point.third)
                .component_mul(&self.inverse_jerk),
            programmed: programmed * programmed,
            greatest: most,
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
    /// and may be described by them.
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
        let places = [0.0, 0.5 * parabola.length, parabola.length];
        places.into_iter().zip(samples).all(|(x, sample)| {
            let (b, a) = parabola.at(x);
            let acceleration = self.acceleration_row(sample, b, a);
            let jerk = sample.jerk_row(b, a, parabola.u);
            b > 0.0
                && b <= sample.cap(raise_squared)
                && acceleration <= margin
                && jerk * jerk * b <= margin * margin
        })
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
    /// v^2 that the program asks for at 100 %.
    programmed: f64,
    /// v^2 that neither override nor axes exceed.
    greatest: f64,
}

impl Sample {
    pub const NONE: Self = Self {
        first: ZERO,
        second: ZERO,
        third: ZERO,
        programmed: 0.0,
        greatest: 0.0,
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

    /// The greatest |q' u + 3 q'' a + q''' b| / J of an axis.
    #[inline]
    pub fn jerk_row(&self, b: f64, a: f64, u: f64) -> f64 {
        let mut most = 0.0;
        for axis in 0..AXIS_COUNT {
            let row = self.first[axis] * u + self.second[axis] * a + self.third[axis] * b;
            most = f64::max(most, row.abs());
        }
        most
    }

    /// The speed at which curvature alone takes an axis to its acceleration or jerk.
    pub fn curve_speed(&self, rows: &AxisRows) -> f64 {
        let by_acceleration = (1.0 / rows.acceleration_row(self, 1.0, 0.0)).sqrt();
        let by_jerk = (1.0 / self.third.amax()).cbrt();
        by_acceleration.min(by_jerk)
    }

    /// The radius of the curve as the rows see it: |q'| / |q''| in s, infinite on a line.
    pub fn radius(&self) -> f64 {
        3.0 * self.first.norm_squared().sqrt() / self.second.norm_squared().sqrt()
    }
}

/// The samples of an interval: its start and its middle. The end is the start of the next one.
#[derive(Clone, Copy, Debug)]
pub(super) struct SamplePair {
    pub start: Sample,
    pub middle: Sample,
}

impl SamplePair {
    pub const NONE: Self = Self {
        start: Sample::NONE,
        middle: Sample::NONE,
    };
}
