//! What an interval allows while nothing is known but its speed: the scalars of the sweep.
//!
//! The jerk of an axis has three terms, `q' j`, `3 q'' v a` and `q''' v^3`. Each is given a share
//! of J in advance, so that speed, acceleration and jerk along the path are limited one by one.

use super::interval_samples::IntervalSamples;
use super::rows::AxisRows;
use super::sample::MovingAxes;
use crate::axes::AXIS_COUNT;
use crate::cube_root::cube_root;
use crate::lanes::{greater, lesser};

/// Share of the speed cap, so that the barrier of the cap has room.
const CAP_SHARE: f64 = 0.98;

/// What is handed out in advance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shares {
    /// Of the limits: in all.
    pub margin: f64,
    /// Of the acceleration: for curvature.
    pub curve: f64,
    /// Of the jerk: for the change of curvature.
    pub twist: f64,
    /// Of the jerk: for accelerating in a curve.
    pub across: f64,
}

/// The greatest amounts of an axis' rows in an interval.
#[derive(Clone, Copy)]
struct AxisBounds {
    first: f64,
    second: f64,
    third: f64,
    /// J / A.
    time: f64,
}

impl AxisBounds {
    const NONE: Self = Self {
        first: 0.0,
        second: 0.0,
        third: 0.0,
        time: 0.0,
    };
}

/// The rows of all axes that move in an interval.
struct MovingBounds {
    axes: [AxisBounds; AXIS_COUNT],
    /// Of `axes`.
    count: usize,
    /// What curvature takes of the acceleration per b, and of the jerk per b^1.5, at most.
    curve: f64,
    twist: f64,
    /// The greatest row of curvature.
    steepest: f64,
    /// What the path between the places takes besides, of both.
    departure: [f64; 2],
}

impl MovingBounds {
    #[inline]
    fn of(rows: &AxisRows, interval: &IntervalSamples) -> Self {
        let samples = interval.places();
        let departure = [interval.departure.second, interval.departure.third].map(f64::from);
        let moving = MovingAxes::at_any(samples);
        let times = rows.jerk_time();
        let [start, middle, end] = samples;
        let greatest = |a: f64, b: f64, c: f64| greater(greater(a.abs(), b.abs()), c.abs());
        // Filled in place: a copy of all axes costs more than what is in it.
        let mut found = Self {
            axes: [AxisBounds::NONE; AXIS_COUNT],
            count: 0,
            curve: 0.0,
            twist: 0.0,
            steepest: 0.0,
            departure,
        };
        for axis in 0..AXIS_COUNT {
            if !moving.contains(axis) {
                continue;
            }
            let time = times[axis];
            let second = greatest(start.second[axis], middle.second[axis], end.second[axis]);
            let third = greatest(start.third[axis], middle.third[axis], end.third[axis]);
            if let Some(bounds) = found.axes.get_mut(found.count) {
                *bounds = AxisBounds {
                    first: greatest(start.first[axis], middle.first[axis], end.first[axis]),
                    second,
                    third,
                    time,
                };
            }
            found.count += 1;
            found.curve = greater(found.curve, second * time);
            found.twist = greater(found.twist, third);
            found.steepest = greater(found.steepest, second);
        }
        found.curve = found.curve / 3.0 + departure[0];
        found.twist += departure[1];
        found
    }

    fn axes(&self) -> impl Iterator<Item = &AxisBounds> {
        self.axes.iter().take(self.count)
    }

    /// `cap`, lowered to where curvature and its change take no more than their shares.
    #[inline]
    fn lowered_cap(&self, mut cap: f64, shares: &Shares) -> f64 {
        if self.curve * cap > shares.curve {
            cap = shares.curve / self.curve;
        }
        if self.twist * cap * cap.sqrt() > shares.twist {
            let root = cube_root(shares.twist / self.twist);
            cap = root * root;
        }
        cap
    }

    /// What is left for the acceleration along the path at the cap, and at rest.
    #[inline]
    fn accelerations(&self, cap: f64, margin: f64) -> [f64; 2] {
        let (mut at_cap, mut at_rest) =
            (PathBounds::NONE.acceleration, PathBounds::NONE.acceleration);
        for bounds in self.axes() {
            let slope = bounds.first * bounds.time;
            let left = margin - (bounds.second * bounds.time / 3.0 + self.departure[0]) * cap;
            if at_cap * slope > left {
                at_cap = left / slope;
            }
            if at_rest * slope > margin {
                at_rest = margin / slope;
            }
        }
        [at_cap, at_rest]
    }

    /// The same for the jerk, where the machine accelerates as `accelerations` say.
    #[inline]
    fn jerks(&self, cap: f64, shares: &Shares, accelerations: [f64; 2]) -> [f64; 2] {
        let v = cap.sqrt();
        let margin = shares.margin;
        let [acceleration, acceleration_at_rest] = accelerations;
        let (mut at_cap, mut at_rest) = (PathBounds::NONE.jerk, PathBounds::NONE.jerk);
        for bounds in self.axes() {
            let across = lesser(shares.across, bounds.second * acceleration * v);
            let left = margin - (bounds.third + self.departure[1]) * cap * v - across;
            if at_cap * bounds.first > left {
                at_cap = left / bounds.first;
            }
            let across = lesser(shares.across, bounds.second * acceleration_at_rest * v);
            let left = margin - across;
            if at_rest * bounds.first > left {
                at_rest = left / bounds.first;
            }
        }
        [at_cap, at_rest]
    }
}

/// Limits along the path in one interval.
///
/// What curvature takes of an axis grows with the speed. What it leaves is the least of several
/// falling straight lines, over b of the acceleration and over b^1.5 of the jerk, and so nowhere less
/// than on the straight line from what it leaves at rest to what it leaves at the cap.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathBounds {
    /// Of b = v^2.
    pub cap: f64,
    /// Of a^2 v^2.
    pub across: f64,
    /// Of the amount of acceleration, at the cap.
    acceleration: f64,
    /// The same at rest.
    acceleration_at_rest: f64,
    /// By what the acceleration falls with b.
    acceleration_fall: f64,
    /// Of the amount of jerk, at the cap.
    jerk: f64,
    /// The same at rest.
    jerk_at_rest: f64,
    /// By what the jerk falls with b^1.5.
    jerk_fall: f64,
}

impl PathBounds {
    /// An interval that limits nothing: what is beyond the ends of a plan.
    pub const NONE: Self = Self {
        cap: 1e30,
        across: 1e60,
        acceleration: 1e30,
        acceleration_at_rest: 1e30,
        acceleration_fall: 0.0,
        jerk: 1e30,
        jerk_at_rest: 1e30,
        jerk_fall: 0.0,
    };

    /// Of an interval with these samples.
    pub fn of(
        rows: &AxisRows,
        interval: &IntervalSamples,
        raise_squared: f64,
        shares: &Shares,
    ) -> Self {
        let moving = MovingBounds::of(rows, interval);
        let least_cap = CAP_SHARE * interval.least_cap(raise_squared);
        let cap = moving.lowered_cap(lesser(Self::NONE.cap, least_cap), shares);
        let accelerations = moving.accelerations(cap, shares.margin);
        let [acceleration, acceleration_at_rest] = accelerations;
        let [jerk, jerk_at_rest] = moving.jerks(cap, shares, accelerations);
        let across = if moving.steepest > 0.0 {
            (shares.across / moving.steepest) * (shares.across / moving.steepest)
        } else {
            Self::NONE.across
        };
        Self {
            cap,
            across,
            acceleration,
            acceleration_at_rest,
            acceleration_fall: (acceleration_at_rest - acceleration).max(0.0) / cap,
            jerk,
            jerk_at_rest,
            jerk_fall: (jerk_at_rest - jerk).max(0.0) / (cap * cap.sqrt()),
        }
    }

    /// The greatest slope of coefficients from one that is `b` to the next, `distance` farther.
    #[inline]
    pub fn acceleration(&self, b: f64, distance: f64) -> f64 {
        let fall = self.acceleration_fall;
        // Of what curvature leaves where b has grown by acceleration times distance.
        let most = (self.acceleration_at_rest - fall * b) / (1.0 + fall * distance);
        greater(self.acceleration, most)
    }

    /// The greatest change of acceleration with s where v^2 is `b`, greater than 0.
    #[inline]
    pub fn bend(&self, b: f64) -> f64 {
        let inverse = 1.0 / b.sqrt();
        greater(
            self.jerk * inverse,
            self.jerk_at_rest * inverse - self.jerk_fall * b,
        )
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::departure::Departure;
    use super::super::sample::{Cap, Sample};
    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::machine_map::MachineMap;

    fn any_axes(size: f64) -> impl Strategy<Value = Axes> {
        let amount = move || prop_oneof![0.01 * size..size, -size..-0.01 * size];
        [amount(), amount(), amount()]
            .prop_map(|[x, y, z]| Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
    }

    fn any_sample() -> impl Strategy<Value = Sample> {
        (any_axes(1e-4), any_axes(1e-5), any_axes(1e-6), 10.0..1e4f64).prop_map(
            |(first, second, third, cap)| {
                let mut axes = MovingAxes::NONE;
                (0..3).for_each(|axis| axes.add(axis));
                Sample {
                    first,
                    second,
                    third,
                    axes,
                    cap: Cap::of(cap, 2.0 * cap),
                    ..Sample::NONE
                }
            },
        )
    }

    fn any_interval() -> impl Strategy<Value = IntervalSamples> {
        let departure = (0.0..1e-5f32, 0.0..1e-8f32);
        ([any_sample(), any_sample(), any_sample()], departure).prop_map(
            |([start, middle, end], (second, third))| IntervalSamples {
                quarters: [middle.cap; 2],
                start,
                middle,
                end,
                departure: Departure { second, third },
            },
        )
    }

    /// Of an axis' rows in an interval and its departures: what acceleration and jerk take at most, over their limits.
    fn taken(axis: &AxisBounds, departure: [f64; 2], across: f64, [b, a, u]: [f64; 3]) -> [f64; 2] {
        let v = b.sqrt();
        let acceleration = (axis.first * a + axis.second * b / 3.0) * axis.time + departure[0] * b;
        let jerk = axis.first * u
            + (axis.second * a * v).min(across)
            + (axis.third + departure[1]) * b * v;
        [acceleration, jerk]
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// All terms together keep the limits, and those that limit are used up.
        #[test]
        fn what_is_left_of_the_limits_is_handed_out(
            interval in any_interval(),
            jerks in prop::array::uniform3(1e3..1e6f64),
            (curve, twist, across) in (0.5..0.9f64, 0.4..0.6f64, 0.2..0.35f64),
        ) {
            let jerk = Axes::from_fn(|axis, _| jerks[axis % 3]);
            let limits = AxisLimits {
                velocity: Axes::repeat(100.0),
                acceleration: Axes::repeat(1000.0),
                jerk,
            };
            let rows = AxisRows::new(&limits, &MachineMap::IDENTITY, 1e-3);
            let shares = Shares { margin: 0.97, curve, twist, across };
            let bounds = PathBounds::of(&rows, &interval, 1.0, &shares);
            let departure = [interval.departure.second, interval.departure.third].map(f64::from);
            let greatest = |row: fn(&Sample) -> &Axes, axis: usize| {
                interval.places().iter().map(|sample| row(sample)[axis].abs()).fold(0.0, f64::max)
            };
            let axes = [0, 1, 2].map(|axis| AxisBounds {
                first: greatest(|sample| &sample.first, axis),
                second: greatest(|sample| &sample.second, axis),
                third: greatest(|sample| &sample.third, axis),
                time: rows.jerk_time()[axis],
            });
            prop_assert!(bounds.cap <= interval.least_cap(1.0));
            let at_cap = [bounds.cap, bounds.acceleration, bounds.jerk];
            let at_rest = [0.0, bounds.acceleration_at_rest, bounds.jerk_at_rest];
            for (state, v) in [(at_cap, bounds.cap.sqrt()), (at_rest, 0.0)] {
                let taken = axes.map(|axis| taken(&axis, departure, across, state));
                for kind in 0..2 {
                    let most = taken.iter().map(|taken| taken[kind]).fold(0.0, f64::max);
                    prop_assert!(most < 0.97 + 1e-9, "{kind} at {v}: {most}");
                    // At rest what accelerating across will take is set aside already.
                    let least = if kind == 1 && v == 0.0 { 0.97 - across } else { 0.97 };
                    prop_assert!(most > least - 1e-9, "{kind} at {v}: {most}");
                }
            }
            // On straight lines from rest to the cap.
            for share in [0.0, 0.3, 0.8, 1.0] {
                let between = |at_rest: f64, at_cap: f64| at_rest + share * (at_cap - at_rest);
                let near = |one: f64, other: f64, at_rest: f64| (one - other).abs() < 1e-9 * at_rest;
                let b = share * bounds.cap;
                let acceleration = between(bounds.acceleration_at_rest, bounds.acceleration);
                let at_rest = bounds.acceleration_at_rest;
                prop_assert!(near(bounds.acceleration(b, 0.0), acceleration, at_rest));
                let v = bounds.cap.sqrt() * share.cbrt();
                let jerk = between(bounds.jerk_at_rest.max(bounds.jerk), bounds.jerk);
                let bend = bounds.bend(v * v) * v;
                prop_assert!(v == 0.0 || near(bend, jerk, bounds.jerk_at_rest.max(bounds.jerk)));
            }
        }
    }
}
