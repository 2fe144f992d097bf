//! The limits of the axes as rows that are linear in b = v^2, a and u.
//!
//! With q(s) the path, each axis keeps
//!
//! ```text
//! |q'| sqrt(b) <= V     |q' a + q'' b| <= A     |q' u + 3 q'' a + q''' b| sqrt(b) <= J
//! ```
//!
//! Where joints have limits of their own, q is the path of the joints, and the axes keep their velocities besides.

use nalgebra::ArrayStorage;

use super::place::Place;
use super::route::{Route, SpeedCap};
use super::sample::{Cap, Curving, MovingAxes, Sample};
use crate::axes::{AXIS_COUNT, Axes, AxisLimits};
use crate::cube_root::cube_root;
use crate::lanes::{Lanes, ZEROS, greater, lesser, rounded};
use crate::machine_map::MachineMap;
use crate::moves::shape::PathPoint;

const ZERO: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));
const UNLIMITED: Axes = Axes::from_array_storage(ArrayStorage([[f64::INFINITY; AXIS_COUNT]]));

/// The share of a cap of v^2 that is used: between the places that are looked at a little more may
/// be taken.
const CAP_SHARE: f64 = 0.999;
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

/// What the axes of the machine, or its joints, are able to do, prepared for [`Sample`].
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisRows {
    map: MachineMap,
    velocity: Axes,
    /// The velocities of the axes, where those above are of joints.
    axis_velocity: Option<Axes>,
    /// 1 / J; 0 where nothing limits the axis.
    inverse_jerk: Axes,
    /// J / A; 0 where the acceleration is unlimited.
    jerk_time: Axes,
    /// A third of that: what [`Sample::second`] is to be multiplied by for shares of A.
    third_of_jerk_time: Axes,
    /// J / A in single precision.
    pub jerk_time_lanes: Lanes,
}

impl AxisRows {
    /// Rows that limit nothing, before the first plan.
    pub const NONE: Self = Self {
        map: MachineMap::IDENTITY,
        velocity: UNLIMITED,
        axis_velocity: None,
        inverse_jerk: ZERO,
        jerk_time: ZERO,
        third_of_jerk_time: ZERO,
        jerk_time_lanes: ZEROS,
    };

    /// `period` of the servo thread, seconds, stands in for what is infinite: an unlimited
    /// acceleration reaches the greatest velocity, and no jerk takes more than `JERK_SHARE` of the
    /// acceleration in one period. With more of it the arcs at rest would shrink to nothing, and
    /// positions once a period would not show it.
    pub fn new(axes: &AxisLimits, map: &MachineMap, period: f64) -> Self {
        let limits = map.limits(axes);
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
            axis_velocity: map.joints().map(|_| axes.velocity),
            inverse_jerk,
            jerk_time,
            third_of_jerk_time: jerk_time / 3.0,
            jerk_time_lanes: rounded(&jerk_time),
        }
    }

    /// The place of the path that has this `point`.
    #[inline]
    pub fn place(&self, point: &PathPoint) -> Place {
        Place::of(point, &self.map)
    }

    /// The place where the path has this `point`, between two others.
    pub fn place_between(&self, point: &PathPoint, ends: [&Place; 2], length: f64) -> Place {
        if self.bends() {
            Place::between(point, ends, length)
        } else {
            self.place(point)
        }
    }

    /// Whether what the limits hold for bends where the path does not.
    pub fn bends(&self) -> bool {
        self.axis_velocity.is_some()
    }

    /// How long it takes to find what the limits hold for at a place, nanoseconds.
    pub fn nanoseconds(&self) -> f64 {
        self.map.nanoseconds()
    }

    /// The rows at `s`, in an interval of the given `length`: together with those a quarter of it
    /// away its caps hold in between too. 0 where a place stands for itself.
    pub fn sample<R: Route>(&self, route: &R, s: f64, length: f64) -> Sample {
        self.sample_of(route, s, &self.place(&route.point(s)), length)
    }

    /// The same where the path is known to have this `place`.
    pub fn sample_of<R: Route>(&self, route: &R, s: f64, place: &Place, length: f64) -> Sample {
        let cap = self.cap(route, s, place, 0.25 * length);
        let [first, second, third] = &place.behind;
        let axes = MovingAxes::of(first, second);
        let first = first.component_mul(&self.inverse_jerk);
        let second = second.component_mul(&self.inverse_jerk) * 3.0;
        let third = third.component_mul(&self.inverse_jerk);
        Sample {
            first,
            second,
            third,
            lanes: [&first, &second, &third].map(rounded),
            cap,
            axes,
        }
    }

    /// The cap at `s`, where the path has this `place`: a v^2 that changes evenly to the cap that is
    /// `beside` away exceeds no velocity in between.
    pub fn cap<R: Route>(&self, route: &R, s: f64, place: &Place, beside: f64) -> Cap {
        let point = &place.point;
        let along = point.first * raised_norm(point, beside);
        let SpeedCap {
            programmed,
            greatest,
        } = route.speed_cap(s, &along);
        let most = (greatest * greatest).min(GREATEST_SPEED_SQUARED);
        let mut most = most.min(greatest_square(&place.behind, &self.velocity, beside));
        if let Some(velocity) = &self.axis_velocity {
            let axes = [&point.first, &point.second, &point.third].map(|of| self.map.apply(of));
            most = most.min(greatest_square(&axes, velocity, beside));
        }
        Cap {
            programmed: programmed * programmed * CAP_SHARE,
            greatest: most * CAP_SHARE,
        }
    }

    /// The speed at which curvature alone takes an axis to its acceleration or jerk.
    pub fn curve_speed(&self, sample: &Sample) -> f64 {
        let by_acceleration = (1.0 / self.acceleration_row(sample, 1.0, 0.0)).sqrt();
        let by_jerk = cube_root(1.0 / sample.third.amax());
        by_acceleration.min(by_jerk)
    }

    /// How the path curves at `s`.
    pub fn curving<R: Route>(&self, route: &R, s: f64) -> Curving {
        let [second, third] = if self.bends() {
            let [_, second, third] = self.place(&route.point(s)).behind;
            [second, third]
        } else {
            let [second, third] = route.bend(s);
            [self.map.apply(&second), self.map.apply(&third)]
        };
        Curving {
            second: second.component_mul(&self.inverse_jerk) * 3.0,
            third: third.component_mul(&self.inverse_jerk),
        }
    }

    /// J / A by axis, shape (9).
    pub fn jerk_time(&self) -> &Axes {
        &self.jerk_time
    }

    /// A third of that, shape (9).
    pub fn third_of_jerk_time(&self) -> &Axes {
        &self.third_of_jerk_time
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
            most = greater(most, (row * self.jerk_time[axis]).abs());
        }
        most
    }
}

/// The v^2 with which none of these derivatives exceeds its velocity, see [`AxisRows::cap`].
#[inline]
fn greatest_square([first, second, third]: &[Axes; 3], velocity: &Axes, beside: f64) -> f64 {
    // For all axes at once: one that stands still has a quotient without end.
    let squares: [f64; AXIS_COUNT] = core::array::from_fn(|axis| {
        // By what q' may exceed both places in between, and 1 / q'^2 the chord between them.
        let slope = first[axis].abs() + third[axis].abs() * (0.125 * beside * beside);
        let change = second[axis] * beside;
        velocity[axis] * velocity[axis] / (slope * slope + CHORD * change * change)
    });
    squares.into_iter().fold(f64::INFINITY, lesser)
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
